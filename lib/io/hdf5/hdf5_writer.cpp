#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/threads.h"
#include "io/file/json_text.h"
#include "io/file/row_file.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/hdf5_listing.h"

namespace st {
namespace {

// Larger arrays start at a multiple of kAlignment, so that they can be used where they are mapped.
constexpr hsize_t kAlignmentThreshold = 1024, kAlignment = 64;

/// HDF5 prints its error stack unless told not to, per thread.
void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

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

nlohmann::json inputs_to_json(const std::vector<InputRef>& inputs) {
  nlohmann::json list = nlohmann::json::array();
  for (const InputRef& input : inputs)
    list.push_back({{"role", input.role}, {"name", input.name}, {"hash", input.hash}});
  return list;
}

}  // namespace

struct AppendedRows;

struct Hdf5Writer::Impl {
  explicit Impl(const std::string& path) : temporary(path) {}
  TemporaryFile temporary;
  File file;
  std::map<std::string, Group> groups;
  ArtifactHeader header;
  std::vector<DatasetInfo> datasets;
  std::map<std::string, DatasetPlace> places;
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
  places[name] = place_of(dataset, type);
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
  impl_->header = header;
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
  impl_->temporary.commit(Content::kArtifact);
  impl_->header.content_hash = hash;
  keep_listing({impl_->temporary.path(), 0, std::move(impl_->header), std::move(impl_->datasets),
                std::move(impl_->places), std::move(impl_->attributes)});
  return hash;
}

}  // namespace st
