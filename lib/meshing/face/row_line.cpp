#include "meshing/face/row_line.h"

#include <algorithm>
#include <cmath>

#include "meshing/face/row_across.h"
#include "meshing/face/row_chains.h"
#include "meshing/face/row_shape.h"
#include "meshing/face/stretch.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kGrowth = 1.4;                   // of heights from row to row, at most
constexpr double kTooSquare = 1.0;                // length over height of a quadrilateral
constexpr double kSquareAspect = 2.2;             // on the mean of a quadrilateral and its neighbours
constexpr double kFreeBeyond = 0.7;               // of a row's height, which must be free behind it,
constexpr double kFreeOfWidth = 0.3;              // and of the length of its quadrilaterals,
constexpr double kMostFree = 4;                   // but no more than of the height
constexpr double kMostShear = radians(50);        // of a side against the square
constexpr double kSideMisfit = 1.8;               // between the height asked for and that of the side's segment
constexpr double kMostTurned = 0.9;               // of the largest turning of the normal: the height shrinks
constexpr double kMostOver = 1.25;                // likewise, over a bend at which no lower height helps
constexpr double kEvenly = 1.15;                  // of such a height: the one beside it
constexpr double kTooLong = 1.5;                  // over the length asked for, likewise
constexpr double kFarTooLong = 2;                 // likewise, of one whose neighbours are not, on the mean
constexpr double kFalling = 0.75;                 // of a column's greatest height: it comes to where others begin,
constexpr double kRisen = 1.5;                    // over its least height before,
constexpr double kAhead = 10;                     // if an edge lies within that many heights
constexpr double kAlong = 0.94;                   // cosine to the direction of a stretch: the row is along it
constexpr double kFreeAside = 0.7;                // of a quadrilateral's length, beside the last one of a row
constexpr double kMiss = 0.01;                    // of a height, by which a node may miss its place
constexpr double kBetween[] = {0.25, 0.5, 0.75};  // of a quadrilateral's length: where room is looked for
constexpr int kSmoothing = 3;                     // passes over the heights
constexpr double kMostRaised = 1.1;               // of a height asked for, by these
constexpr std::size_t kNeighbours = 3;            // of a quadrilateral, on each side
constexpr std::size_t kLeastRun = 4;              // quadrilaterals beside each other

class LineMaker {
 public:
  LineMaker(FaceWork& work, const RowLine& line, const RowSides& sides) : w_(work), line_(line), sides_(sides) {
    next_.columns.resize(n());
    next_.joined = line.joined;
    along_.resize(n());
    across_.resize(n());
    height_.assign(n(), 0);
    over_asked_.assign(line.joined.size(), 0);
    stepped_.resize(n());
    across_node_.assign(n(), kNone);
  }

  NextLine run() {
    const auto runs = find_runs();
    for (const auto& [first, last] : runs) {
      direct(first, last);
      bound(first, last);
      smooth(first, last);
      limit_turning(first, last);
      find_across(w_, {line_, next_.joined, along_, across_, height_}, first, last, across_node_);
      for (std::size_t i = first; i <= last; ++i)
        if (across_node_[i] != kNone && next_.columns[i].existing == kNone) lead_across(i);
      place(first, last);
    }
    close();
    for (std::size_t i = 0; i + 1 < n(); ++i) next_.joined[i] = next_.joined[i] && is_good(i);
    end_long();
    end_square();
    end_beside();
    drop_short_runs();
    return std::move(next_);
  }

 private:
  using Run = std::pair<std::size_t, std::size_t>;  // columns, first and last

  std::size_t n() const { return line_.nodes.size(); }
  const MeshNode& node(std::size_t i) const { return w_.mesh.nodes[line_.nodes[i]]; }
  double width(std::size_t i) const { return distance(node(i).x, node(i + 1).x); }

  std::vector<Run> find_runs() const {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < next_.joined.size(); ++i) {
      if (!next_.joined[i]) continue;
      const std::size_t first = i;
      while (i + 1 < next_.joined.size() && next_.joined[i + 1]) ++i;
      runs.push_back({first, i + 1});
    }
    return runs;
  }

  /// Directions along and square to the line, and the heights that the sizes ask for.
  void direct(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i <= last; ++i) {
      const MeshNode& a = node(i);
      std::size_t from = i > first ? i - 1 : i, to = i < last ? i + 1 : i;
      if (line_.is_closed && i == 0) from = n() - 2;
      if (line_.is_closed && i + 1 == n()) to = 1;
      // by angle, not by length: the shorter neighbour tells as much
      const Vec3 back = normalized(a.x - node(from).x), ahead = normalized(node(to).x - a.x);
      along_[i] = normalized(back + ahead - dot(back + ahead, a.normal) * a.normal);
      across_[i] = cross(a.normal, along_[i]);
      const bool is_known = line_.is_known(i) && !w_.field->has_metrics();  // else normals matter
      const double own = is_known ? line_.asked[i].in(across_[i]) : w_.field->length_along(a.x, across_[i], w_.hint);
      const double there = w_.field->length_along(a.x + own * across_[i], across_[i], w_.hint);
      height_[i] = 0.5 * (own + std::min(there, kGrowth * own));
    }
  }

  /// At the sides the loop's own nodes are taken; towards them heights and directions change in equal steps.
  void bound(std::size_t first, std::size_t last) {
    const bool has_first = first == 0 && take_side(0, sides_.first);
    const bool has_last = last + 1 == n() && take_side(last, sides_.last);
    if (!has_first && !has_last) return;
    const double f_first = has_first ? factor_at(first) : 1, f_last = has_last ? factor_at(last) : 1;
    const double b_first = has_first ? shear_at(first) : 0, b_last = has_last ? shear_at(last) : 0;
    std::vector<double> way(n(), 0);
    for (std::size_t i = first; i < last; ++i) way[i + 1] = way[i] + width(i);
    for (std::size_t i = first; i <= last; ++i) {
      const double share = way[i] / way[last];
      const double shear = (1 - share) * b_first + share * b_last;
      height_[i] *= ((1 - share) * f_first + share * f_last) / std::cos(shear);
      across_[i] = std::cos(shear) * across_[i] - std::sin(shear) * along_[i];
    }
  }

  bool take_side(std::size_t i, std::int32_t side) {
    if (side == kNone) return false;
    next_.columns[i].existing = side;
    next_.columns[i].node = w_.mesh.nodes[side];
    const double factor = factor_at(i);
    if (std::abs(shear_at(i)) < kMostShear && factor < kSideMisfit && factor > 1 / kSideMisfit) return true;
    next_.columns[i].existing = kNone;
    next_.joined[i == 0 ? 0 : i - 1] = 0;  // the rows come off the side
    return false;
  }
  /// Height of the side's segment over that asked for.
  double factor_at(std::size_t i) const {
    return dot(next_.columns[i].node.x - node(i).x, cross(node(i).normal, along_[i])) / height_[i];
  }
  double shear_at(std::size_t i) const {
    return turning(cross(node(i).normal, along_[i]), next_.columns[i].node.x - node(i).x, node(i).normal);
  }

  /// What is asked for holds all the same: beside the end of a nose lengths grow within one segment.
  void smooth(std::size_t first, std::size_t last) {
    const std::vector<double> asked = height_;
    std::vector<double> old;
    for (int pass = 0; pass < kSmoothing; ++pass) {
      old = height_;
      for (std::size_t i = first; i <= last; ++i) {
        if (next_.columns[i].existing != kNone) continue;
        std::size_t from = i > first ? i - 1 : i, to = i < last ? i + 1 : i;
        if (line_.is_closed && i == 0) from = n() - 2;
        if (line_.is_closed && i + 1 == n()) to = 1;
        height_[i] = 0.25 * old[from] + 0.5 * old[i] + 0.25 * old[to];
      }
    }
    for (std::size_t i = first; i <= last; ++i) height_[i] = std::min(height_[i], kMostRaised * asked[i]);
  }

  /// From a column's node up to its height, into stepped_; false where the surface turns away.
  bool step(std::size_t i) {
    stepped_[i].is_there = step_on_surface(w_, node(i), across_[i], height_[i], stepped_[i].node);
    stepped_[i].height = height_[i];
    return stepped_[i].is_there;
  }

  /// Heights over which the surface turns too far become lower, and those beside them.
  void limit_turning(std::size_t first, std::size_t last) {
    bool is_limited = false;
    for (std::size_t i = first; i <= last; ++i) {
      if (next_.columns[i].existing != kNone || !step(i)) continue;
      const double turned = angle_between(stepped_[i].node.normal, node(i).normal);
      if (turned <= kMostTurned * w_.max_turning) continue;
      height_[i] *= kMostTurned * w_.max_turning / turned;
      is_limited = true;
    }
    if (!is_limited) return;
    for (std::size_t i = first + 1; i <= last; ++i) height_[i] = std::min(height_[i], kEvenly * height_[i - 1]);
    for (std::size_t i = last; i-- > first;) height_[i] = std::min(height_[i], kEvenly * height_[i + 1]);
  }

  /// Whole rows up to nodes straight across; the last one ends there.
  void lead_across(std::size_t i) {
    NextLine::Column& c = next_.columns[i];
    const MeshNode &a = node(i), &b = w_.mesh.nodes[across_node_[i]];
    const double n_rows = std::max(1.0, std::round(distance(a.x, b.x) / height_[i]));
    if (line_.has_arrived(i) || n_rows == 1) {
      c.existing = across_node_[i];
      c.node = b;
      c.is_across = true;
      return;
    }
    c.node.p = a.p + 1 / n_rows * (b.p - a.p);
    w_.evaluate(c.node);
    c.asked = w_.ask_sizes(c.node);
    height_[i] = distance(a.x, c.node.x);
    c.is_placed = !turns_too_far(a, c.node) && is_free(w_.mesh.seen_from(line_.nodes[i], c.node.p));
  }
  bool turns_too_far(const MeshNode& a, const MeshNode& b) const {
    return !(dot(a.normal, b.normal) > std::cos(kMostOver * w_.max_turning));
  }
  /// Do both columns lead to nodes across?
  bool leads_across(std::size_t i) const { return across_node_[i] != kNone && across_node_[i + 1] != kNone; }

  void place(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i <= last; ++i) {
      NextLine::Column& c = next_.columns[i];
      if (c.existing != kNone) {
        c.is_placed = true;
        continue;
      }
      if (across_node_[i] != kNone) continue;
      if (!(stepped_[i].height == height_[i] ? stepped_[i].is_there : step(i))) continue;
      c.node = stepped_[i].node;
      c.asked = w_.ask_sizes(c.node);
      if (is_over_crest(i)) continue;
      c.is_placed = !turns_too_far(node(i), c.node) && is_column_free(i);
    }
  }

  /// The last column of a ring is the first.
  void close() {
    if (line_.is_closed) next_.columns[n() - 1] = next_.columns[0];
  }

  /// Is the way of a column free, and some of the room beyond?
  bool is_column_free(std::size_t i) const {
    const double length =
        std::max(i > 0 && next_.joined[i - 1] ? width(i - 1) : 0, i + 1 < n() && next_.joined[i] ? width(i) : 0);
    const Vec2 beyond = beyond_of(node(i).p, next_.columns[i].node.p, length / height_[i]);
    return is_free(w_.mesh.seen_from(line_.nodes[i], beyond));
  }
  /// Heights have risen and fall again, towards other rows.
  bool is_over_crest(std::size_t i) const {
    if (!(height_[i] < kFalling * line_.highest[i]) || !(line_.highest[i] > kRisen * line_.lowest[i])) return false;
    const Vec2 ahead = node(i).p + kAhead * (next_.columns[i].node.p - node(i).p);
    return !is_free(w_.mesh.seen_from(line_.nodes[i], ahead));
  }
  /// Likewise between columns i and i+1.
  bool is_free_between(std::size_t i) const {
    const double aspect = width(i) / (0.5 * (height_[i] + height_[i + 1]));
    return std::all_of(std::begin(kBetween), std::end(kBetween), [&](double share) {
      const Vec2 a = (1 - share) * node(i).p + share * node(i + 1).p;
      const Vec2 b = (1 - share) * next_.columns[i].node.p + share * next_.columns[i + 1].node.p;
      return is_free(w_.mesh.seen_left_of(line_.nodes[i], line_.nodes[i + 1], a, beyond_of(a, b, aspect)));
    });
  }
  static Vec2 beyond_of(Vec2 a, Vec2 b, double aspect) {
    return a + (1 + std::clamp(kFreeOfWidth * aspect, kFreeBeyond, kMostFree)) * (b - a);
  }
  bool is_free(std::int32_t t) const { return t != kNone && w_.mesh.triangles[t].state == kUnfinished; }

  /// Is the quadrilateral between columns i and i+1 one of a row?
  bool is_good(std::size_t i) {
    const NextLine::Column &c = next_.columns[i], &d = next_.columns[i + 1];
    if (!c.is_placed || !d.is_placed) return false;
    if (leads_across(i)) return is_good_across(i);
    if (c.is_across || d.is_across) return false;
    if (!is_upright(node(i), node(i + 1), d.node, c.node)) return false;
    return aspect(i) > kTooSquare && is_as_asked(i) && is_free_between(i);
  }

  /// Likewise where both columns lead to nodes across. A column that is there makes a triangle with the other's last.
  bool is_good_across(std::size_t i) const {
    const NextLine::Column &c = next_.columns[i], &d = next_.columns[i + 1];
    const bool is_last = c.is_across && d.is_across;
    if (is_last && !w_.mesh.is_fixed(c.existing, d.existing)) return false;
    if (line_.has_arrived(i) || line_.has_arrived(i + 1))
      return is_last && line_.has_arrived(i) != line_.has_arrived(i + 1);
    const Vec3 along = d.node.x - c.node.x, middle = 0.5 * (c.node.x + d.node.x);
    return is_upright(node(i), node(i + 1), d.node, c.node) && aspect(i) > kTooSquare &&
           !is_oblique(*w_.field, w_.field->local_on(middle, c.node.normal, w_.hint), along, c.node.x - node(i).x);
  }

  /// Not far too long for the sizes at its far side, nor oblique. Sets over_asked_.
  bool is_as_asked(std::size_t i) {
    const Vec3 a = next_.columns[i].node.x, b = next_.columns[i + 1].node.x;
    const LocalSize local = w_.field->local_on(0.5 * (a + b), next_.columns[i].node.normal, w_.hint);
    const bool is_along = std::abs(dot(local.direction, b - a)) > kAlong * distance(a, b);
    over_asked_[i] = distance(a, b) / (is_along ? local.along : local.in(b - a));
    return over_asked_[i] <= kFarTooLong && !is_oblique(*w_.field, local, b - a, a - node(i).x);
  }

  double aspect(std::size_t i) const {
    const double length = width(i) + distance(next_.columns[i].node.x, next_.columns[i + 1].node.x);
    return length /
           (distance(node(i).x, next_.columns[i].node.x) + distance(node(i + 1).x, next_.columns[i + 1].node.x));
  }

  /// Where quadrilaterals are too long for the sizes, and not by chance: lengths along scatter.
  void end_long() {
    const std::vector<char> joined = next_.joined;
    const std::size_t n_all = joined.size();
    for (std::size_t i = 0; i < n_all; ++i) {
      if (!(over_asked_[i] > kTooLong)) continue;
      const bool is_between =
          (line_.is_closed || (i > 0 && i + 1 < n_all)) && joined[(i + n_all - 1) % n_all] && joined[(i + 1) % n_all];
      if (!is_between || mean_around(i, joined, [&](std::size_t k) { return over_asked_[k]; }) > kTooLong)
        next_.joined[i] = 0;
    }
  }

  /// Where quadrilaterals and their neighbours are nearly as high as long.
  void end_square() {
    const std::vector<char> joined = next_.joined;
    for (std::size_t i = 0; i < joined.size(); ++i)
      if (mean_around(i, joined, [&](std::size_t k) { return aspect(k); }) < kSquareAspect) next_.joined[i] = 0;
  }

  /// Where what is beside the ends of a row is near: a narrower gap has room for no triangles.
  void end_beside() {
    if (line_.is_closed) return;
    for (const auto& [first, last] : find_runs()) {
      std::size_t from = first, to = last;
      while (from < to && is_hemmed(from, from + 1)) next_.joined[from++] = 0;
      while (from < to && is_hemmed(to, to - 1)) next_.joined[--to] = 0;
    }
  }
  bool is_hemmed(std::size_t end, std::size_t inner) const {
    const NextLine::Column &c = next_.columns[end], &d = next_.columns[inner];
    if (c.existing != kNone || across_node_[end] != kNone) return false;
    return !is_free(w_.mesh.seen_from(line_.nodes[end], c.node.p + kFreeAside * (c.node.p - d.node.p)));
  }

  /// Of a value of a quadrilateral and its neighbours that are joined.
  template <typename ValueOf>
  double mean_around(std::size_t i, const std::vector<char>& joined, const ValueOf& value_of) const {
    double sum = 0, count = 0;
    const std::size_t before = line_.is_closed ? kNeighbours : std::min(i, kNeighbours);
    const std::size_t after = line_.is_closed ? kNeighbours : std::min(joined.size() - 1 - i, kNeighbours);
    for (std::size_t k = 0; k <= before + after; ++k) {
      const std::size_t at = (i + joined.size() + k - before) % joined.size();
      if (!joined[at]) continue;
      sum += value_of(at);
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  void drop_short_runs() {
    const std::vector<Run> runs = find_runs();
    // those that meet where the line is closed are one
    std::size_t over = 0;
    if (line_.is_closed && next_.joined.front() && next_.joined.back())
      over = runs.front().second - runs.front().first + runs.back().second - runs.back().first;
    for (const auto& [first, last] : runs) {
      const bool is_over = over >= kLeastRun && (first == 0 || last + 1 == n());
      bool is_across = false;
      for (std::size_t i = first; i < last; ++i) is_across |= leads_across(i);
      if (last - first < kLeastRun && !is_over && !is_across)
        std::fill_n(next_.joined.begin() + static_cast<std::ptrdiff_t>(first), last - first, 0);
    }
  }

  FaceWork& w_;
  const RowLine& line_;
  const RowSides& sides_;
  NextLine next_;
  std::vector<Vec3> along_, across_;
  std::vector<double> height_;
  std::vector<double> over_asked_;  // [quadrilaterals] length over what the sizes ask for; 0: they do not count
  struct Stepped {
    MeshNode node;
    double height = 0;
    bool is_there = false;
  };
  std::vector<Stepped> stepped_;           // [columns] where the last step from the line came, over this height
  std::vector<std::int32_t> across_node_;  // [columns] to which rows lead, kNone: they go on as the sizes ask for
};

}  // namespace

bool step_on_surface(const FaceWork& work, const MeshNode& a, Vec3 d, double length, MeshNode& p) {
  const auto first = tangent_step(a.du, a.dv, length * d);
  if (!first) return false;
  const Vec3 aside = cross(a.normal, d);
  p.p = a.p + *first;
  for (int step = 0;; ++step) {
    work.evaluate(p);
    const Vec3 chord = p.x - a.x;
    const double reached = norm(chord), aslant = dot(chord, aside);
    if (!(reached > 0) || !std::isfinite(reached)) return false;
    if (std::abs(length - reached) < kMiss * length && std::abs(aslant) < kMiss * length) return true;
    if (step == 4) return reached > 0.6 * length && reached < 1.6 * length && std::abs(aslant) < 0.2 * length;
    const auto back = tangent_step(p.du, p.dv, -aslant * aside);
    if (!back) return false;
    p.p = a.p + std::clamp(length / reached, 0.4, 2.0) * (p.p - a.p + *back);
  }
}

NextLine next_line(FaceWork& work, const RowLine& line, const RowSides& sides) {
  return LineMaker(work, line, sides).run();
}

}  // namespace st
