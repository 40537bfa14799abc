#include "features/cut_strips.h"

#include <algorithm>
#include <utility>

#include "features/strip_shape.h"
#include "geometry/shape/polyline.h"

namespace st {
namespace {

constexpr double kSmoothTurn = 0.9;  // cosine: edges that go on into each other

/// Coedges that go on into each other, in the direction of their loop.
struct Run {
  std::vector<CoedgeId> pieces;
  double length = 0;
};

class CutStripFinder {
 public:
  CutStripFinder(const Model& model, std::span<const std::uint8_t> is_smooth)
      : model_(model),
        t_(model.tables()),
        is_cut_end_(static_cast<std::size_t>(t_.n_vertices()), 0),
        n_uses_(count_uses(t_)) {
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (const std::size_t k : {0, 1})
        if (is_smooth[e]) is_cut_end_[t_.edge_vertices[2 * static_cast<std::size_t>(e) + k]] = 1;
  }

  std::vector<Strip> run() const {
    std::vector<Strip> strips;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (t_.loops(f).size() != 1) continue;
      std::vector<Run> runs = runs_of(t_.coedges(f));
      std::ranges::stable_sort(runs, [](const Run& a, const Run& b) { return a.length > b.length; });
      if (!are_sides(f, runs)) continue;
      strips.push_back({.face = f,
                        .edges = {t_.coedge_edge[runs[0].pieces[0]], t_.coedge_edge[runs[1].pieces[0]]},
                        .is_opposed = true,
                        .length = runs[0].length,
                        .stations = stations_between(curve_of(runs[0]), curve_of(runs[1]), true)});
    }
    return strips;
  }

 private:
  VertexId begin_of(CoedgeId c) const {
    return t_.edge_vertices[2 * static_cast<std::size_t>(t_.coedge_edge[c]) + (t_.coedge_is_reversed[c] ? 1 : 0)];
  }

  Vec3 direction(CoedgeId c, bool is_end) const {
    const auto curve = model_.curve(t_.coedge_edge[c]);
    const bool is_reversed = t_.coedge_is_reversed[c] != 0;
    const Vec3 d = normalized(curve->evaluate(is_reversed != is_end ? curve->t_max() : curve->t_min()).d1);
    return is_reversed ? -d : d;
  }

  bool goes_on(CoedgeId c, CoedgeId next) const {
    return is_cut_end_[begin_of(next)] && dot(direction(c, true), direction(next, false)) > kSmoothTurn;
  }

  /// None where the loop has no corner.
  std::vector<Run> runs_of(IdRange loop) const {
    const auto at = [&](CoedgeId i) { return loop.first() + i % loop.size(); };
    CoedgeId first = 0;
    while (first < loop.size() && goes_on(at(first + loop.size() - 1), at(first))) ++first;
    std::vector<Run> runs;
    for (CoedgeId i = first; first < loop.size() && i < first + loop.size(); ++i) {
      if (i == first || !goes_on(at(i - 1), at(i))) runs.emplace_back();
      runs.back().pieces.push_back(at(i));
      runs.back().length += t_.edge_length[t_.coedge_edge[at(i)]];
    }
    return runs;
  }

  /// As find_strips() wants it of two edges, where one at least is in pieces.
  bool are_sides(FaceId f, const std::vector<Run>& runs) const {
    if (runs.size() < 2 || (runs[0].pieces.size() == 1 && runs[1].pieces.size() == 1)) return false;
    double rest = 0;
    for (std::size_t i = 2; i < runs.size(); ++i) rest += runs[i].length;
    const auto is_open = [&](const Run& run) {
      return std::ranges::all_of(run.pieces, [&](CoedgeId c) { return n_uses_[t_.coedge_edge[c]] == 2; });
    };
    return is_open(runs[0]) && is_open(runs[1]) && are_long_sides(runs[0].length, runs[1].length, rest) &&
           is_narrow(t_.face_area[f], runs[0].length);
  }

  PolylineCurve curve_of(const Run& run) const {
    std::vector<Vec3> points;
    for (const CoedgeId c : run.pieces) {
      const auto own = model_.facets().points(t_.coedge_edge[c]);
      if (!points.empty()) points.pop_back();  // where the pieces meet
      if (t_.coedge_is_reversed[c])
        points.insert(points.end(), own.rbegin(), own.rend());
      else
        points.insert(points.end(), own.begin(), own.end());
    }
    return PolylineCurve(std::move(points));
  }

  const Model& model_;
  const ModelTables& t_;
  std::vector<std::uint8_t> is_cut_end_;  // [n_vertices] a smooth edge ends there
  std::vector<int> n_uses_;               // [n_edges] coedges of any face
};

}  // namespace

std::vector<Strip> find_cut_strips(const Model& model, std::span<const std::uint8_t> is_smooth) {
  return model.facets().empty() ? std::vector<Strip>() : CutStripFinder(model, is_smooth).run();
}

}  // namespace st
