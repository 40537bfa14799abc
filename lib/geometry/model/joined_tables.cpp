#include "geometry/model/joined_tables.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "geometry/model/rectangle_width.h"

namespace st {
namespace {

/// A coedge of the CAD on its way around a face.
struct Step {
  CoedgeId coedge;
  bool is_reversed;  ///< passed against its edge
};

class TableJoiner {
 public:
  TableJoiner(const ModelTables& cad, const Composites& composites)
      : cad_(cad),
        composites_(composites),
        is_joined_(static_cast<std::size_t>(cad.n_edges()), 0),
        is_inside_(static_cast<std::size_t>(cad.n_vertices()), 0),
        composite_of_(static_cast<std::size_t>(cad.n_faces()), kNone),
        uses_(static_cast<std::size_t>(cad.n_edges())),
        loop_of_(static_cast<std::size_t>(cad.n_coedges())),
        face_of_coedge_(static_cast<std::size_t>(cad.n_coedges())),
        chain_of_(static_cast<std::size_t>(cad.n_edges()), kNone),
        place_in_chain_(static_cast<std::size_t>(cad.n_edges()), kNone) {}

  JoinedTables run() {
    mark();
    find_chains();
    joined_.tables = cad_;
    join_edges();
    add_loops();
    for (FaceId f = 0; f < cad_.n_faces(); ++f)
      if (joined_.composite[f] != kNone)
        measure(f);
      else if (joined_.face_of[f] != f)
        empty(f);
    return std::move(joined_);
  }

 private:
  void mark() {
    for (const EdgeId e : composites_.joined_edges) is_joined_[e] = 1;
    for (const VertexId v : composites_.joined_vertices) is_inside_[v] = 1;
    for (std::int32_t i = 0; i < composites_.size(); ++i)
      for (const FaceId f : composites_.members(i)) composite_of_[f] = i;
    for (FaceId f = 0; f < cad_.n_faces(); ++f)
      for (const LoopId l : cad_.loops(f))
        for (const CoedgeId c : cad_.loop_coedges(l)) {
          uses_[cad_.coedge_edge[c]].push_back(c);
          loop_of_[c] = l;
          face_of_coedge_[c] = f;
        }
  }

  /// A pole of a composite is a point like others of its chart.
  bool is_gone(EdgeId e) const {
    if (is_joined_[e]) return true;
    return cad_.edge_is_degenerate[e] && !uses_[e].empty() &&
           std::ranges::all_of(uses_[e], [&](CoedgeId c) { return composite_of_[face_of_coedge_[c]] != kNone; });
  }

  VertexId end(EdgePiece p, bool is_last) const {
    return cad_.edge_vertices[2 * static_cast<std::size_t>(p.edge) + (is_last != p.is_reversed ? 1 : 0)];
  }

  /// The piece on the other side of the last (or first) vertex of `p`; no edge where the chain ends.
  EdgePiece beyond(EdgePiece p, bool is_last) const {
    const VertexId v = end(p, is_last);
    if (!is_inside_[v]) return {};
    for (const EdgeId e : at_vertex_[v])
      if (e != p.edge) return {e, end({e, false}, !is_last) != v};
    return {};
  }

  void find_chains() {
    at_vertex_.resize(static_cast<std::size_t>(cad_.n_vertices()));
    for (EdgeId e = 0; e < cad_.n_edges(); ++e)
      if (!is_gone(e) && !cad_.edge_is_degenerate[e])
        for (const int k : {0, 1})
          if (const VertexId v = cad_.edge_vertices[2 * static_cast<std::size_t>(e) + k]; is_inside_[v])
            at_vertex_[v].push_back(e);
    joined_.piece_offsets = {0};
    for (EdgeId e = 0; e < cad_.n_edges(); ++e) {
      if (!is_gone(e) && chain_of_[e] == kNone) add_chain(e);
      joined_.piece_offsets.push_back(static_cast<std::int32_t>(joined_.pieces.size()));
    }
  }

  void add_chain(EdgeId e) {
    EdgePiece p{e, false};
    if (!cad_.edge_is_degenerate[e])
      for (EdgePiece before = beyond(p, false); before.edge != kNone && before.edge != e; before = beyond(p, false))
        p = before;
    for (; p.edge != kNone && chain_of_[p.edge] == kNone;
         p = cad_.edge_is_degenerate[e] ? EdgePiece{} : beyond(p, true)) {
      chain_of_[p.edge] = e;
      place_in_chain_[p.edge] = static_cast<std::int32_t>(joined_.pieces.size()) - joined_.piece_offsets.back();
      joined_.pieces.push_back(p);
    }
  }

  void join_edges() {
    ModelTables& t = joined_.tables;
    for (EdgeId e = 0; e < cad_.n_edges(); ++e) {
      const auto pieces = joined_.pieces_of(e);
      const auto row = 2 * static_cast<std::size_t>(e);
      if (pieces.empty()) {  // a point without a use
        t.edge_vertices[row + 1] = t.edge_vertices[row];
        t.edge_length[e] = 0;
        t.edge_is_degenerate[e] = 1;
        t.edge_name[e].clear();
      }
      if (pieces.size() < 2) continue;
      t.edge_vertices[row] = end(pieces.front(), false);
      t.edge_vertices[row + 1] = end(pieces.back(), true);
      t.edge_length[e] = 0;
      for (const EdgePiece& p : pieces) {
        t.edge_length[e] += cad_.edge_length[p.edge];
        t.edge_tolerance[e] = std::max(t.edge_tolerance[e], cad_.edge_tolerance[p.edge]);
      }
      t.edge_range[row] = 0, t.edge_range[row + 1] = t.edge_length[e];
    }
  }

  /// Around a face with its outside towards the eye, the face on the left.
  Step step(CoedgeId c) const {
    const bool is_turned = composite_of_[face_of_coedge_[c]] != kNone && cad_.face_is_reversed[face_of_coedge_[c]] != 0;
    return {c, (cad_.coedge_is_reversed[c] != 0) != is_turned};
  }

  CoedgeId next(CoedgeId c) const {
    const IdRange loop = cad_.loop_coedges(loop_of_[c]);
    const std::int32_t first = loop.first(), n = loop.size();
    const bool is_turned = cad_.face_is_reversed[face_of_coedge_[c]] != 0;
    return first + (c - first + (is_turned ? n - 1 : 1)) % n;
  }

  /// The next one along the rim of a composite.
  CoedgeId next_on_rim(CoedgeId c) const {
    c = next(c);
    for (std::size_t i = 0; i < cad_.coedge_edge.size(); ++i) {
      const EdgeId e = cad_.coedge_edge[c];
      if (is_joined_[e])
        c = uses_[e][0] == c ? uses_[e].back() : uses_[e].front();
      else if (!cad_.edge_is_degenerate[e])
        return c;
      c = next(c);
    }
    fail();
  }

  [[noreturn]] static void fail() {
    throw Error(ExitCode::kInput, "loops of composites in the geometry artifact do not close; run st-import again");
  }

  std::vector<std::vector<Step>> rim_loops(std::int32_t composite) const {
    std::vector<std::pair<double, std::vector<Step>>> loops;
    std::vector<CoedgeId> seen;
    const auto is_seen = [&](CoedgeId c) { return std::ranges::find(seen, c) != seen.end(); };
    for (const FaceId f : composites_.members(composite))
      for (const CoedgeId first : cad_.coedges(f)) {
        const EdgeId e = cad_.coedge_edge[first];
        if (is_joined_[e] || cad_.edge_is_degenerate[e] || is_seen(first)) continue;
        std::vector<Step> loop;
        for (CoedgeId c = first; loop.empty() || c != first; c = next_on_rim(c)) {
          if (loop.size() > cad_.coedge_edge.size()) fail();
          loop.push_back(step(c));
          seen.push_back(c);
        }
        loops.emplace_back(-area(composite, loop), std::move(loop));
      }
    std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::vector<Step>> result;
    for (auto& [area, loop] : loops) result.push_back(std::move(loop));
    return result;
  }

  double area(std::int32_t composite, const std::vector<Step>& loop) const {
    const Vec2* uv = &composites_.node_uv[static_cast<std::size_t>(composites_.node_offsets[composite])];
    double sum = 0;
    for (const Step& s : loop) {
      const std::int32_t rim = composites_.rim(s.coedge);
      double own = 0;
      for (std::int32_t k = composites_.rim_offsets[rim]; k + 1 < composites_.rim_offsets[rim + 1]; ++k)
        own += cross(uv[composites_.rim_node[k]], uv[composites_.rim_node[k + 1]]);
      sum += s.is_reversed ? -own : own;
    }
    return sum;
  }

  void add_loops() {
    ModelTables& t = joined_.tables;
    t.face_loop_offsets = t.loop_coedge_offsets = {0};
    t.coedge_edge.clear();
    t.coedge_is_reversed.clear();
    joined_.coedge_piece_offsets = {0};
    for (FaceId f = 0; f < cad_.n_faces(); ++f) {
      const std::int32_t composite = composite_of_[f];
      const FaceId first = composite == kNone ? f : composites_.members(composite).front();
      joined_.face_of.push_back(first);
      joined_.composite.push_back(first == f ? composite : kNone);
      if (composite == kNone)
        for (const LoopId l : cad_.loops(f)) {
          std::vector<Step> loop;
          for (const CoedgeId c : cad_.loop_coedges(l)) loop.push_back(step(c));
          add_loop(std::move(loop));
        }
      else if (first == f)
        for (std::vector<Step>& loop : rim_loops(composite)) add_loop(std::move(loop));
      t.face_loop_offsets.push_back(t.n_loops());
    }
  }

  /// Whether the chain of its edge is passed backwards.
  bool is_backward(const Step& s) const {
    const EdgeId e = cad_.coedge_edge[s.coedge];
    return s.is_reversed != joined_.pieces_of(chain_of_[e])[static_cast<std::size_t>(place_in_chain_[e])].is_reversed;
  }

  bool begins_chain(const Step& s) const {
    const EdgeId e = cad_.coedge_edge[s.coedge];
    const auto last = static_cast<std::int32_t>(joined_.pieces_of(chain_of_[e]).size()) - 1;
    return place_in_chain_[e] == (is_backward(s) ? last : 0);
  }

  void add_loop(std::vector<Step> loop) {
    ModelTables& t = joined_.tables;
    std::rotate(loop.begin(), std::ranges::find_if(loop, [&](const Step& s) { return begins_chain(s); }), loop.end());
    for (std::size_t i = 0; i < loop.size();) {
      const EdgeId chain = chain_of_[cad_.coedge_edge[loop[i].coedge]];
      const bool is_reversed = is_backward(loop[i]);
      std::vector<CoedgeId> own;
      for (std::size_t k = 0; k < joined_.pieces_of(chain).size(); ++k, ++i) {
        if (i == loop.size() || chain_of_[cad_.coedge_edge[loop[i].coedge]] != chain) fail();
        own.push_back(loop[i].coedge);
      }
      if (is_reversed) std::reverse(own.begin(), own.end());
      joined_.coedge_pieces.insert(joined_.coedge_pieces.end(), own.begin(), own.end());
      joined_.coedge_piece_offsets.push_back(static_cast<std::int32_t>(joined_.coedge_pieces.size()));
      t.coedge_edge.push_back(chain);
      t.coedge_is_reversed.push_back(is_reversed);
    }
    t.loop_coedge_offsets.push_back(t.n_coedges());
  }

  void measure(FaceId f) {
    ModelTables& t = joined_.tables;
    const std::int32_t composite = joined_.composite[f];
    t.face_area[f] = 0;
    for (const FaceId m : composites_.members(composite)) {
      t.face_area[f] += cad_.face_area[m];
      t.face_box[f].add(cad_.face_box[m]);
      t.face_tolerance[f] = std::max(t.face_tolerance[f], cad_.face_tolerance[m]);
    }
    double perimeter = 0;
    for (const EdgeId e : t.edges_of(f)) perimeter += t.edge_length[e];
    t.face_width[f] = rectangle_width(t.face_area[f], perimeter);
    t.face_is_reversed[f] = 0;
    const auto are_all = [&](SurfaceType type) {
      return std::ranges::all_of(composites_.members(composite), [&](FaceId m) { return cad_.face_type[m] == type; });
    };
    t.face_type[f] = are_all(SurfaceType::kPlane) && is_flat(composite, t.face_tolerance[f]) ? SurfaceType::kPlane
                     : are_all(SurfaceType::kBspline)                                        ? SurfaceType::kBspline
                                                                                             : SurfaceType::kOther;
    for (std::size_t k = 0; k < 4; ++k)
      t.face_uv_bounds[4 * static_cast<std::size_t>(f) + k] =
          composites_.uv_bounds[4 * static_cast<std::size_t>(composite) + k];
  }

  /// All of it is in the composite.
  void empty(FaceId f) {
    joined_.tables.face_area[f] = joined_.tables.face_width[f] = 0;
    joined_.tables.face_type[f] = SurfaceType::kOther;
  }

  bool is_flat(std::int32_t composite, double tolerance) const {
    const Chart chart = composites_.chart(composite);
    Vec3 sum{};
    for (const Corners& c : chart.corners) sum += cross(chart.x[c[1]] - chart.x[c[0]], chart.x[c[2]] - chart.x[c[0]]);
    const Vec3 normal = normalized(sum);
    return std::ranges::all_of(chart.x, [&](Vec3 x) { return std::abs(dot(x - chart.x[0], normal)) <= tolerance; });
  }

  const ModelTables& cad_;
  const Composites& composites_;
  std::vector<std::uint8_t> is_joined_, is_inside_;
  std::vector<std::int32_t> composite_of_;
  std::vector<std::vector<CoedgeId>> uses_;     // of each CAD edge
  std::vector<LoopId> loop_of_;                 // of each CAD coedge
  std::vector<FaceId> face_of_coedge_;          // likewise
  std::vector<std::vector<EdgeId>> at_vertex_;  // edges that go on as one there
  std::vector<EdgeId> chain_of_;
  std::vector<std::int32_t> place_in_chain_;
  JoinedTables joined_;
};

}  // namespace

JoinedTables join_tables(const ModelTables& cad, const Composites& composites) {
  return TableJoiner(cad, composites).run();
}

EntityCounts count_left(const ModelTables& t) {
  EntityCounts n;
  std::vector<std::uint8_t> has_edge(static_cast<std::size_t>(t.n_edges()), 0),
      has_vertex(static_cast<std::size_t>(t.n_vertices()), 0);
  for (FaceId f = 0; f < t.n_faces(); ++f) n.faces += t.is_joined(f) ? 0 : 1;
  for (const EdgeId e : t.coedge_edge) {
    has_edge[e] = 1;
    for (const std::size_t k : {0, 1}) has_vertex[t.edge_vertices[2 * static_cast<std::size_t>(e) + k]] = 1;
  }
  n.edges = static_cast<std::int32_t>(std::ranges::count(has_edge, 1));
  n.vertices = static_cast<std::int32_t>(std::ranges::count(has_vertex, 1));
  return n;
}

}  // namespace st
