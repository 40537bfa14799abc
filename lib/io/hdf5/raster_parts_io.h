// What raster.hdf and sizing.hdf both have: resolved numbers, an octree, and what they know of the model.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/sizing_artifact.h"

namespace st {

template <>
struct Element<SmallNormal> : Elements<ElementType::kUint8, 3> {};

inline constexpr const char* kSizing = "/st/sizing";
inline constexpr const char* kFaceName = "/st/face/name";
inline constexpr const char* kFaceOffset = "/st/face/cell_offset";
inline constexpr const char* kEdgeName = "/st/edge/name";
inline constexpr const char* kSampleAlong = "/st/sample/along";
inline constexpr const char* kConeStretch = "/st/cone/stretch";

inline bool is_positive(float x) { return is_finite(x) & (x > 0); }
template <std::size_t N>
bool are_finite(const float (&x)[N]) {
  bool is_good = true;
  for (const float each : x) is_good = is_good & is_finite(each);
  return is_good;
}

/// What a mapped field keeps alive.
struct MappedArrays {
  std::vector<std::shared_ptr<const void>> owners;

  template <class T>
  std::span<const T> map(const Hdf5Reader& file, const std::string& name, std::size_t columns = Element<T>::count) {
    const auto array = std::make_shared<MappedArray<T>>(file.map<T>(name, columns));
    owners.push_back(array);
    return array->values();
  }
};

/// All read_*() throw Error(kInput) for what is not as it must be.
void write_numbers(Hdf5Writer& file, const SizingNumbers& n);
SizingNumbers read_numbers(const Hdf5Reader& file);

void write_shape(Hdf5Writer& file, const OctreeShape& shape);
OctreeShape read_shape(const Hdf5Reader& file);
/// The arrays stay in the file, and `mapped` keeps them alive.
OctreeView map_shape(const Hdf5Reader& file, MappedArrays& mapped);

void write_model(Hdf5Writer& file, const SizedModel& model);
SizedModel read_model(const Hdf5Reader& file, std::size_t n_leaves);

}  // namespace st
