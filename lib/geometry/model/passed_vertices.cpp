#include "geometry/model/passed_vertices.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"

namespace st {
namespace {

constexpr double kSmoothTurn = 0.9986;  // cosine of 3 degrees: edges go on as one

class PassedVertices {
 public:
  PassedVertices(const Model& cad, std::span<const FaceId> part_of)
      : cad_(cad),
        t_(cad.tables()),
        part_of_(part_of),
        is_alone_(part_of.size(), 1),
        uses_(static_cast<std::size_t>(t_.n_edges())),
        face_of_coedge_(static_cast<std::size_t>(t_.n_coedges())) {
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (part_of_[f] != f) is_alone_[f] = is_alone_[part_of_[f]] = 0;
      for (const CoedgeId c : t_.coedges(f)) {
        uses_[t_.coedge_edge[c]].push_back(c);
        face_of_coedge_[c] = f;
      }
    }
  }

  std::vector<VertexId> run(std::span<const EdgeId> joined_edges, std::span<const std::uint8_t> must_end) const {
    std::vector<std::uint8_t> is_end(static_cast<std::size_t>(t_.n_vertices()), 0), is_gone(uses_.size(), 0);
    std::vector<std::vector<EdgeId>> at(static_cast<std::size_t>(t_.n_vertices()));
    for (const EdgeId e : joined_edges) is_gone[e] = 1;
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (const int k : {0, 1}) {
        const VertexId v = t_.edge_vertices[2 * static_cast<std::size_t>(e) + k];
        if (is_gone[e])
          is_end[v] = 1;
        else
          at[v].push_back(e);
      }
    DisjointSets chains(t_.n_edges());
    std::vector<VertexId> passed;
    for (VertexId v = 0; v < t_.n_vertices(); ++v)
      if (is_end[v] && !must_end[v] && at[v].size() == 2 && chains.find(at[v][0]) != chains.find(at[v][1]) &&
          goes_on(at[v][0], at[v][1], v)) {
        chains.join(at[v][0], at[v][1]);
        passed.push_back(v);
      }
    return passed;
  }

 private:
  /// Away from the end at `v`.
  Vec3 direction(EdgeId e, VertexId v) const {
    const bool is_first = t_.edge_vertices[2 * static_cast<std::size_t>(e)] == v;
    const auto curve = cad_.curve(e);
    const CurvePoint p = curve->evaluate(is_first ? curve->t_min() : curve->t_max());
    return normalized(is_first ? p.d1 : -p.d1);
  }

  std::vector<FaceId> beside(EdgeId e) const {
    std::vector<FaceId> parts;
    for (const CoedgeId c : uses_[e]) parts.push_back(part_of_[face_of_coedge_[c]]);
    std::ranges::sort(parts);
    return parts;
  }

  bool goes_on(EdgeId a, EdgeId b, VertexId v) const {
    for (const EdgeId e : {a, b})
      if (t_.edge_is_degenerate[e] || !t_.edge_name[e].empty() || !(t_.edge_length[e] > 0) ||
          t_.edge_vertices[2 * static_cast<std::size_t>(e)] == t_.edge_vertices[2 * static_cast<std::size_t>(e) + 1])
        return false;
    return beside(a) == beside(b) && dot(direction(a, v), direction(b, v)) < -kSmoothTurn && are_next(a, b, v);
  }

  /// In faces that stay alone trimming curves must go on, too.
  bool are_next(EdgeId a, EdgeId b, VertexId v) const {
    constexpr double kSameUv = 1e-4;  // of the face's bounds
    const auto end = [&](CoedgeId c) {
      const std::size_t row = 2 * static_cast<std::size_t>(t_.coedge_edge[c]);
      return cad_.pcurve(face_of_coedge_[c], c)->point(t_.edge_range[row + (t_.edge_vertices[row] == v ? 0 : 1)]);
    };
    return std::ranges::all_of(uses_[a], [&](CoedgeId c) {
      const FaceId f = face_of_coedge_[c];
      if (is_alone_[f] == 0) return true;
      const double* bounds = &t_.face_uv_bounds[4 * static_cast<std::size_t>(f)];
      const Vec2 p = end(c);
      return std::ranges::any_of(uses_[b], [&](CoedgeId o) {
        if (face_of_coedge_[o] != f) return false;
        const Vec2 way = end(o) - p;
        return std::abs(way.x) <= kSameUv * (bounds[1] - bounds[0]) &&
               std::abs(way.y) <= kSameUv * (bounds[3] - bounds[2]);
      });
    });
  }

  const Model& cad_;
  const ModelTables& t_;
  std::span<const FaceId> part_of_;
  std::vector<std::uint8_t> is_alone_;
  std::vector<std::vector<CoedgeId>> uses_;
  std::vector<FaceId> face_of_coedge_;
};

}  // namespace

std::vector<VertexId> find_passed_vertices(const Model& cad, std::span<const EdgeId> joined_edges,
                                           std::span<const FaceId> part_of, std::span<const std::uint8_t> must_end) {
  return PassedVertices(cad, part_of).run(joined_edges, must_end);
}

}  // namespace st
