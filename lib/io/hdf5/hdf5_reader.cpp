#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/mapped_file.h"
#include "io/hdf5/hdf5_handles.h"
#include "io/hdf5/hdf5_open.h"

namespace st {
namespace {

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
  void read_dataset_info(hid_t dataset, const std::string& name);
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
    if (H5Iget_type(object) == H5I_DATASET) read_dataset_info(object, name + "/" + child);
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

void Hdf5Reader::Impl::read_dataset_info(hid_t dataset, const std::string& name) {
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

ArtifactHeader Hdf5Reader::header_of(const std::string& path) {
  Impl file;
  file.path = path;
  file.open();
  return std::move(file.header);
}

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
    if (is_provenance(key)) continue;
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
