#include "io/hdf5/sizing_artifact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/raster_parts_io.h"
#include "io/hdf5/sources_io.h"
#include "io/hdf5/wing_records_io.h"
#include "sizing/moved_field.h"

namespace st {

template <>
struct Element<CellLength> : Elements<ElementType::kFloat32, 5> {};

template <>
struct Element<Cone> : Elements<ElementType::kFloat32, 13> {};
template <>
struct Element<ConeStretch> : Elements<ElementType::kFloat32, 4> {};

template <>
struct Element<CellSplit> : Elements<ElementType::kFloat32, 5> {};

template <>
struct Element<CellColour> : Elements<ElementType::kUint8> {};

namespace {

constexpr int kPlainSizingVersion = 7;     // of one with the same length in all directions
constexpr int kStretchedConesVersion = 8;  // of one without lengths on surfaces
constexpr int kSurfaceSizesVersion = 9;    // of one without metrics
constexpr const char* kFrame = "/st/octree/frame";
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
constexpr const char* kFirstAlong = "/st/cone/first_along";
constexpr const char* kSiteAlong = "/st/cone/along_of_site";
constexpr const char* kFaceWeight = "/st/face/weight";

/// Finite lengths > 0; `upper` may be negated.
bool is_length(const CellLength& c) {
  return is_positive(c.length) & is_positive(std::abs(c.upper)) & are_finite(c.gradient);
}

constexpr auto kCells = [](const Hdf5Reader& file, const std::string& name, std::span<const CellLength> cells) {
  require_rows_to_be(file, name, cells, "a finite length > 0", is_length);
};
constexpr auto kPlanes = [](const Hdf5Reader& file, const std::string& name, std::span<const CellSplit> split) {
  require_rows_to_be(file, name, split, "a plane", [](const CellSplit& s) {
    return are_finite(s.normal) & is_finite(s.offset) & is_finite(s.margin);
  });
};

/// Columns that stay in the file.
struct MappedColumns {
  const Hdf5Reader& file;
  MappedArrays& mapped;

  template <class T, class Check = decltype(kUnchecked)>
  void operator()(const std::string& name, std::span<const T>& column, Rows rows = {}, const Check& check = {}) const {
    column = mapped.map<T>(file, name);
    if (rows.n != Rows::kAny) file.require_rows(name, rows.n);
    check(file, name, column);
  }
};

void require_ascending(const Hdf5Reader& file, std::span<const std::int32_t> leaf) {
  for (std::size_t i = 1; i < leaf.size(); ++i)
    if (leaf[i] <= leaf[i - 1]) file.fail(kSplitLeaf, "does not ascend at row " + std::to_string(i));
}

/// Of sides that are finite.
bool is_rectangle(const Cone& c) {
  return are_finite(c.side[0]) & are_finite(c.side[1]) & are_finite(c.half) & (c.half[0] >= 0) & (c.half[1] >= 0);
}

/// Sites name cones that exist, and ascend by length: a query ends at the first that is too long.
void require_site_cones(const Hdf5Reader& file, const char* first_name, const char* name, const OctreeFieldData& data,
                        std::span<const std::int32_t> first, std::span<const std::int32_t> cones) {
  if (first.size() != data.cells.size() + data.split_leaf.size() + 1)
    file.fail(first_name, "does not fit the number of cells");
  require_offsets(file, first_name, first, cones.size());
  require_ids(file, name, cones, data.cones.cone.size());
  parallel_for(first.size() - 1, kCheckedAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t site = begin; site < end; ++site)
      for (std::int32_t k = first[site] + 1; k < first[site + 1]; ++k)
        if (data.cones.cone[cones[k]].length < data.cones.cone[cones[k - 1]].length)
          file.fail(name, "row " + std::to_string(k) + " names a shorter cone than the row before");
  });
}

void require_cones(const Hdf5Reader& file, const OctreeFieldData& data) {
  require_rows_to_be(file, kCone, data.cones.cone, "a place with a length and a slope > 0", [](const Cone& c) {
    return are_finite(c.x) & is_positive(c.length) & is_positive(c.slope) & is_rectangle(c);
  });
  if (data.cones.cause.size() != data.cones.cone.size()) file.fail(kConeCause, "does not fit the number of cones");
  require_site_cones(file, kFirstCone, kSiteCones, data, data.cones.first, data.cones.of_site);
  if (data.cones.stretch.empty()) return;
  require_rows_to_be(file, kConeStretch, data.cones.stretch, "a direction with a length", [](const ConeStretch& s) {
    return are_finite(s.direction) & is_finite(s.along) & (s.along >= 0);
  });
  if (data.cones.stretch.size() != data.cones.cone.size()) file.fail(kConeStretch, "does not fit the number of cones");
  require_site_cones(file, kFirstAlong, kSiteAlong, data, data.cones.first_along, data.cones.along_of_site);
}

/// Without cones there is one length everywhere; older versions told others by cells.
void require_no_cause(const Hdf5Reader& file, std::span<const std::int32_t> causes) {
  if (std::ranges::count(causes, kNone) != std::ssize(causes))
    throw Error(ExitCode::kInput,
                file.path() + ": an older st-prolong made it without cones; run st-raster and st-prolong again");
}

/// Slope and scale of a sizing.
std::pair<double, double> read_slope_and_scale(const Hdf5Reader& file) {
  const double slope = file.double_attribute(kSizing, "slope"), scale = file.double_attribute(kSizing, "scale");
  if (!is_finite(slope) || slope < 0) file.fail(std::string(kSizing) + "@slope", "is no slope");
  if (!is_finite(scale) || !(scale > 0)) file.fail(std::string(kSizing) + "@scale", "is no scale");
  return {slope, scale};
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

/// `lengths`: of a field or an artifact.
template <class Io, class Lengths>
void visit_lengths(const Io& io, Lengths& lengths, std::size_t n_leaves) {
  io(kCell, lengths.cells, {n_leaves}, kCells);
  io(kCause, lengths.cause, {n_leaves});
}

/// Leaves that a surface splits. `split`: of a field or a Blanking.
template <class Io, class Split, class Lengths>
void visit_split(const Io& io, Split& split, Lengths& lengths, std::size_t n_leaves) {
  io(kSplitLeaf, split.split_leaf, {}, ids_below(n_leaves));
  const std::size_t n = split.split_leaf.size();
  io(kSplitPlane, split.split, {n}, kPlanes);
  io(kSplitCell, lengths.second_cells, {n}, kCells);
  io(kSplitCause, lengths.second_cause, {n});
}

template <class Io, class Cones>
void visit_cones(const Io& io, Cones& cones, bool is_stretched) {
  io(kCone, cones.cone);
  io(kConeCause, cones.cause);
  io(kFirstCone, cones.first);
  io(kSiteCones, cones.of_site);
  if (!is_stretched) return;
  io(kConeStretch, cones.stretch);
  io(kFirstAlong, cones.first_along);
  io(kSiteAlong, cones.along_of_site);
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
  const auto mapped = std::make_shared<MappedArrays>();
  OctreeFieldData data;
  data.octree = map_shape(file, *mapped);
  const MappedColumns map{file, *mapped};
  const std::size_t n_leaves = data.octree.leaf_keys.size();
  visit_lengths(map, data, n_leaves);
  if (file.has(kColour)) visit_split(map, data, data, n_leaves);
  require_ascending(file, data.split_leaf);
  if (file.has(kCone)) {
    visit_cones(map, data.cones, file.has(kConeStretch));
    data.max_aspect = read_numbers(file).max_aspect;
    data.max_length = read_numbers(file).far_length;
    require_cones(file, data);
  } else {
    require_no_cause(file, data.cause);
  }
  const std::shared_ptr<const SourceTree> sources = read_sources(file).tree();
  mapped->owners.push_back(sources);
  data.sources = sources.get();
  std::tie(data.slope, data.scale) = read_slope_and_scale(file);
  require_distinct_lengths(file, min_length, data.scale, data.octree.edge);
  return make_octree_field(data, mapped, min_length, read_frame(file));
}

std::vector<double> read_face_weight(const Hdf5Reader& file) {
  std::vector<double> weight = file.read<double>(kFaceWeight);
  require_lengths(file, kFaceWeight, weight);
  return weight;
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

std::string write_sizing(const std::string& path, const SizingArtifact& sizing) {
  ArtifactHeader header = sizing.header;
  const bool is_blanked = !sizing.blanking.colour.empty();
  header.schema_version = kPlainSizingVersion;
  if (!sizing.cones.stretch.empty()) header.schema_version = kStretchedConesVersion;
  if (!sizing.sources.background.triangles.empty()) header.schema_version = kSurfaceSizesVersion;
  if (!sizing.sources.background.node_metric.empty()) header.schema_version = kSizingVersion;
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
  if (sizing.frame != Similarity()) write_frame(file, sizing.frame);
  const WrittenColumns write{file};
  visit_lengths(write, sizing.lengths, 0);
  if (is_blanked) {
    write(kColour, sizing.blanking.colour);
    visit_split(write, sizing.blanking, sizing.lengths, 0);
  }
  if (!sizing.cones.first.empty()) visit_cones(write, sizing.cones, !sizing.cones.stretch.empty());
  write_sources(file, sizing.sources);
  write_model(file, sizing.model);
  file.write<double>(kFaceWeight, sizing.face_weight);
  file.write_strings(kSourceName, sizing.source_name);
  return file.commit();
}

SizingArtifact read_sizing(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kPlainSizingVersion, "st-prolong");
  SizingArtifact sizing;
  sizing.header = file.header();
  sizing.numbers = read_numbers(file);
  std::tie(sizing.slope, sizing.scale) = read_slope_and_scale(file);
  sizing.shape = read_shape(file);
  sizing.frame = read_frame(file);
  const std::size_t n = sizing.shape.leaf_keys.size();
  const ReadColumns read{file};
  visit_lengths(read, sizing.lengths, n);
  if (file.has(kColour)) {
    read(kColour, sizing.blanking.colour, {n});
    visit_split(read, sizing.blanking, sizing.lengths, n);
    require_ascending(file, sizing.blanking.split_leaf);
  }
  if (file.has(kCone)) {
    visit_cones(read, sizing.cones, file.has(kConeStretch));
    require_cones(file, sizing.field_data(nullptr));
  } else {
    require_no_cause(file, sizing.lengths.cause);
  }
  sizing.face_weight = read_face_weight(file);
  sizing.sources = read_sources(file);
  sizing.model = read_model(file, n);
  sizing.source_name = file.read_strings(kSourceName);
  return sizing;
}

MappedSizing map_sizing(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kPlainSizingVersion, "st-prolong");
  return {file.header(), read_numbers(file), read_face_weight(file),
          map_field(file, file.double_attribute(kSizing, "smallest_length"))};
}

CauseNames read_cause_names(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kPlainSizingVersion, "st-prolong");
  return {file.read_strings(kEdgeName), file.read_strings(kFaceName), file.read_strings(kSourceName)};
}

std::vector<WingRecord> read_asked_wings(const std::string& path) {
  const Hdf5Reader file(path, "sizing", kSizingVersion);
  require_version(file, kPlainSizingVersion, "st-prolong");
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
