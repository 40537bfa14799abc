#include "sizing/source_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sizing/space_metric.h"

namespace st {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What asks for no more than either.
SourceSpacing least_of(const SourceSpacing& a, const SourceSpacing& b) {
  const double radius = std::max(a.radius, b.radius), width = std::max(a.doubling - a.radius, b.doubling - b.radius);
  return {std::min(a.length, b.length), radius, radius + width};
}

std::vector<Box3> cores_of(const std::vector<SourceTree::Entry>& entries) {
  std::vector<Box3> cores;
  for (const SourceTree::Entry& e : entries) cores.push_back(e.source->growth().core);
  return cores;
}

}  // namespace

FewSources::FewSources(const std::int32_t* source, std::size_t n) : bits_(kMost + 2) {
  const auto are_below = [&](int bits) {
    return std::all_of(source, source + n, [bits](std::int32_t s) { return s < 1 << bits; });
  };
  const bool is_small = n <= kMost && are_below(kBits);
  if (!is_small && !(n <= kMostWide && are_below(kWideBits))) return;
  const int bits = is_small ? kBits : kWideBits;
  bits_ = (n + 1) | (is_small ? 0 : kWide);
  for (std::size_t i = 0; i < n; ++i)
    bits_ |= static_cast<std::uint64_t>(source[i]) << (4 + bits * static_cast<int>(i));
}

SourceTree::SourceTree(std::vector<Entry> entries) : entries_(std::move(entries)), tree_(cores_of(entries_)) {
  min_size_ = kInfinity;
  for (const Entry& e : entries_) {
    min_size_ = std::min(min_size_, e.source->min_size());
    max_aspect_ = std::max(max_aspect_, e.source->max_aspect());
    slope_ = std::max(slope_, e.source->slope());
    has_metrics_ = has_metrics_ || e.source->has_metrics();
  }
  for (const BoxTree::Node& node : tree_.nodes()) {
    SourceSpacing least = entries_[tree_.items()[node.begin]].source->growth().spacing;
    for (std::int32_t i = node.begin + 1; i < node.end; ++i)
      least = least_of(least, entries_[tree_.items()[i]].source->growth().spacing);
    least_.push_back(least);
  }
}

inline bool SourceTree::reaches(std::int32_t node, double distance2, double best) const {
  const SourceSpacing& s = least_[node];
  const double room = best - s.length;
  if (!(room >= 0)) return false;
  // never steeper than the slope
  const bool is_plain = s.doubling <= s.radius;
  const double far = s.radius + room / slope_;
  if (distance2 <= far * far) return true;
  return !is_plain && grown_length(s, slope_, std::sqrt(distance2)) <= best;
}

double SourceTree::size_below(Vec3 x, double upper, std::int32_t* winner) const {
  // asked for by all: lengths a little above the best, so that one that equals it is seen
  constexpr double kAbove = 1 + 1e-15;
  double best = upper;
  std::int32_t by = kNone;
  tree_.visit_near(
      x, [&](std::int32_t node, double d2) { return reaches(node, d2, best); },
      [&](std::int32_t i) {
        const double length = entries_[i].source->size_below(x, kAbove * best);
        if (length < best || (length == best && by != kNone && i < by)) {
          best = length;
          by = i;
        }
      });
  if (winner) *winner = by;
  return best;
}

LocalSize SourceTree::local_below(Vec3 x, const LocalSize& upper) const {
  std::int32_t winner = kNone;
  const double length = size_below(x, upper.length, &winner);
  if (max_aspect_ <= 1 && upper.along <= upper.length) return {length, length, {}};
  int hint = 0;
  const LocalSize first = winner == kNone ? upper : entries_[winner].source->local(x, hint);
  LocalSize least = first;
  if (!(least.along > least.length)) return {length, length, {}};
  if (winner != kNone) least.along = std::min(least.along, upper.in(least.direction));
  tree_.visit_near(
      x, [&](std::int32_t node, double d2) { return reaches(node, d2, least.along); },
      [&](std::int32_t i) {
        const LocalSize other = i == winner ? first : entries_[i].source->local(x, hint);
        least.along = std::min(least.along, other.in(least.direction));
      });
  least.length = length;
  least.along = std::max(least.along, length);
  return least;
}

LocalSize SourceTree::local_on_below(Vec3 x, Vec3 normal, const LocalSize& upper) const {
  const auto in_plane = [&](const LocalSize& s) { return s.along > s.length ? cut_by_plane(metric_of(s), normal) : s; };
  LocalSize least = in_plane(upper);
  int hint = 0;
  tree_.visit_near(
      x, [&](std::int32_t node, double d2) { return reaches(node, d2, upper.along); },
      [&](std::int32_t i) {
        const SizeSource& source = *entries_[i].source;
        const LocalSize own = source.local_on(x, normal, hint);
        least = least_in_plane(least, source.has_metrics() ? own : in_plane(own), normal);
      });
  return least;
}

double SourceTree::least_near(Vec3 x, double radius, double upper) const {
  double best = upper;
  const double drop = slope_ * radius;
  tree_.visit_near(
      x, [&](std::int32_t node, double d2) { return least_[node].length < best && reaches(node, d2, best + drop); },
      [&](std::int32_t i) { best = entries_[i].source->least_within(x, radius, best); });
  return best;
}

FewSources SourceTree::find_near(Vec3 x, double radius, double upper) const {
  constexpr double kClear = 1 + 1e-5;  // what sources ask for is exact to 1e-6
  const double drop = slope_ * radius;
  std::vector<std::pair<double, std::int32_t>> found;  // the least that it asks for
  double bound = upper;
  tree_.visit_near(
      x, [&](std::int32_t node, double d2) { return least_[node].length < bound && reaches(node, d2, bound + drop); },
      [&](std::int32_t i) {
        const SizeSource& source = *entries_[i].source;
        const double at_x = source.size_below(x, bound + drop), least = std::max(source.min_size(), at_x - drop);
        if (!(least < bound)) return;
        found.push_back({least, i});
        bound = std::min(bound, kClear * (at_x + drop));
      });
  std::vector<std::int32_t> near;
  for (const auto& [least, i] : found)
    if (least < bound) near.push_back(i);
  std::sort(near.begin(), near.end());
  return {near.data(), near.size()};
}

bool SourceTree::tells(Vec3 x, double length) const {
  const double above = std::nextafter(length, kInfinity);
  return size_below(x, above) < above;
}

Vec3 SourceTree::gradient(std::int32_t source, Vec3 x) const { return entries_[source].source->gradient(x); }

Vec3 SourceTree::origin(std::int32_t source, Vec3 x) const {
  constexpr int kMostSteps = 50;
  const SizeSource& s = *entries_[source].source;
  for (int i = 0; i < kMostSteps; ++i) {
    const Vec3 g = gradient(source, x);
    const double rise = s.size(x) - s.min_size();
    if (!(rise > 1e-6 * s.min_size()) || !(norm2(g) > 1e-12)) break;
    x = x - (rise / norm2(g)) * g;
  }
  return x;
}

}  // namespace st
