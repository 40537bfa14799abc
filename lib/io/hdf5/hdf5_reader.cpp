#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/mapped_file.h"
#include "io/hdf5/hdf5_listing.h"

namespace st {
namespace {

void require_schema(const Hdf5Listing& file, const std::string& schema, int newest_version) {
  const ArtifactHeader& header = file.header;
  const std::string version = std::to_string(header.schema_version), newest = std::to_string(newest_version);
  if (header.schema != schema)
    throw Error(ExitCode::kInput, file.path + ": is a " + header.schema + " artifact, but a " + schema +
                                      " artifact is needed; give the file that " + tool_of_schema(schema) + " wrote");
  if (header.schema_version > newest_version)
    throw Error(ExitCode::kInput,
                file.path + ": " + schema + " schema version " + version + " is newer than this tool knows (" + newest +
                    "); use the version of st that wrote it (" + header.tool_version + ") or a newer one");
}

}  // namespace

struct Hdf5Reader::Impl {
  std::shared_ptr<const Hdf5Listing> listing;
  int file = -1;

  Impl(const std::string& path, const std::function<void(const Hdf5Listing&)>& on_header)
      : listing(list_artifact(path, on_header)), file(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file < 0) listing->damaged(std::string("cannot be opened (") + std::strerror(errno) + ")");
  }
  ~Impl() { close(file); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// False when the file ends before.
  bool read_bytes(const std::string& name, char* bytes, std::size_t n_bytes) const;
};

bool Hdf5Reader::Impl::read_bytes(const std::string& name, char* bytes, std::size_t n_bytes) const {
  const std::int64_t offset = listing->places.at(name).offset;
  if (n_bytes > 0 && offset < 0) return false;
  std::size_t done = 0;
  while (done < n_bytes) {
    const ssize_t n = pread(file, bytes + done, n_bytes - done, offset + static_cast<off_t>(done));
    if (n == 0 || (n < 0 && errno != EINTR)) return false;
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  return true;
}

Hdf5Reader::Hdf5Reader(const std::string& path) : impl_(std::make_unique<Impl>(path, [](const Hdf5Listing&) {})) {}

Hdf5Reader::Hdf5Reader(const std::string& path, const std::string& schema, int newest_version)
    : impl_(std::make_unique<Impl>(path,
                                   [&](const Hdf5Listing& file) { require_schema(file, schema, newest_version); })) {}
Hdf5Reader::~Hdf5Reader() = default;

ArtifactHeader Hdf5Reader::header_of(const std::string& path) { return header_of_artifact(path); }

const std::string& Hdf5Reader::path() const { return impl_->listing->path; }
const ArtifactHeader& Hdf5Reader::header() const { return impl_->listing->header; }
const std::vector<DatasetInfo>& Hdf5Reader::datasets() const { return impl_->listing->datasets; }
bool Hdf5Reader::has(const std::string& name) const { return impl_->listing->find(name) != nullptr; }

const DatasetInfo& Hdf5Reader::info(const std::string& name) const {
  const DatasetInfo* found = impl_->listing->find(name);
  if (!found) fail(name, "is missing");
  return *found;
}

void Hdf5Reader::fail(const std::string& dataset, const std::string& what) const {
  impl_->listing->damaged(dataset + ": " + what);
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
  std::size_t n_bytes = element_size(d.type);
  for (const std::uint64_t extent : d.shape) n_bytes *= extent;
  if (!impl_->read_bytes(name, static_cast<char*>(values), n_bytes)) fail(name, "cannot be read");
  if (hash_hex(values, n_bytes) != d.checksum) fail(name, "does not fit its checksum");
}

std::vector<std::string> Hdf5Reader::read_strings(const std::string& name) const {
  const std::size_t n = count_elements(name, ElementType::kString, 1);
  const std::size_t width = impl_->listing->places.at(name).width;
  if (info(name).is_foreign) fail(name, "has strings of variable length, which are for other programs");
  if (n && width > impl_->listing->file_bytes / n) fail(name, "is larger than the file");
  std::vector<char> padded(n * width);
  if (!impl_->read_bytes(name, padded.data(), padded.size())) fail(name, "cannot be read");
  std::vector<std::string> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = up_to_nul(padded.data() + i * width, width);
  if (checksum_of(values) != info(name).checksum) fail(name, "does not fit its checksum");
  return values;
}

std::shared_ptr<const void> Hdf5Reader::map_raw(const std::string& name, std::size_t alignment) const {
  const DatasetInfo& d = info(name);
  std::size_t n_bytes = element_size(d.type);
  for (const std::uint64_t extent : d.shape) n_bytes *= extent;
  const std::int64_t place = n_bytes ? file_offset(name) : -1;
  const auto offset = static_cast<std::size_t>(place);
  if (place < 0 || offset % alignment != 0) {
    std::shared_ptr<std::vector<std::uint64_t>> copy = std::make_shared<std::vector<std::uint64_t>>(n_bytes / 8 + 1);
    read_raw(name, copy->data());
    return {copy, copy->data()};
  }
  if (n_bytes > impl_->listing->file_bytes || offset > impl_->listing->file_bytes - n_bytes)
    fail(name, "ends after the file");
  const std::size_t page = sysconf(_SC_PAGESIZE), start = offset / page * page, length = offset - start + n_bytes;
  const std::shared_ptr<const void> base = map_file(impl_->file, start, length, path());
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
  return number_attribute<std::int64_t>(*this, impl_->listing->attributes, {group, name}, 'i');
}
double Hdf5Reader::double_attribute(const std::string& group, const std::string& name) const {
  return number_attribute<double>(*this, impl_->listing->attributes, {group, name}, 'd');
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
  return impl_->listing->places.at(info(name).name).offset;
}

std::vector<AttributeSummary> Hdf5Reader::content_attributes() const {
  std::vector<AttributeSummary> list;
  for (const auto& [key, value] : impl_->listing->attributes) {
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
