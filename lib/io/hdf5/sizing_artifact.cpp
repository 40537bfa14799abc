#include "io/hdf5/sizing_artifact.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/face_labels_io.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/wing_records_io.h"
#include "sizing/moved_field.h"
#include "sizing/source_types.h"

namespace st {

template <>
struct Element<CellLength> : Elements<ElementType::kFloat32, 5> {};

template <>
struct Element<Cone> : Elements<ElementType::kFloat32, 13> {};
template <>
struct Element<ConeStretch> : Elements<ElementType::kFloat32, 4> {};

template <>
struct Element<CellPlane> : Elements<ElementType::kFloat32, 6> {};

template <>
struct Element<CellSplit> : Elements<ElementType::kFloat32, 5> {};

template <>
struct Element<SmallNormal> : Elements<ElementType::kUint8, 3> {};

template <>
struct Element<SampleReach> : Elements<ElementType::kFloat32, 6> {};

template <>
struct Element<CellColour> : Elements<ElementType::kUint8> {};

namespace {

constexpr int kOpenSizingVersion = 2;       // of a sizing without a surface in it
constexpr int kUnmovedSizingVersion = 3;    // of one whose octree lies where it was made
constexpr int kPlainRasterVersion = 2;      // of a raster without samples
constexpr int kSampledRasterVersion = 3;    // of a complete raster with samples
constexpr int kPartialRasterVersion = 4;    // of an incomplete one; from here on not_sampled is written
constexpr int kSurfaceRasterVersion = 5;    // of one with a coarse surface, the same length in all directions
constexpr int kStretchedRasterVersion = 6;  // of one near the origin
constexpr int kFarRasterVersion = 7;        // of one far from it; up to here samples are points
constexpr int kPlainSizingVersion = 4;      // of a sizing with the same length in all directions
constexpr int kStretchedSizingVersion = 5;  // of one whose cells tell the lengths, not cones
constexpr int kConeSizingVersion = 6;       // of one without faces and sources
constexpr int kFacesSizingVersion = 7;      // of one whose cones have the same length in all directions
constexpr int kStretchedConesVersion = 8;   // of one without lengths on surfaces
constexpr const char* kSizing = "/st/sizing";
constexpr const char* kNotSampled = "not_sampled";
constexpr const char* kRoot = "/st/octree/root";
constexpr const char* kFrame = "/st/octree/frame";
constexpr const char* kLeafKey = "/st/octree/leaf_key";
constexpr const char* kLeafLevel = "/st/octree/leaf_level";
constexpr const char* kNodeChild = "/st/octree/node_child";
constexpr const char* kStoredLength = "/st/octree/stored_length";
constexpr const char* kStoredCause = "/st/octree/stored_cause";
constexpr const char* kSamplePoint = "/st/sample/point";
constexpr const char* kSampleLength = "/st/sample/length";
constexpr const char* kPlaceOrigin = "/st/place_origin";
constexpr const char* kSampleCause = "/st/sample/cause";
constexpr const char* kSampleNormal = "/st/sample/normal";
constexpr const char* kSampleReach = "/st/sample/reach";
constexpr const char* kSampleDirection = "/st/sample/direction";
constexpr const char* kSampleAlong = "/st/sample/along";
constexpr const char* kMaxAspect = "max_aspect";
constexpr const char* kAlong = "/st/octree/along";
constexpr const char* kDirection = "/st/octree/direction";
constexpr const char* kSurfacePoint = "/st/surface/point";
constexpr const char* kSurfaceTriangle = "/st/surface/triangle";
constexpr const char* kFlowInside = "flow_inside";
constexpr const char* kCell = "/st/octree/cell";
constexpr const char* kCause = "/st/octree/cause";
constexpr const char* kColour = "/st/octree/colour";
constexpr const char* kSplitLeaf = "/st/split/leaf";
constexpr const char* kSplitPlane = "/st/split/plane";
constexpr const char* kSplitCell = "/st/split/cell";
constexpr const char* kSplitCause = "/st/split/cause";
constexpr const char* kCone = "/st/cone/cone";
constexpr const char* kConeCause = "/st/cone/cause";
constexpr const char* kFirstCone = "/st/cone/first";
constexpr const char* kSiteCones = "/st/cone/of_site";
constexpr const char* kConeStretch = "/st/cone/stretch";
constexpr const char* kFirstAlong = "/st/cone/first_along";
constexpr const char* kSiteAlong = "/st/cone/along_of_site";
constexpr const char* kOther = "/st/octree/other";  // sources by cell: version 6 alone
constexpr const char* kSourceKind = "/st/source/kind";
constexpr const char* kSourceNumbers = "/st/source/numbers";
constexpr const char* kSourceSlope = "source_slope";
constexpr const char* kBackgroundNode = "/st/background/node";
constexpr const char* kBackgroundSize = "/st/background/size";
constexpr const char* kBackgroundTet = "/st/background/tet";
constexpr const char* kBackgroundTriangle = "/st/background/triangle";
constexpr const char* kFaceOffset = "/st/face/cell_offset";
constexpr const char* kFaceLeaf = "/st/face/cell_leaf";
constexpr const char* kFaceArea = "/st/face/cell_area";
constexpr const char* kFacePlane = "/st/face/cell_plane";
constexpr const char* kFaceName = "/st/face/name";
constexpr const char* kEdgeName = "/st/edge/name";
constexpr const char* kGroupName = "/st/group/name";
constexpr const char* kFaceGroup = "/st/face/group";
constexpr const char* kSourceName = "/st/source/name";
constexpr const char* kFaceWeight = "/st/face/weight";
constexpr const char* kFaceLmin = "/st/face/lmin";
constexpr const char* kUndercutCause = "/st/undercut/cause";
constexpr const char* kUndercutCount = "/st/undercut/count";
constexpr const char* kUndercutLeast = "/st/undercut/least";
constexpr const char* kUndercutPlace = "/st/undercut/place";

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
  const bool is_stretched = file.has(kSampleAlong) || file.has(kAlong) || file.has(kConeStretch);
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

/// What any walk through the octree relies on.
void require_shape(const Hdf5Reader& file, const OctreeView& octree) {
  require_countable(octree.leaf_keys.size(), "cells of one octree");
  if (const std::string defect = octree_tree_defect(octree); !defect.empty()) file.fail("/st/octree", defect);
}

bool is_positive(float x) { return is_finite(x) & (x > 0); }

bool is_reach(const SampleReach& r) {
  bool is_good = true;
  for (int k = 0; k < 3; ++k) is_good = is_good & is_finite(r.u[k]) & is_finite(r.v[k]);
  return is_good;
}

/// Finite lengths > 0; `upper` may be negated.
bool is_length(const CellLength& c) {
  return is_positive(c.length) & is_positive(std::abs(c.upper)) & is_finite(c.gradient[0]) & is_finite(c.gradient[1]) &
         is_finite(c.gradient[2]);
}

void require_cells(const Hdf5Reader& file, const char* name, std::span<const CellLength> cells) {
  require_rows_to_be(file, name, cells, "a finite length > 0", is_length);
}

/// Split leaves ascend and exist; their planes are finite.
void require_split(const Hdf5Reader& file, std::span<const std::int32_t> leaf, std::span<const CellSplit> split,
                   std::size_t n_leaves) {
  require_ids(file, kSplitLeaf, leaf, n_leaves);
  for (std::size_t i = 1; i < leaf.size(); ++i)
    if (leaf[i] <= leaf[i - 1]) file.fail(kSplitLeaf, "does not ascend at row " + std::to_string(i));
  require_rows_to_be(file, kSplitPlane, split, "a plane", [](const CellSplit& s) {
    return is_finite(s.normal[0]) & is_finite(s.normal[1]) & is_finite(s.normal[2]) & is_finite(s.offset) &
           is_finite(s.margin);
  });
}

/// Of sides that are finite.
bool is_rectangle(const Cone& c) {
  bool is_good = true;
  for (int e = 0; e < 2; ++e) {
    is_good = is_good & is_finite(c.half[e]) & (c.half[e] >= 0);
    for (int k = 0; k < 3; ++k) is_good = is_good & is_finite(c.side[e][k]);
  }
  return is_good;
}

/// Sites name cones that exist, and ascend by length: a query ends at the first that is too long.
void require_site_cones(const Hdf5Reader& file, const char* first_name, const char* name, const OctreeFieldData& data,
                        std::span<const std::int32_t> first, std::span<const std::int32_t> cones) {
  if (first.size() != data.cells.size() + data.split_leaf.size() + 1)
    file.fail(first_name, "does not fit the number of cells");
  require_offsets(file, first_name, first, cones.size());
  require_ids(file, name, cones, data.cones.size());
  for (std::size_t site = 0; site + 1 < first.size(); ++site)
    for (std::int32_t k = first[site] + 1; k < first[site + 1]; ++k)
      if (data.cones[cones[k]].length < data.cones[cones[k - 1]].length)
        file.fail(name, "row " + std::to_string(k) + " names a shorter cone than the row before");
}

void require_cones(const Hdf5Reader& file, const OctreeFieldData& data) {
  require_rows_to_be(file, kCone, data.cones, "a place with a length and a slope > 0", [](const Cone& c) {
    return is_finite(c.x[0]) & is_finite(c.x[1]) & is_finite(c.x[2]) & is_positive(c.length) & is_positive(c.slope) &
           is_rectangle(c);
  });
  if (data.cone_cause.size() != data.cones.size()) file.fail(kConeCause, "does not fit the number of cones");
  require_site_cones(file, kFirstCone, kSiteCones, data, data.first_cone, data.site_cones);
  if (data.stretch.empty()) return;
  require_rows_to_be(file, kConeStretch, data.stretch, "a direction with a length", [](const ConeStretch& s) {
    return is_finite(s.direction[0]) & is_finite(s.direction[1]) & is_finite(s.direction[2]) & is_finite(s.along) &
           (s.along >= 0);
  });
  if (data.stretch.size() != data.cones.size()) file.fail(kConeStretch, "does not fit the number of cones");
  require_site_cones(file, kFirstAlong, kSiteAlong, data, data.first_along, data.site_along);
}

/// Slope and scale of a sizing.
std::pair<double, double> read_slope_and_scale(const Hdf5Reader& file) {
  const double slope = file.double_attribute(kSizing, "slope"), scale = file.double_attribute(kSizing, "scale");
  if (!is_finite(slope) || slope < 0) file.fail(std::string(kSizing) + "@slope", "is no slope");
  if (!is_finite(scale) || !(scale > 0)) file.fail(std::string(kSizing) + "@scale", "is no scale");
  return {slope, scale};
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

void write_samples(Hdf5Writer& file, const std::vector<LengthSample>& samples, Vec3 origin, bool has_reach,
                   bool is_stretched) {
  std::vector<float> points, lengths, along;
  std::vector<std::int32_t> causes;
  std::vector<SmallNormal> normals, directions;
  std::vector<SampleReach> reaches;
  for (const LengthSample& s : samples) {
    normals.push_back(s.normal);
    const Vec3 x = s.xyz - origin;
    for (const double c : {x.x, x.y, x.z}) points.push_back(static_cast<float>(c));
    lengths.push_back(s.length);
    causes.push_back(s.cause);
    directions.push_back(s.stretch.direction);
    along.push_back(s.stretch.along);
    reaches.push_back(s.reach);
  }
  file.write<float>(kSamplePoint, points, 3);
  file.write<float>(kSampleLength, lengths);
  file.write<std::int32_t>(kSampleCause, causes);
  file.write<SmallNormal>(kSampleNormal, normals);
  if (has_reach) file.write<SampleReach>(kSampleReach, reaches);
  if (!is_stretched) return;
  file.write<SmallNormal>(kSampleDirection, directions);
  file.write<float>(kSampleAlong, along);
}

std::vector<LengthSample> read_samples(const Hdf5Reader& file, Vec3 origin) {
  const std::vector<float> lengths = file.read<float>(kSampleLength), points = file.read<float>(kSamplePoint, 3);
  const std::vector<std::int32_t> causes = file.read_rows<std::int32_t>(kSampleCause, lengths.size());
  if (points.size() != 3 * lengths.size()) file.fail(kSamplePoint, "does not fit the number of lengths");
  std::vector<SmallNormal> normals(lengths.size());
  if (file.has(kSampleNormal)) normals = file.read_rows<SmallNormal>(kSampleNormal, lengths.size());
  require_finite(file, kSamplePoint, points);
  require_rows_to_be(file, kSampleLength, std::span<const float>(lengths), "a finite length > 0", is_positive);
  std::vector<LengthSample> samples;
  std::vector<SmallNormal> directions(lengths.size());
  std::vector<float> along(lengths.size());
  std::vector<SampleReach> reaches(lengths.size());
  if (file.has(kSampleReach)) {
    reaches = file.read_rows<SampleReach>(kSampleReach, lengths.size());
    require_rows_to_be(file, kSampleReach, std::span<const SampleReach>(reaches), "finite", is_reach);
  }
  if (file.has(kSampleAlong)) {
    directions = file.read_rows<SmallNormal>(kSampleDirection, lengths.size());
    along = file.read_rows<float>(kSampleAlong, lengths.size());
    require_lengths(file, kSampleAlong, along);
  }
  for (std::size_t i = 0; i < lengths.size(); ++i)
    samples.push_back({origin + Vec3{points[3 * i], points[3 * i + 1], points[3 * i + 2]},
                       lengths[i],
                       causes[i],
                       normals[i],
                       {directions[i], along[i]},
                       reaches[i]});
  return samples;
}

void write_surface(Hdf5Writer& file, const BlankSurface& surface) {
  file.write<Vec3>(kSurfacePoint, surface.points);
  file.write<Triangle>(kSurfaceTriangle, surface.triangles);
  file.set_attribute(kSizing, kFlowInside, std::int64_t{surface.side == BlankSide::kOutside});
}

BlankSurface read_surface(const Hdf5Reader& file) {
  BlankSurface surface{file.read<Vec3>(kSurfacePoint), file.read<Triangle>(kSurfaceTriangle), BlankSide::kInside};
  for (const Triangle& t : surface.triangles) require_ids(file, kSurfaceTriangle, t.n, surface.points.size());
  require_finite(file, kSurfacePoint, surface.points);
  if (file.int_attribute(kSizing, kFlowInside) != 0) surface.side = BlankSide::kOutside;
  return surface;
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
  require_rows_to_be(file, kFacePlane, std::span<const CellPlane>(faces.plane), "a plane", [](const CellPlane& p) {
    return is_finite(p.center[0]) & is_finite(p.center[1]) & is_finite(p.center[2]) & is_finite(p.normal[0]) &
           is_finite(p.normal[1]) & is_finite(p.normal[2]);
  });
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

/// Rotation by rows, scale, translation.
void write_frame(Hdf5Writer& file, const Similarity& frame) {
  std::vector<double> numbers;
  for (const Vec3& row : frame.rotation) numbers.insert(numbers.end(), {row.x, row.y, row.z});
  numbers.insert(numbers.end(), {frame.scale, frame.translation.x, frame.translation.y, frame.translation.z});
  file.write<double>(kFrame, numbers);
}

Similarity read_frame(const Hdf5Reader& file) {
  Similarity frame;
  if (!file.has(kFrame)) return frame;
  const std::vector<double> n = file.read_rows<double>(kFrame, 13);
  for (std::size_t i = 0; i < 3; ++i) frame.rotation[i] = {n[3 * i], n[3 * i + 1], n[3 * i + 2]};
  frame.scale = n[9];
  frame.translation = {n[10], n[11], n[12]};
  require_finite(file, kFrame, n);
  if (!(frame.scale > 0)) file.fail(kFrame, "its scale is not positive");
  return frame;
}

constexpr std::size_t kSourceColumns = 32;

/// Points, half axes, spacings, extent, aspect, direction.
std::array<double, kSourceColumns> source_row(const SourceSpec& s) {
  std::array<double, kSourceColumns> row{};
  auto out = row.begin();
  const auto add = [&](Vec3 v) {
    for (const double x : {v.x, v.y, v.z}) *out++ = x;
  };
  for (const Vec3 p : s.point) add(p);
  for (const Vec3 h : s.half_axis) add(h);
  for (const SourceSpacing& d : s.spacing) add({d.length, d.radius, d.doubling});
  *out++ = s.extent;
  *out++ = s.aspect;
  add(s.direction);
  return row;
}

SourceSpec source_of(SourceKind kind, const double* in) {
  SourceSpec s;
  s.kind = kind;
  const auto take = [&] {
    const Vec3 v{in[0], in[1], in[2]};
    in += 3;
    return v;
  };
  for (Vec3& p : s.point) p = take();
  for (Vec3& h : s.half_axis) h = take();
  for (SourceSpacing& d : s.spacing) {
    const Vec3 v = take();
    d = {v.x, v.y, v.z};
  }
  s.extent = *in++;
  s.aspect = *in++;
  s.direction = take();
  return s;
}

void write_sources(Hdf5Writer& file, const SourceSet& set) {
  file.set_attribute(kSizing, kSourceSlope, set.slope);
  if (!set.sources.empty()) {
    std::vector<std::uint8_t> kinds;
    std::vector<double> numbers;
    for (const SourceSpec& s : set.sources) {
      kinds.push_back(static_cast<std::uint8_t>(s.kind));
      const auto row = source_row(s);
      numbers.insert(numbers.end(), row.begin(), row.end());
    }
    file.write<std::uint8_t>(kSourceKind, kinds);
    file.write<double>(kSourceNumbers, numbers, kSourceColumns);
  }
  if (set.background.is_empty()) return;
  std::vector<double> sizes;
  for (const LocalSize& s : set.background.node_size)
    sizes.insert(sizes.end(), {s.length, s.along, s.direction.x, s.direction.y, s.direction.z});
  std::vector<std::int32_t> tets;
  for (const auto& tet : set.background.tets) tets.insert(tets.end(), tet.begin(), tet.end());
  file.write<Vec3>(kBackgroundNode, set.background.node_xyz);
  file.write<double>(kBackgroundSize, sizes, 5);
  file.write<std::int32_t>(kBackgroundTet, tets, 4);
  if (set.background.triangles.empty()) return;
  std::vector<std::int32_t> corners;
  for (const auto& triangle : set.background.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  file.write<std::int32_t>(kBackgroundTriangle, corners, 3);
}

BackgroundMesh read_background(const Hdf5Reader& file) {
  BackgroundMesh mesh;
  mesh.node_xyz = file.read<Vec3>(kBackgroundNode);
  const std::vector<double> sizes = file.read_rows<double>(kBackgroundSize, mesh.node_xyz.size(), 5);
  const std::vector<std::int32_t> tets = file.read<std::int32_t>(kBackgroundTet, 4);
  require_finite(file, kBackgroundNode, mesh.node_xyz);
  require_finite(file, kBackgroundSize, sizes);
  require_ids(file, kBackgroundTet, tets, mesh.node_xyz.size());
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i) {
    const double* s = sizes.data() + 5 * i;
    if (!(s[0] > 0 && s[1] >= s[0])) file.fail(kBackgroundSize, fmt::format("row {} is no length > 0", i));
    mesh.node_size.push_back({s[0], s[1], {s[2], s[3], s[4]}});
  }
  for (std::size_t t = 0; t + 4 <= tets.size(); t += 4)
    mesh.tets.push_back({tets[t], tets[t + 1], tets[t + 2], tets[t + 3]});
  if (!file.has(kBackgroundTriangle)) return mesh;
  const std::vector<std::int32_t> corners = file.read<std::int32_t>(kBackgroundTriangle, 3);
  require_ids(file, kBackgroundTriangle, corners, mesh.node_xyz.size());
  for (std::size_t t = 0; t + 3 <= corners.size(); t += 3)
    mesh.triangles.push_back({corners[t], corners[t + 1], corners[t + 2]});
  return mesh;
}

/// Empty where the file has none.
SourceSet read_sources(const Hdf5Reader& file) {
  SourceSet set;
  if (file.has(kOther))
    file.fail(kOther, "holds sources by cell, as one version of st-prolong stored them: run st-prolong again");
  if (!file.has(kFaceOffset)) return set;
  set.slope = file.double_attribute(kSizing, kSourceSlope);
  if (!is_finite(set.slope) || !(set.slope > 0))
    file.fail(std::string(kSizing) + "@" + kSourceSlope, "is no slope > 0");
  if (file.has(kBackgroundTet)) set.background = read_background(file);
  if (!file.has(kSourceKind)) return set;
  const std::vector<std::uint8_t> kinds = file.read<std::uint8_t>(kSourceKind);
  const std::vector<double> numbers = file.read_rows<double>(kSourceNumbers, kinds.size(), kSourceColumns);
  const std::vector<std::string> names = file.read_strings(kSourceName);
  require_finite(file, kSourceNumbers, numbers);
  if (names.size() != kinds.size()) file.fail(kSourceName, "does not fit the number of sources");
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (!find_source_type(static_cast<SourceKind>(kinds[i]))) file.fail(kSourceKind, "names a kind that is unknown");
    set.sources.push_back(source_of(static_cast<SourceKind>(kinds[i]), numbers.data() + kSourceColumns * i));
    SourceSpec& s = set.sources.back();
    s.name = names[i];
    bool is_good = s.extent >= 0 && s.aspect >= 1;
    for (int k = 0; k < n_spacings(s.kind); ++k) is_good &= s.spacing[k].length > 0 && s.spacing[k].radius >= 0;
    if (!is_good) file.fail(kSourceNumbers, fmt::format("row {} asks for no length > 0", i));
  }
  return set;
}

/// What a mapped field keeps alive.
struct MappedArrays {
  MappedArray<std::uint64_t> leaf_key;
  MappedArray<std::uint8_t> leaf_level;
  MappedArray<std::int32_t> node_child;
  MappedArray<CellLength> cell;
  MappedArray<std::int32_t> cause;
  MappedArray<std::int32_t> split_leaf;
  MappedArray<CellSplit> split;
  MappedArray<CellLength> second_cell;
  MappedArray<std::int32_t> second_cause;
  MappedArray<CellLength> along;
  MappedArray<SmallNormal> direction;
  MappedArray<Cone> cone;
  MappedArray<std::int32_t> cone_cause;
  MappedArray<std::int32_t> first_cone;
  MappedArray<std::int32_t> site_cones;
  MappedArray<ConeStretch> stretch;
  MappedArray<std::int32_t> first_along;
  MappedArray<std::int32_t> site_along;
  std::shared_ptr<const SourceTree> sources;
};

/// The cones of a file that has them.
void map_cones(const Hdf5Reader& file, MappedArrays& arrays, OctreeFieldData& data) {
  arrays.cone = file.map<Cone>(kCone);
  arrays.cone_cause = file.map<std::int32_t>(kConeCause);
  arrays.first_cone = file.map<std::int32_t>(kFirstCone);
  arrays.site_cones = file.map<std::int32_t>(kSiteCones);
  data.cones = arrays.cone.values();
  data.cone_cause = arrays.cone_cause.values();
  data.first_cone = arrays.first_cone.values();
  data.site_cones = arrays.site_cones.values();
  if (file.has(kConeStretch)) {
    arrays.stretch = file.map<ConeStretch>(kConeStretch);
    arrays.first_along = file.map<std::int32_t>(kFirstAlong);
    arrays.site_along = file.map<std::int32_t>(kSiteAlong);
    data.stretch = arrays.stretch.values();
    data.first_along = arrays.first_along.values();
    data.site_along = arrays.site_along.values();
    data.max_aspect = read_numbers(file).max_aspect;
  }
  data.max_length = read_numbers(file).far_length;
  require_cones(file, data);
}

/// The smallest length of the field is one, and coordinates of the model have digits enough for it.
void require_distinct_lengths(const Hdf5Reader& file, double min_length, double scale, double root_edge) {
  constexpr double kSmallest = 1e-15;
  if (!is_finite(min_length) || !(min_length > 0)) file.fail(std::string(kSizing) + "@smallest_length", "is no length");
  if (min_length * scale < kSmallest * root_edge)
    throw Error(
        ExitCode::kUsage,
        fmt::format("{}: lengths down to {:.3g} cannot be told apart in a model of {:.3g}; use a larger --scale",
                    file.path(), min_length * scale, root_edge));
}

std::unique_ptr<OctreeField> map_field(const Hdf5Reader& file, double min_length) {
  const std::vector<double> root = file.read_rows<double>(kRoot, 4);
  const auto arrays = std::make_shared<MappedArrays>();
  arrays->leaf_key = file.map<std::uint64_t>(kLeafKey);
  arrays->leaf_level = file.map<std::uint8_t>(kLeafLevel);
  arrays->node_child = file.map<std::int32_t>(kNodeChild, 8);
  arrays->cell = file.map<CellLength>(kCell);
  arrays->cause = file.map<std::int32_t>(kCause);
  if (file.has(kColour)) {
    const std::size_t n = file.info(kSplitLeaf).shape[0];
    arrays->split_leaf = file.map<std::int32_t>(kSplitLeaf);
    arrays->split = file.map<CellSplit>(kSplitPlane);
    arrays->second_cell = file.map<CellLength>(kSplitCell);
    arrays->second_cause = file.map<std::int32_t>(kSplitCause);
    if (arrays->split.size() != n || arrays->second_cell.size() != n || arrays->second_cause.size() != n)
      file.fail(kSplitLeaf, "does not fit the other arrays of split cells");
  }
  if (arrays->cell.size() != arrays->leaf_key.size()) file.fail(kCell, "length does not fit the number of leaves");
  if (arrays->cause.size() != arrays->leaf_key.size()) file.fail(kCause, "length does not fit the number of leaves");
  OctreeFieldData data;
  data.octree = {{root[0], root[1], root[2]},
                 root[3],
                 arrays->leaf_key.values(),
                 arrays->leaf_level.values(),
                 arrays->node_child.values()};
  require_shape(file, data.octree);
  data.cells = arrays->cell.values();
  data.cause = arrays->cause.values();
  data.split_leaf = arrays->split_leaf.values();
  data.split = arrays->split.values();
  data.second_cells = arrays->second_cell.values();
  data.second_cause = arrays->second_cause.values();
  require_cells(file, kCell, data.cells);
  require_split(file, data.split_leaf, data.split, data.cells.size());
  require_cells(file, kSplitCell, data.second_cells);
  if (file.has(kAlong)) {
    arrays->along = file.map<CellLength>(kAlong);
    arrays->direction = file.map<SmallNormal>(kDirection);
    if (arrays->along.size() != arrays->cell.size() + arrays->split_leaf.size() ||
        arrays->direction.size() != arrays->along.size())
      file.fail(kAlong, "does not fit the number of cells");
    require_cells(file, kAlong, arrays->along.values());
    data.along = arrays->along.values();
    data.direction = arrays->direction.values();
    data.max_aspect = read_numbers(file).max_aspect;
  }
  if (file.has(kCone)) map_cones(file, *arrays, data);
  arrays->sources = read_sources(file).tree();
  data.sources = arrays->sources.get();
  std::tie(data.slope, data.scale) = read_slope_and_scale(file);
  require_distinct_lengths(file, min_length, data.scale, root[3]);
  return make_octree_field(data, arrays, min_length, read_frame(file));
}

/// Nothing where no least length is given.
void write_undercuts(Hdf5Writer& file, const std::vector<double>& face_lmin, const std::vector<Undercut>& undercuts) {
  if (!face_lmin.empty()) file.write<double>(kFaceLmin, face_lmin);
  if (undercuts.empty()) return;
  std::vector<std::int32_t> causes;
  std::vector<std::int64_t> counts;
  std::vector<double> least;
  std::vector<Vec3> places;
  for (const Undercut& u : undercuts) {
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

void read_undercuts(const Hdf5Reader& file, std::size_t n_faces, std::vector<double>& face_lmin,
                    std::vector<Undercut>& undercuts) {
  if (file.has(kFaceLmin)) {
    face_lmin = file.read_rows<double>(kFaceLmin, n_faces);
    require_lengths(file, kFaceLmin, face_lmin);
  }
  if (!file.has(kUndercutCause)) return;
  const std::vector<std::int32_t> causes = file.read<std::int32_t>(kUndercutCause);
  const std::vector<std::int64_t> counts = file.read_rows<std::int64_t>(kUndercutCount, causes.size());
  const std::vector<double> least = file.read_rows<double>(kUndercutLeast, causes.size());
  const std::vector<Vec3> places = file.read_rows<Vec3>(kUndercutPlace, causes.size());
  require_lengths(file, kUndercutLeast, least);
  require_finite(file, kUndercutPlace, places);
  for (std::size_t i = 0; i < causes.size(); ++i) undercuts.push_back({causes[i], counts[i], least[i], places[i]});
}

std::vector<double> read_face_weight(const Hdf5Reader& file) {
  std::vector<double> weight = file.read<double>(kFaceWeight);
  require_lengths(file, kFaceWeight, weight);
  return weight;
}

CauseNames read_names(const Hdf5Reader& file) {
  return {file.read_strings(kEdgeName), file.read_strings(kFaceName), file.read_strings(kSourceName)};
}

}  // namespace

std::unique_ptr<OctreeField> SizingArtifact::field(const Similarity& of) const {
  const std::shared_ptr<const SourceTree> tree = sources.tree();
  return make_octree_field(field_data(tree.get()), tree, 0, of);
}

std::string cause_text(const CauseNames& names, std::int32_t cause) {
  if (cause == kNone) return "the largest length";
  const std::size_t id = static_cast<std::size_t>(cause_id(cause));
  const auto label = [id](const char* kind, const std::vector<std::string>& of) {
    const std::string name = id < of.size() ? of[id] : "";
    return std::string(kind) + " " + std::to_string(id + 1) + (name.empty() ? "" : " \"" + name + "\"");
  };
  switch (cause_kind(cause)) {
    case CauseKind::kEdge:
      return label("edge", names.edge);
    case CauseKind::kFace:
      return label("face", names.face);
    case CauseKind::kSource:
      return label("source", names.source);
    case CauseKind::kOther:
      break;
  }
  return "the background mesh";
}

std::string write_raster(const std::string& path, const RasterArtifact& raster) {
  ArtifactHeader header = raster.header;
  header.schema_version = raster.samples.empty() ? kPlainRasterVersion : kSampledRasterVersion;
  if (raster.n_not_sampled > 0) header.schema_version = kPartialRasterVersion;
  if (!raster.surface.triangles.empty()) header.schema_version = kSurfaceRasterVersion;
  if (raster.numbers.max_aspect > 1) header.schema_version = kStretchedRasterVersion;
  if (raster.faces.origin != Vec3{}) header.schema_version = kFarRasterVersion;
  const bool has_reach = std::any_of(raster.samples.begin(), raster.samples.end(),
                                     [](const LengthSample& s) { return s.reach != SampleReach{}; });
  if (has_reach) header.schema_version = kRasterVersion;
  Hdf5Writer file(path, header);
  write_numbers(file, raster.numbers);
  if (header.schema_version >= kPartialRasterVersion) file.set_attribute(kSizing, kNotSampled, raster.n_not_sampled);
  write_shape(file, raster.octree.shape);
  file.write<float>(kStoredLength, raster.octree.stored_length);
  file.write<std::int32_t>(kStoredCause, raster.octree.stored_cause);
  if (!raster.samples.empty())
    write_samples(file, raster.samples, raster.faces.origin, has_reach, raster.numbers.max_aspect > 1);
  if (!raster.surface.triangles.empty()) write_surface(file, raster.surface);
  write_face_cells(file, raster.faces);
  file.write_strings(kFaceName, raster.labels.face_name);
  file.write_strings(kEdgeName, raster.edge_name);
  write_wings(file, raster.wings);
  write_groups(file, raster.labels);
  write_undercuts(file, raster.face_lmin, raster.undercuts);
  return file.commit();
}

RasterArtifact read_raster(const std::string& path) {
  const Hdf5Reader file(path, "raster", kRasterVersion);
  require_version(file, kPlainRasterVersion, "st-raster");
  RasterArtifact raster;
  raster.header = file.header();
  raster.numbers = read_numbers(file);
  if (raster.header.schema_version >= kPartialRasterVersion)
    raster.n_not_sampled = file.int_attribute(kSizing, kNotSampled);
  raster.octree.shape = read_shape(file);
  const std::size_t n = raster.octree.shape.leaf_keys.size();
  raster.octree.stored_length = file.read_rows<float>(kStoredLength, n);
  raster.octree.stored_cause = file.read_rows<std::int32_t>(kStoredCause, n);
  if (file.has(kSurfaceTriangle)) raster.surface = read_surface(file);
  require_rows_to_be(file, kStoredLength, std::span<const float>(raster.octree.stored_length), "a length > 0",
                     [](float x) { return x > 0; });
  raster.faces = read_face_cells(file, n);
  if (file.has(kSamplePoint)) raster.samples = read_samples(file, raster.faces.origin);
  raster.edge_name = file.read_strings(kEdgeName);
  raster.wings = read_wings(file);
  raster.labels = read_face_labels(file, raster.faces);
  read_undercuts(file, raster.labels.face_name.size(), raster.face_lmin, raster.undercuts);
  return raster;
}

std::string write_sizing(const std::string& path, const SizingArtifact& sizing) {
  ArtifactHeader header = sizing.header;
  const bool is_blanked = !sizing.blanking.colour.empty();
  const bool is_moved = sizing.frame != Similarity();
  header.schema_version = is_moved ? kPlainSizingVersion : is_blanked ? kUnmovedSizingVersion : kOpenSizingVersion;
  if (!sizing.along.empty()) header.schema_version = kStretchedSizingVersion;
  if (!sizing.cones.first.empty()) header.schema_version = kConeSizingVersion;
  const bool has_faces = sizing.faces.n_faces() > 0;
  if (has_faces) header.schema_version = kFacesSizingVersion;
  if (!sizing.cones.stretch.empty()) header.schema_version = kStretchedConesVersion;
  if (!sizing.sources.background.triangles.empty()) header.schema_version = kSizingVersion;
  Hdf5Writer file(path, header);
  write_numbers(file, sizing.numbers);
  double smallest = sizing.numbers.far_length;
  for (const CellLength& c : sizing.lengths.cells) smallest = std::min<double>(smallest, c.at_centre());
  for (const Cone& c : sizing.cones.cone) smallest = std::min<double>(smallest, c.length);
  smallest = std::min(smallest, sizing.sources.min_size());
  file.set_attribute(kSizing, "slope", sizing.slope);
  file.set_attribute(kSizing, "scale", sizing.scale);
  file.set_attribute(kSizing, "smallest_length", smallest);
  write_shape(file, sizing.shape);
  if (is_moved) write_frame(file, sizing.frame);
  file.write<CellLength>(kCell, sizing.lengths.cells);
  file.write<std::int32_t>(kCause, sizing.lengths.cause);
  if (is_blanked) {
    file.write<CellColour>(kColour, sizing.blanking.colour);
    file.write<std::int32_t>(kSplitLeaf, sizing.blanking.split_leaf);
    file.write<CellSplit>(kSplitPlane, sizing.blanking.split);
    file.write<CellLength>(kSplitCell, sizing.lengths.second_cells);
    file.write<std::int32_t>(kSplitCause, sizing.lengths.second_cause);
  }
  if (!sizing.along.empty()) {
    file.write<CellLength>(kAlong, sizing.along);
    file.write<SmallNormal>(kDirection, sizing.direction);
  }
  if (!sizing.cones.first.empty()) {
    file.write<Cone>(kCone, sizing.cones.cone);
    file.write<std::int32_t>(kConeCause, sizing.cones.cause);
    file.write<std::int32_t>(kFirstCone, sizing.cones.first);
    file.write<std::int32_t>(kSiteCones, sizing.cones.of_site);
  }
  if (!sizing.cones.stretch.empty()) {
    file.write<ConeStretch>(kConeStretch, sizing.cones.stretch);
    file.write<std::int32_t>(kFirstAlong, sizing.cones.first_along);
    file.write<std::int32_t>(kSiteAlong, sizing.cones.along_of_site);
  }
  if (has_faces) {
    write_sources(file, sizing.sources);
    write_face_cells(file, sizing.faces);
    write_groups(file, sizing.labels);
    write_undercuts(file, sizing.face_lmin, sizing.undercuts);
  }
  file.write<double>(kFaceWeight, sizing.face_weight);
  file.write_strings(kFaceName, sizing.names.face);
  file.write_strings(kEdgeName, sizing.names.edge);
  file.write_strings(kSourceName, sizing.names.source);
  write_wings(file, sizing.wings);
  return file.commit();
}

SizingArtifact read_sizing(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kOpenSizingVersion, "st-prolong");
  SizingArtifact sizing;
  sizing.header = file.header();
  sizing.numbers = read_numbers(file);
  std::tie(sizing.slope, sizing.scale) = read_slope_and_scale(file);
  sizing.shape = read_shape(file);
  sizing.frame = read_frame(file);
  const std::size_t n = sizing.shape.leaf_keys.size();
  sizing.lengths.cells = file.read_rows<CellLength>(kCell, n);
  sizing.lengths.cause = file.read_rows<std::int32_t>(kCause, n);
  require_cells(file, kCell, sizing.lengths.cells);
  if (file.has(kColour)) {
    sizing.blanking.colour = file.read_rows<CellColour>(kColour, n);
    sizing.blanking.split_leaf = file.read<std::int32_t>(kSplitLeaf);
    const std::size_t n_split = sizing.blanking.split_leaf.size();
    sizing.blanking.split = file.read_rows<CellSplit>(kSplitPlane, n_split);
    sizing.lengths.second_cells = file.read_rows<CellLength>(kSplitCell, n_split);
    sizing.lengths.second_cause = file.read_rows<std::int32_t>(kSplitCause, n_split);
    require_split(file, sizing.blanking.split_leaf, sizing.blanking.split, n);
    require_cells(file, kSplitCell, sizing.lengths.second_cells);
  }
  if (file.has(kAlong)) {
    const std::size_t n_sites = n + sizing.blanking.split_leaf.size();
    sizing.along = file.read_rows<CellLength>(kAlong, n_sites);
    sizing.direction = file.read_rows<SmallNormal>(kDirection, n_sites);
    require_cells(file, kAlong, sizing.along);
  }
  if (file.has(kCone)) {
    sizing.cones.cone = file.read<Cone>(kCone);
    sizing.cones.cause = file.read<std::int32_t>(kConeCause);
    sizing.cones.first = file.read<std::int32_t>(kFirstCone);
    sizing.cones.of_site = file.read<std::int32_t>(kSiteCones);
    if (file.has(kConeStretch)) {
      sizing.cones.stretch = file.read<ConeStretch>(kConeStretch);
      sizing.cones.first_along = file.read<std::int32_t>(kFirstAlong);
      sizing.cones.along_of_site = file.read<std::int32_t>(kSiteAlong);
    }
    require_cones(file, sizing.field_data(nullptr));
  }
  sizing.face_weight = read_face_weight(file);
  sizing.names = read_names(file);
  sizing.sources = read_sources(file);
  sizing.wings = read_wings(file);
  if (file.has(kFaceOffset)) {
    sizing.faces = read_face_cells(file, n);
    sizing.labels = read_face_labels(file, sizing.faces);
    read_undercuts(file, sizing.labels.face_name.size(), sizing.face_lmin, sizing.undercuts);
  }
  return sizing;
}

MappedSizing map_sizing(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kOpenSizingVersion, "st-prolong");
  return {file.header(), read_numbers(file), read_face_weight(file),
          map_field(file, file.double_attribute(kSizing, "smallest_length"))};
}

CauseNames read_cause_names(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kOpenSizingVersion, "st-prolong");
  return read_names(file);
}

std::vector<WingRecord> read_asked_wings(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kOpenSizingVersion, "st-prolong");
  const double scale = read_slope_and_scale(file).second;
  const Similarity frame = read_frame(file);
  std::vector<WingRecord> wings;
  for (WingRecord& wing : read_wings(file)) {
    for (WingRecord::Station& s : wing.stations) s.asked *= scale;
    wings.push_back(moved(frame, std::move(wing)));
  }
  return wings;
}

std::unique_ptr<SizeField> open_sizing(const std::string& path, ArtifactHeader* header) {
  MappedSizing sizing = map_sizing(path);
  if (header) *header = std::move(sizing.header);
  return std::move(sizing.field);
}

}  // namespace st
