#include "meshing/topology/curve_discretiser.h"

#include <algorithm>
#include <cmath>

#include "base/limits.h"

namespace st {
namespace {

constexpr int kInitialIntervals = 16;
constexpr int kMaxDepth = 24;
constexpr double kSamplesPerLength = 2.0;  // samples of the size along one requested length
constexpr double kFullRadius = 0.4;        // of the length: circles from this radius on get segments of max_turning
constexpr double kMostDense = 1.5;         // segments for one of such a circle, however small the radius
constexpr std::uint64_t kMaxSegments = 10'000'000;  // of one edge between two corners: 1 GB
constexpr double kCorner = 0.01;       // of the length: what turns by more than max_turning within this is a corner
constexpr double kCornerReach = 0.25;  // lengths: a corner nearer to an end or another corner has no node of its own
constexpr double kMovedEnd = 0.25;     // of the first segment: a vertex further off the curve's end may pass nodes
constexpr double kLeftAhead = 0.5;     // of the next segment: a node less far ahead of such a vertex is left out

struct Sample {
  double t;
  Vec3 x, d1;
  double h;     // requested along the curve
  double size;  // the smallest requested
};

class Discretiser {
 public:
  Discretiser(const Curve& curve, const SizeField& field, const CurveMeshOptions& options)
      : curve_(curve), field_(field), max_turning_(radians(options.max_turning_deg)) {}

  EdgeMesh run(int min_segments) {
    sample();
    integrate();
    find_stops();
    share_segments(min_segments);
    return place();
  }

 private:
  Sample at(double t) {
    const CurvePoint p = curve_.evaluate(t);
    const LocalSize local = has_metrics_ ? field_.local_on(p.x, a_normal_to(p.d1), hint_) : field_.local(p.x, hint_);
    return {t, p.x, p.d1, local.in(p.d1), local.length};
  }

  void sample() {
    Sample last = at(curve_.t_min());
    samples_.push_back(last);
    for (int i = 1; i <= kInitialIntervals; ++i) {
      const double s = static_cast<double>(i) / kInitialIntervals;
      const Sample next =
          at(i == kInitialIntervals ? curve_.t_max() : curve_.t_min() + s * (curve_.t_max() - curve_.t_min()));
      refine(last, next, 0);
      last = next;
    }
  }

  /// Halves an interval until it is short against the size and turns little, or is as short as a corner.
  void refine(const Sample& a, const Sample& b, int depth) {
    const double chord = distance(a.x, b.x);
    const double h = std::min(a.h, b.h);
    const bool turns =
        norm(a.d1) > 0 && norm(b.d1) > 0 && angle_between(a.d1, b.d1) > 0.5 * max_turning_ && chord > kCorner * h;
    if (depth < kMaxDepth && (kSamplesPerLength * chord > h || turns)) {
      const Sample m = at(0.5 * (a.t + b.t));
      refine(a, m, depth + 1);
      refine(m, b, depth + 1);
      return;
    }
    samples_.push_back(b);
  }

  double turning(std::size_t i) const { return angle_between(samples_[i - 1].d1, samples_[i].d1); }

  /// A chord may leave the curve as far as one that turns by max_turning on a circle of the curve's radius r, or of
  /// kFullRadius lengths h where r is smaller: s^2 / (8 r) = max(r, kFullRadius h) max_turning^2 / 8 for a segment s.
  /// From that radius on, a segment turns by max_turning; on smaller arcs it turns more, and what turns within next to
  /// no length (a kink, a hook at an end) counts for next to nothing. On a curve shorter than the size its own length
  /// is the measure: a small sphere stays round.
  void integrate() {
    double arc = 0;
    for (std::size_t i = 1; i < samples_.size(); ++i) arc += distance(samples_[i - 1].x, samples_[i].x);
    share_.assign(1, 0.0);
    lengths_.assign(1, 0.0);
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const Sample &a = samples_[i - 1], &b = samples_[i];
      const double by_size = distance(a.x, b.x) * 0.5 * (1 / a.h + 1 / b.h);
      const double by_turning = turning(i) / max_turning_;
      const double at_full_radius = std::max(by_size, distance(a.x, b.x) / arc) / (kFullRadius * max_turning_);
      const double by_chord_error =
          std::min(std::sqrt(by_turning * std::min(by_turning, at_full_radius)), kMostDense * at_full_radius);
      share_.push_back(share_.back() + std::max(by_size, by_chord_error));
      lengths_.push_back(lengths_.back() + by_size);
    }
  }

  /// The ends and, the sharpest first, the corners that are not too near to one of these: samples that become nodes.
  void find_stops() {
    stops_ = {0, samples_.size() - 1};
    std::vector<std::size_t> corners;
    for (std::size_t i = 1; i < samples_.size(); ++i)
      if (turning(i) > max_turning_ && distance(samples_[i - 1].x, samples_[i].x) <= kCorner * samples_[i].h)
        corners.push_back(i);
    std::stable_sort(corners.begin(), corners.end(),
                     [&](std::size_t i, std::size_t j) { return turning(i) > turning(j); });
    for (const std::size_t i : corners) {
      const auto is_near = [&](std::size_t stop) { return std::abs(lengths_[i] - lengths_[stop]) < kCornerReach; };
      if (std::none_of(stops_.begin(), stops_.end(), is_near)) stops_.push_back(i);
    }
    std::sort(stops_.begin(), stops_.end());
  }

  double part_share(std::size_t part) const { return share_[stops_[part + 1]] - share_[stops_[part]]; }

  /// Segments between two stops: what the share says, rounded; where that makes too few, the part with the largest
  /// segments gets more.
  void share_segments(int min_segments) {
    int n = 0;
    for (std::size_t part = 0; part + 1 < stops_.size(); ++part) {
      const auto n_part = static_cast<std::uint64_t>(std::llround(std::min(part_share(part), 1e18)));
      n_segments_.push_back(std::max(1, checked_id(n_part, "segments of one CAD edge", kMaxSegments)));
      n += n_segments_.back();
    }
    for (; n < min_segments; ++n) {
      std::size_t largest = 0;
      for (std::size_t part = 1; part < n_segments_.size(); ++part)
        if (part_share(part) * n_segments_[largest] > part_share(largest) * n_segments_[part]) largest = part;
      ++n_segments_[largest];
    }
  }

  EdgeMesh place() {
    std::vector<double> t{curve_.t_min()}, h;
    std::vector<Vec3> x;
    for (std::size_t part = 0; part < n_segments_.size(); ++part) place_part(part, t);
    const int n = static_cast<int>(t.size()) - 1;
    if (!(share_.back() > 0) || !strictly_increasing(t))
      for (int k = 0; k <= n; ++k) t[k] = curve_.t_min() + (curve_.t_max() - curve_.t_min()) * k / n;
    t.back() = curve_.t_max();
    for (const double at_t : t) {
      const Sample s = at(at_t);
      x.push_back(s.x);
      h.push_back(s.size);
    }
    return EdgeMesh::of_curve(std::move(t), std::move(x), std::move(h));
  }

  /// Equal shares between two stops; the first one's node is there.
  void place_part(std::size_t part, std::vector<double>& t) const {
    const int n = n_segments_[part];
    std::size_t i = stops_[part] + 1;
    for (int k = 1; k < n; ++k) {
      const double want = share_[stops_[part]] + part_share(part) * k / n;
      while (i + 1 < share_.size() && share_[i] < want) ++i;
      const double own = share_[i] - share_[i - 1];
      const double s = own > 0 ? (want - share_[i - 1]) / own : 0.5;
      t.push_back(samples_[i - 1].t + s * (samples_[i].t - samples_[i - 1].t));
    }
    t.push_back(samples_[stops_[part + 1]].t);
  }

  static bool strictly_increasing(const std::vector<double>& t) {
    for (std::size_t k = 1; k < t.size(); ++k)
      if (!(t[k] > t[k - 1])) return false;
    return true;
  }

  const Curve& curve_;
  const SizeField& field_;
  double max_turning_;
  int hint_ = 0;
  const bool has_metrics_ = field_.has_metrics();
  std::vector<Sample> samples_;
  std::vector<double> share_;       // segments up to each sample
  std::vector<double> lengths_;     // requested lengths up to each sample
  std::vector<std::size_t> stops_;  // samples that are nodes: both ends and corners, ascending
  std::vector<int> n_segments_;     // between two stops
};

/// Inner nodes next to `end`, met in this order, that do not lead away from it.
int count_passed(const Vec3& end, const std::vector<Vec3>& x) {
  int n = 0;
  if (distance(end, x[0]) <= kMovedEnd * distance(x[0], x[1])) return n;
  for (std::size_t k = 1; k + 1 < x.size(); ++k, ++n) {
    const Vec3 next = x[k + 1] - x[k];
    if (dot(x[k] - end, next) >= kLeftAhead * dot(next, next)) break;
  }
  return n;
}

}  // namespace

EdgeMesh discretise_curve(const Curve& curve, const SizeField& field, const CurveMeshOptions& options) {
  return Discretiser(curve, field, options).run(options.min_segments);
}

void end_at_vertices(EdgeMesh& nodes, const Vec3& first, const Vec3& last, int min_segments) {
  std::vector<Vec3>& x = nodes.node_xyz;
  const int n_inner = static_cast<int>(x.size()) - 2, n_spare = std::max(0, n_inner + 1 - min_segments);
  const int n_first = std::min(n_spare, count_passed(first, x));
  const int n_last = std::min({n_spare - n_first, n_inner - n_first, count_passed(last, {x.rbegin(), x.rend()})});
  x.front() = first;
  x.back() = last;
  if (n_first + n_last == 0) return;
  const auto leave_out = [&](auto& values) {
    values.erase(values.end() - 1 - n_last, values.end() - 1);
    values.erase(values.begin() + 1, values.begin() + 1 + n_first);
  };
  std::vector<double> t = nodes.node_t, size = nodes.node_size;
  leave_out(t);
  leave_out(x);
  leave_out(size);
  nodes = EdgeMesh::of_curve(std::move(t), std::move(x), std::move(size));
}

}  // namespace st
