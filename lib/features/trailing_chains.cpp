#include "features/trailing_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/disjoint_sets.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

constexpr double kOneLine = 0.985;  // cosine, 10 degrees: between two edges and the way across the notch between them
constexpr double kGoesOn = 0.7;     // cosine, 45 degrees: between two edges of one line that meet
constexpr double kSquare = radians(1);  // of a base, from square to the side: a plate's has no noses before it

/// Where an edge ends.
struct End {
  Vec3 x;
  Vec3 out;  // unit, onwards
};

std::array<End, 2> ends_of(const Model& model, EdgeId e) {
  const auto curve = model.curve(e);
  const CurvePoint a = curve->evaluate(curve->t_min()), b = curve->evaluate(curve->t_max());
  return {End{a.x, -normalized(a.d1)}, End{b.x, normalized(b.d1)}};
}

/// `widest`: of the notch.
bool goes_on(const End& a, const End& b, double widest) {
  const Vec3 way = b.x - a.x;
  const double width = norm(way);
  return width > 0 && width <= widest && dot(a.out, way) > kOneLine * width && -dot(b.out, way) > kOneLine * width;
}

std::vector<std::vector<WingEdge>> sets_of(DisjointSets& sets, std::span<const WingEdge> edges) {
  std::vector<std::vector<WingEdge>> all;
  for (const std::vector<std::int32_t>& set : sets.groups()) {
    all.emplace_back();
    for (const std::int32_t i : set) all.back().push_back(edges[static_cast<std::size_t>(i)]);
  }
  return all;
}

/// Joins each edge with the first one of the same key.
class Joiner {
 public:
  explicit Joiner(DisjointSets& sets) : sets_(sets) {}
  void add(std::int32_t key, std::size_t i) {
    const auto [known, is_new] = first_.emplace(key, static_cast<std::int32_t>(i));
    if (!is_new) sets_.join(static_cast<std::int32_t>(i), known->second);
  }

 private:
  DisjointSets& sets_;
  std::map<std::int32_t, std::int32_t> first_;
};

void join_across_notches(const Model& model, std::span<const WingEdge> edges, DisjointSets& sets) {
  const ModelTables& t = model.tables();
  const EdgeFaces faces_at(t);
  std::map<FaceId, std::vector<std::int32_t>> at_face;
  std::vector<std::array<End, 2>> ends;
  for (const WingEdge& w : edges) {
    const auto own = static_cast<std::int32_t>(ends.size());
    ends.push_back(ends_of(model, w.edge));
    const bool may_be_plate = w.base != kNone && std::abs(w.angle - kPi / 2) < kSquare;
    for (const FaceId f : faces_at[w.edge])
      if (!may_be_plate && f != w.base) at_face[f].push_back(own);
  }
  for (const auto& [face, own] : at_face)
    for (std::size_t a = 0; a < own.size(); ++a)
      for (std::size_t b = a + 1; b < own.size(); ++b) {
        const auto i = own[a], j = own[b];
        const double widest = std::max(edges[i].length, edges[j].length);
        for (const End& from : ends[i])
          for (const End& to : ends[j])
            if (goes_on(from, to, widest)) sets.join(i, j);
      }
}

}  // namespace

std::vector<std::vector<WingEdge>> trailing_chains(const Model& model, std::span<const WingEdge> edges) {
  std::vector<WingEdge> trailing;
  for (const WingEdge& w : edges)
    if (w.kind != WingEdgeKind::kLeading) trailing.push_back(w);
  DisjointSets sets(static_cast<std::int64_t>(trailing.size()));
  Joiner at_vertex(sets), at_base(sets);
  for (std::size_t i = 0; i < trailing.size(); ++i) {
    if (trailing[i].base != kNone) at_base.add(trailing[i].base, i);
    for (const std::size_t k : {0, 1})
      at_vertex.add(model.tables().edge_vertices[2 * static_cast<std::size_t>(trailing[i].edge) + k], i);
  }
  join_across_notches(model, trailing, sets);
  return sets_of(sets, trailing);
}

std::vector<std::vector<WingEdge>> lines_of(const Model& model, std::span<const WingEdge> chain) {
  struct EndOfEdge {
    std::size_t edge;
    VertexId vertex;
    Vec3 out;
  };
  std::vector<EndOfEdge> ends;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const std::array<End, 2> own = ends_of(model, chain[i].edge);
    for (const std::size_t k : {0, 1})
      ends.push_back({i, model.tables().edge_vertices[2 * static_cast<std::size_t>(chain[i].edge) + k], own[k].out});
  }
  std::ranges::stable_sort(ends, {}, &EndOfEdge::vertex);
  DisjointSets sets(static_cast<std::int64_t>(chain.size()));
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size() && ends[j].vertex == ends[i].vertex; ++j)
      if (dot(ends[i].out, ends[j].out) < -kGoesOn)
        sets.join(static_cast<std::int32_t>(ends[i].edge), static_cast<std::int32_t>(ends[j].edge));
  Joiner at_base(sets);
  for (std::size_t i = 0; i < chain.size(); ++i)
    if (chain[i].base != kNone) at_base.add(chain[i].base, i);
  return sets_of(sets, chain);
}

ChainLine::ChainLine(std::span<const EdgePlace> places) {
  std::vector<Box3> boxes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool goes_on = i + 1 < places.size() && places[i + 1].edge == places[i].edge;
    pieces_.push_back({places[i].x, places[goes_on ? i + 1 : i].x});
    boxes.emplace_back();
    boxes.back().add(pieces_.back().begin);
    boxes.back().add(pieces_.back().end);
  }
  tree_ = BoxTree(boxes);
}

bool ChainLine::is_near(Vec3 x, double reach) const {
  bool is_found = false;
  tree_.visit_near(
      x, [&](std::int32_t, double d2) { return !is_found && d2 <= reach * reach; },
      [&](std::int32_t i) {
        const Piece& piece = pieces_[static_cast<std::size_t>(i)];
        is_found = is_found || segment_distance(x, piece.begin, piece.end) < reach;
      });
  return is_found;
}

}  // namespace st
