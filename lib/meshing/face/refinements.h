// Places where the size field became finer than requested, and the field with them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/boxes.h"
#include "base/vec.h"
#include "meshing/face/face_mesher.h"
#include "sizing/length_tree.h"
#include "sizing/size_field.h"

namespace st {

/// Slope with which the length grows away from a refinement,
inline constexpr double kRefinementSlope = 0.3;
/// lengths along away from one that shortens these alone,
inline constexpr double kAlongSlope = 0.6;
/// and from one that does so for a single triangle.
inline constexpr double kNearbySlope = 2;

/// From `p` to the box; 0 inside.
inline double box_distance(const Box3& box, Vec3 p) { return std::sqrt(distance2(p, box)); }

/// What a refinement makes shorter.
enum class Shortens : std::int64_t {
  kAll,          ///< all lengths
  kAlong,        ///< lengths along, no shorter than those across
  kAlongNearby,  ///< likewise, hardly beyond the radius
};

/// A refinement that was taken. Without padding: its bytes tell what a mesh was made from.
struct Refinement {
  Vec3 x;
  double length = 0;  ///< requested there, model unit
  double reach = 0;   ///< distance at which the request at `x` is met again, model unit
  double radius = 0;  ///< around `x`: requested there, too
  Shortens shortens = Shortens::kAll;

  bool operator==(const Refinement&) const = default;
};
static_assert(sizeof(Refinement) == 7 * sizeof(double));

inline bool contains(const std::vector<Refinement>& all, const Refinement& r) {
  return std::ranges::find(all, r) != all.end();
}

inline double slope_of(Shortens shortens) {
  return shortens == Shortens::kAll ? kRefinementSlope : shortens == Shortens::kAlong ? kAlongSlope : kNearbySlope;
}

/// All refinements of one run. The field outlives the object.
class Refinements {
 public:
  explicit Refinements(const SizeField& field) : field_(field) {}

  /// Takes the place, all lengths no finer than `floor` times the request there. False when it is about as fine
  /// already. Where lengths along become 0 they are those across, all over the radius. Local, linear in the places.
  bool add(const RefinementPoint& place, double floor, Shortens shortens = Shortens::kAll);
  /// Those that reach into the box, in the order in which they were taken.
  std::vector<Refinement> near(const Box3& box) const;

  const std::vector<Refinement>& all() const { return all_; }
  /// Takes over what another rank took.
  void assign(std::vector<Refinement> all) { all_ = std::move(all); }

 private:
  const SizeField& field_;
  std::vector<Refinement> all_;
};

/// The least of length_i + slope * distance beyond the radius of place i. Immutable. A query visits about as many
/// places as can matter.
class RefinementTree {
 public:
  /// Of the places that shorten this.
  RefinementTree(const std::vector<Refinement>& places, Shortens shortens);
  /// No more than `length`.
  double least(Vec3 xyz, double length) const;
  double shortest() const { return shortest_; }

 private:
  double slope_;
  std::vector<Refinement> places_;
  LengthTree tree_;                                            // of these, by the tips of their cones
  double shortest_ = std::numeric_limits<double>::infinity();  // of the places
};

/// The base with what refinements make shorter; the base outlives it. Immutable.
class RefinedField : public SizeField {
 public:
  RefinedField(const SizeField& base, const std::vector<Refinement>& places);
  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override;
  LocalSize local(Vec3 xyz, int& hint) const override { return local_on(xyz, {}, hint); }
  LocalSize local_on(Vec3 xyz, Vec3 normal, int& hint) const override;
  bool has_metrics() const override { return base_.has_metrics(); }
  bool is_stretched() const override { return base_.is_stretched(); }
  double min_size() const override;
  double slope() const override;

 private:
  const SizeField& base_;
  RefinementTree all_, along_, nearby_;  // by what they shorten
};

}  // namespace st
