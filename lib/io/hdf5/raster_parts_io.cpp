#include "io/hdf5/raster_parts_io.h"

#include <string>

#include "base/limits.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/wing_records_io.h"

namespace st {

template <>
struct Element<CellPlane> : Elements<ElementType::kFloat32, 6> {};

namespace {

constexpr const char* kRoot = "/st/octree/root";
constexpr const char* kLeafKey = "/st/octree/leaf_key";
constexpr const char* kLeafLevel = "/st/octree/leaf_level";
constexpr const char* kNodeChild = "/st/octree/node_child";
constexpr const char* kPlaceOrigin = "/st/place_origin";
constexpr const char* kMaxAspect = "max_aspect";
constexpr const char* kFaceLeaf = "/st/face/cell_leaf";
constexpr const char* kFaceArea = "/st/face/cell_area";
constexpr const char* kFacePlane = "/st/face/cell_plane";
constexpr const char* kGroupName = "/st/group/name";
constexpr const char* kFaceGroup = "/st/face/group";
constexpr const char* kFaceLmin = "/st/face/lmin";
constexpr const char* kUndercutCause = "/st/undercut/cause";
constexpr const char* kUndercutCount = "/st/undercut/count";
constexpr const char* kUndercutLeast = "/st/undercut/least";
constexpr const char* kUndercutPlace = "/st/undercut/place";

/// What any walk through the octree relies on.
void require_shape(const Hdf5Reader& file, const OctreeView& octree) {
  require_countable(octree.leaf_keys.size(), "cells of one octree");
  if (const std::string defect = octree_tree_defect(octree); !defect.empty()) file.fail("/st/octree", defect);
}

/// Written where it is not that of space.
Vec3 read_place_origin(const Hdf5Reader& file) {
  if (!file.has(kPlaceOrigin)) return {};
  const std::vector<double> x = file.read_rows<double>(kPlaceOrigin, 3);
  require_finite(file, kPlaceOrigin, x);
  return {x[0], x[1], x[2]};
}

FaceCells read_face_cells(const Hdf5Reader& file, std::size_t n_leaves) {
  FaceCells faces{
      file.read<std::int64_t>(kFaceOffset), file.read<std::int32_t>(kFaceLeaf), {}, {}, read_place_origin(file)};
  faces.area = file.read_rows<float>(kFaceArea, faces.leaf.size());
  faces.plane = file.read_rows<CellPlane>(kFacePlane, faces.leaf.size(), 6);
  require_offsets(file, kFaceOffset, faces.offsets, faces.leaf.size());
  require_ids(file, kFaceLeaf, faces.leaf, n_leaves);
  require_lengths(file, kFaceArea, faces.area);
  require_rows_to_be(file, kFacePlane, std::span<const CellPlane>(faces.plane), "a plane",
                     [](const CellPlane& p) { return are_finite(p.center) & are_finite(p.normal); });
  return faces;
}

void write_face_cells(Hdf5Writer& file, const FaceCells& faces) {
  const Vec3 origin = faces.origin;
  if (origin != Vec3{}) file.write<double>(kPlaceOrigin, std::vector<double>{origin.x, origin.y, origin.z});
  file.write<std::int64_t>(kFaceOffset, faces.offsets);
  file.write<std::int32_t>(kFaceLeaf, faces.leaf);
  file.write<float>(kFaceArea, faces.area);
  file.write<CellPlane>(kFacePlane, faces.plane);
}

/// What a file says of faces besides their names.
void write_groups(Hdf5Writer& file, const FaceLabels& labels) {
  if (labels.face_group.empty()) return;
  file.write_strings(kGroupName, labels.group_name);
  file.write<std::int32_t>(kFaceGroup, labels.face_group);
  write_labels(file, labels);
}

FaceLabels read_face_labels(const Hdf5Reader& file, const FaceCells& faces) {
  FaceLabels labels;
  labels.face_name = file.read_strings(kFaceName);
  if (faces.offsets.size() != labels.face_name.size() + 1) file.fail(kFaceOffset, "does not fit the number of faces");
  if (file.has(kFaceGroup)) return read_labels(file, labels.face_name.size());  // files before groups were have none
  return labels;
}

/// Nothing where no least length is given.
void write_undercuts(Hdf5Writer& file, const SizedModel& model) {
  if (!model.face_lmin.empty()) file.write<double>(kFaceLmin, model.face_lmin);
  if (model.undercuts.empty()) return;
  std::vector<std::int32_t> causes;
  std::vector<std::int64_t> counts;
  std::vector<double> least;
  std::vector<Vec3> places;
  for (const Undercut& u : model.undercuts) {
    causes.push_back(u.cause);
    counts.push_back(u.n);
    least.push_back(u.least);
    places.push_back(u.place);
  }
  file.write<std::int32_t>(kUndercutCause, causes);
  file.write<std::int64_t>(kUndercutCount, counts);
  file.write<double>(kUndercutLeast, least);
  file.write<Vec3>(kUndercutPlace, places);
}

void read_undercuts(const Hdf5Reader& file, SizedModel& model) {
  if (file.has(kFaceLmin)) {
    model.face_lmin = file.read_rows<double>(kFaceLmin, model.labels.face_name.size());
    require_lengths(file, kFaceLmin, model.face_lmin);
  }
  if (!file.has(kUndercutCause)) return;
  const std::vector<std::int32_t> causes = file.read<std::int32_t>(kUndercutCause);
  const std::vector<std::int64_t> counts = file.read_rows<std::int64_t>(kUndercutCount, causes.size());
  const std::vector<double> least = file.read_rows<double>(kUndercutLeast, causes.size());
  const std::vector<Vec3> places = file.read_rows<Vec3>(kUndercutPlace, causes.size());
  require_lengths(file, kUndercutLeast, least);
  require_finite(file, kUndercutPlace, places);
  for (std::size_t i = 0; i < causes.size(); ++i)
    model.undercuts.push_back({causes[i], counts[i], least[i], places[i]});
}

}  // namespace

void write_numbers(Hdf5Writer& file, const SizingNumbers& n) {
  file.set_attribute(kSizing, "min_length", n.min_length);
  file.set_attribute(kSizing, "max_length", n.max_length);
  file.set_attribute(kSizing, "far_length", n.far_length);
  file.set_attribute(kSizing, "alpha_deg", n.alpha_deg);
  file.set_attribute(kSizing, "cell_per_length", n.cell_per_length);
  file.set_attribute(kSizing, "diagonal", n.diagonal);
  if (n.max_aspect > 1) file.set_attribute(kSizing, kMaxAspect, n.max_aspect);
}

SizingNumbers read_numbers(const Hdf5Reader& file) {
  const auto get = [&](const char* name) { return file.double_attribute(kSizing, name); };
  const bool is_stretched = file.has(kSampleAlong) || file.has(kConeStretch);
  for (const char* name : {"min_length", "max_length", "far_length", "alpha_deg", "cell_per_length", "diagonal"})
    if (!is_finite(get(name)) || get(name) < 0) file.fail(std::string(kSizing) + "@" + name, "is no length");
  for (const char* name : {"max_length", "far_length"})
    if (get(name) == 0) file.fail(std::string(kSizing) + "@" + name, "is no length > 0");
  const double max_aspect = is_stretched ? get(kMaxAspect) : 1;
  if (!is_finite(max_aspect) || max_aspect < 1) file.fail(std::string(kSizing) + "@" + kMaxAspect, "is no ratio >= 1");
  return {get("min_length"),      get("max_length"), get("far_length"), get("alpha_deg"),
          get("cell_per_length"), get("diagonal"),   max_aspect};
}

void write_shape(Hdf5Writer& file, const OctreeShape& shape) {
  file.write<double>(kRoot, std::vector<double>{shape.lo.x, shape.lo.y, shape.lo.z, shape.edge});
  file.write<std::uint64_t>(kLeafKey, shape.leaf_keys);
  file.write<std::uint8_t>(kLeafLevel, shape.leaf_levels);
  file.write<std::int32_t>(kNodeChild, shape.node_children, 8);
}

OctreeShape read_shape(const Hdf5Reader& file) {
  const std::vector<double> root = file.read_rows<double>(kRoot, 4);
  OctreeShape shape{{root[0], root[1], root[2]},
                    root[3],
                    file.read<std::uint64_t>(kLeafKey),
                    file.read<std::uint8_t>(kLeafLevel),
                    file.read<std::int32_t>(kNodeChild, 8)};
  require_shape(file, shape.view());
  return shape;
}

OctreeView map_shape(const Hdf5Reader& file, MappedArrays& mapped) {
  const std::vector<double> root = file.read_rows<double>(kRoot, 4);
  const OctreeView octree{{root[0], root[1], root[2]},
                          root[3],
                          mapped.map<std::uint64_t>(file, kLeafKey),
                          mapped.map<std::uint8_t>(file, kLeafLevel),
                          mapped.map<std::int32_t>(file, kNodeChild, 8)};
  require_shape(file, octree);
  return octree;
}

void write_model(Hdf5Writer& file, const SizedModel& model) {
  write_face_cells(file, model.faces);
  file.write_strings(kFaceName, model.labels.face_name);
  file.write_strings(kEdgeName, model.edge_name);
  write_wings(file, model.wings);
  write_groups(file, model.labels);
  write_undercuts(file, model);
}

SizedModel read_model(const Hdf5Reader& file, std::size_t n_leaves) {
  SizedModel model;
  model.faces = read_face_cells(file, n_leaves);
  model.edge_name = file.read_strings(kEdgeName);
  model.labels = read_face_labels(file, model.faces);
  model.wings = read_wings(file);
  read_undercuts(file, model);
  return model;
}

}  // namespace st
