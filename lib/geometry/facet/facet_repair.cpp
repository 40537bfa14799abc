#include "geometry/facet/facet_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "base/error.h"
#include "base/lists_by_key.h"
#include "geometry/facet/facet_flaps.h"
#include "geometry/facet/facet_gaps.h"
#include "geometry/facet/facet_sides.h"
#include "geometry/facet/short_sides.h"
#include "geometry/facet/split_sides.h"

namespace st {
namespace {

constexpr double kCapHeight = 0.02;  // over the longest side
constexpr double kCapOff = 5e-5;     // of the diagonal: what turning a side may move the surface by
constexpr double kAtCorner = 0.5;    // cosine between facets that lie on one surface, at least
constexpr double kNoNormal = 1e-3;   // height over longest side: below, the normal is rounding
constexpr int kCapPasses = 12;       // over all facets: caps may lie on caps

class FacetRepair {
 public:
  explicit FacetRepair(FacetInput& input) : in_(input) {
    for (const Vec3 x : input.x) box_.add(x);
  }

  std::vector<ImportFinding> run() {
    drop_duplicates();
    const bool were_apart = are_parts_apart(), has_joined = join_free_nodes();
    if (has_joined) drop_duplicates();
    if (has_joined && were_apart) unite_parts();
    if (gaps_.had_free_sides) divide_at_nodes();
    if (gaps_.had_free_sides) drop_lone_lines();
    join_short_sides();
    drop_unused_nodes();
    if (!has_area()) throw Error(ExitCode::kGeometry, "no facet has an area; export the model again");
    orient();
    turn_caps();
    return std::move(findings_);
  }

 private:
  void add(FindingKind kind, Vec3 x, double size, std::size_t n) {
    findings_.push_back({kind, "", x, size, true, std::to_string(n)});
  }

  bool has_area() const {
    return std::any_of(in_.corners.begin(), in_.corners.end(),
                       [&](const Corners& c) { return flatness(c) > kSinglePrecision; });
  }

  void drop_duplicates() {
    std::vector<Corners> sorted = in_.corners;
    for (Corners& c : sorted) std::ranges::sort(c);
    ListsByKey<> by_lowest(in_.x.size(), [&](const auto& visit) {
      for (std::size_t t = 0; t < sorted.size(); ++t) visit(sorted[t][0], static_cast<std::int32_t>(t));
    });
    std::vector<std::uint8_t> is_kept(sorted.size(), 0);
    std::size_t n_duplicates = 0;
    std::vector<TwinFacets> pairs;
    Vec3 place;
    for (std::size_t node = 0; node < by_lowest.n_keys(); ++node) {
      const std::span<std::int32_t> own = by_lowest[node];
      std::ranges::stable_sort(own, {}, [&](std::int32_t t) -> const Corners& { return sorted[t]; });
      for (std::size_t i = 0, j; i < own.size(); i = j) {
        const Corners& c = sorted[own[i]];
        for (j = i + 1; j < own.size() && sorted[own[j]] == c;) ++j;
        if (c[0] == c[1] || c[1] == c[2]) continue;
        if (j - i > 1 && n_duplicates == 0) place = in_.x[c[0]];
        const bool is_left = (j - i) % 2 == 1 || flatness(c) > kNoNormal;  // two without area are nothing
        is_kept[own[i]] = is_left;
        n_duplicates += j - i - is_left;
        if (j - i == 2 && is_left) pairs.push_back({own[i], own[i + 1]});
      }
    }
    for (const auto& [a, b] : find_flaps(in_.corners, pairs)) {
      is_kept[a] = is_kept[b] = 0;
      ++n_duplicates;
    }
    if (n_duplicates > 0) add(FindingKind::kDuplicateFacets, place, 0, n_duplicates);
    in_.keep([&](std::size_t t) { return is_kept[t] != 0; });
  }

  /// Whether any node was joined.
  bool join_free_nodes() {
    gaps_ = join_gaps(in_, box_.diagonal());
    if (gaps_.n_nodes > 0) add(FindingKind::kJoinedNodes, gaps_.place, gaps_.gap, gaps_.n_nodes);
    return gaps_.n_nodes > 0;
  }

  /// Connected parts of a file that tells no solids.
  bool are_parts_apart() const {
    std::vector<std::int32_t> part(in_.x.size(), kNone);
    for (std::size_t t = 0; t < in_.corners.size(); ++t)
      for (const std::int32_t n : in_.corners[t])
        if (const std::int32_t before = std::exchange(part[n], in_.part[t]); before != kNone && before != in_.part[t])
          return false;
    return true;
  }

  /// Parts without a name that hang together now: gaps alone divided them.
  void unite_parts() {
    DisjointSets sets(static_cast<std::int64_t>(in_.part_name.size()));
    for_each_pair(sorted_sides(in_.corners, in_.x.size()), [&](std::span<const FacetSide> s) {
      const std::int32_t a = in_.part[s.front().triangle], b = in_.part[s.back().triangle];
      if (a != b && in_.part_name[a].empty() && in_.part_name[b].empty()) sets.join(a, b);
    });
    if (in_.part_name.empty()) return;
    for (std::int32_t& part : in_.part) part = sets.find(part);
  }

  /// Where facets end on a side of another one.
  void divide_at_nodes() {
    const std::size_t n_before = in_.corners.size();
    const std::size_t n = split_sides_at_nodes(in_, gaps_.gap);
    if (n == 0) return;
    findings_.push_back({FindingKind::kOther, "", in_.x[in_.corners[n_before][1]], 0, true,
                         fmt::format("facets with nodes of others on a side, divided there: {}", n)});
  }

  /// Facets without neighbours that are lines within the gap.
  void drop_lone_lines() {
    std::vector<std::uint8_t> n_free(in_.corners.size(), 0);
    for_each_pair(sorted_sides(in_.corners, in_.x.size()), [&](std::span<const FacetSide> s) {
      if (s.size() == 1) ++n_free[s[0].triangle];
    });
    std::size_t n_lines = 0;
    in_.keep([&](std::size_t t) {
      const Corners& c = in_.corners[t];
      if (n_free[t] < 3 || flatness(c) * side_length(c, longest_side(c)) > gaps_.gap) return true;
      if (n_lines++ == 0) place_ = in_.x[c[0]];
      return false;
    });
    if (n_lines > 0)
      findings_.push_back({FindingKind::kOther, "", place_, 0, true,
                           fmt::format("facets without area that have no neighbours, removed: {}", n_lines)});
  }

  /// As convex hulls have them: nodes that are one but for rounding, with needles between.
  void join_short_sides() {
    const std::size_t n = join_ends_of_short_sides(in_, kFacetGap * box_.diagonal());
    if (n == 0) return;
    findings_.push_back({FindingKind::kOther, "", in_.x[in_.corners.empty() ? 0 : in_.corners[0][0]], 0, true,
                         fmt::format("sides of facets that are points but for rounding, removed: {}", n)});
    drop_duplicates();
  }

  void drop_unused_nodes() {
    std::vector<std::int32_t> number(in_.x.size(), kNone);
    for (const Corners& c : in_.corners)
      for (const std::int32_t n : c) number[n] = 0;
    std::int32_t n_used = 0;
    for (std::size_t n = 0; n < number.size(); ++n) {
      if (number[n] == kNone) continue;
      number[n] = n_used++;
      in_.x[number[n]] = in_.x[n];
    }
    in_.x.resize(n_used);
    for (Corners& c : in_.corners)
      for (std::int32_t& n : c) n = number[n];
  }

  /// Neighbours across sides that two facets have, whichever way round; or two of each part.
  void link() {
    const ListsByKey<FacetSide> sides = sorted_sides(in_.corners, in_.x.size());
    links_.assign(in_.corners.size(), {});
    is_open_.assign(in_.corners.size(), 0);
    std::vector<FacetSide> own;
    for_each_pair(sides, [&](std::span<const FacetSide> s) {
      own.assign(s.begin(), s.end());
      const auto part = [&](const FacetSide& side) { return in_.part[side.triangle]; };
      if (s.size() > 2) std::ranges::stable_sort(own, {}, part);
      bool is_closed = s.size() % 2 == 0;
      for (std::size_t i = 0; i + 1 < s.size() && s.size() > 2; i += 2)
        is_closed &= part(own[i]) == part(own[i + 1]) && (i == 0 || part(own[i - 1]) != part(own[i]));
      for (const FacetSide& side : s) is_open_[side.triangle] |= !is_closed;
      for (std::size_t i = 0; is_closed && i < own.size(); i += 2) link(&own[i]);
    });
  }

  void link(const FacetSide* s) {
    const bool agree = s[0].is_forward != s[1].is_forward;
    for (const int own : {0, 1})
      std::ranges::find(links_[s[own].triangle], kNone, &Link::other)[0] = {s[1 - own].triangle, agree};
  }

  struct Link {
    std::int32_t other = kNone;
    bool agree = true;
  };

  struct Part {
    std::vector<std::int32_t> triangles;
    Box3 box;
    double volume = 0;  ///< as it is turned
    bool is_closed = true;
  };

  void orient() {
    link();
    std::vector<std::uint8_t> is_turned(in_.corners.size(), 0), is_seen(in_.corners.size(), 0);
    std::vector<Part> parts;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(is_seen.size()); ++t)
      if (!is_seen[t]) parts.push_back(flood(t, is_turned, is_seen));
    for (const Part& p : parts) {
      const bool is_inside = std::any_of(parts.begin(), parts.end(), [&](const Part& o) {
        return &o != &p && o.is_closed && o.box.diagonal() > p.box.diagonal() && contains(o.box, p.box);
      });
      if (p.is_closed && p.volume < 0 && !is_inside)
        for (const std::int32_t t : p.triangles) is_turned[t] ^= 1;
    }
    std::size_t n_turned = 0;
    for (std::size_t t = 0; t < is_turned.size(); ++t) {
      if (!is_turned[t]) continue;
      if (n_turned++ == 0) place_ = in_.x[in_.corners[t][0]];
      std::swap(in_.corners[t][1], in_.corners[t][2]);
    }
    if (n_turned > 0) add(FindingKind::kTurnedFacets, place_, 0, n_turned);
    give_own_nodes(parts);
  }

  /// Closed parts that touch are bodies of their own, as solids of CAD are.
  void give_own_nodes(const std::vector<Part>& parts) {
    std::vector<std::int32_t> owner(in_.x.size(), kNone), copy(in_.x.size(), kNone);
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(parts.size()); ++p) {
      if (!parts[p].is_closed) continue;
      std::vector<std::int32_t> copied;
      for (const std::int32_t t : parts[p].triangles)
        for (std::int32_t& n : in_.corners[t]) {
          if (owner[n] == kNone) owner[n] = p;
          if (owner[n] == p) continue;
          if (copy[n] == kNone) {
            copy[n] = static_cast<std::int32_t>(in_.x.size());
            in_.x.push_back(in_.x[n]);
            copied.push_back(n);
          }
          n = copy[n];
        }
      for (const std::int32_t n : copied) copy[n] = kNone;
    }
  }

  Part flood(std::int32_t first, std::vector<std::uint8_t>& is_turned, std::vector<std::uint8_t>& is_seen) const {
    Part part;
    part.triangles = {first};
    is_seen[first] = 1;
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      const std::int32_t t = part.triangles[i];
      part.is_closed = part.is_closed && !is_open_[t];
      for (const auto& [other, agree] : links_[t]) {
        if (other == kNone) break;
        const std::uint8_t wanted = is_turned[t] ^ (agree ? 0 : 1);
        if (!is_seen[other]) {
          is_seen[other] = 1;
          is_turned[other] = wanted;
          part.triangles.push_back(other);
        } else if (is_turned[other] != wanted) {
          fail_one_sided(t);
        }
      }
    }
    turn_by_area(part, is_turned);
    return part;
  }

  /// As most of the area was.
  void turn_by_area(Part& part, std::vector<std::uint8_t>& is_turned) const {
    double kept = 0, turned = 0;
    const Vec3 origin = in_.x[in_.corners[part.triangles[0]][0]];
    for (const std::int32_t t : part.triangles) {
      const Corners& c = in_.corners[t];
      const Vec3 n = cross(in_.x[c[1]] - in_.x[c[0]], in_.x[c[2]] - in_.x[c[0]]);
      (is_turned[t] ? turned : kept) += norm(n);
      part.volume += (is_turned[t] ? -1 : 1) * dot(in_.x[c[0]] - origin, n) / 6;
      for (const std::int32_t node : c) part.box.add(in_.x[node]);
    }
    if (turned <= kept) return;
    part.volume = -part.volume;
    for (const std::int32_t t : part.triangles) is_turned[t] ^= 1;
  }

  [[noreturn]] void fail_one_sided(std::int32_t t) const {
    const Vec3 x = in_.x[in_.corners[t][0]];
    throw Error(ExitCode::kGeometry,
                fmt::format("the facets around ({:.6g}, {:.6g}, {:.6g}) have one side alone, like a Moebius strip: no "
                            "side is outside; repair them",
                            x.x, x.y, x.z));
  }

  /// A cap is a facet with a node almost on its longest side: the side is replaced by one from that node, so that
  /// needles do not fold. Not where that makes a worse facet, one of another orientation, or a side that is there
  /// already.
  void turn_caps() {
    std::size_t n_turned = 0, n_before = 0;
    for (int pass = 0; pass < kCapPasses; ++pass) {
      const std::vector<Corners> neighbours = find_neighbours(in_.corners);
      facets_ = cells_of_nodes(in_.corners, in_.x.size());
      std::vector<std::uint8_t> is_touched(in_.corners.size(), 0);
      for (std::int32_t t = 0; t < static_cast<std::int32_t>(in_.corners.size()); ++t) {
        const int k = longest_side(in_.corners[t]);
        const std::int32_t other = neighbours[t][k];
        if (other == kNone || is_touched[t] || is_touched[other] || in_.part[t] != in_.part[other]) continue;
        if (!is_cap(in_.corners[t], k) || !turn_side(t, k, neighbours)) continue;
        if (n_turned++ == 0) place_ = in_.x[in_.corners[t][0]];
        for (const std::int32_t touched : {t, other}) {
          is_touched[touched] = 1;
          for (const std::int32_t beside : neighbours[touched])
            if (beside != kNone) is_touched[beside] = 1;
        }
      }
      if (n_turned == n_before) break;
      n_before = n_turned;
    }
    if (n_turned > 0)
      findings_.push_back({FindingKind::kOther, "", place_, 0, true,
                           fmt::format("facets with a node almost on a side, that side turned: {}", n_turned)});
  }

  int longest_side(const Corners& c) const {
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (side_length(c, k) > side_length(c, longest)) longest = k;
    return longest;
  }
  double side_length(const Corners& c, int k) const { return distance(in_.x[c[k]], in_.x[c[(k + 1) % 3]]); }
  /// Over the longest side, as a share of it.
  double flatness(const Corners& c) const {
    const double longest = side_length(c, longest_side(c));
    return longest > 0 ? norm(area_normal(in_.x, c)) / (longest * longest) : 0;
  }

  bool is_cap(const Corners& c, int k) const {
    const Vec3 a = in_.x[c[k]], side = in_.x[c[(k + 1) % 3]] - a, apex = in_.x[c[(k + 2) % 3]] - a;
    const double length = norm(side), along = dot(apex, side) / (length * length), share = flatness(c);
    return share < kCapHeight && share * length < kCapOff * box_.diagonal() && along > 2 * kCapHeight &&
           along < 1 - 2 * kCapHeight;
  }

  bool turn_side(std::int32_t t, int k, const std::vector<Corners>& neighbours) {
    const std::int32_t other = neighbours[t][k];
    const Corners c = in_.corners[t], o = in_.corners[other];
    const std::int32_t a = c[k], b = c[(k + 1) % 3], apex = c[(k + 2) % 3], opposite = o[0] + o[1] + o[2] - a - b;
    const Corners first{apex, a, opposite}, second{apex, opposite, b};
    const Vec3 normal = area_normal(in_.x, o);
    const bool is_flat = dot(normalized(area_normal(in_.x, c)), normalized(normal)) > kAtCorner;
    if (!is_flat && flatness(c) > kNoNormal && !is_folded(t, neighbours)) return false;  // a sharp edge
    if (opposite == apex || has_side(apex, opposite)) return false;
    if (!is_line_on_line(c, o, a + b)) {
      if (!(dot(area_normal(in_.x, first), normal) > 0 && dot(area_normal(in_.x, second), normal) > 0)) return false;
      if (std::min(flatness(first), flatness(second)) <= flatness(c)) return false;
    }
    in_.corners[t] = first;
    in_.corners[other] = second;
    return true;
  }

  /// Whether two facets without area have their longest side in common, of nodes that add up to `ends`. Each node lies
  /// within it, so that turning it makes all sides shorter.
  bool is_line_on_line(const Corners& c, const Corners& o, std::int32_t ends) const {
    const int k = longest_side(o);
    return std::max(flatness(c), flatness(o)) <= kNoNormal && o[k] + o[(k + 1) % 3] == ends && is_cap(o, k);
  }

  bool is_folded(std::int32_t t, const std::vector<Corners>& neighbours) const {
    const Vec3 normal = area_normal(in_.x, in_.corners[t]);
    return std::all_of(neighbours[t].begin(), neighbours[t].end(), [&](std::int32_t other) {
      return other == kNone || dot(normal, area_normal(in_.x, in_.corners[other])) < 0;
    });
  }

  bool has_side(std::int32_t a, std::int32_t b) const {
    return std::ranges::any_of(facets_[a], [&](std::int32_t t) { return std::ranges::count(in_.corners[t], b) > 0; });
  }

  FacetInput& in_;
  Box3 box_;
  std::vector<ImportFinding> findings_;
  std::vector<std::array<Link, 3>> links_;  // of each facet, those without another one last
  std::vector<std::uint8_t> is_open_;       // has a side that not exactly two facets have
  ListsByKey<> facets_;                     // of nodes, when a pass began
  JoinedGaps gaps_;
  Vec3 place_;
};

}  // namespace

std::vector<ImportFinding> repair_facets(FacetInput& input) { return FacetRepair(input).run(); }

}  // namespace st
