#include "meshing/face/ridge_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "meshing/face/row_chains.h"
#include "meshing/face/row_line.h"
#include "meshing/face/stretch.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr int kBeside = 3;                 // nodes of a loop on each side, among which the seed's length is least
constexpr double kStraight = radians(30);  // a loop that turns by less goes on
constexpr double kAspect = 1.5;            // length along over across: less begins no line
constexpr double kHasDirection = 1.1;      // likewise: less tells no direction
constexpr int kSearched = 40;              // steps without that, from a loop on or between two parts of a line
constexpr int kMostSteps = 20000;          // of a line
constexpr double kWindow = 3;              // lengths across to each side, in which the least one is looked for
constexpr double kWindowOfStep = 0.05;     // likewise, of a step: the direction may be off by three degrees
constexpr int kProbes = 4;                 // on each side
constexpr int kWidenings = 3;              // to twice that, where it is as short all over
constexpr int kHalvings = 10;              // between probes
constexpr double kLonger = 1.1;            // there over the least one: less is no ridge
constexpr double kTurned = 0.7;            // cosine between steps: a line that turns more ends
constexpr double kClear = 1.5;             // lengths across, to other nodes and edges that must stay
constexpr double kClearBeside = 20;        // likewise, to such edges along the line: their rows cover it
constexpr double kBesideCosine = 0.8;      // between such an edge and the line
constexpr std::size_t kLeastNodes = 4;
// lines that reach no loop
constexpr std::size_t kSections = 12;     // of the face, at most, along which lengths are looked at
constexpr double kStep = 3;               // lengths between two of these
constexpr double kLeastStep = 1.0 / 128;  // likewise, of a section
constexpr double kMostStep = 1.0 / 16;
constexpr int kMostInside = 12;  // lines that are tried

class RidgeLayer {
 public:
  explicit RidgeLayer(FaceWork& work) : w_(work), m_(work.mesh) {
    for (const auto& [a, b] : work.segments) add_beside(a, b);
  }

  std::vector<std::vector<std::int32_t>> run() {
    std::vector<std::vector<std::int32_t>> lines;
    for (const auto& [seed, inward] : find_seeds()) {
      const std::vector<MeshNode> places = trace(seed, inward);
      triangle_ = kNone;
      for (std::vector<std::int32_t>& line : insert(places, seed)) lines.push_back(std::move(line));
    }
    int n_tried = 0;
    for (const Inside& i : find_inside()) {
      if (is_beside_lines(i.place) || n_tried++ == kMostInside) continue;
      for (std::vector<std::int32_t>& line : insert(trace_both_ways(i), i.seed)) lines.push_back(std::move(line));
    }
    return lines;
  }

 private:
  struct Seed {
    std::int32_t node;
    Vec3 inward;
  };

  /// A place inside the face where the length is least, and a node from which it is seen.
  struct Inside {
    MeshNode place;
    std::int32_t seed;
  };

  /// On sections between loops and lines, the sides of the triangles so far: those with the least lengths first.
  std::vector<Inside> find_inside() {
    std::vector<std::pair<std::int32_t, std::int32_t>> sections;
    for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
      const PlaneTriangle& t = m_.triangles[i];
      for (int k = 0; k < 3 && t.state == kUnfinished; ++k)
        if (const std::int32_t a = t.v[k], b = t.v[(k + 1) % 3]; a < b && !(t.constrained >> k & 1))
          sections.push_back({a, b});
    }
    std::vector<Inside> found;
    const std::size_t step = sections.size() / kSections + 1;
    for (std::size_t i = 0; i < sections.size(); i += step) add_least(sections[i].first, sections[i].second, found);
    std::ranges::stable_sort(found, {}, [](const Inside& i) { return i.place.request; });
    return found;
  }

  /// Of the section from a to b: places with shorter lengths than at both sides.
  void add_least(std::int32_t a, std::int32_t b, std::vector<Inside>& found) {
    const auto at = [&](double share) {
      MeshNode p;
      p.p = (1 - share) * m_.nodes[a].p + share * m_.nodes[b].p;
      w_.evaluate(p);
      p.request = length_across(p);
      return p;
    };
    const Vec2 way = m_.nodes[b].p - m_.nodes[a].p;
    std::vector<std::pair<double, double>> samples;  // shares and lengths
    for (double share = 0; share < 1;) {
      const MeshNode p = at(share);
      samples.push_back({share, p.request});
      share += std::clamp(kStep * p.request / norm(way.x * p.du + way.y * p.dv), kLeastStep, kMostStep);
    }
    samples.push_back({1, at(1).request});
    for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
      const double own = samples[k].second;
      if (own > samples[k - 1].second || own >= samples[k + 1].second) continue;
      MeshNode near = at(samples[k].first);
      w_.ask_sizes(near);
      if (is_beside_lines(near)) continue;  // so is the least one, which takes a hundred lengths more to find
      double low = samples[k - 1].first, high = samples[k + 1].first;
      for (int n = 0; n < 2 * kHalvings; ++n) {  // by thirds
        const double one = low + (high - low) / 3, two = high - (high - low) / 3;
        const bool is_lower = at(one).request < at(two).request;
        (is_lower ? high : low) = is_lower ? two : one;
      }
      Inside inside{at(0.5 * (low + high)), a};
      w_.ask_sizes(inside.place);
      if (!is_long(inside.place)) continue;
      const Vec3 across = normalized(cross(inside.place.normal, inside.place.squeeze));
      if (!to_least(inside.place, across, inside.place.request) || !is_long(inside.place)) continue;
      triangle_ = kNone;
      if (!goes_to(inside.place.p, a)) inside.seed = b;
      found.push_back(inside);
    }
  }

  /// From a place inside the face.
  std::vector<MeshNode> trace_both_ways(const Inside& i) {
    const Vec3 ahead = normalized(i.place.squeeze);
    const std::vector<MeshNode> rest = trace(i.place, i.seed, ahead);
    std::vector<MeshNode> line = trace(i.place, i.seed, -1 * ahead);  // triangle_ is that of its end
    std::ranges::reverse(line);
    line.push_back(i.place);
    line.insert(line.end(), rest.begin(), rest.end());
    return line;
  }

  /// Nodes where the length is least along their loop.
  std::vector<Seed> find_seeds() const {
    const auto n = static_cast<std::size_t>(m_.n_boundary);
    std::vector<std::int32_t> next(n, kNone), previous(n, kNone);
    for (const auto& [a, b] : w_.segments) {
      next[a] = next[a] == kNone ? b : a;
      previous[b] = previous[b] == kNone ? a : b;
    }
    std::vector<Seed> seeds;
    for (std::int32_t i = 0; i < m_.n_boundary; ++i)
      if (is_least(i, next) && is_least(i, previous, true)) {
        const MeshNode &at = m_.nodes[i], &a = m_.nodes[previous[i]], &b = m_.nodes[next[i]];
        if (at.is_pole || std::abs(turning(at.x - a.x, b.x - at.x, at.normal)) > kStraight) continue;
        seeds.push_back({i, normalized(cross(at.normal, b.x - a.x))});
      }
    return seeds;
  }

  /// Of those alike the first one along `step` counts: `is_strict` in the other direction.
  bool is_least(std::int32_t i, const std::vector<std::int32_t>& step, bool is_strict = false) const {
    std::int32_t at = i;
    for (int k = 0; k < kBeside; ++k) {
      if (step[at] == kNone || step[at] == at) return false;
      at = step[at];
      const double other = m_.nodes[at].request, own = m_.nodes[i].request;
      if (is_strict ? other <= own : other < own) return false;
    }
    return true;
  }

  static bool is_long(const MeshNode& n) { return aspect_of(n) >= kAspect; }

  /// Places one length along apart, from a loop on, also where edges may not be longer along the way for a while.
  std::vector<MeshNode> trace(std::int32_t seed, Vec3 inward) {
    MeshNode at = m_.nodes[seed];
    to_least(at, normalized(cross(at.normal, inward)), at.request);  // the seed is at one end of a round nose
    return trace(at, seed, inward);
  }
  /// Behind a place that is seen from the seed.
  std::vector<MeshNode> trace(MeshNode at, std::int32_t seed, Vec3 ahead) {
    std::vector<MeshNode> line;
    triangle_ = kNone;
    for (int n = 0, n_without = 0; n < kMostSteps && n_without < kSearched; ++n) {
      const std::optional<MeshNode> next = step_from(at, ahead);
      if (!next || !goes_to(next->p, seed)) break;
      ahead = normalized(next->x - at.x);
      at = *next;
      n_without = is_long(at) ? 0 : n_without + 1;
      line.push_back(at);
    }
    return line;
  }

  /// From where the search was last, or from the seed; false: an edge that must stay is in the way.
  bool goes_to(Vec2 p, std::int32_t seed) {
    if (triangle_ == kNone) triangle_ = m_.triangle_towards(seed, p);
    if (triangle_ != kNone) triangle_ = m_.locate(p, triangle_);
    return triangle_ != kNone && m_.triangles[triangle_].state == kUnfinished;
  }

  std::optional<MeshNode> step_from(const MeshNode& at, Vec3 ahead) {
    Vec3 d = ahead - dot(ahead, at.normal) * at.normal;
    if (aspect_of(at) > kHasDirection) {
      const Vec3 own = dot(at.squeeze, ahead) < 0 ? -1 * at.squeeze : at.squeeze;
      if (dot(own, ahead) > kTurned * norm(own)) d = own;
    }
    d = normalized(d);
    if (d == Vec3{}) return std::nullopt;
    double length = at.request * aspect_of(at);
    MeshNode next;
    for (int i = 0; i < 2; ++i) {
      if (!step_on_surface(w_, at, d, length, next)) return std::nullopt;
      w_.ask_sizes(next);
      if (i == 0) length = 0.5 * (length + std::min(next.request * aspect_of(next), 2 * length));
    }
    if (!to_least(next, normalized(cross(next.normal, d)), length)) return std::nullopt;
    if (dot(normalized(next.x - at.x), ahead) < kTurned) return std::nullopt;
    return next;
  }

  /// The length across, without its direction where that is not needed for it.
  double length_across(MeshNode p) const {
    if (!w_.field->has_metrics()) return w_.field->size(p.x, w_.hint);
    w_.ask_sizes(p);
    return p.request;
  }

  /// Moves it across to where the length is least, or to the middle of where it is about that; false: there is none.
  bool to_least(MeshNode& node, Vec3 across, double step) {
    const MeshNode from = node;
    const auto at = [&](double way) {
      MeshNode p = from;
      if (const auto move = tangent_step(from.du, from.dv, way * across)) p.p = from.p + *move;
      w_.evaluate(p);
      return p;
    };
    const auto request_at = [&](double way) { return length_across(at(way)); };
    double reach = std::max(kWindow * from.request, kWindowOfStep * step);
    for (int i = 0; i <= kWidenings; ++i, reach *= 2) {
      std::array<double, 2 * kProbes + 1> request;
      for (int k = -kProbes; k <= kProbes; ++k) request[k + kProbes] = request_at(k * reach / kProbes);
      const auto least = std::min_element(request.begin(), request.end());
      if (std::min(request.front(), request.back()) < kLonger * *least) continue;
      const double middle = (static_cast<double>(least - request.begin()) - kProbes) * reach / kProbes;
      const double level = kLonger * *least;
      const auto end = [&](double outside) {  // of where lengths are below the level
        double low = middle, high = outside;
        for (int n = 0; n < kHalvings; ++n) (request_at(0.5 * (low + high)) < level ? low : high) = 0.5 * (low + high);
        return low;
      };
      node = at(0.5 * (end(-reach) + end(reach)));
      w_.ask_sizes(node);
      return true;
    }
    return false;
  }

  /// In pieces, where it comes near to others or has no long edges. The first place is seen from the seed, or in
  /// triangle_.
  std::vector<std::vector<std::int32_t>> insert(const std::vector<MeshNode>& places, std::int32_t seed) {
    std::vector<std::vector<std::int32_t>> lines(1);
    for (const MeshNode& place : places) {
      const std::int32_t last = lines.back().empty() ? kNone : lines.back().back();
      const std::int32_t n = is_long(place) ? insert(place, last, seed) : kNone;
      const bool is_joined = n != kNone && last != kNone && m_.force_side(last, n);
      if (!is_joined && !lines.back().empty()) lines.emplace_back();
      if (n != kNone) lines.back().push_back(n);
    }
    std::erase_if(lines, [](const auto& line) { return line.size() < kLeastNodes; });
    for (const auto& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i) add_beside(line[i - 1], line[i]);
    return lines;
  }

  std::int32_t insert(const MeshNode& p, std::int32_t last, std::int32_t seed) {
    if (w_.is_runaway()) return kNone;
    if (last != kNone) triangle_ = m_.seen_from(last, p.p);  // a search over triangles stops at the line itself
    if (!goes_to(p.p, seed)) return kNone;
    if (!m_.find_cavity(p.p, metric_of(p), triangle_) || is_crowded(p, last)) return kNone;
    m_.nodes.push_back(p);
    m_.nodes.back().is_laid = m_.nodes.back().is_kept = true;
    m_.added_node();
    const auto added = static_cast<std::int32_t>(m_.nodes.size()) - 1;
    m_.fill_cavity(added);
    triangle_ = m_.triangle_at(added);
    return added;
  }

  bool is_crowded(const MeshNode& p, std::int32_t last) const {
    const double clear = kClear * p.request;
    const bool is_near = std::any_of(m_.ring().begin(), m_.ring().end(), [&](const Triangulation::RingEdge& e) {
      const Vec3 a = m_.nodes[e.a].x, b = m_.nodes[e.b].x;
      if (e.a != last && distance(p.x, a) < clear) return true;
      return e.constrained && e.a != last && e.b != last && segment_distance(p.x, a, b) < clear;
    });
    if (is_near) return true;
    return is_beside_lines(p);
  }

  /// An edge beside which no line is laid, if it is long for the lengths there.
  struct Beside {
    Vec3 a, b, middle;
    double length;
  };
  void add_beside(std::int32_t from, std::int32_t to) {
    const Vec3 a = m_.nodes[from].x, b = m_.nodes[to].x;
    beside_.push_back({a, b, 0.5 * (a + b), distance(a, b)});
  }

  bool is_beside_lines(const MeshNode& p) const {
    const double clear = kClearBeside * p.request;
    return std::ranges::any_of(beside_, [&](const Beside& side) {
      const double reach = clear + side.length;  // most are further away
      return side.length > kAspect * p.request && norm2(p.x - side.middle) < reach * reach &&
             is_beside(p, side.b - side.a) && segment_distance(p.x, side.a, side.b) < clear;
    });
  }

  static bool is_beside(const MeshNode& p, Vec3 edge) {
    return std::abs(dot(p.squeeze, edge)) > kBesideCosine * norm(p.squeeze) * norm(edge);
  }

  FaceWork& w_;
  Triangulation& m_;
  std::vector<Beside> beside_;     // edges of loops, and of lines so far
  std::int32_t triangle_ = kNone;  // where the last place is
};

}  // namespace

std::vector<std::vector<std::int32_t>> lay_ridges(FaceWork& work) { return RidgeLayer(work).run(); }

}  // namespace st
