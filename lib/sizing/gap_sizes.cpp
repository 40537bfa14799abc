#include "sizing/gap_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sizing/crossing_parts.h"
#include "sizing/gap_stretch.h"
#include "sizing/size_limits.h"

namespace st {
namespace {

constexpr double kTouching = 1e-3;     // of the smallest length: nearer surfaces touch
constexpr double kSagging = 2;         // times that of both patches: nearer patches of two solids touch
constexpr double kBeyond = 0.13;       // of the patch's width beyond a crossing: clear of cells that a border cuts
constexpr double kSidestep = 0.2;      // of the patch's width, along a crossing: more than such a cell
constexpr double kLeastClosing = 0.5;  // of the slope that closes a gap at an edge: a cusp has twice
constexpr double kMostClosing = 4;     // likewise
constexpr double kLarge = 2.5;         // times this patch: its corners may miss this one
constexpr int kMaxDepth = 8;           // of tiles in tiles
constexpr int kMaxParts = 4;           // into which a tile is cut each way at once
constexpr int kFirstParts = 2;

/// Lengths across what lies ahead (gap) or behind (wall) of a patch; 0: it does not matter.
int cells_to(const GapPatch& patch, double along_normal) {
  return (along_normal > 0 ? patch.gap_cells : patch.wall_cells).value_or(0);
}

/// As far as a patch has to look, in its lengths.
int most_cells(const GapPatch& patch) { return std::max(patch.gap_cells.value_or(0), patch.wall_cells.value_or(0)); }

/// Smallest length of a patch that sees another one: both sides of a slot are to have the same lengths.
double floor_before(const GapPatch& patch, const GapPatch& other) {
  const bool is_own = patch.keeps_floor || other.slot_floor == 0;
  return is_own ? patch.min_length : std::min(patch.min_length, other.slot_floor);
}

/// A patch that may face another one, and a sphere around it.
struct Facing {
  Vec3 center;
  double radius;
  const GapPatch* patch;
};

/// Cuts a patch into tiles that are small enough for the gap they see.
class GapTiler {
 public:
  GapTiler(const GapPatch& patch, const std::vector<Facing>& facing, const GapFinder::MeetingPlace& meeting_place,
           const CrossingParts& parts, double cell_per_length, std::vector<RasterBox>& boxes)
      : patch_(patch),
        shape_(patch.shape),
        facing_(facing),
        meeting_place_(meeting_place),
        parts_(parts),
        cell_per_length_(cell_per_length),
        boxes_(boxes) {
    has_large_ = std::any_of(facing.begin(), facing.end(), [&](const Facing& f) { return is_large(*f.patch); });
  }

  void run() {
    const Tile whole{shape_.s_lo, shape_.s_hi, shape_.t_lo, shape_.t_hi};
    cut(whole, kFirstParts, kFirstParts, 0);
  }

 private:
  struct Tile {
    double s_lo, s_hi, t_lo, t_hi;
  };

  /// The patch that a point sees and that asks for the smallest length.
  struct Sight {
    double length;                    // of the patch where it sees nothing, model unit
    double distance = 0;              // to the other patch along the normal, either sign, model unit
    const GapPatch* other = nullptr;  // none: nothing asks for less
    Vec3 x;                           // where the other patch is met
    Vec3 from, normal;                // the point, and the patch's normal there
  };

  Sight look(double s, double t) const {
    const Vec3 x = shape_.point(s, t), n = shape_.normal_at(s, t);
    Sight sight{patch_.length, 0, nullptr, {}, x, n};
    for (const Facing& f : facing_) {
      const Vec3 to = f.center - x;
      const double along = dot(to, n);
      if (std::abs(along) - f.radius > most_cells(patch_) * sight.length ||
          norm2(to) - along * along > f.radius * f.radius)
        continue;
      const std::optional<double> d = f.patch->shape.facing_distance(x, n);
      if (d && !is_contact(*f.patch, *d) && std::abs(*d) < cells_to(patch_, *d) * sight.length &&
          !(*d > 0 && (is_past_crossing(*f.patch, s, t, *d) || closes_at_edge(*f.patch, x, n, *d) ||
                       parts_.cross_where_closed(patch_, *f.patch, x, *d))))
        sight = {std::abs(*d) / cells_to(patch_, *d), *d, f.patch, x + *d * n, x, n};
    }
    return sight;
  }

  /// Nothing lies between the patches. Material ends with its solid: behind it no other one makes a wall. A shaft in
  /// its bore lies on it as far as paraboloids can tell.
  bool is_contact(const GapPatch& other, double d) const {
    if (std::abs(d) <= kTouching * patch_.min_length) return true;
    if (patch_.solid < 0 || other.solid < 0 || other.solid == patch_.solid) return false;
    return d < kSagging * (shape_.sagging() + other.shape.sagging());
  }

  /// Beyond a sharp edge the patches of its sides cross, and seem to face each other: where the gap closes, this patch
  /// goes on with the other face behind it. In a gap that ends in an edge there is none of this patch beyond.
  bool is_past_crossing(const GapPatch& other, double s, double t, double d) const {
    const Vec3 n = shape_.normal_at(s, t), opposite = other.shape.normal_beside(shape_.point(s, t) + d * n);
    const double along_s = -dot(opposite, shape_.axis_s), along_t = -dot(opposite, shape_.axis_t);
    const double slope = std::hypot(along_s, along_t);
    if (!(slope > 0)) return false;
    const double width =
        (std::abs(along_s) * (shape_.s_hi - shape_.s_lo) + std::abs(along_t) * (shape_.t_hi - shape_.t_lo)) / slope;
    const double step = (d * std::abs(dot(opposite, n)) / slope + kBeyond * width) / slope;
    // Near the end of a side its cells may miss the place: those beside it tell as well.
    const std::array asides = {0.0, kSidestep * width / slope, -kSidestep * width / slope};
    return std::any_of(asides.begin(), asides.end(), [&](double aside) {
      double s1 = s + step * along_s - aside * along_t;
      double t1 = t + step * along_t + aside * along_s;
      slide_inside(along_s, along_t, s1, t1);
      return lies_before(other, s1, t1);
    });
  }

  /// Between a fairing and its wing no lengths fit across where they meet: down to the floor, rows of these would
  /// follow the edge. In a slot that ends in an edge both sides run beside each other.
  bool closes_at_edge(const GapPatch& other, Vec3 x, Vec3 n, double d) const {
    const std::optional<Vec3> edge = meeting_place_(patch_.cause, other.cause, x);
    if (!edge) return false;
    const Vec3 opposite = other.shape.normal_beside(x + d * n);
    const Vec3 closing = (dot(opposite, n) * n - opposite) / std::abs(dot(opposite, n));  // the slope, as a vector
    const double at_edge = norm(closing) * distance(*edge, x);  // by how much the gap has closed up there, about
    return dot(*edge - x, closing) > 0 && at_edge > kLeastClosing * d && at_edge < kMostClosing * d;
  }

  /// Is the place inside the loops, with the other patch's face behind it?
  bool lies_before(const GapPatch& other, double s, double t) const {
    if (!(s >= shape_.s_lo && s <= shape_.s_hi && t >= shape_.t_lo && t <= shape_.t_hi)) return false;
    if (!shape_.is_inside(s, s, t, t)) return false;
    const Vec3 x = shape_.point(s, t), n = shape_.normal_at(s, t);
    return std::any_of(facing_.begin(), facing_.end(), [&](const Facing& f) {
      return f.patch->cause == other.cause && f.patch->shape.facing_distance(x, n).value_or(0) < 0;
    });
  }

  /// Shifts (s, t) across the direction (along_s, along_t), so along the crossing, as far as the patch's side that is
  /// nearly parallel to the direction makes it.
  void slide_inside(double along_s, double along_t, double& s, double& t) const {
    if (std::abs(along_s) >= std::abs(along_t)) {
      const double inside = std::clamp(t, shape_.t_lo, shape_.t_hi);
      s -= (inside - t) * along_t / along_s, t = inside;
    } else {
      const double inside = std::clamp(s, shape_.s_lo, shape_.s_hi);
      t -= (inside - s) * along_s / along_t, s = inside;
    }
  }

  /// Likewise, and no less than the floor.
  Sight look_above_floor(double s, double t) const {
    Sight sight = look(s, t);
    sight.length = std::max(sight.length, sight.other ? floor_before(patch_, *sight.other) : patch_.min_length);
    return sight;
  }

  /// Cuts the tile into n_s x n_t, and each part again while it is larger than its raster box.
  void cut(const Tile& tile, int n_s, int n_t, int depth) {
    const double ds = (tile.s_hi - tile.s_lo) / n_s, dt = (tile.t_hi - tile.t_lo) / n_t;
    std::array<Sight, (kMaxParts + 1) * (kMaxParts + 1)> sight;
    for (int j = 0; j <= n_t; ++j)
      for (int i = 0; i <= n_s; ++i)
        sight[j * (n_s + 1) + i] = look_above_floor(tile.s_lo + i * ds, tile.t_lo + j * dt);
    for (int j = 0; j < n_t; ++j)
      for (int i = 0; i < n_s; ++i) {
        const int k = j * (n_s + 1) + i;
        const auto is_less = [](const Sight& a, const Sight& b) { return a.length < b.length; };
        const Sight& closest = std::min({sight[k], sight[k + 1], sight[k + n_s + 1], sight[k + n_s + 2]}, is_less);
        visit({tile.s_lo + i * ds, tile.s_lo + (i + 1) * ds, tile.t_lo + j * dt, tile.t_lo + (j + 1) * dt}, closest,
              depth);
      }
  }

  /// `closest`: of the tile's corners.
  void visit(const Tile& tile, const Sight& closest, int depth) {
    const double length = closest.length;
    if (!(length < patch_.length) || !shape_.is_inside(tile.s_lo, tile.s_hi, tile.t_lo, tile.t_hi)) return;
    const double room = kPatchFill * cell_per_length_ * length;
    const auto parts = [&](double width) {
      return std::clamp(static_cast<int>(std::ceil(width / room)), 1, kMaxParts);
    };
    const int n_s = parts(tile.s_hi - tile.s_lo), n_t = parts(tile.t_hi - tile.t_lo);
    if (n_s * n_t > 1 && depth < kMaxDepth) return cut(tile, n_s, n_t, depth + 1);
    const double s = 0.5 * (tile.s_lo + tile.s_hi), t = 0.5 * (tile.t_lo + tile.t_hi);
    add_box(shape_.point(s, t), length, patch_.cause, stretch_of(closest),
            reach_of(0.5 * (shape_.point(tile.s_hi, t) - shape_.point(tile.s_lo, t)),
                     0.5 * (shape_.point(s, tile.t_hi) - shape_.point(s, tile.t_lo))));
    if (has_large_) add_far_box(s, t);
  }

  SampleStretch stretch_of(const Sight& sight) const {
    if (!sight.other) return {};
    return gap_stretch(patch_, {sight.from, sight.normal, sight.other, sight.x, sight.length});
  }

  void add_box(Vec3 x, double length, std::int32_t cause, const SampleStretch& stretch, const SampleReach& reach = {}) {
    boxes_.push_back({x,
                      static_cast<float>(0.5 * cell_per_length_ * length),
                      static_cast<float>(length),
                      cause,
                      {},
                      stretch,
                      reach});
  }

  /// Speaks for a patch on the other side that is so large that it may not see this one.
  void add_far_box(double s, double t) {
    Sight sight = look(s, t);
    if (!sight.other || !cells_to(*sight.other, sight.distance) || !is_large(*sight.other)) return;
    sight.length =
        std::max(std::abs(sight.distance) / cells_to(*sight.other, sight.distance), floor_before(*sight.other, patch_));
    if (sight.length < sight.other->length) add_box(sight.x, sight.length, sight.other->cause, stretch_of(sight));
  }

  bool is_large(const GapPatch& other) const { return extent(other) > kLarge * extent(patch_); }
  static double extent(const GapPatch& p) { return std::max(p.shape.s_hi - p.shape.s_lo, p.shape.t_hi - p.shape.t_lo); }

  const GapPatch& patch_;
  const Paraboloid& shape_;
  const std::vector<Facing>& facing_;
  const GapFinder::MeetingPlace& meeting_place_;
  const CrossingParts& parts_;
  const double cell_per_length_;
  std::vector<RasterBox>& boxes_;
  bool has_large_;
};

}  // namespace

GapFinder::GapFinder(std::span<const GapPatch> patches, double cell_per_length, MeetingPlace meeting_place)
    : patches_(patches),
      cell_per_length_(cell_per_length),
      meeting_place_(std::move(meeting_place)),
      tree_(patches),
      parts_(patches) {}

void GapFinder::add_boxes(std::size_t i, std::vector<RasterBox>& boxes) const {
  const GapPatch& patch = patches_[i];
  if (most_cells(patch) == 0) return;
  std::vector<std::int32_t> ids;
  tree_.find_facing(i, most_cells(patch) * patch.length, ids);
  if (ids.empty()) return;
  std::vector<Facing> facing;
  for (const std::int32_t id : ids) {
    const Box3 box = patches_[id].shape.box();
    facing.push_back({box.center(), 0.5 * box.diagonal(), &patches_[id]});
  }
  GapTiler(patch, facing, meeting_place_, parts_, cell_per_length_, boxes).run();
}

}  // namespace st
