#include "sizing/raster_face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "base/assert.h"
#include "base/ids.h"
#include "geometry/shape/bspline.h"
#include "geometry/shape/composite_surface.h"
#include "sizing/cell_limit.h"
#include "sizing/line_stretch.h"
#include "sizing/patch_walk.h"
#include "sizing/probe_turning.h"

namespace st {
namespace {

constexpr int kFirstCuts = 4;            // per direction, on surfaces whose curvature varies freely
constexpr int kDoubts = 6;               // splits (two per halving) granted to a curvature that no angle confirms
constexpr double kConfirmed = 2;         // a curvature up to this times the largest angle per distance around counts as
                                         // confirmed
constexpr double kPart = 0.9;            // of a surface's range in u or v: less is a part of it
constexpr double kAngleNoise = 1e-3;     // angles below this times alpha say nothing
constexpr double kBreakInset = 1e-7;     // of the interval: probes stay on their side of a crease
constexpr double kSingular2 = 1e-20;     // squared sine of the angle between du and dv at a singular point
constexpr double kClearlyFlatter = 0.3;  // smaller over larger curvature: their directions are certain
constexpr double kClearlyCurved = 0.01;  // of alpha along one length: likewise
constexpr double kAligned = 0.9;         // cosine: pairs of probes that tell of a direction; others turn across it, too
constexpr double kLeastOfHalf = 0.2;     // of half a patch: ends nearer to its middle tell nothing
constexpr double kCollapsed = 1e-9;  // derivative over the other one, scaled to the ranges, where a side has collapsed

constexpr std::int64_t kBoxesPerNews = 1000;  // how far a large face is

class FaceRaster {
 public:
  using CurvaturePatch = Patch<CurvatureProbe>;

  FaceRaster(const Surface& surface, const LoopPolygons& loops, const SamplingLimits& limits, std::int32_t cause,
             std::vector<RasterBox>& boxes, std::vector<GapPatch>* patches, const ChordLimit* chord,
             const std::function<void(double)>& on_area)
      : surface_(surface),
        loops_(loops),
        limits_(limits),
        cause_(cause),
        boxes_(boxes),
        patches_(patches),
        chord_(chord),
        on_area_(on_area) {
    range_u_ = surface.u_max() - surface.u_min();
    range_v_ = surface.v_max() - surface.v_min();
    const SurfaceType type = surface.type();
    is_free_ = !(type == SurfaceType::kPlane || type == SurfaceType::kCylinder || type == SurfaceType::kCone ||
                 type == SurfaceType::kSphere || type == SurfaceType::kTorus);
    Box2 rim;
    for (const LoopSide& s : loops.sides()) rim.add(s.a);
    is_part_ = !rim.is_empty() && (rim.size().x < kPart * range_u_ || rim.size().y < kPart * range_v_);
  }

  FaceRasterReport run() {
    const std::vector<double> us =
        grid_lines(surface_.u_min(), surface_.u_max(), creases(surface_.u_breaks(), Direction::kU));
    const std::vector<double> vs =
        grid_lines(surface_.v_min(), surface_.v_max(), creases(surface_.v_breaks(), Direction::kV));
    PatchWalk<CurvatureProbe, FaceRaster> walk(surface_, loops_, *this);
    for (std::size_t j = 0; j + 1 < vs.size(); ++j)
      for (std::size_t i = 0; i + 1 < us.size(); ++i) {
        const auto [u0, u1] = inset_interval(us, i);
        const auto [v0, v1] = inset_interval(vs, j);
        walk.walk(u0, u1, v0, v1, is_free_ ? kFirstCuts : 1);
      }
    return report_;
  }

  CurvatureProbe probe(Vec2 uv) {
    ++report_.n_evaluations;
    const SurfacePoint2 p = surface_.evaluate2(uv);
    const Vec3 n = cross(p.du, p.dv);
    const double du2 = norm2(p.du), dv2 = norm2(p.dv), n2 = norm2(n);
    const double lu2 = du2 * range_u_ * range_u_, lv2 = dv2 * range_v_ * range_v_;
    if (!(n2 > kSingular2 * du2 * dv2) || lu2 < kCollapsed * kCollapsed * lv2 || lv2 < kCollapsed * kCollapsed * lu2)
      return {p.x, {}, 0};
    return {p.x, n / std::sqrt(n2), std::abs(principal_curvature(p).k1)};
  }

  /// Never before its curvature is known: what is doubted there counts for its parts.
  bool must_split(const PatchSize&) const { return false; }

  /// Decides whether a patch is split; if not, makes it a raster box.
  bool visit(const CurvaturePatch& patch, const PatchSize& size, int& n_doubts) {
    bool is_doubtful = false;
    const double curvature = patch.n_inside > 0 ? patch_curvature(patch, is_doubtful) : boundary_curvature(patch);
    const double length = allowed_length(curvature, size.center);
    const bool is_large =
        size.extent > patch_per_length(limits_) * length || (is_free_ && size.extent > limits_.max_length);
    const bool may_doubt = is_doubtful && n_doubts < kDoubts && size.extent > limits_.min_length;
    if (is_large || may_doubt) {
      n_doubts += is_doubtful;
      return true;
    }
    add_box(patch, size, length);
    return false;
  }

 private:
  enum class Direction { kU, kV };

  // --- creases

  /// Breaks across which the normal jumps by more than alpha somewhere. Weaker ones are sampled like a smooth surface.
  std::vector<double> creases(const std::vector<double>& breaks, Direction direction) {
    constexpr int kProbes = 5;
    std::vector<double> result;
    const bool across_u = direction == Direction::kU;
    const double step = kBreakInset * (across_u ? range_u_ : range_v_);
    for (const double b : breaks) {
      bool is_crease = false;
      for (int k = 0; k < kProbes && !is_crease; ++k) {
        const double share = (k + 0.5) / kProbes;
        const double other = across_u ? surface_.v_min() + range_v_ * share : surface_.u_min() + range_u_ * share;
        const Vec3 before = normal_at(across_u ? Vec2{b - step, other} : Vec2{other, b - step});
        const Vec3 after = normal_at(across_u ? Vec2{b + step, other} : Vec2{other, b + step});
        is_crease = angle_between(before, after) > limits_.alpha;
      }
      if (is_crease) result.push_back(b);
    }
    return result;
  }

  Vec3 normal_at(Vec2 uv) {
    ++report_.n_evaluations;
    const SurfacePoint p = surface_.evaluate(uv);
    return normalized(cross(p.du, p.dv));
  }

  static std::vector<double> grid_lines(double lo, double hi, const std::vector<double>& inner) {
    std::vector<double> lines{lo};
    for (const double x : inner)
      if (x > lines.back() && x < hi) lines.push_back(x);
    lines.push_back(hi);
    return lines;
  }

  /// Interval k between grid lines, drawn in a little from those that are creases.
  static std::pair<double, double> inset_interval(const std::vector<double>& lines, std::size_t k) {
    const double inset = kBreakInset * (lines[k + 1] - lines[k]);
    return {lines[k] + (k > 0 ? inset : 0), lines[k + 1] - (k + 2 < lines.size() ? inset : 0)};
  }

  // --- lengths

  double allowed_length(double curvature, Vec3 x) const {
    double length = curvature * limits_.max_length > limits_.alpha ? limits_.alpha / curvature : limits_.max_length;
    if (chord_ && chord_->least() < length) length = std::min(length, chord_->at(x));
    if (curvature * length * length > 8 * limits_.chord)
      length = std::sqrt(8 * limits_.chord / curvature);  // sagitta of a flat arc
    return std::max(length, limits_.min_length);
  }

  /// Largest curvature that the probes inside the loops show: the larger of curvature at a point and angle per distance
  /// between neighbours.
  double patch_curvature(const CurvaturePatch& patch, bool& is_doubtful) const {
    const PairTurning pairs(patch, kAngleNoise * limits_.alpha);
    double curvature = 0;
    for (const double rate : pairs.rate) curvature = std::max(curvature, rate);
    for (std::size_t k = 0; k < 9; ++k) {
      if (!patch.is_inside[k]) continue;
      double own = patch.probe[k].curvature;
      if (is_free_ && own * limits_.max_length > limits_.alpha) {
        double confirmed = kConfirmed * PairTurning::largest_at(k, pairs.rate);
        if (own > confirmed && is_part_ && are_inside_in_one_line(patch))
          confirmed = kConfirmed * turning_around(patch, k);
        if (own > confirmed && PairTurning::largest_at(k, pairs.angle) < 0.5 * limits_.alpha) {
          is_doubtful = true;
          own = confirmed;
        }
      }
      curvature = std::max(curvature, own);
    }
    return curvature;
  }

  /// Whether the loops leave one row or column of probes: along a nose at the rim nothing turns.
  static bool are_inside_in_one_line(const CurvaturePatch& patch) {
    std::array<bool, 3> row{}, column{};
    for (std::size_t k = 0; k < 9; ++k)
      if (patch.is_inside[k]) row[k / 3] = column[k % 3] = true;
    return std::ranges::count(row, true) == 1 || std::ranges::count(column, true) == 1;
  }

  /// Largest angle per distance from a probe to its neighbours, outside of the loops, too.
  double turning_around(CurvaturePatch patch, std::size_t probe) const {
    patch.n_inside = 9;
    return PairTurning::largest_at(probe, PairTurning(patch, kAngleNoise * limits_.alpha).rate);
  }

  /// Largest curvature at the middles of the loop sides, for a patch without a probe inside the loops.
  double boundary_curvature(const CurvaturePatch& patch) {
    constexpr std::size_t kMaxProbes = 4;
    double curvature = 0;
    const std::size_t step = (patch.sides.size() + kMaxProbes - 1) / kMaxProbes;
    for (std::size_t i = 0; i < patch.sides.size(); i += step) {
      const LoopSide& s = loops_.sides()[patch.sides[i]];
      const Vec2 middle = 0.5 * (s.a + s.b);
      const Vec2 uv{std::clamp(middle.x, patch.u[0], patch.u[2]), std::clamp(middle.y, patch.v[0], patch.v[2])};
      curvature = std::max(curvature, probe(uv).curvature);
    }
    return curvature;
  }

  void add_box(const CurvaturePatch& patch, const PatchSize& size, double length) {
    const PatchPart part = part_inside(patch, loops_);
    Vec3 way;
    boxes_.push_back({patch.sides.empty() ? size.center : part.center,
                      static_cast<float>(0.5 * limits_.cell_per_length * length), static_cast<float>(length), cause_,
                      SmallNormal(patch.probe[4].normal),
                      stretch_of(patch, patch.is_inside[4] ? patch.uv(4) : part.uv, length, way),
                      reach_of(part.along_u, part.along_v)});
    if (patches_ && patch.probe[4].normal != Vec3{}) patches_->push_back(gap_patch(patch, length, way));
    report_.area += inside_area(patch);
    if (on_area_ && (report_.n_patches + 1) % kBoxesPerNews == 0)
      on_area_(report_.area - std::exchange(told_area_, report_.area));
    require_samples(static_cast<std::uint64_t>(++report_.n_patches), limits_.max_samples);
  }

  /// At a place (u,v) of the patch, along the direction of the smaller curvature, where that allows a longer edge: it
  /// turns by no more than alpha, and its chord is no further from the surface than that of one length across.
  /// Sets the direction, whether it allows more or not.
  SampleStretch stretch_of(const CurvaturePatch& patch, Vec2 uv, double length, Vec3& direction) {
    if (!(limits_.max_aspect > 1)) return {};
    ++report_.n_evaluations;
    const SurfacePoint2 p = surface_.evaluate2(uv);
    const Curvature own = principal_curvature(p);
    const ChordLimit::Answer chord = chord_ ? chord_->answer(p.x) : ChordLimit::Answer{};
    direction = flattest_direction(p, own);
    const bool is_clear = std::abs(own.k2) < kClearlyFlatter * std::abs(own.k1) &&
                          std::abs(own.k1) * length > kClearlyCurved * limits_.alpha;
    if (!is_clear && chord.length <= length)  // the chord decides
      direction = normalized(cross(normalized(cross(p.du, p.dv)), chord.direction));
    if (direction == Vec3{}) return {};
    const double curvature = std::max(curvature_along(patch, direction, own), turning_to_ends(patch, uv, p, direction));
    double along = std::min(max_along(), limits_.max_aspect * length);
    if (along * curvature > limits_.alpha) along = limits_.alpha / curvature;
    if (along * along * curvature > limits_.alpha * length) along = std::sqrt(limits_.alpha * length / curvature);
    if (!(along > kLeastStretch * length)) return {};
    return {SmallNormal(direction), static_cast<float>(along)};
  }

  /// Largest turning per distance of the normal along the direction: at the middle, and between the probes.
  static double curvature_along(const CurvaturePatch& patch, Vec3 direction, const Curvature& own) {
    double curvature = std::abs(own.k2);
    for (std::size_t i = 0; i < ProbePairs::n; ++i) {
      const std::size_t a = kPairs.first[i], b = kPairs.second[i];
      const CurvatureProbe &pa = patch.probe[a], &pb = patch.probe[b];
      if (!patch.is_inside[a] || !patch.is_inside[b] || pa.normal == Vec3{} || pb.normal == Vec3{}) continue;
      const Vec3 d = pb.x - pa.x;
      const double along = std::abs(dot(d, direction));
      if (along > kAligned * norm(d))
        curvature = std::max(curvature, std::abs(dot(pb.normal - pa.normal, direction)) / along);
    }
    return curvature;
  }

  /// As far as the patch is large to both sides of the place, no further than the surface: largest turning per distance
  /// of the normal along the direction.
  double turning_to_ends(const CurvaturePatch& patch, Vec2 uv, const SurfacePoint2& p, Vec3 direction) {
    const auto way = tangent_step(p.du, p.dv, direction);
    if (!way) return 0;
    Box3 box;
    for (const CurvatureProbe& probe : patch.probe) box.add(probe.x);
    const double half = 0.5 * box.diagonal();
    const Vec3 normal = normalized(cross(p.du, p.dv));
    double turning = 0;
    for (const double step : {-half, half}) {
      const Vec2 end = uv + step * *way;
      const Vec2 at{std::clamp(end.x, surface_.u_min(), surface_.u_max()),
                    std::clamp(end.y, surface_.v_min(), surface_.v_max())};
      const SurfacePoint there = surface_.evaluate(at);
      const double distance = std::abs(dot(there.x - p.x, direction));
      if (distance > kLeastOfHalf * half)
        turning =
            std::max(turning, std::abs(dot(normalized(cross(there.du, there.dv)) - normal, direction)) / distance);
    }
    report_.n_evaluations += 2;
    return turning;
  }

  double max_along() const { return limits_.max_along.value_or(limits_.max_length); }

  GapPatch gap_patch(const CurvaturePatch& patch, double length, Vec3 way) const {
    std::array<Vec3, 9> points;
    for (std::size_t k = 0; k < 9; ++k) points[k] = patch.probe[k].x;
    GapPatch result;
    result.shape = fit_patch(points, patch.probe[4].normal);
    result.shape.inside = cells_inside(patch, loops_);
    result.length = length;
    if (limits_.gap_floor > 0) result.slot_floor = std::min(limits_.gap_floor, limits_.min_length);
    result.min_length = limits_.gap_floor > 0 ? result.slot_floor : limits_.min_length;
    result.gap_cells = limits_.gap_cells;
    result.wall_cells = limits_.wall_cells;
    result.stretch = {limits_.max_aspect, max_along(), limits_.alpha};
    result.way = way;
    result.cause = cause_;
    return result;
  }

  const Surface& surface_;
  const LoopPolygons& loops_;
  const SamplingLimits& limits_;
  const std::int32_t cause_;
  std::vector<RasterBox>& boxes_;
  std::vector<GapPatch>* const patches_;
  const ChordLimit* const chord_;
  const std::function<void(double)>& on_area_;
  double told_area_ = 0;
  FaceRasterReport report_;
  double range_u_ = 1, range_v_ = 1;
  bool is_part_ = false;  // of a larger surface: patches do not begin at its rim
  bool is_free_ = true;   // curvature varies freely: not a plane, cylinder, cone, sphere or torus
};

}  // namespace

std::unique_ptr<Surface> whole_spline(const Surface& part) {
  const auto* spline = dynamic_cast<const BsplineSurface*>(&part);
  return spline ? spline->whole() : nullptr;
}

FaceRasterReport raster_face(const Surface& surface, const LoopPolygons& loops, const SamplingLimits& limits,
                             std::int32_t cause, std::vector<RasterBox>& boxes, std::vector<GapPatch>* patches,
                             const ChordLimit* chord, const std::function<void(double area)>& on_area) {
  ST_ASSERT(0 < limits.min_length && limits.min_length <= limits.max_length);
  ST_ASSERT(0 < limits.alpha && limits.alpha <= kPi / 2 && limits.cell_per_length >= 1);
  const auto* composite = dynamic_cast<const CompositeSurface*>(&surface);
  if (!composite) return FaceRaster(surface, loops, limits, cause, boxes, patches, chord, on_area).run();
  FaceRasterReport report;
  for (std::int32_t i = 0; i < composite->n_members(); ++i) {
    const std::size_t n_boxes = boxes.size(), n_patches = patches ? patches->size() : 0;
    const LoopPolygons rim(composite->rim_of_member(i));
    const std::unique_ptr<Surface> whole = whole_spline(composite->member(i));
    const FaceRasterReport own =
        FaceRaster(whole ? *whole : composite->member(i), rim, limits, cause, boxes, patches, chord, on_area).run();
    report.area += own.area;
    report.n_patches += own.n_patches;
    report.n_evaluations += own.n_evaluations;
    if (!composite->is_member_turned(i)) continue;
    for (RasterBox& box : std::span(boxes).subspan(n_boxes)) box.normal = box.normal.reversed();
    if (patches)
      for (GapPatch& patch : std::span(*patches).subspan(n_patches)) patch.shape.flip();
  }
  return report;
}

}  // namespace st
