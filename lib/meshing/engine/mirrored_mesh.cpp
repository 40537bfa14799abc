#include "meshing/engine/mirrored_mesh.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "meshing/face/patch_image.h"

namespace st {
namespace {

/// [n_edges] 1: of faces that are images, and not in the plane.
std::vector<std::uint8_t> image_edges(const Mirror& mirror, const ModelTables& t) {
  std::vector<std::uint8_t> is_image(t.n_edges(), 0);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const EdgeId e : t.edges_of(f))
      if (mirror.face_is_image[f] && mirror.edge[e] != e) is_image[e] = 1;
  return is_image;
}

class ImageMaker {
 public:
  ImageMaker(const Mirror& mirror, const ModelTables& tables, const MeshTopology& topology, MeshResult& result)
      : mirror_(mirror), t_(tables), merged_(topology.tables()), result_(result), out_(tables) {}

  ModelTables run() {
    place_vertices();
    make_edges();
    std::vector<FacePatch> patches(t_.n_faces());
    for (FacePatch& p : result_.patches)
      if (p.face != kNone) patches[p.face] = std::move(p);
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (mirror_.face_is_image[f])
        patches[f] = image_of(patches[mirror_.face[f]], f);
      else if (mirror_.face[f] == f)
        for (Vec3& x : patches[f].inner_xyz) x = mirror_.in_plane(x);
      patches[f].face = f;
    }
    result_.patches = std::move(patches);
    add_failures();
    return std::move(out_);
  }

 private:
  /// Vertices that were merged stand where the one of the lowest id is: on the other side that may be another one.
  void place_vertices() {
    node_of_.resize(t_.n_vertices());
    std::iota(node_of_.begin(), node_of_.end(), 0);
    is_image_vertex_.assign(t_.n_vertices(), 0);
    is_image_edge_ = image_edges(mirror_, t_);
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (int k = 0; k < 2; ++k) {
        const VertexId v = t_.edge_vertices[2 * e + k];
        node_of_[v] = merged_.edge_vertices[2 * e + k];
        if (is_image_edge_[e] && mirror_.vertex[v] != v) is_image_vertex_[v] = 1;
      }
    for (VertexId v = 0; v < t_.n_vertices(); ++v) {
      const VertexId own = mirror_.vertex[v];
      if (own == v)
        out_.vertex_xyz[v] = mirror_.in_plane(t_.vertex_xyz[v]);
      else if (is_image_vertex_[v])
        out_.vertex_xyz[node_of_[v]] = mirror_.image_of(t_.vertex_xyz[node_of_[own]]);
    }
  }

  void make_edges() {
    const EdgeMesh half = std::exchange(result_.edges, EdgeMesh());
    EdgeMesh& all = result_.edges;
    all.edge_offsets.push_back(0);
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      const EdgeId own = is_image_edge_[e] ? mirror_.edge[e] : e;
      const auto first = static_cast<std::size_t>(all.edge_offsets.back());
      for (const NodeId n : half.nodes(own)) {
        const Vec3 x = half.node_xyz[n];
        all.node_t.push_back(half.node_t[n]);
        all.node_xyz.push_back(own != e ? mirror_.image_of(x) : mirror_.edge[e] == e ? mirror_.in_plane(x) : x);
        all.node_size.push_back(half.node_size[n]);
        if (!half.node_request.empty()) all.node_request.push_back(half.node_request[n]);
      }
      if (all.node_xyz.size() > first) {
        all.node_xyz[first] = out_.vertex_xyz[merged_.edge_vertices[2 * e]];
        all.node_xyz.back() = out_.vertex_xyz[merged_.edge_vertices[2 * e + 1]];
      }
      all.edge_offsets.push_back(static_cast<std::int32_t>(all.node_xyz.size()));
    }
  }

  RimPlace image_of(const RimPlace& place) const {
    const auto [dim, entity, index] = place;
    if (dim == static_cast<std::uint8_t>(EntityDim::kVertex)) return {dim, node_of_[mirror_.vertex[entity]], 0};
    return {dim, mirror_.edge[entity], index};
  }

  FacePatch image_of(const FacePatch& half, FaceId face) const {
    const bool is_turned_over = t_.face_is_reversed[face] != t_.face_is_reversed[mirror_.face[face]];
    return st::image_of(half, {face, [&](Vec3 x) { return mirror_.image_of(x); }, is_turned_over,
                               [&](const RimPlace& place) { return image_of(place); }});
  }

  void add_failures() {
    for (std::size_t i = 0, n = result_.failures.size(); i < n; ++i) {
      FaceFailure f = result_.failures[i];
      if (mirror_.face[f.face] == f.face) continue;
      f.face = mirror_.face[f.face];
      f.xyz = mirror_.image_of(f.xyz);
      result_.failures.push_back(std::move(f));
    }
    for (std::size_t i = 0, n = result_.attempts.size(); i < n; ++i) {
      FaceAttempt f = result_.attempts[i];
      FaceId& face = f.patch.face;
      if (mirror_.face[face] == face) continue;
      face = mirror_.face[face];
      for (std::vector<Vec3>* points : {&f.patch.inner_xyz, &f.places})
        for (Vec3& x : *points) x = mirror_.image_of(x);
      for (EdgeId& e : f.segment_edge) e = mirror_.edge[e];
      result_.attempts.push_back(std::move(f));
    }
    std::ranges::stable_sort(result_.failures, {}, &FaceFailure::face);
    std::ranges::stable_sort(result_.attempts, {}, &FaceAttempt::face);
    for (std::size_t i = 0, n = result_.folds.size(); i < n; ++i) {
      result_.folds.push_back(result_.folds[i]);
      result_.folds.back().x = mirror_.image_of(result_.folds[i].x);
    }
    result_.n_crossing_pairs *= 2;
  }

  const Mirror& mirror_;
  const ModelTables &t_, &merged_;
  MeshResult& result_;
  ModelTables out_;
  std::vector<VertexId> node_of_;  // of each vertex the one whose node it has
  std::vector<std::uint8_t> is_image_vertex_, is_image_edge_;
};

}  // namespace

std::vector<FaceId> faces_to_mesh(const Mirror& mirror) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < mirror.face.size(); ++f)
    if (!mirror.face_is_image[f]) faces.push_back(static_cast<FaceId>(f));
  return faces;
}

MergedFeatures mirrored(const MergedFeatures& merged, const Mirror& mirror, const ModelTables& t) {
  const std::vector<std::uint8_t> is_image = image_edges(mirror, t);
  const auto is_off_plane = [&](EdgeId e, bool by_ends) {
    const auto is_in = [&](int k) { return mirror.vertex[t.edge_vertices[2 * e + k]] == t.edge_vertices[2 * e + k]; };
    return mirror.edge[e] != e && !(by_ends && (is_in(0) || is_in(1)));
  };
  MergedFeatures all;
  for (const EdgeId e : merged.edge) {
    if (mirror.edge[e] == e) all.edge.push_back(e);
    if (is_image[e] || !is_off_plane(e, true)) continue;
    all.edge.insert(all.edge.end(), {e, mirror.edge[e]});
  }
  std::sort(all.edge.begin(), all.edge.end());
  std::vector<std::tuple<FaceId, EdgeId, EdgeId, std::uint8_t>> strips;
  std::set<FaceId> stays;  // all strips of a ledge, or none
  for (std::size_t s = 0; s < merged.strip_face.size(); ++s) {
    const EdgeId kept = merged.strip_kept[s], closed = merged.strip_closed[s];
    const bool is_ring = t.edge_vertices[2 * kept] == t.edge_vertices[2 * kept + 1];
    if (!is_off_plane(kept, is_ring) || !is_off_plane(closed, is_ring)) stays.insert(merged.strip_face[s]);
  }
  for (std::size_t s = 0; s < merged.strip_face.size(); ++s) {
    const FaceId f = merged.strip_face[s];
    const EdgeId kept = merged.strip_kept[s], closed = merged.strip_closed[s];
    if (mirror.face_is_image[f] || mirror.face[f] == f || stays.contains(f)) continue;
    strips.emplace_back(f, kept, closed, merged.strip_is_opposed[s]);
    strips.emplace_back(mirror.face[f], mirror.edge[kept], mirror.edge[closed], merged.strip_is_opposed[s]);
  }
  std::sort(strips.begin(), strips.end());
  for (const auto& [face, kept, closed, is_opposed] : strips) {
    all.strip_face.push_back(face);
    all.strip_kept.push_back(kept);
    all.strip_closed.push_back(closed);
    all.strip_is_opposed.push_back(is_opposed);
  }
  return all;
}

ModelTables add_image(const Mirror& mirror, const ModelTables& tables, const MeshTopology& topology,
                      MeshResult& result) {
  return ImageMaker(mirror, tables, topology, result).run();
}

}  // namespace st
