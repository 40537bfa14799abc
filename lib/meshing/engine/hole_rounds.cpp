#include "meshing/engine/hole_rounds.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/current_work.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/share.h"
#include "base/threads.h"
#include "mesh/merge.h"
#include "meshing/engine/crossing_search.h"
#include "meshing/engine/paired_faces.h"
#include "meshing/engine/region_tasks.h"
#include "meshing/hole/hole_crossing.h"
#include "meshing/hole/hole_merger.h"

namespace st {
namespace {

constexpr int kGrowth[] = {2, 6};  // layers by which a hole grows when it cannot be filled; then the whole face is done
                                   // again

}  // namespace

std::vector<FacePatch> HoleRounds::take_patches() {
  if (!failed_faces_.empty()) patches_ = insert_fills(*numbering_, holes_.marks(), fills_);
  add_old_patches(*numbering_, failed_faces_, patches_);
  return std::move(patches_);
}

void HoleRounds::mesh_edges() {
  const std::vector<SegmentRun> runs = marked_runs(old_, holes_.marks());
  const std::vector<int> least = min_segments_per_edge(model_.tables());
  const auto make = [&](std::int32_t r) {
    Box3 box;
    for (std::int32_t i = runs[r].first; i <= runs[r].last; ++i) box.add(old_.edges.node_xyz[i]);
    const RefinedField field(field_, refinements_.near(box));
    return discretise_run(old_, runs[r], *model_.curve(runs[r].edge), field,
                          {options_.max_turning_deg, least[runs[r].edge]});
  };
  update_ = update_edges(old_, runs, paired_.make_nodes(runs, make, executor_));
  request_curve_lengths();
  numbering_.emplace(old_, update_);
  result_.edges = update_.edges;
}

/// New nodes were asked for by the field, whatever was refined.
void HoleRounds::request_curve_lengths() {
  int hint = 0;
  EdgeMesh& e = update_.edges;
  for (std::size_t i = 0; i < e.node_t.size(); ++i)
    if (e.node_previous[i] == kNone) e.node_request[i] = field_.size(e.node_xyz[i], hint);
}

/// Fills all holes; those where that fails grow and are filled again. No places: sizes do not help.
std::vector<RefinementPoint> HoleRounds::mesh_regions() {
  fills_.assign(model_.tables().n_faces(), {});
  std::vector<FaceId> faces = paired_.filled_of(holes_.dirty_faces());
  for (std::size_t step = 0;; ++step) {
    const std::vector<HoleRim> rims = find_rims(faces);
    if (rims.empty()) return {};
    faces.clear();
    const bool can_grow = step <= std::size(kGrowth);
    for (const std::int32_t i : fill(rims)) {
      if (faces.empty() || faces.back() != rims[i].face) faces.push_back(rims[i].face);
      if (!can_grow) continue;
      ++result_.n_grown;
      if (executor_.is_root()) grow(rims[i], step);
    }
    for (const FaceId f : faces) fills_[f].clear();
    if (can_grow) continue;
    failed_faces_ = paired_.with_partners(faces);
    return {};
  }
}

/// The hole grows by layers first, then to the whole face.
void HoleRounds::grow(const HoleRim& rim, std::size_t step) {
  if (step < std::size(kGrowth))
    holes_.grow(rim.face, rim.triangles, kGrowth[step]);
  else
    holes_.grow_to_face(rim.face);
}

/// Collective. By face; on every rank, their triangles on rank 0.
std::vector<HoleRim> HoleRounds::find_rims(const std::vector<FaceId>& faces) const {
  std::vector<HoleRim> rims;
  if (executor_.is_root())
    for (const FaceId f : faces)
      for (HoleRim& rim : find_hole_rims(old_, holes_.marks(), f)) rims.push_back(std::move(rim));
  share(executor_, rims);
  return rims;
}

/// Without triangles where it cannot be filled, or where earlier runs ended at its face.
Piece HoleRounds::fill_hole(const HoleRim& rim, const MakeMesh& make_mesh) const {
  const CurrentWork at_face("face", rim.face + 1);
  Piece fill;
  if (options_.left_out.contains(rim.face)) return fill;
  try {
    const RefinedField field(field_, refinements_.near(model_.tables().face_box[rim.face]));
    const auto surface = model_.surface(rim.face);
    const FaceBoundary boundary = make_hole_boundary(model_, *surface, rim, holes_.marks(), *numbering_, field);
    FaceMesh filled = make_mesh(*surface, boundary, field);
    if (filled.cause == FailureCause::kNone && filled.n_folds == 0)
      fill = make_hole_fill(rim, boundary, std::move(filled));
  } catch (const Error&) {  // no triangles: the hole grows
  }
  int hint = 0;
  for (FaceNode& n : fill.mesh.inner) n.h = field_.size(n.x, hint);
  return fill;
}

/// Collective. A fill is a function of the inputs, of the new nodes on curves, of what was refined, and of the
/// triangles in all holes, which rank 0 knows.
std::string HoleRounds::made_from(const std::vector<HoleRim>& rims) const {
  std::string digest;
  if (executor_.is_root()) {
    Hasher hasher;
    const Bytes bytes = packed(result_.edges, refinements_.all());
    hasher.add(bytes.data(), bytes.size());
    for (const HoleRim& rim : rims) hasher.add(std::span<const TriangleId>(rim.triangles));
    digest = hasher.hex();
  }
  share(executor_, digest);
  return digest;
}

/// Counts by the sizes over the marked triangles.
double HoleRounds::expected_triangles(const HoleRim& rim) const {
  constexpr std::size_t kPerPiece = 8192;
  const SurfaceMesh& m = old_.mesh;
  const FaceField field(field_, refinements_, model_.tables().face_box[rim.face]);
  std::vector<double> pieces(rim.triangles.size() / kPerPiece + 1, 0);
  parallel_for(rim.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    int hint = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const NodeId* n = m.triangles[rim.triangles[k]].n;
      const Vec3 a = m.node_xyz[n[0]], b = m.node_xyz[n[1]], c = m.node_xyz[n[2]];
      const double h = field.get().size((a + b + c) / 3, hint);
      pieces[begin / kPerPiece] += kTrianglesPerWeight * 0.5 * norm(cross(b - a, c - a)) / (h * h);
    }
  });
  return std::accumulate(pieces.begin(), pieces.end(), 0.0);
}

/// Collective. By hole, from rank 0, which knows their triangles.
std::vector<double> HoleRounds::expected_triangles(const std::vector<HoleRim>& rims) const {
  std::vector<double> expected(rims.size(), 0);
  for (std::size_t i = 0; executor_.is_root() && i < rims.size(); ++i) try {
      expected[i] = expected_triangles(rims[i]);
    } catch (const Error&) {  // filling it will say what is wrong
    }
  share(executor_, expected);
  return expected;
}

Regions HoleRounds::holes_as_regions(const std::vector<HoleRim>& rims) const {
  return {.face = [&rims](std::int32_t i) { return rims[i].face; },
          .boundary =
              [this, &rims](std::int32_t i, const Surface& surface) {
                const RefinedField field(field_, refinements_.near(model_.tables().face_box[rims[i].face]));
                return make_hole_boundary(model_, surface, rims[i], holes_.marks(), *numbering_, field);
              },
          .places = [this](const FaceBoundary& boundary) { return hole_places(boundary, *numbering_); },
          .share_faces = true};
}

/// From the tiles.
Piece HoleRounds::fill_tiled(const HoleRim& rim, std::int32_t number, TiledRegions& tiled) const {
  return fill_hole(rim, [&](const Surface& surface, const FaceBoundary& boundary, const SizeField&) {
    Piece seams = tiled.seams(surface, number, boundary, executor_);
    if (seams.mesh.n_folds > 0) return std::move(seams.mesh);  // it will not do
    return tiled.join(number, boundary, std::move(seams), executor_);
  });
}

/// Collective. Fills the holes, heavy ones tile by tile, or as a whole where that fails; returns those that stay open,
/// ascending.
std::vector<std::int32_t> HoleRounds::fill(const std::vector<HoleRim>& rims) {
  const std::vector<double> expected = expected_triangles(rims);
  std::vector<Piece> fills(rims.size());
  const MakeMesh make = [&](const Surface& surface, const FaceBoundary& boundary, const SizeField& field) {
    return mesh_face(surface, boundary, field, options_.of_face());
  };
  const auto take = [&](std::int32_t i, Bytes&& result) {
    unpack(result, fills[i]);
    return !fills[i].mesh.corners.empty();
  };
  std::vector<std::int32_t> all(rims.size());
  std::iota(all.begin(), all.end(), 0);
  RegionTasks({.cut = "hole cut",
               .whole = "hole",
               .tile = "hole tile",
               .seams = "hole join",
               .progress = "filling holes",
               .unit = "",
               .make_whole = [&](std::int32_t i) { return packed(fill_hole(rims[i], make)); },
               .take_whole = take,
               .make_seams = [&](std::int32_t i, TiledRegions& tiled) { return packed(fill_tiled(rims[i], i, tiled)); },
               .take_seams = take},
              TiledRegions(model_, holes_as_regions(rims), field_, refinements_, options_.of_face(), {}),
              made_from(rims), expected, options_, executor_)
      .run(all);
  std::vector<std::int32_t> failed;
  for (std::size_t i = 0; executor_.is_root() && i < rims.size(); ++i) {
    if (fills[i].mesh.corners.empty() || !add_image(rims[i].face, fills[i]))
      failed.push_back(static_cast<std::int32_t>(i));
    fills_[rims[i].face].push_back(std::move(fills[i]));
  }
  share(executor_, failed);
  return failed;
}

/// Local, on rank 0. Whether the face's partner, if it has one, has the image of what fills the whole face.
bool HoleRounds::add_image(FaceId face, const Piece& fill) {
  const FaceId partner = paired_.partner_of(face);
  if (partner == kNone) return true;
  fills_[partner].assign(1, paired_.image(face, fill, *numbering_));
  return !fills_[partner][0].mesh.corners.empty();
}

/// What was kept and what is new as one mesh.
void HoleRounds::join() {
  if (!failed_faces_.empty()) result_.mesh = {};
  if (!failed_faces_.empty() || !executor_.is_root()) return;
  renew_surrounded_nodes();
  result_.edges = update_.edges;
  patches_ = insert_fills(*numbering_, holes_.marks(), fills_);
  result_.mesh = weld_filled(*numbering_, patches_);
}

/// Nodes that stay although all their triangles are new were asked for by the new sizes as well.
void HoleRounds::renew_surrounded_nodes() {
  std::vector<char> is_held(old_.inner_begin[0], 0);
  const auto hold = [&](TriangleId t) {
    for (NodeId n : old_.mesh.triangles[t].n)
      if (n < old_.inner_begin[0]) is_held[n] = 1;
  };
  const std::vector<char>& is_marked = holes_.marks().triangle;
  for (TriangleId t = 0; t < static_cast<TriangleId>(is_marked.size()); ++t)
    if (!is_marked[t]) hold(t);
  int hint = 0;
  EdgeMesh& e = update_.edges;
  for (std::size_t i = 0; i < e.node_t.size(); ++i)
    if (const NodeId n = e.node_previous[i]; n != kNone && !is_held[n])
      e.node_request[i] = field_.size(e.node_xyz[i], hint);
}

/// Both triangles of a pair are halved; one of the old mesh is made again. None where a face failed.
std::vector<RefinementPoint> HoleRounds::find_crossings() {
  std::vector<RefinementPoint> places;
  if (!failed_faces_.empty() || !executor_.is_root()) return places;
  const SurfaceMesh& m = result_.mesh;
  const std::vector<TrianglePair> pairs = find_new_crossings(m, bodies_of(model_.tables()));
  result_.n_crossing_pairs = static_cast<int>(pairs.size());
  n_unmeasured_pairs_ = result_.n_crossing_pairs;
  crossing_.clear();
  for (const TrianglePair& pair : pairs)
    for (const TriangleId t : {pair.a, pair.b}) {
      if (places.size() >= kHolePolicy.max_crossing_places) break;
      const NodeId* n = m.triangles[t].n;
      places.push_back(halve_triangle(m.node_xyz[n[0]], m.node_xyz[n[1]], m.node_xyz[n[2]]));
      if (m.triangle_previous[t] != kNone) crossing_.push_back(m.triangle_previous[t]);
    }
  return options_.pairs ? with_images(std::move(places), *options_.pairs, model_.tables()) : places;
}

void HoleRounds::choose_again(std::size_t) {
  if (executor_.is_root()) log_info("refining where new triangles cross others");
  holes_.mark_again(refinements_, crossing_);
}

}  // namespace st
