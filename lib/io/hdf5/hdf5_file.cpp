#include "io/hdf5/hdf5_file.h"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/mapped_file.h"
#include "base/threads.h"
#include "io/file/json_text.h"
#include "io/file/row_file.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/hdf5_open.h"

namespace st {
namespace {

constexpr const char* kChecksum = "xxh3";
constexpr const char* kRoot = "/st";
// Attributes of /st that say where the artifact comes from, not what it says of the model.
const std::set<std::string> kProvenance = {"content_hash", "geometry_hash", "tool",
                                           "tool_version", "options",       "inputs"};
// Larger arrays start at a multiple of kAlignment, so that they can be used where they are mapped.
constexpr hsize_t kAlignmentThreshold = 1024, kAlignment = 64;

/// Closes an HDF5 id at the end of its scope.
template <herr_t (*Close)(hid_t)>
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id) : id_(id) {}  // NOLINT: made to be assigned from the C API
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  operator hid_t() const { return id_; }
  bool is_valid() const { return id_ >= 0; }
  /// Closes now; false when that failed.
  bool reset() { return id_ < 0 || Close(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
};
using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Attribute = Handle<H5Aclose>;
using Properties = Handle<H5Pclose>;

// HDF5 1.10 keeps a file whose closing failed (disk full) and crashes over it at exit. Its clean-up is not needed:
// every file is closed by its handle.
[[maybe_unused]] const herr_t kNoCleanUp = H5dont_atexit();

/// HDF5 prints its error stack unless told not to, per thread.
void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hid_t native_type(ElementType type) {
  switch (type) {
    case ElementType::kFloat64:
      return H5T_NATIVE_DOUBLE;
    case ElementType::kFloat32:
      return H5T_NATIVE_FLOAT;
    case ElementType::kInt32:
      return H5T_NATIVE_INT32;
    case ElementType::kInt64:
      return H5T_NATIVE_INT64;
    case ElementType::kUint8:
      return H5T_NATIVE_UINT8;
    case ElementType::kUint64:
      return H5T_NATIVE_UINT64;
    case ElementType::kString:
      break;
  }
  throw Error(ExitCode::kInternal, "no HDF5 type for strings here");
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x80; });
}

/// Fixed-length string type, at least one byte.
Type fixed_string(std::size_t length, bool ascii) {
  Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, std::max<std::size_t>(1, length));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  return type;
}

/// The character set stays ASCII although the bytes are UTF-8: VTK 9.1 asks for it, and HDF5 does not convert.
Type variable_string() {
  Type type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, H5T_VARIABLE);
  return type;
}

std::string up_to_nul(const char* text, std::size_t max_length) { return std::string(text, strnlen(text, max_length)); }

std::string checksum_of(const std::vector<std::string>& values) {
  Hasher hasher;
  for (const std::string& value : values) hasher.add(std::string_view(value));
  return hasher.hex();
}

/// The value of an attribute, as hashed: a kind and the bytes.
struct AttributeValue {
  char kind = 's';  // s string, i integers, d double
  std::string bytes;
};
using AttributeKey = std::pair<std::string, std::string>;  // group, name

/// Hash of everything that the artifact says of the model: datasets and attributes by name, provenance apart.
std::string content_hash(const std::vector<DatasetInfo>& datasets_by_name,
                         const std::map<AttributeKey, AttributeValue>& attributes) {
  Hasher hasher;
  for (const DatasetInfo& d : datasets_by_name) {
    if (is_provenance(d.name)) continue;
    hasher.add(std::string_view(d.name));
    hasher.add(std::string_view(element_type_name(d.type)));
    hasher.add(std::span<const std::uint64_t>(d.shape));
    hasher.add(std::string_view(d.checksum));
  }
  for (const auto& [key, value] : attributes) {
    if (key.first == kRoot && kProvenance.count(key.second)) continue;
    hasher.add(std::string_view(key.first));
    hasher.add(std::string_view(key.second));
    hasher.add(&value.kind, 1);
    hasher.add(std::string_view(value.bytes));
  }
  return hasher.hex();
}

nlohmann::json inputs_to_json(const std::vector<InputRef>& inputs) {
  nlohmann::json list = nlohmann::json::array();
  for (const InputRef& input : inputs)
    list.push_back({{"role", input.role}, {"name", input.name}, {"hash", input.hash}});
  return list;
}

/// A text in a JSON object; "" when there is none, or it is no text.
std::string text_of(const nlohmann::json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : "";
}

/// "st-import" for "geometry": the tool to run again.
std::string tool_of(const std::string& schema) {
  static const std::map<std::string, std::string> tools = {{"geometry", "st-import"},
                                                           {"raster", "st-raster"},
                                                           {"sizing", "st-prolong"},
                                                           {"patches", "st-mesh"},
                                                           {"mesh", "st-merge"}};
  const auto it = tools.find(schema);
  return it == tools.end() ? "the tool that made it" : it->second;
}

}  // namespace

bool is_provenance(const std::string& dataset) { return dataset.ends_with("/previous_id"); }

const char* element_type_name(ElementType type) {
  constexpr const char* kNames[] = {"float64", "float32", "int32", "int64", "uint8", "uint64", "string"};
  return kNames[static_cast<int>(type)];
}

// -------------------------------------------------------------------------------- writer

struct AppendedRows;

struct Hdf5Writer::Impl {
  explicit Impl(const std::string& path) : temporary(path) {}
  TemporaryFile temporary;
  File file;
  std::map<std::string, Group> groups;
  std::vector<DatasetInfo> datasets;
  std::map<AttributeKey, AttributeValue> attributes;

  [[noreturn]] void fail(const std::string& what) const {
    const std::string cause = errno ? std::string(" (") + std::strerror(errno) + ")" : "";
    throw Error(ExitCode::kOutput,
                temporary.path() + ": " + what + cause + "; free some space or choose another directory");
  }
  void require(bool ok, const std::string& what) const {
    if (!ok) fail("cannot write " + what);
  }
  hid_t group(const std::string& name);
  void write_attribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* value) const;
  void set(const std::string& group_name, const std::string& name, AttributeValue value);
  Dataset create_dataset(const std::string& name, hid_t type, hid_t space);
  void write_checksum(hid_t dataset, const std::string& checksum) const;
  void finish_dataset(hid_t dataset, DatasetInfo info);
  void add_writes(hid_t dataset, const std::string& name, std::span<const std::byte> bytes,
                  std::vector<std::function<void()>>& jobs);
  std::uint64_t rows_begin(hid_t dataset, const std::string& name);
  void flush_rows(AppendedRows& rows) const;
  void hash_elsewhere(AppendedRows& rows) const;
  void end_rows();

  std::optional<RowFile> rows_file;  // the temporary file once more, for rows
  std::vector<std::unique_ptr<AppendedRows>> appended;
};

/// A dataset whose rows come one after the other.
struct AppendedRows {
  Dataset dataset;
  DatasetInfo info;
  std::uint64_t at = 0, end = 0;  // in the file: of the next bytes, of the last
  bool is_elsewhere = false;      // others write them
  std::vector<std::byte> waiting;
  Hasher hasher;
};

/// The group `name` ("/a/b"), made as needed, parents first. Attributes and links stay inside the object headers.
hid_t Hdf5Writer::Impl::group(const std::string& name) {
  const auto it = groups.find(name);
  if (it != groups.end()) return it->second;
  const std::size_t slash = name.rfind('/');
  if (slash == std::string::npos) throw Error(ExitCode::kInternal, name + ": not an absolute path");
  if (slash > 0) group(name.substr(0, slash));
  const Properties creation(H5Pcreate(H5P_GROUP_CREATE));
  H5Pset_obj_track_times(creation, false);
  H5Pset_link_phase_change(creation, 256, 128);
  H5Pset_attr_phase_change(creation, 256, 128);
  Group made(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT));
  require(made.is_valid(), name);
  return groups.emplace(name, std::move(made)).first->second;
}

void Hdf5Writer::Impl::write_attribute(hid_t object, const std::string& name, hid_t type, hid_t space,
                                       const void* value) const {
  const Attribute attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  require(attribute.is_valid() && H5Awrite(attribute, type, value) >= 0, "attribute " + name);
}

void Hdf5Writer::Impl::set(const std::string& group_name, const std::string& name, AttributeValue value) {
  const hid_t object = group(group_name);
  if (value.kind == 's') {
    const Type type = fixed_string(value.bytes.size(), is_ascii(value.bytes));
    const Space space(H5Screate(H5S_SCALAR));
    write_attribute(object, name, type, space, value.bytes.c_str());
  } else {
    const hsize_t n = value.bytes.size() / 8;
    const Space space(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr));
    write_attribute(object, name, value.kind == 'd' ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64, space, value.bytes.data());
  }
  attributes[{group_name, name}] = std::move(value);
}

Dataset Hdf5Writer::Impl::create_dataset(const std::string& name, hid_t type, hid_t space) {
  errno = 0;
  group(name.substr(0, name.rfind('/')));
  const Properties creation(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_layout(creation, H5D_CONTIGUOUS);
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  H5Pset_obj_track_times(creation, false);
  if (H5Tis_variable_str(type) <= 0) H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);  // refused for variable length
  Dataset dataset(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  require(dataset.is_valid(), name);
  return dataset;
}

void Hdf5Writer::Impl::write_checksum(hid_t dataset, const std::string& checksum) const {
  const Type type = fixed_string(checksum.size(), true);
  const Space space(H5Screate(H5S_SCALAR));
  write_attribute(dataset, kChecksum, type, space, checksum.c_str());
}

void Hdf5Writer::Impl::finish_dataset(hid_t dataset, DatasetInfo info) {
  write_checksum(dataset, info.checksum);
  datasets.push_back(std::move(info));
}

Hdf5Writer::Hdf5Writer(const std::string& path, const ArtifactHeader& header) {
  silence_hdf5();
  impl_ = std::make_unique<Impl>(path);
  const Properties creation(H5Pcreate(H5P_FILE_CREATE)), access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_obj_track_times(creation, false);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);  // its metadata carries checksums of its own
  H5Pset_alignment(access, kAlignmentThreshold, kAlignment);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_file_locking(access, false, true);
  errno = 0;
  impl_->file = H5Fcreate(impl_->temporary.name().c_str(), H5F_ACC_TRUNC, creation, access);
  if (!impl_->file.is_valid()) impl_->fail("cannot be created");
  set_attribute(kRoot, "schema", header.schema);
  set_attribute(kRoot, "schema_version", std::int64_t{header.schema_version});
  set_attribute(kRoot, "unit", header.unit);
  if (header.unit_in_m) set_attribute(kRoot, "unit_in_m", *header.unit_in_m);
  set_attribute(kRoot, "tool", header.tool);
  set_attribute(kRoot, "tool_version", header.tool_version);
  set_attribute(kRoot, "options", header.options_json);
  set_attribute(kRoot, "inputs", json_text(inputs_to_json(header.inputs)));
  set_attribute(kRoot, "geometry_hash", header.geometry_hash);
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::write_raw(const std::string& name, ElementType type, const void* values, std::size_t n_elements,
                           std::size_t columns) {
  if (columns == 0 || n_elements % columns != 0)
    throw Error(ExitCode::kInternal,
                name + ": " + std::to_string(n_elements) + " values are not rows of " + std::to_string(columns));
  const std::span bytes(static_cast<const std::byte*>(values), n_elements * element_size(type));
  const hsize_t dims[2] = {n_elements / columns, columns};
  const Space space(H5Screate_simple(columns == 1 ? 1 : 2, dims, nullptr));
  const Dataset dataset = impl_->create_dataset(name, native_type(type), space);
  std::string checksum;
  std::vector<std::function<void()>> jobs = {[&] {
    Hasher hasher;
    hasher.add(bytes.data(), bytes.size());
    checksum = hasher.hex();
  }};
  if (!bytes.empty()) impl_->add_writes(dataset, name, bytes, jobs);
  run_jobs(jobs);
  DatasetInfo info{name, type, {dims[0]}, checksum, false};
  if (columns != 1) info.shape.push_back(columns);
  impl_->finish_dataset(dataset, std::move(info));
}

/// Where the rows lie in the file, which is open for them.
std::uint64_t Hdf5Writer::Impl::rows_begin(hid_t dataset, const std::string& name) {
  const haddr_t begin = H5Dget_offset(dataset);
  require(begin != HADDR_UNDEF, name);
  if (!rows_file) rows_file.emplace(temporary.name(), temporary.path());
  return begin;
}

std::size_t Hdf5Writer::begin_rows(const std::string& name, ElementType type, std::size_t n_rows, std::size_t columns) {
  const hsize_t dims[2] = {n_rows, columns};
  const Space space(H5Screate_simple(columns == 1 ? 1 : 2, dims, nullptr));
  auto rows = std::make_unique<AppendedRows>();
  rows->dataset = impl_->create_dataset(name, native_type(type), space);
  rows->info = {name, type, {n_rows}, Hasher().hex(), false};
  if (columns != 1) rows->info.shape.push_back(columns);
  if (n_rows > 0) rows->at = impl_->rows_begin(rows->dataset, name);
  rows->end = rows->at + n_rows * columns * element_size(type);
  impl_->write_checksum(rows->dataset, rows->info.checksum);  // its place; the value follows
  impl_->appended.push_back(std::move(rows));
  return impl_->appended.size() - 1;
}

std::uint64_t Hdf5Writer::rows_elsewhere(std::size_t dataset) {
  AppendedRows& rows = *impl_->appended.at(dataset);
  rows.is_elsewhere = true;
  return rows.at;
}

const std::string& Hdf5Writer::temporary_name() const { return impl_->temporary.name(); }

void Hdf5Writer::append_bytes(std::size_t dataset, std::span<const std::byte> bytes) {
  constexpr std::size_t kWorthWriting = std::size_t{1} << 20;
  AppendedRows& rows = *impl_->appended.at(dataset);
  while (!bytes.empty()) {
    const auto some = bytes.first(std::min(bytes.size(), kWorthWriting - rows.waiting.size()));
    rows.waiting.insert(rows.waiting.end(), some.begin(), some.end());
    bytes = bytes.subspan(some.size());
    if (rows.waiting.size() >= kWorthWriting) impl_->flush_rows(rows);
  }
}

void Hdf5Writer::Impl::flush_rows(AppendedRows& rows) const {
  if (rows.waiting.size() > rows.end - rows.at)
    throw Error(ExitCode::kInternal, rows.info.name + ": more rows than were announced");
  rows.hasher.add(std::span<const std::byte>(rows.waiting));
  rows_file->write(rows.at, rows.waiting, rows.info.name);
  rows.at += rows.waiting.size();
  rows.waiting.clear();
}

/// By what is in the file.
void Hdf5Writer::Impl::hash_elsewhere(AppendedRows& rows) const {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  const int file = open(temporary.name().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  std::vector<std::byte> piece(std::min<std::uint64_t>(kPiece, rows.end - rows.at));
  ssize_t n = file < 0 ? -1 : 1;
  for (; n > 0 && rows.at < rows.end; rows.at += static_cast<std::uint64_t>(n)) {
    const std::size_t n_wanted = std::min<std::uint64_t>(piece.size(), rows.end - rows.at);
    n = pread(file, piece.data(), n_wanted, static_cast<off_t>(rows.at));
    if (n > 0) rows.hasher.add(piece.data(), static_cast<std::size_t>(n));
  }
  if (file >= 0) close(file);
  require(n > 0, rows.info.name);
}

void Hdf5Writer::Impl::end_rows() {
  std::vector<std::function<void()>> jobs;
  for (const auto& rows : appended)
    if (rows->is_elsewhere && rows->at < rows->end) jobs.emplace_back([&] { hash_elsewhere(*rows); });
  run_jobs(jobs);
  for (const auto& rows : appended) {
    flush_rows(*rows);
    if (rows->at != rows->end) throw Error(ExitCode::kInternal, rows->info.name + ": fewer rows than were announced");
    rows->info.checksum = rows->hasher.hex();
    const Attribute attribute(H5Aopen(rows->dataset, kChecksum, H5P_DEFAULT));
    const Type type = fixed_string(rows->info.checksum.size(), true);
    require(attribute.is_valid() && H5Awrite(attribute, type, rows->info.checksum.c_str()) >= 0, rows->info.name);
    datasets.push_back(rows->info);
  }
  appended.clear();
}

/// Jobs that write the rows of a dataset. Its place in the file is known: they go there past HDF5, which has one
/// thread.
void Hdf5Writer::Impl::add_writes(hid_t dataset, const std::string& name, std::span<const std::byte> bytes,
                                  std::vector<std::function<void()>>& jobs) {
  constexpr std::size_t kPerJob = std::size_t{4} << 20;
  const std::uint64_t begin = rows_begin(dataset, name);
  for (std::size_t at = 0; at < bytes.size(); at += kPerJob)
    jobs.emplace_back([this, name, begin, at, some = bytes.subspan(at, std::min(kPerJob, bytes.size() - at))] {
      rows_file->write(begin + at, some, name);
    });
}

void Hdf5Writer::write_strings(const std::string& name, const std::vector<std::string>& values) {
  std::size_t width = 1;
  for (const std::string& value : values) width = std::max(width, value.size());
  std::vector<char> padded(values.size() * width, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(padded.data() + i * width, values[i].data(), values[i].size());
  std::vector<std::string> stored(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) stored[i] = up_to_nul(padded.data() + i * width, width);
  const hsize_t n = values.size();
  const Space space(H5Screate_simple(1, &n, nullptr));
  const Type type = fixed_string(width, false);
  const Dataset dataset = impl_->create_dataset(name, type, space);
  if (n) impl_->require(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) >= 0, name);
  impl_->finish_dataset(dataset, {name, ElementType::kString, {n}, checksum_of(stored), false});
}

void Hdf5Writer::write_vtk_strings(const std::string& name, const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  std::vector<std::string> stored;
  for (const std::string& value : values) {
    pointers.push_back(value.c_str());
    stored.emplace_back(value.c_str());
  }
  const hsize_t n = values.size();
  const Space space(H5Screate_simple(1, &n, nullptr));
  const Type type = variable_string();
  const Dataset dataset = impl_->create_dataset(name, type, space);
  if (n) impl_->require(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0, name);
  impl_->finish_dataset(dataset, {name, ElementType::kString, {n}, checksum_of(stored), true});
}

void Hdf5Writer::set_attribute(const std::string& group, const std::string& name, const std::string& value) {
  impl_->set(group, name, {'s', value.c_str()});  // NOLINT(readability-redundant-string-cstr): to the first NUL, as
                                                  // HDF5 reads it
}
void Hdf5Writer::set_attribute(const std::string& group, const std::string& name, std::int64_t value) {
  impl_->set(group, name, {'i', std::string(reinterpret_cast<const char*>(&value), sizeof value)});
}
void Hdf5Writer::set_attribute(const std::string& group, const std::string& name, double value) {
  impl_->set(group, name, {'d', std::string(reinterpret_cast<const char*>(&value), sizeof value)});
}
void Hdf5Writer::set_attribute(const std::string& group, const std::string& name,
                               const std::vector<std::int64_t>& values) {
  impl_->set(group, name,
             {'i', std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(std::int64_t))});
}

std::string Hdf5Writer::commit() {
  impl_->end_rows();
  std::sort(impl_->datasets.begin(), impl_->datasets.end(),
            [](const DatasetInfo& a, const DatasetInfo& b) { return a.name < b.name; });
  std::string hash = content_hash(impl_->datasets, impl_->attributes);
  errno = 0;
  set_attribute(kRoot, "content_hash", hash);
  impl_->groups.clear();
  impl_->require(H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) >= 0, "the file");
  impl_->require(impl_->file.reset(), "the file");
  impl_->temporary.commit();
  return hash;
}

// -------------------------------------------------------------------------------- reader

namespace {

/// A file must exist, be a regular file, and start like HDF5.
void require_hdf5_file(const std::string& path) {
  const auto fail = [&](const std::string& what) { throw Error(ExitCode::kInput, path + ": " + what); };
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) {
    if (errno == ENOENT) fail("no such file; check the name");
    fail(std::string("cannot be opened (") + std::strerror(errno) + "); check the name and its permissions");
  }
  if (S_ISDIR(info.st_mode)) fail("is a directory; give an artifact (.hdf)");
  if (!S_ISREG(info.st_mode)) fail("is not a regular file; give an artifact (.hdf)");
  if (info.st_size == 0) fail("is empty; make it again with the tool that should have written it");
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) fail(std::string("cannot be opened (") + std::strerror(errno) + "); check its permissions");
  char start[8] = {};
  const ssize_t n = read(fd, start, sizeof start);
  close(fd);
  if (n != 8 || std::memcmp(start, "\211HDF\r\n\032\n", 8) != 0)
    fail("is not an artifact (no HDF5 file); give a .hdf file that an st tool wrote");
}

std::optional<ElementType> element_type_of(hid_t type) {
  if (H5Tget_class(type) == H5T_STRING) return ElementType::kString;
  for (const ElementType t : {ElementType::kFloat64, ElementType::kFloat32, ElementType::kInt32, ElementType::kInt64,
                              ElementType::kUint8, ElementType::kUint64})
    if (H5Tequal(type, native_type(t)) > 0) return t;
  return std::nullopt;
}

/// The value, unless it is of another type or claims more than `max_bytes`.
std::optional<AttributeValue> read_attribute(hid_t attribute, std::uint64_t max_bytes) {
  const Type type(H5Aget_type(attribute));
  const Space space(H5Aget_space(attribute));
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  if (!type.is_valid() || n < 0 || n > 64) return std::nullopt;
  AttributeValue value;
  if (H5Tget_class(type) == H5T_STRING) {
    if (n != 1 || H5Tis_variable_str(type) != 0 || H5Tget_size(type) > max_bytes) return std::nullopt;
    value.bytes.resize(H5Tget_size(type));
    if (H5Aread(attribute, type, value.bytes.data()) < 0) return std::nullopt;
    value.bytes = up_to_nul(value.bytes.data(), value.bytes.size());
    return value;
  }
  value.kind = H5Tget_class(type) == H5T_FLOAT ? 'd' : 'i';
  const hid_t memory_type = value.kind == 'd' ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
  if (H5Tequal(type, memory_type) <= 0) return std::nullopt;
  value.bytes.resize(8 * n);
  if (H5Aread(attribute, memory_type, value.bytes.data()) < 0) return std::nullopt;
  return value;
}

}  // namespace

struct Hdf5Reader::Impl {
  std::string path;
  File file;
  std::uint64_t file_bytes = 0;
  int n_objects = 0;  // listed so far
  ArtifactHeader header;
  std::vector<DatasetInfo> datasets;
  std::map<AttributeKey, AttributeValue> attributes;

  [[noreturn]] void damaged(const std::string& what) const {
    throw Error(ExitCode::kInput, path + ": " + what + "; the file is damaged or incomplete: make it again with " +
                                      tool_of(header.schema));
  }
  void open();
  void require_schema(const std::string& schema, int newest_version) const;
  void read_contents();
  void read_group(const std::string& name, int depth);
  void read_attributes(hid_t group, const std::string& name);
  void read_dataset_info(const std::string& name);
  void read_header();
  std::string text(const std::string& name, bool required = true) const;
  const DatasetInfo* find(const std::string& name) const;
};

void Hdf5Reader::Impl::open() {
  require_hdf5_file(path);
  file = open_hdf5(path);
  if (!file.is_valid()) damaged("cannot be opened as HDF5");
  hsize_t size = 0;
  if (H5Fget_filesize(file, &size) < 0) damaged("has no size");
  file_bytes = size;
  if (H5Lexists(file, kRoot, H5P_DEFAULT) <= 0)
    throw Error(
        ExitCode::kInput,
        path + ": is HDF5, but no artifact of an st tool (no group /st); give a .hdf file that an st tool wrote");
  read_attributes(Group(H5Gopen2(file, kRoot, H5P_DEFAULT)), kRoot);
  read_header();
}

void Hdf5Reader::Impl::require_schema(const std::string& schema, int newest_version) const {
  const std::string version = std::to_string(header.schema_version), newest = std::to_string(newest_version);
  if (header.schema != schema)
    throw Error(ExitCode::kInput, path + ": is a " + header.schema + " artifact, but a " + schema +
                                      " artifact is needed; give the file that " + tool_of(schema) + " wrote");
  if (header.schema_version > newest_version)
    throw Error(ExitCode::kInput,
                path + ": " + schema + " schema version " + version + " is newer than this tool knows (" + newest +
                    "); use the version of st that wrote it (" + header.tool_version + ") or a newer one");
}

/// Lists everything and compares it with the content hash.
void Hdf5Reader::Impl::read_contents() {
  read_group("", 0);
  std::sort(datasets.begin(), datasets.end(),
            [](const DatasetInfo& a, const DatasetInfo& b) { return a.name < b.name; });
  if (content_hash(datasets, attributes) != header.content_hash) damaged("its parts do not fit its content hash");
}

/// Lists datasets and attributes below a group. Depth and number of parts bound what a malformed file can do.
void Hdf5Reader::Impl::read_group(const std::string& name, int depth) {
  constexpr int kMaxDepth = 8, kMaxObjects = 10000;
  const std::string path_name = name.empty() ? "/" : name;
  if (depth > kMaxDepth) damaged(path_name + ": groups too deep");
  const Group group(H5Gopen2(file, path_name.c_str(), H5P_DEFAULT));
  read_attributes(group, path_name);
  const auto names = link_names(group, kMaxObjects);
  if (!names) damaged("group " + path_name + " cannot be listed, or has more than 10000 parts");
  for (const std::string& child : *names) {
    if (++n_objects > kMaxObjects) damaged("has more than " + std::to_string(kMaxObjects) + " parts");
    if (const std::string defect = link_defect(group, child, Hdf5Origin::kArtifact); !defect.empty())
      damaged(name + "/" + child + " " + defect);
    const Handle<H5Oclose> object(H5Oopen(group, child.c_str(), H5P_DEFAULT));
    if (!object.is_valid()) damaged(name + "/" + child + " cannot be opened");
    if (H5Iget_type(object) == H5I_GROUP) read_group(name + "/" + child, depth + 1);
    if (H5Iget_type(object) == H5I_DATASET) read_dataset_info(name + "/" + child);
  }
}

/// `group` may be one that could not be opened.
void Hdf5Reader::Impl::read_attributes(hid_t group, const std::string& name) {
  H5O_info_t info{};
  if (H5Oget_info2(group, &info, H5O_INFO_NUM_ATTRS) < 0) damaged("group " + name + " cannot be read");
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const Attribute attribute(H5Aopen_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_NATIVE, i, H5P_DEFAULT, H5P_DEFAULT));
    char attribute_name[256] = {};
    if (!attribute.is_valid() || H5Aget_name(attribute, sizeof attribute_name, attribute_name) < 0)
      damaged("an attribute of " + name + " cannot be read");
    const auto value = read_attribute(attribute, file_bytes);
    if (!value) damaged("attribute " + std::string(attribute_name) + " of " + name + " cannot be read");
    attributes[{name, attribute_name}] = *value;
  }
}

void Hdf5Reader::Impl::read_dataset_info(const std::string& name) {
  const Dataset dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT));
  const Type type(H5Dget_type(dataset));
  const Space space(H5Dget_space(dataset));
  hsize_t dims[2] = {};
  const int rank = H5Sget_simple_extent_ndims(space);
  const auto element_type = element_type_of(type);
  if (!element_type || rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, dims, nullptr) < 0)
    damaged("dataset " + name + " cannot be read");
  if (const std::string defect = storage_defect(dataset, Hdf5Origin::kArtifact); !defect.empty())
    damaged("dataset " + name + " " + defect);
  DatasetInfo info{name, *element_type, {dims, dims + rank}, "", false};
  const std::size_t bytes_each = std::max<std::size_t>(1, element_size(*element_type));
  if (dims[0] > file_bytes || (rank == 2 && dims[1] > file_bytes) ||
      dims[0] * (rank == 2 ? dims[1] : 1) > file_bytes / bytes_each)
    damaged("dataset " + name + " is larger than the file");
  const Attribute attribute(H5Aopen(dataset, kChecksum, H5P_DEFAULT));
  if (!attribute.is_valid()) damaged("dataset " + name + " has no checksum");
  if (const auto value = read_attribute(attribute, file_bytes)) info.checksum = value->bytes;
  info.is_foreign = H5Tis_variable_str(type) != 0;
  datasets.push_back(std::move(info));
}

std::string Hdf5Reader::Impl::text(const std::string& name, bool required) const {
  const auto it = attributes.find({kRoot, name});
  if (it != attributes.end() && it->second.kind == 's') return it->second.bytes;
  if (required) damaged("attribute /st@" + name + " is missing");
  return "";
}

void Hdf5Reader::Impl::read_header() {
  header.schema = text("schema");
  const auto integer = attributes.find({kRoot, "schema_version"});
  if (integer == attributes.end() || integer->second.kind != 'i') damaged("attribute /st@schema_version is missing");
  std::int64_t version = 0;
  std::memcpy(&version, integer->second.bytes.data(), sizeof version);
  if (version < 1 || version > std::numeric_limits<int>::max())
    damaged("schema version " + std::to_string(version) + " does not exist");
  header.schema_version = static_cast<int>(version);
  header.tool = text("tool", false);
  header.tool_version = text("tool_version", false);
  header.options_json = text("options", false);
  header.unit = text("unit", false);
  const auto unit = attributes.find({kRoot, "unit_in_m"});
  if (unit != attributes.end() && unit->second.kind == 'd')
    std::memcpy(&header.unit_in_m.emplace(), unit->second.bytes.data(), sizeof(double));
  header.content_hash = text("content_hash");
  header.geometry_hash = text("geometry_hash", false);
  const auto inputs = nlohmann::json::parse(text("inputs", false), nullptr, false);
  if (inputs.is_array())
    for (const auto& input : inputs)
      if (input.is_object())
        header.inputs.push_back({text_of(input, "role"), text_of(input, "name"), text_of(input, "hash")});
}

const DatasetInfo* Hdf5Reader::Impl::find(const std::string& name) const {
  const auto it = std::lower_bound(datasets.begin(), datasets.end(), name,
                                   [](const DatasetInfo& d, const std::string& n) { return d.name < n; });
  return it != datasets.end() && it->name == name ? &*it : nullptr;
}

Hdf5Reader::Hdf5Reader(const std::string& path) : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  impl_->open();
  impl_->read_contents();
}

Hdf5Reader::Hdf5Reader(const std::string& path, const std::string& schema, int newest_version)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  impl_->open();
  impl_->require_schema(schema, newest_version);
  impl_->read_contents();
}

Hdf5Reader::~Hdf5Reader() = default;

const std::string& Hdf5Reader::path() const { return impl_->path; }
const ArtifactHeader& Hdf5Reader::header() const { return impl_->header; }
const std::vector<DatasetInfo>& Hdf5Reader::datasets() const { return impl_->datasets; }
bool Hdf5Reader::has(const std::string& name) const { return impl_->find(name) != nullptr; }

const DatasetInfo& Hdf5Reader::info(const std::string& name) const {
  const DatasetInfo* found = impl_->find(name);
  if (!found) fail(name, "is missing");
  return *found;
}

void Hdf5Reader::fail(const std::string& dataset, const std::string& what) const {
  impl_->damaged(dataset + ": " + what);
}

std::size_t Hdf5Reader::count_elements(const std::string& name, ElementType type, std::size_t columns) const {
  const DatasetInfo& d = info(name);
  if (d.type != type) fail(name, std::string("is ") + element_type_name(d.type) + ", not " + element_type_name(type));
  const std::size_t stored_columns = d.shape.size() == 2 ? d.shape[1] : 1;
  if (stored_columns != columns || (columns == 1) != (d.shape.size() == 1))
    fail(name, "has " + std::to_string(stored_columns) + " columns, not " + std::to_string(columns));
  return d.shape[0] * columns;
}

void Hdf5Reader::require_rows(const std::string& name, std::size_t n_rows) const {
  const std::size_t stored = info(name).shape[0];
  if (stored != n_rows) fail(name, "has " + std::to_string(stored) + " rows, not " + std::to_string(n_rows));
}

void Hdf5Reader::read_raw(const std::string& name, void* values) const {
  const DatasetInfo& d = info(name);
  std::size_t n = 1;
  for (const std::uint64_t extent : d.shape) n *= extent;
  if (n) {
    const Dataset dataset(H5Dopen2(impl_->file, name.c_str(), H5P_DEFAULT));
    if (!dataset.is_valid() || H5Dread(dataset, native_type(d.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      fail(name, "cannot be read");
  }
  if (hash_hex(values, n * element_size(d.type)) != d.checksum) fail(name, "does not fit its checksum");
}

std::vector<std::string> Hdf5Reader::read_strings(const std::string& name) const {
  const std::size_t n = count_elements(name, ElementType::kString, 1);
  const Dataset dataset(H5Dopen2(impl_->file, name.c_str(), H5P_DEFAULT));
  const Type type(H5Dget_type(dataset));
  const std::size_t width = H5Tget_size(type);
  if (H5Tis_variable_str(type) != 0) fail(name, "has strings of variable length, which are for other programs");
  if (n && width > impl_->file_bytes / n) fail(name, "is larger than the file");
  std::vector<char> padded(n * width);
  if (n && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) fail(name, "cannot be read");
  std::vector<std::string> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = up_to_nul(padded.data() + i * width, width);
  if (checksum_of(values) != info(name).checksum) fail(name, "does not fit its checksum");
  return values;
}

std::shared_ptr<const void> Hdf5Reader::map_raw(const std::string& name, std::size_t alignment) const {
  const DatasetInfo& d = info(name);
  std::size_t n_bytes = element_size(d.type);
  for (const std::uint64_t extent : d.shape) n_bytes *= extent;
  const Dataset dataset(H5Dopen2(impl_->file, name.c_str(), H5P_DEFAULT));
  const haddr_t offset = n_bytes ? H5Dget_offset(dataset) : HADDR_UNDEF;
  int* fd = nullptr;
  if (offset == HADDR_UNDEF || offset % alignment != 0 ||
      H5Fget_vfd_handle(impl_->file, H5P_DEFAULT, reinterpret_cast<void**>(&fd)) < 0) {
    std::shared_ptr<std::vector<std::uint64_t>> copy = std::make_shared<std::vector<std::uint64_t>>(n_bytes / 8 + 1);
    read_raw(name, copy->data());
    return {copy, copy->data()};
  }
  if (n_bytes > impl_->file_bytes || offset > impl_->file_bytes - n_bytes) fail(name, "ends after the file");
  const std::size_t page = sysconf(_SC_PAGESIZE), start = offset / page * page, length = offset - start + n_bytes;
  const std::shared_ptr<const void> base = map_file(*fd, start, length, path());
  if (!base) fail(name, std::string("cannot be mapped (") + std::strerror(errno) + ")");
  const void* values = static_cast<const char*>(base.get()) + (offset - start);
  const std::shared_ptr<const void> owner(base, values);
  if (hash_hex(values, n_bytes) != d.checksum) fail(name, "does not fit its checksum");
  return owner;
}

namespace {
template <class T>
T number_attribute(const Hdf5Reader& reader, const std::map<AttributeKey, AttributeValue>& attributes,
                   const AttributeKey& key, char kind) {
  const auto it = attributes.find(key);
  if (it == attributes.end() || it->second.kind != kind || it->second.bytes.size() != sizeof(T))
    reader.fail(key.first + "@" + key.second, "is missing");
  T value;
  std::memcpy(&value, it->second.bytes.data(), sizeof value);
  return value;
}
}  // namespace

std::int64_t Hdf5Reader::int_attribute(const std::string& group, const std::string& name) const {
  return number_attribute<std::int64_t>(*this, impl_->attributes, {group, name}, 'i');
}
double Hdf5Reader::double_attribute(const std::string& group, const std::string& name) const {
  return number_attribute<double>(*this, impl_->attributes, {group, name}, 'd');
}

void Hdf5Reader::verify(const std::string& name) const {
  const DatasetInfo& d = info(name);
  if (d.is_foreign) return;
  if (d.type == ElementType::kString) {
    read_strings(name);
    return;
  }
  std::size_t n_bytes = element_size(d.type);
  for (const std::uint64_t extent : d.shape) n_bytes *= extent;
  std::vector<std::byte> values(n_bytes);
  read_raw(name, values.data());
}

std::int64_t Hdf5Reader::file_offset(const std::string& name) const {
  const Dataset dataset(H5Dopen2(impl_->file, info(name).name.c_str(), H5P_DEFAULT));
  const haddr_t offset = H5Dget_offset(dataset);
  return offset == HADDR_UNDEF ? -1 : static_cast<std::int64_t>(offset);
}

std::vector<AttributeSummary> Hdf5Reader::content_attributes() const {
  std::vector<AttributeSummary> list;
  for (const auto& [key, value] : impl_->attributes) {
    if (key.first == kRoot && kProvenance.count(key.second)) continue;
    const std::string name = key.first + "@" + key.second;
    if (value.kind == 's') list.push_back({name, value.bytes});
    if (value.kind == 'i' && value.bytes.size() == sizeof(std::int64_t))
      list.push_back({name, int_attribute(key.first, key.second)});
    if (value.kind == 'd' && value.bytes.size() == sizeof(double))
      list.push_back({name, double_attribute(key.first, key.second)});
  }
  return list;
}

}  // namespace st
