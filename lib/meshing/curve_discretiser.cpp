#include "meshing/curve_discretiser.h"

#include <algorithm>
#include <cmath>

namespace st {
namespace {

constexpr int kInitialIntervals = 16;
constexpr int kMaxDepth = 16;
constexpr double kMostByTurning = 64;       // segments for one, where the curve turns; a corner is no reason for more
constexpr double kSamplesPerLength = 2.0;   // samples of the size along one requested length

struct Sample {
  double t;
  Vec3 x, d1;
  double h;
};

class Discretiser {
 public:
  Discretiser(const Curve& curve, const SizeField& field, const CurveMeshOptions& options)
      : curve_(curve), field_(field), max_turning_(radians(options.max_turning_deg)) {}

  CurveNodes run(int min_segments) {
    sample();
    integrate();
    return place(min_segments);
  }

 private:
  Sample at(double t) {
    const CurvePoint p = curve_.evaluate(t);
    return {t, p.x, p.d1, field_.size(p.x, hint_)};
  }

  void sample() {
    Sample last = at(curve_.t_min());
    samples_.push_back(last);
    for (int i = 1; i <= kInitialIntervals; ++i) {
      const double s = static_cast<double>(i) / kInitialIntervals;
      const Sample next = at(i == kInitialIntervals ? curve_.t_max() : curve_.t_min() + s * (curve_.t_max() - curve_.t_min()));
      refine(last, next, 0);
      last = next;
    }
  }

  /// Halves an interval until it is short against the size and turns little.
  void refine(const Sample& a, const Sample& b, int depth) {
    const double chord = distance(a.x, b.x);
    const double h = std::min(a.h, b.h);
    const bool turns = norm(a.d1) > 0 && norm(b.d1) > 0 && angle_between(a.d1, b.d1) > 0.5 * max_turning_ && depth < 8;
    if (depth < kMaxDepth && (kSamplesPerLength * chord > h || turns)) {
      const Sample m = at(0.5 * (a.t + b.t));
      refine(a, m, depth + 1);
      refine(m, b, depth + 1);
      return;
    }
    samples_.push_back(b);
  }

  void integrate() {
    share_.assign(1, 0.0);
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const Sample &a = samples_[i - 1], &b = samples_[i];
      const double by_size = distance(a.x, b.x) * 0.5 * (1 / a.h + 1 / b.h);
      const double by_turning = angle_between(a.d1, b.d1) / max_turning_;
      share_.push_back(share_.back() + std::clamp(by_turning, by_size, kMostByTurning * by_size));
    }
  }

  CurveNodes place(int min_segments) {
    const double total = share_.back();
    const int n = std::max(min_segments, static_cast<int>(std::lround(std::min(total, 1e8))));
    CurveNodes nodes;
    nodes.t.push_back(curve_.t_min());
    std::size_t i = 1;
    for (int k = 1; k < n; ++k) {
      const double want = total * k / n;
      while (i + 1 < share_.size() && share_[i] < want) ++i;
      const double part = share_[i] - share_[i - 1];
      const double s = part > 0 ? (want - share_[i - 1]) / part : 0.5;
      nodes.t.push_back(samples_[i - 1].t + s * (samples_[i].t - samples_[i - 1].t));
    }
    nodes.t.push_back(curve_.t_max());
    if (!(total > 0) || !strictly_increasing(nodes.t))
      for (int k = 0; k <= n; ++k) nodes.t[k] = curve_.t_min() + (curve_.t_max() - curve_.t_min()) * k / n;
    nodes.t.back() = curve_.t_max();
    for (double t : nodes.t) {
      const Sample s = at(t);
      nodes.x.push_back(s.x);
      nodes.h.push_back(s.h);
    }
    return nodes;
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
  std::vector<Sample> samples_;
  std::vector<double> share_;   // integral of ds/h up to each sample
};

}  // namespace

CurveNodes discretise_curve(const Curve& curve, const SizeField& field, const CurveMeshOptions& options) {
  return Discretiser(curve, field, options).run(options.min_segments);
}

}  // namespace st
