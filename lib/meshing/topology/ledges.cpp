#include "meshing/topology/ledges.h"

#include <algorithm>
#include <utility>

#include "features/arc_table.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

constexpr double kStep = 0.5;  // cosine between the normals on both sides of a ledge, at least

class LedgeFinder {
 public:
  LedgeFinder(const Model& model, const SizeField& field, std::span<const MergeLimit> face_limit)
      : model_(model), t_(model.tables()), field_(field), face_limit_(face_limit), faces_at_(t_) {}

  /// A strip for each pair of edges, in the order of the first loop; empty where the face is no narrow ledge.
  std::vector<Strip> strips_of(FaceId f) {
    const IdRange loops = t_.loops(f);
    if (loops.size() != 2) return {};
    const IdRange a = t_.loop_coedges(loops.first()), b = t_.loop_coedges(loops.first() + 1);
    if (a.size() != b.size() || a.size() < 2 || !are_between_two(f)) return {};
    const std::int32_t n = a.size(), nearest = nearest_corner(a.first(), b);
    std::vector<Strip> strips;
    for (std::int32_t i = 0; i < n; ++i) {
      const CoedgeId own = a.first() + i, across = b.first() + (nearest - i - 1 + 2 * n) % n;
      Strip strip;
      strip.face = f;
      strip.edges[0] = t_.coedge_edge[own], strip.edges[1] = t_.coedge_edge[across];
      strip.is_opposed = t_.coedge_is_reversed[own] == t_.coedge_is_reversed[across];
      if (!is_narrow(strip) || !is_step(own, across)) return {};
      strip.length = t_.edge_length[strip.edges[0]];
      strips.push_back(std::move(strip));
    }
    return strips;
  }

 private:
  /// Whether each of its edges has another face across, and two ends.
  bool are_between_two(FaceId f) const {
    return std::ranges::all_of(t_.edges_of(f), [&](EdgeId e) {
      return !t_.edge_is_degenerate[e] && faces_at_[e].size() == 2 && faces_at_[e][0] != faces_at_[e][1] &&
             t_.edge_vertices[2 * e] != t_.edge_vertices[2 * e + 1];
    });
  }

  Vec3 start(CoedgeId c) const {
    return t_.vertex_xyz[t_.edge_vertices[2 * t_.coedge_edge[c] + (t_.coedge_is_reversed[c] ? 1 : 0)]];
  }

  /// Which coedge of the other loop starts nearest to where this one starts.
  std::int32_t nearest_corner(CoedgeId c, IdRange loop) const {
    std::int32_t nearest = 0;
    for (std::int32_t k = 1; k < loop.size(); ++k)
      if (distance(start(loop.first() + k), start(c)) < distance(start(loop.first() + nearest), start(c))) nearest = k;
    return nearest;
  }

  /// At equal shares of the lengths, the ends included.
  bool is_narrow(const Strip& strip) {
    constexpr int kPlaces = 8;
    constexpr double kClearly = 0.8;  // in between it may be wider
    const auto kept = model_.curve(strip.edges[0]), closed = model_.curve(strip.edges[1]);
    const ArcTable a(*kept), b(*closed);
    for (int i = 0; i <= kPlaces; ++i) {
      const double share = static_cast<double>(i) / kPlaces;
      const Vec3 x = kept->point(a.parameter_at(share)),
                 y = closed->point(b.parameter_at(strip.is_opposed ? 1 - share : share));
      if (distance(x, y) > kClearly * face_limit_[strip.face].at(field_.size(x, hint_))) return false;
    }
    return true;
  }

  /// Whether the surface turns up at one edge and down at the other: no wall ends here, and no groove is closed.
  bool is_step(CoedgeId own, CoedgeId across) const {
    const Vec3 a = normal_beyond(own), b = normal_beyond(across);
    return dot(a, b) > kStep;
  }

  /// Half way along the edge, outward.
  Vec3 normal_beyond(CoedgeId c) const {
    const EdgeId e = t_.coedge_edge[c];
    for (const FaceId f : faces_at_[e])
      for (const CoedgeId other : t_.coedges(f)) {
        if (other == c || t_.coedge_edge[other] != e) continue;
        const double t = 0.5 * (t_.edge_range[2 * e] + t_.edge_range[2 * e + 1]);
        const SurfacePoint p = model_.surface(f)->evaluate(model_.pcurve(f, other)->point(t));
        const Vec3 n = normalized(cross(p.du, p.dv));
        return t_.face_is_reversed[f] ? -n : n;
      }
    return {};
  }

  const Model& model_;
  const ModelTables& t_;
  const SizeField& field_;
  std::span<const MergeLimit> face_limit_;
  EdgeFaces faces_at_;
  int hint_ = 0;
};

}  // namespace

std::vector<Strip> find_ledges(const Model& model, const SizeField& field, std::span<const MergeLimit> face_limit) {
  LedgeFinder finder(model, field, face_limit);
  std::vector<Strip> strips;
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    for (Strip& strip : finder.strips_of(f)) strips.push_back(std::move(strip));
  return strips;
}

}  // namespace st
