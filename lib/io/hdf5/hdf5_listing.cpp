#include "io/hdf5/hdf5_listing.h"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "io/hdf5/hdf5_open.h"
#include "io/hdf5/kept_listings.h"

namespace st {
namespace {

/// A text in a JSON object; "" when there is none, or it is no text.
std::string text_of(const nlohmann::json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : "";
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

/// Opens a file and fills its listing.
class Lister {
 public:
  explicit Lister(Hdf5Listing& listing) : l_(listing) {}

  void open();
  void read_contents();

 private:
  void read_group(const std::string& name, int depth);
  void read_attributes(hid_t group, const std::string& name);
  void read_dataset_info(hid_t dataset, const std::string& name);
  void read_header();
  std::string text(const std::string& name, bool required = true) const;

  Hdf5Listing& l_;
  File file_;
  int n_objects_ = 0;  // listed so far
};

void Lister::open() {
  require_hdf5_file(l_.path);
  file_ = open_hdf5(l_.path);
  if (!file_.is_valid()) l_.damaged("cannot be opened as HDF5");
  hsize_t size = 0;
  if (H5Fget_filesize(file_, &size) < 0) l_.damaged("has no size");
  l_.file_bytes = size;
  if (H5Lexists(file_, kRoot, H5P_DEFAULT) <= 0)
    throw Error(
        ExitCode::kInput,
        l_.path + ": is HDF5, but no artifact of an st tool (no group /st); give a .hdf file that an st tool wrote");
  read_attributes(Group(H5Gopen2(file_, kRoot, H5P_DEFAULT)), kRoot);
  read_header();
}

/// Lists everything and compares it with the content hash.
void Lister::read_contents() {
  read_group("", 0);
  std::sort(l_.datasets.begin(), l_.datasets.end(),
            [](const DatasetInfo& a, const DatasetInfo& b) { return a.name < b.name; });
  if (content_hash(l_.datasets, l_.attributes) != l_.header.content_hash)
    l_.damaged("its parts do not fit its content hash");
}

/// Lists datasets and attributes below a group. Depth and number of parts bound what a malformed file can do.
void Lister::read_group(const std::string& name, int depth) {
  constexpr int kMaxDepth = 8, kMaxObjects = 10000;
  const std::string path_name = name.empty() ? "/" : name;
  if (depth > kMaxDepth) l_.damaged(path_name + ": groups too deep");
  const Group group(H5Gopen2(file_, path_name.c_str(), H5P_DEFAULT));
  read_attributes(group, path_name);
  const auto names = link_names(group, kMaxObjects);
  if (!names) l_.damaged("group " + path_name + " cannot be listed, or has more than 10000 parts");
  for (const std::string& child : *names) {
    if (++n_objects_ > kMaxObjects) l_.damaged("has more than " + std::to_string(kMaxObjects) + " parts");
    if (const std::string defect = link_defect(group, child, Hdf5Origin::kArtifact); !defect.empty())
      l_.damaged(name + "/" + child + " " + defect);
    const Handle<H5Oclose> object(H5Oopen(group, child.c_str(), H5P_DEFAULT));
    if (!object.is_valid()) l_.damaged(name + "/" + child + " cannot be opened");
    if (H5Iget_type(object) == H5I_GROUP) read_group(name + "/" + child, depth + 1);
    if (H5Iget_type(object) == H5I_DATASET) read_dataset_info(object, name + "/" + child);
  }
}

/// `group` may be one that could not be opened.
void Lister::read_attributes(hid_t group, const std::string& name) {
  H5O_info_t info{};
  if (H5Oget_info2(group, &info, H5O_INFO_NUM_ATTRS) < 0) l_.damaged("group " + name + " cannot be read");
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const Attribute attribute(H5Aopen_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_NATIVE, i, H5P_DEFAULT, H5P_DEFAULT));
    char attribute_name[256] = {};
    if (!attribute.is_valid() || H5Aget_name(attribute, sizeof attribute_name, attribute_name) < 0)
      l_.damaged("an attribute of " + name + " cannot be read");
    const auto value = read_attribute(attribute, l_.file_bytes);
    if (!value) l_.damaged("attribute " + std::string(attribute_name) + " of " + name + " cannot be read");
    l_.attributes[{name, attribute_name}] = *value;
  }
}

void Lister::read_dataset_info(hid_t dataset, const std::string& name) {
  const Type type(H5Dget_type(dataset));
  const Space space(H5Dget_space(dataset));
  hsize_t dims[2] = {};
  const int rank = H5Sget_simple_extent_ndims(space);
  const auto element_type = element_type_of(type);
  if (!element_type || rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, dims, nullptr) < 0)
    l_.damaged("dataset " + name + " cannot be read");
  if (const std::string defect = storage_defect(dataset, Hdf5Origin::kArtifact); !defect.empty())
    l_.damaged("dataset " + name + " " + defect);
  DatasetInfo info{name, *element_type, {dims, dims + rank}, "", false};
  const std::size_t bytes_each = std::max<std::size_t>(1, element_size(*element_type));
  if (dims[0] > l_.file_bytes || (rank == 2 && dims[1] > l_.file_bytes) ||
      dims[0] * (rank == 2 ? dims[1] : 1) > l_.file_bytes / bytes_each)
    l_.damaged("dataset " + name + " is larger than the file");
  const Attribute attribute(H5Aopen(dataset, kChecksum, H5P_DEFAULT));
  if (!attribute.is_valid()) l_.damaged("dataset " + name + " has no checksum");
  if (const auto value = read_attribute(attribute, l_.file_bytes)) info.checksum = value->bytes;
  info.is_foreign = H5Tis_variable_str(type) != 0;
  l_.places[name] = place_of(dataset, type);
  l_.datasets.push_back(std::move(info));
}

std::string Lister::text(const std::string& name, bool required) const {
  const auto it = l_.attributes.find({kRoot, name});
  if (it != l_.attributes.end() && it->second.kind == 's') return it->second.bytes;
  if (required) l_.damaged("attribute /st@" + name + " is missing");
  return "";
}

void Lister::read_header() {
  l_.header.schema = text("schema");
  const auto integer = l_.attributes.find({kRoot, "schema_version"});
  if (integer == l_.attributes.end() || integer->second.kind != 'i')
    l_.damaged("attribute /st@schema_version is missing");
  std::int64_t version = 0;
  std::memcpy(&version, integer->second.bytes.data(), sizeof version);
  if (version < 1 || version > std::numeric_limits<int>::max())
    l_.damaged("schema version " + std::to_string(version) + " does not exist");
  l_.header.schema_version = static_cast<int>(version);
  l_.header.tool = text("tool", false);
  l_.header.tool_version = text("tool_version", false);
  l_.header.options_json = text("options", false);
  l_.header.unit = text("unit", false);
  const auto unit = l_.attributes.find({kRoot, "unit_in_m"});
  if (unit != l_.attributes.end() && unit->second.kind == 'd')
    std::memcpy(&l_.header.unit_in_m.emplace(), unit->second.bytes.data(), sizeof(double));
  l_.header.content_hash = text("content_hash");
  l_.header.geometry_hash = text("geometry_hash", false);
  const auto inputs = nlohmann::json::parse(text("inputs", false), nullptr, false);
  if (inputs.is_array())
    for (const auto& input : inputs)
      if (input.is_object())
        l_.header.inputs.push_back({text_of(input, "role"), text_of(input, "name"), text_of(input, "hash")});
}

/// The state of a file.
struct FileMark {
  dev_t device = 0;
  ino_t inode = 0;
  off_t bytes = 0;
  std::int64_t seconds = 0, nanoseconds = 0;
  bool operator==(const FileMark&) const = default;
};

std::optional<FileMark> mark_of(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) return std::nullopt;
  return FileMark{info.st_dev, info.st_ino, info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
}

struct Kept {
  std::mutex mutex;
  bool is_on = false;
  std::map<std::string, std::pair<FileMark, std::shared_ptr<const Hdf5Listing>>> listings;  // by path
};

Kept& kept() {
  static Kept all;
  return all;
}

}  // namespace

std::string tool_of_schema(const std::string& schema) {
  static const std::map<std::string, std::string> tools = {{"geometry", "st-import"},
                                                           {"raster", "st-raster"},
                                                           {"sizing", "st-prolong"},
                                                           {"patches", "st-mesh"},
                                                           {"mesh", "st-merge"}};
  const auto it = tools.find(schema);
  return it == tools.end() ? "the tool that made it" : it->second;
}

const DatasetInfo* Hdf5Listing::find(const std::string& name) const {
  const auto it = std::lower_bound(datasets.begin(), datasets.end(), name,
                                   [](const DatasetInfo& d, const std::string& n) { return d.name < n; });
  return it != datasets.end() && it->name == name ? &*it : nullptr;
}

void Hdf5Listing::damaged(const std::string& what) const {
  throw Error(ExitCode::kInput, path + ": " + what + "; the file is damaged or incomplete: make it again with " +
                                    tool_of_schema(header.schema));
}

std::shared_ptr<const Hdf5Listing> list_artifact(const std::string& path,
                                                 const std::function<void(const Hdf5Listing&)>& on_header) {
  if (auto listing = kept_listing(path)) {
    on_header(*listing);
    return listing;
  }
  const std::optional<FileMark> mark = mark_of(path);  // before it is read
  const auto listing = std::make_shared<Hdf5Listing>();
  listing->path = path;
  Lister lister(*listing);
  lister.open();
  on_header(*listing);
  lister.read_contents();
  const std::lock_guard lock(kept().mutex);
  if (mark && kept().is_on) kept().listings[path] = {*mark, listing};
  return listing;
}

ArtifactHeader header_of_artifact(const std::string& path) {
  if (const auto listing = kept_listing(path)) return listing->header;
  Hdf5Listing listing;
  listing.path = path;
  Lister(listing).open();
  return std::move(listing.header);
}

DatasetPlace place_of(hid_t dataset, hid_t type) {
  const haddr_t offset = H5Dget_offset(dataset);
  return {offset == HADDR_UNDEF ? -1 : static_cast<std::int64_t>(offset), H5Tget_size(type)};
}

void keep_listing(Hdf5Listing listing) {
  const std::lock_guard lock(kept().mutex);
  const std::optional<FileMark> mark = kept().is_on ? mark_of(listing.path) : std::nullopt;
  if (!mark) return;
  listing.file_bytes = static_cast<std::uint64_t>(mark->bytes);
  const std::string path = listing.path;
  kept().listings[path] = {*mark, std::make_shared<const Hdf5Listing>(std::move(listing))};
}

std::shared_ptr<const Hdf5Listing> kept_listing(const std::string& path) {
  const std::lock_guard lock(kept().mutex);
  const auto found = kept().listings.find(path);
  return found != kept().listings.end() && mark_of(path) == found->second.first ? found->second.second : nullptr;
}

void keep_listings() {
  const std::lock_guard lock(kept().mutex);
  kept().is_on = true;
}

}  // namespace st
