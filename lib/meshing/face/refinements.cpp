#include "meshing/face/refinements.h"

#include <algorithm>
#include <iterator>

namespace st {
namespace {

constexpr double kWorthwhile = 0.95;  // of the present length: a refinement that asks for more than this is no change
constexpr double kRoundOff = 1 - 1e-12;  // of the bound by which places are passed over: no rounding may hide one that
                                         // counts

/// Of the cone whose top is cut off at the radius.
double at_centre(const Refinement& r) { return r.length - slope_of(r.shortens) * r.radius; }

double length_at(const Refinement& r, Vec3 x) {
  return std::max(r.length, at_centre(r) + slope_of(r.shortens) * distance(x, r.x));
}

}  // namespace

bool Refinements::add(const RefinementPoint& place, double floor, Shortens shortens) {
  int hint = 0;
  const LocalSize local = field_.local(place.x, hint);
  const double request = local.along;
  double present = request, along = request;
  for (const Refinement& r : all_) {
    double& least = r.shortens == Shortens::kAll ? present : along;
    least = std::min(least, length_at(r, place.x));
  }
  present = std::min(present, std::max(along, local.length));
  const double length = shortens == Shortens::kAll ? std::max(place.length, floor * local.length) : place.length;
  const double least = shortens == Shortens::kAll ? length : std::max(length, local.length);
  if (least > kWorthwhile * present) return false;
  all_.push_back(
      {place.x, length, place.radius + std::max(0.0, (request - length) / slope_of(shortens)), place.radius, shortens});
  return true;
}

std::vector<Refinement> Refinements::near(const Box3& box) const {
  std::vector<Refinement> result;
  for (const Refinement& r : all_)
    if (box_distance(box, r.x) <= r.reach) result.push_back(r);
  return result;
}

RefinementTree::RefinementTree(const std::vector<Refinement>& places, Shortens shortens) : slope_(slope_of(shortens)) {
  std::ranges::copy_if(places, std::back_inserter(places_), [&](const auto& r) { return r.shortens == shortens; });
  std::vector<Box3> boxes(places_.size());
  std::vector<double> tips;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    boxes[i].add(places_[i].x);
    tips.push_back(at_centre(places_[i]));
    shortest_ = std::min(shortest_, places_[i].length);
  }
  tree_ = LengthTree(boxes, tips);
}

double RefinementTree::least(Vec3 xyz, double length) const {
  double bound = length / kRoundOff;
  tree_.visit_from(xyz, slope_, bound, [&](std::int32_t i) {
    length = std::min(length, length_at(places_[i], xyz));
    bound = length / kRoundOff;
  });
  return length;
}

RefinedField::RefinedField(const SizeField& base, const std::vector<Refinement>& places)
    : base_(base),
      all_(places, Shortens::kAll),
      along_(places, Shortens::kAlong),
      nearby_(places, Shortens::kAlongNearby) {}

double RefinedField::size(Vec3 xyz, int& hint) const { return all_.least(xyz, base_.size(xyz, hint)); }

LocalSize RefinedField::local_on(Vec3 xyz, Vec3 normal, int& hint) const {
  LocalSize local = base_.local_on(xyz, normal, hint);
  if (local.along > local.length)
    local.along = std::max(local.length, nearby_.least(xyz, along_.least(xyz, local.along)));
  local.along = all_.least(xyz, local.along);
  if (local.along > local.length) return local;
  return {local.along, local.along, {}};
}

double RefinedField::min_size() const { return std::min(base_.min_size(), all_.shortest()); }

double RefinedField::slope() const { return std::max(base_.slope(), kRefinementSlope); }

}  // namespace st
