#include "meshing/engine/paired_holes.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/sort_once.h"
#include "mesh/merge.h"
#include "meshing/engine/curve_tasks.h"
#include "meshing/engine/paired_faces.h"
#include "meshing/face/face_patch.h"

namespace st {

PairedHoles::PairedHoles(const Model& model, const HoleMesh& old, const PeriodicPairs* pairs)
    : model_(model), old_(old), pairs_(pairs ? *pairs : none_) {}

EdgeMesh PairedHoles::make_nodes(const std::vector<SegmentRun>& runs,
                                 const std::function<EdgeMesh(std::int32_t r)>& make, const Executor& executor) const {
  std::vector<std::int32_t> own, images, place(runs.size(), kNone);
  for (std::int32_t r = 0; r < static_cast<std::int32_t>(runs.size()); ++r) {
    std::vector<std::int32_t>& kind = pairs_.empty() || pairs_.edges()[runs[r].edge].leader == kNone ? own : images;
    place[r] = static_cast<std::int32_t>(kind.size());
    kind.push_back(r);
  }
  const auto make_own = [&](std::int32_t i) {
    EdgeMesh nodes = make(own[i]);
    if (!pairs_.empty())
      for (std::size_t k = 1; k + 1 < nodes.node_xyz.size(); ++k)
        nodes.node_xyz[k] = pairs_.on_own_axis(runs[own[i]].edge, nodes.node_xyz[k]);
    return nodes;
  };
  EdgeMesh nodes = make_curve_nodes(static_cast<std::int32_t>(own.size()), make_own, executor);
  if (images.empty()) return nodes;
  const EdgeMesh followed = make_curve_nodes(
      static_cast<std::int32_t>(images.size()),
      [&](std::int32_t i) { return image_of_run(runs[images[i]], runs, nodes, place); }, executor);
  EdgeMesh all;
  for (std::size_t r = 0; r < runs.size(); ++r)
    all.append(pairs_.edges()[runs[r].edge].leader == kNone ? nodes : followed, place[r]);
  return all;
}

/// `nodes`: of leaders, by their `place`. Its ends stay to the bit.
EdgeMesh PairedHoles::image_of_run(const SegmentRun& run, const std::vector<SegmentRun>& runs, const EdgeMesh& nodes,
                                   const std::vector<std::int32_t>& place) const {
  const EdgeMesh& m = old_.edges;
  const PairFollower& f = pairs_.edges()[run.edge];
  const std::int32_t from = m.first_node(run.edge), to = m.first_node(f.leader), last = m.n_nodes(run.edge) - 1,
                     first = to + (f.is_opposed ? last - (run.last - from) : run.first - from);
  const auto it =
      std::ranges::find_if(runs, [&](const SegmentRun& r) { return r.edge == f.leader && r.first == first; });
  if (it == runs.end() || it->last - it->first != run.last - run.first)
    throw Error(ExitCode::kInternal, old_.tables.edge_label(run.edge) + ": what goes of it is no image");
  EdgeMesh leader;
  leader.append(nodes, place[it - runs.begin()]);
  EdgeMesh image =
      image_nodes(old_.tables, run.edge, *model_.curve(run.edge), f, leader, m.node_t[run.first], m.node_t[run.last]);
  image.node_xyz.front() = m.node_xyz[run.first];
  image.node_xyz.back() = m.node_xyz[run.last];
  return image;
}

std::vector<FaceId> PairedHoles::filled_of(const std::vector<FaceId>& faces) const {
  std::vector<FaceId> filled;
  std::ranges::copy_if(faces, std::back_inserter(filled), [&](FaceId f) {
    return std::ranges::none_of(pairs_.pairs(), [&](const FacePair& p) { return p.b == f; });
  });
  return filled;
}

std::vector<FaceId> PairedHoles::with_partners(std::vector<FaceId> faces) const {
  for (std::size_t i = 0, n = faces.size(); i < n; ++i)
    if (const FaceId b = partner_of(faces[i]); b != kNone) faces.push_back(b);
  sort_once(faces);
  return faces;
}

std::optional<std::size_t> PairedHoles::pair_of(FaceId face) const {
  const auto it = std::ranges::find(pairs_.pairs(), face, &FacePair::a);
  if (it == pairs_.pairs().end()) return std::nullopt;
  return static_cast<std::size_t>(it - pairs_.pairs().begin());
}

FaceId PairedHoles::partner_of(FaceId face) const {
  const auto pair = pair_of(face);
  return pair ? pairs_.pairs()[*pair].b : kNone;
}

Piece PairedHoles::image(FaceId face, const Piece& fill, const HoleNumbering& numbering) const {
  FaceBoundary boundary;
  boundary.nodes = fill.boundary;
  FaceMesh mesh = fill.mesh;
  for (std::size_t i = 0; old_.face_is_turned[face] && i < mesh.corners.size(); i += 3)
    std::swap(mesh.corners[i + 1], mesh.corners[i + 2]);
  const PairImage image =
      image_on_pair(model_, pairs_, *pair_of(face), make_patch(old_.tables, face, boundary, mesh, numbering.boundary),
                    numbering.boundary);
  return image.error.empty() ? as_fill(image.patch, numbering) : Piece();
}

/// Boundary nodes by their (u,v), of which one on a seam has two. They have a place by their id alone.
Piece PairedHoles::as_fill(const FacePatch& patch, const HoleNumbering& numbering) const {
  Piece fill;
  std::map<std::tuple<NodeId, double, double>, std::int32_t> known;
  std::vector<std::int32_t> number(3 * patch.triangles.size(), kNone);
  for (std::size_t i = 0; i < patch.uv_corner.size(); ++i) {
    const std::int32_t corner = patch.uv_corner[i];
    const NodeId n = patch.triangles[corner / 3].n[corner % 3];
    const Vec2 uv = patch.own_uv[i];
    const auto [it, is_new] = known.emplace(std::tuple(n, uv.x, uv.y), static_cast<std::int32_t>(fill.boundary.size()));
    number[corner] = it->second;
    if (is_new)
      fill.boundary.push_back(
          {uv, {}, 0, boundary_id_of(old_.tables.n_vertices(), numbering.update.edges, patch, n), false});
  }
  const auto shift = static_cast<std::int32_t>(fill.boundary.size()) - patch.n_boundary;
  for (std::size_t i = 0; i < patch.inner_xyz.size(); ++i)
    fill.mesh.inner.push_back({patch.inner_uv[i], patch.inner_xyz[i], patch.inner_size[i], kNone, false});
  // a patch's triangles look out of the solid, those of a fill as the mesh before
  const bool turns = (old_.tables.face_is_reversed[patch.face] != 0) != (old_.face_is_turned[patch.face] != 0);
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const auto node = [&](std::size_t k) {
      return number[3 * t + k] == kNone ? patch.triangles[t].n[k] + shift : number[3 * t + k];
    };
    for (const std::size_t k : turns ? std::array{0u, 2u, 1u} : std::array{0u, 1u, 2u})
      fill.mesh.corners.push_back(node(k));
  }
  return fill;
}

std::vector<char> PairedHoles::with_edges_of_pairs(std::vector<char> keep_edge) const {
  if (pairs_.empty()) return keep_edge;
  keep_edge.resize(static_cast<std::size_t>(old_.tables.n_edges()), 0);
  for (const FacePair& p : pairs_.pairs())
    for (const FaceId f : {p.a, p.b})
      for (const EdgeId e : old_.tables.edges_of(f)) keep_edge[e] = 1;
  return keep_edge;
}

}  // namespace st
