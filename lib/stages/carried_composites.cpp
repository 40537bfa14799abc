#include "stages/carried_composites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/sort_once.h"
#include "geometry/model/edit_model.h"

namespace st {
namespace {

/// Parameters of an edge whose range was `from` and is `to`: a line's grow where it is scaled, a circle's do not.
std::vector<double> stretched(std::span<const double> t, const double* from, const double* to) {
  std::vector<double> all(t.begin(), t.end());
  if (from[0] != to[0] || from[1] != to[1])
    for (double& x : all) x = std::lerp(to[0], to[1], (x - from[0]) / (from[1] - from[0]));
  return all;
}

/// Ids of one input in the result, kNone: gone.
std::vector<std::int32_t> places_of(const std::vector<Origin>& origins, std::int32_t input, std::int32_t n) {
  std::vector<std::int32_t> places(static_cast<std::size_t>(n), kNone);
  for (std::size_t i = 0; i < origins.size(); ++i)
    if (origins[i].input == input) places[static_cast<std::size_t>(origins[i].id)] = static_cast<std::int32_t>(i);
  return places;
}

class Carrier {
 public:
  Carrier(const EditTrace& trace, const Model& result, std::span<const Similarity> motion)
      : trace_(trace),
        result_(result),
        t_(result.tables()),
        motion_(motion),
        is_joined_(static_cast<std::size_t>(t_.n_edges()), 0) {}

  /// Returns how many composites stay behind.
  int carry(const JoinedInput& input, std::int32_t number) {
    const ModelTables& cad = input.cad;
    const Composites& c = input.composites;
    if (c.empty()) return 0;
    face_ = places_of(trace_.faces, number, cad.n_faces());
    edge_ = places_of(trace_.edges, number, cad.n_edges());
    const std::vector<VertexId> vertex = places_of(trace_.vertices, number, cad.n_vertices());
    int n_left = 0;
    for (std::int32_t i = 0; i < c.size(); ++i) {
      if (may_carry(cad, c.members(i)))
        add(cad, c, i);
      else
        ++n_left;
    }
    for (const VertexId v : c.joined_vertices)
      if (vertex[static_cast<std::size_t>(v)] != kNone) passed_.push_back(vertex[static_cast<std::size_t>(v)]);
    return n_left;
  }

  Composites take() {
    sort_once(out_.joined_edges);
    std::ranges::sort(rims_, {}, &std::pair<CoedgeId, Rim>::first);
    for (const auto& [coedge, rim] : rims_) {
      out_.rim_coedge.push_back(coedge);
      out_.rim_t.insert(out_.rim_t.end(), rim.t.begin(), rim.t.end());
      out_.rim_node.insert(out_.rim_node.end(), rim.node.begin(), rim.node.end());
      out_.rim_triangle.insert(out_.rim_triangle.end(), rim.triangle.begin(), rim.triangle.end());
      out_.rim_offsets.push_back(static_cast<std::int32_t>(out_.rim_t.size()));
    }
    pass_vertices();
    return std::move(out_);
  }

 private:
  struct Rim {
    std::vector<double> t;
    std::span<const std::int32_t> node, triangle;
  };

  bool may_carry(const ModelTables& cad, std::span<const FaceId> members) const {
    FaceId before = kNone;
    for (const FaceId m : members) {
      const FaceId f = face_[static_cast<std::size_t>(m)];
      if (f == kNone || f < before || !has_same_coedges(cad, m, f)) return false;
      before = f;
      const Similarity& motion = motion_[static_cast<std::size_t>(f)];
      if (motion.is_mirrored() ||
          !(motion == motion_[static_cast<std::size_t>(face_[static_cast<std::size_t>(members.front())])]))
        return false;
    }
    return true;
  }

  bool has_same_coedges(const ModelTables& cad, FaceId m, FaceId f) const {
    return std::ranges::equal(cad.edges_of(m), t_.edges_of(f),
                              [&](EdgeId a, EdgeId b) { return edge_[static_cast<std::size_t>(a)] == b; });
  }

  void add(const ModelTables& cad, const Composites& c, std::int32_t i) {
    const auto place = [&](FaceId m) { return face_[static_cast<std::size_t>(m)]; };
    const Similarity& motion = motion_[static_cast<std::size_t>(place(c.members(i).front()))];
    std::map<FaceId, Vec2> growth_of;  // of (u,v) of the members
    for (const FaceId m : c.members(i)) {
      out_.member.push_back(place(m));
      growth_of[m] = motion.scale == 1 ? Vec2{1, 1} : parameter_growth(result_, place(m), motion.scale);
      for (std::int32_t k = 0; k < cad.coedges(m).size(); ++k)
        add_coedge(cad, c, cad.coedges(m).first() + k, t_.coedges(place(m)).first() + k);
    }
    out_.member_offsets.push_back(static_cast<std::int32_t>(out_.member.size()));
    for (auto n = static_cast<std::size_t>(c.node_offsets[i]); n < static_cast<std::size_t>(c.node_offsets[i + 1]);
         ++n) {
      out_.node_xyz.push_back(motion(c.node_xyz[n]));
      out_.node_uv.push_back(motion.scale * c.node_uv[n]);
    }
    out_.node_offsets.push_back(static_cast<std::int32_t>(out_.node_xyz.size()));
    for (auto t = static_cast<std::size_t>(c.triangle_offsets[i]);
         t < static_cast<std::size_t>(c.triangle_offsets[i + 1]); ++t) {
      out_.triangle_nodes.push_back(c.triangle_nodes[t]);
      out_.triangle_face.push_back(place(c.triangle_face[t]));
      out_.triangle_pole.push_back(c.triangle_pole[t]);
      std::array<Vec2, 3>& uv = out_.triangle_uv.emplace_back(c.triangle_uv[t]);
      const Vec2 growth = growth_of.at(c.triangle_face[t]);
      for (Vec2& p : uv) p = {growth.x * p.x, growth.y * p.y};
    }
    out_.triangle_offsets.push_back(static_cast<std::int32_t>(out_.triangle_nodes.size()));
    for (std::size_t k = 0; k < 4; ++k)
      out_.uv_bounds.push_back(motion.scale * c.uv_bounds[4 * static_cast<std::size_t>(i) + k]);
  }

  /// `old` of the input became `now`: its edge is joined, or its rim goes with it.
  void add_coedge(const ModelTables& cad, const Composites& c, CoedgeId old, CoedgeId now) {
    const EdgeId e = cad.coedge_edge[static_cast<std::size_t>(old)];
    if (std::ranges::binary_search(c.joined_edges, e)) {
      out_.joined_edges.push_back(edge_[static_cast<std::size_t>(e)]);
      is_joined_[static_cast<std::size_t>(edge_[static_cast<std::size_t>(e)])] = 1;
      return;
    }
    const auto row = static_cast<std::size_t>(c.rim(old));
    if (row >= c.rim_coedge.size() || c.rim_coedge[row] != old) return;  // a pole
    const auto first = static_cast<std::size_t>(c.rim_offsets[row]),
               n = static_cast<std::size_t>(c.rim_offsets[row + 1]) - first;
    rims_.emplace_back(
        now, Rim{stretched(std::span(c.rim_t).subspan(first, n), &cad.edge_range[2 * static_cast<std::size_t>(e)],
                           &t_.edge_range[2 * static_cast<std::size_t>(edge_[static_cast<std::size_t>(e)])]),
                 std::span(c.rim_node).subspan(first, n), std::span(c.rim_triangle).subspan(first, n)});
  }

  /// Where two edges are left, which go on as one.
  void pass_vertices() {
    sort_once(passed_);
    std::vector<std::vector<EdgeId>> at(static_cast<std::size_t>(t_.n_vertices()));
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (const std::size_t k : {0, 1})
        if (!is_joined_[static_cast<std::size_t>(e)])
          at[static_cast<std::size_t>(t_.edge_vertices[2 * static_cast<std::size_t>(e) + k])].push_back(e);
    for (const VertexId v : passed_)
      if (const auto& own = at[static_cast<std::size_t>(v)]; own.size() == 2 && own[0] != own[1])
        out_.joined_vertices.push_back(v);
  }

  const EditTrace& trace_;
  const Model& result_;
  const ModelTables& t_;
  std::span<const Similarity> motion_;
  std::vector<FaceId> face_;  // of the input's, where they are
  std::vector<EdgeId> edge_;
  std::vector<std::uint8_t> is_joined_;  // edges of the result
  std::vector<VertexId> passed_;
  std::vector<std::pair<CoedgeId, Rim>> rims_;
  Composites out_;
};

}  // namespace

Composites carry_composites(std::span<const JoinedInput> inputs, const EditTrace& trace, const Model& result,
                            std::span<const Similarity> motion, int& n_left) {
  Carrier carrier(trace, result, motion);
  n_left = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) n_left += carrier.carry(inputs[i], static_cast<std::int32_t>(i));
  return carrier.take();
}

}  // namespace st
