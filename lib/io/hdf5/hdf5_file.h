// Reading and writing HDF5 files of ours. Internal to io: no HDF5 type is visible, and no other layer includes this.
//
// Every dataset is contiguous, carries its checksum in the attribute `xxh3`, and is written without time stamps, so
// equal content gives equal bytes. Datasets and attributes written through Hdf5Writer make up the content hash;
// provenance in the header does not.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/vec.h"
#include "geometry/shape/chart_topology.h"
#include "geometry/shape/surface.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/inspect.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Element types of datasets, little-endian in the file.
enum class ElementType { kFloat64, kFloat32, kInt32, kInt64, kUint8, kUint64, kString };

/// "float64", "string" ...
const char* element_type_name(ElementType type);
/// Bytes of one element in memory; 0 for strings.
constexpr std::size_t element_size(ElementType type) {
  constexpr std::size_t kSizes[] = {8, 4, 4, 8, 1, 8, 0};
  return kSizes[static_cast<int>(type)];
}

/// How a C++ value is stored: as `Count` elements.
template <ElementType Type, std::size_t Count = 1>
struct Elements {
  static constexpr ElementType type = Type;
  static constexpr std::size_t count = Count;
};
template <class T>
struct Element;
template <>
struct Element<double> : Elements<ElementType::kFloat64> {};
template <>
struct Element<float> : Elements<ElementType::kFloat32> {};
template <>
struct Element<std::int32_t> : Elements<ElementType::kInt32> {};
template <>
struct Element<std::int64_t> : Elements<ElementType::kInt64> {};
template <>
struct Element<std::uint8_t> : Elements<ElementType::kUint8> {};
template <>
struct Element<std::byte> : Elements<ElementType::kUint8> {};
template <>
struct Element<SurfaceType> : Elements<ElementType::kUint8> {};
template <>
struct Element<std::uint64_t> : Elements<ElementType::kUint64> {};
template <>
struct Element<Vec3> : Elements<ElementType::kFloat64, 3> {};
template <>
struct Element<Vec2> : Elements<ElementType::kFloat64, 2> {};
template <>
struct Element<Box3> : Elements<ElementType::kFloat64, 6> {};
template <>
struct Element<Triangle> : Elements<ElementType::kInt32, 3> {};
template <>
struct Element<Corners> : Elements<ElementType::kInt32, 3> {};

/// Calls `f` with a value of the C++ type that has these elements; std::string for strings.
template <class Function>
auto with_element(ElementType type, const Function& f) {
  switch (type) {
    case ElementType::kFloat64:  // NOLINT(bugprone-branch-clone): each calls for another type
      return f(double());
    case ElementType::kFloat32:
      return f(float());
    case ElementType::kInt32:
      return f(std::int32_t());
    case ElementType::kInt64:
      return f(std::int64_t());
    case ElementType::kUint8:
      return f(std::uint8_t());
    case ElementType::kUint64:
      return f(std::uint64_t());
    case ElementType::kString:
      break;
  }
  return f(std::string());
}

/// Whether a dataset says only what entities were before (`.../previous_id`): provenance, as equal contents may come
/// from different ones.
bool is_provenance(const std::string& dataset);

/// A file that appears under its name only when it is complete: written beside it, synced, renamed by commit(). Without
/// commit() nothing is left. All functions throw Error(kOutput) naming the file.
class Hdf5Writer {
 public:
  /// Creates the temporary file and writes the header (schema, provenance) into it; header.content_hash is ignored.
  Hdf5Writer(const std::string& path, const ArtifactHeader& header);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Writes an array as dataset `name` (an absolute path; groups are made as needed), shape (n) or (n, columns).
  /// `columns` counts elements of the basic type; values.size() must be a multiple of it. Each name once.
  template <class T>
  void write(const std::string& name, std::span<const T> values, std::size_t columns = Element<T>::count) {
    static_assert(sizeof(T) == Element<T>::count * element_size(Element<T>::type), "no padding inside");
    write_raw(name, Element<T>::type, values.data(), values.size() * Element<T>::count, columns);
  }
  template <class T>
  void write(const std::string& name, const std::vector<T>& values, std::size_t columns = Element<T>::count) {
    write(name, std::span<const T>(values), columns);
  }
  /// Makes room for `n_rows` rows that append() brings, in order: all of them before commit(). Returns the number of
  /// the dataset for append(). One thread at a time.
  template <class T>
  std::size_t begin_rows(const std::string& name, std::size_t n_rows) {
    return begin_rows(name, Element<T>::type, n_rows, Element<T>::count);
  }
  /// The next rows of a dataset; of each dataset one thread, at the same time as other threads those of others.
  template <class T>
  void append(std::size_t dataset, std::span<const T> rows) {
    append_bytes(dataset, std::as_bytes(rows));
  }
  /// Instead of append(): others write the rows, from this place in the file on (bytes), before commit().
  std::uint64_t rows_elsewhere(std::size_t dataset);
  /// The file until commit().
  const std::string& temporary_name() const;
  /// UTF-8 strings, fixed-length and padded with NUL (a NUL inside a string ends it), shape (n).
  void write_strings(const std::string& name, const std::vector<std::string>& values);
  /// UTF-8 strings of variable length, shape (n): the only kind that VTK's reader takes. Nobody reads them back, for
  /// HDF5 1.10 overruns its buffers on damaged ones; write_strings() has to store the same strings elsewhere.
  void write_vtk_strings(const std::string& name, const std::vector<std::string>& values);

  /// Attributes of a group (made as needed), part of the content.
  void set_attribute(const std::string& group, const std::string& name, const std::string& value);
  void set_attribute(const std::string& group, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& group, const std::string& name, double value);
  void set_attribute(const std::string& group, const std::string& name, const std::vector<std::int64_t>& values);

  /// Stores the content hash, closes, syncs and renames. Returns the content hash. Nothing may be written afterwards.
  std::string commit();

 private:
  void write_raw(const std::string& name, ElementType type, const void* values, std::size_t n_elements,
                 std::size_t columns);
  std::size_t begin_rows(const std::string& name, ElementType type, std::size_t n_rows, std::size_t columns);
  void append_bytes(std::size_t dataset, std::span<const std::byte> bytes);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a dataset is, without its values.
struct DatasetInfo {
  std::string name;  ///< absolute path
  ElementType type = ElementType::kUint8;
  std::vector<std::uint64_t> shape;
  std::string checksum;     ///< as stored
  bool is_foreign = false;  ///< strings of variable length, written for VTK and never read by us
};

/// A read-only array that lives in the page cache: shared by all processes of a machine that map the same file. Keeps
/// the file mapped.
template <class T>
class MappedArray {
 public:
  MappedArray() = default;
  MappedArray(std::shared_ptr<const void> owner, std::span<const T> values)
      : owner_(std::move(owner)), values_(values) {}
  std::span<const T> values() const { return values_; }
  std::size_t size() const { return values_.size(); }
  const T& operator[](std::size_t i) const { return values_[i]; }

 private:
  std::shared_ptr<const void> owner_;
  std::span<const T> values_;
};

/// Reads files that Hdf5Writer made. All functions throw Error(kInput) naming file, dataset and remedy.
class Hdf5Reader {
 public:
  /// Opens an artifact of any schema: the file is complete, ours, and its parts fit the stored content hash (checksums
  /// of values are verified when they are read).
  explicit Hdf5Reader(const std::string& path);
  /// Opens it in the same way, and requires this schema and a version not newer than `newest_version`.
  Hdf5Reader(const std::string& path, const std::string& schema, int newest_version = 1);
  ~Hdf5Reader();
  /// The header alone: the file is complete and ours, but its parts are not looked at.
  static ArtifactHeader header_of(const std::string& path);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  const std::string& path() const;
  const ArtifactHeader& header() const;
  /// All datasets, by name.
  const std::vector<DatasetInfo>& datasets() const;
  bool has(const std::string& name) const;
  const DatasetInfo& info(const std::string& name) const;

  /// Values of a dataset of exactly this type and number of columns, checksum verified.
  template <class T>
  std::vector<T> read(const std::string& name, std::size_t columns = Element<T>::count) const {
    std::vector<T> values(count_elements(name, Element<T>::type, columns) / Element<T>::count);
    read_raw(name, values.data());
    return values;
  }
  /// Reads in the same way, and requires exactly `n_rows` rows.
  template <class T>
  std::vector<T> read_rows(const std::string& name, std::size_t n_rows, std::size_t columns = Element<T>::count) const {
    require_rows(name, n_rows);
    return read<T>(name, columns);
  }
  void require_rows(const std::string& name, std::size_t n_rows) const;
  std::vector<std::string> read_strings(const std::string& name) const;
  std::vector<std::string> read_string_rows(const std::string& name, std::size_t n_rows) const {
    require_rows(name, n_rows);
    return read_strings(name);
  }
  /// Values mapped from the file, checksum verified; a dataset too small to be aligned is copied.
  template <class T>
  MappedArray<T> map(const std::string& name, std::size_t columns = Element<T>::count) const {
    const std::size_t n = count_elements(name, Element<T>::type, columns) / Element<T>::count;
    std::shared_ptr<const void> owner = map_raw(name, alignof(T));
    return {owner, std::span<const T>(static_cast<const T*>(owner.get()), n)};
  }

  /// Reads a dataset only to verify its checksum.
  void verify(const std::string& name) const;

  /// Where the values start in the file, bytes; -1 for an empty dataset.
  std::int64_t file_offset(const std::string& name) const;

  /// All single-valued attributes that are part of the content, by name.
  std::vector<AttributeSummary> content_attributes() const;
  std::int64_t int_attribute(const std::string& group, const std::string& name) const;
  double double_attribute(const std::string& group, const std::string& name) const;

  /// Throws Error(kInput): "<path>: <dataset>: <what>; <remedy>". For contents that contradict each other.
  [[noreturn]] void fail(const std::string& dataset, const std::string& what) const;

 private:
  std::size_t count_elements(const std::string& name, ElementType type, std::size_t columns) const;
  void read_raw(const std::string& name, void* values) const;
  std::shared_ptr<const void> map_raw(const std::string& name, std::size_t alignment) const;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace st
