#include "meshing/face/refinements.h"

#include <algorithm>
#include <iterator>

#include "base/axis.h"

namespace st {
namespace {

constexpr double kWorthwhile = 0.95;  // of the present length: a refinement that asks for more than this is no change
constexpr std::int32_t kPlacesPerLeaf = 8;
constexpr double kRoundOff = 1 - 1e-12;  // of the bound by which places are passed over: no rounding may hide one that
                                         // counts

/// Of the cone whose top is cut off at the radius.
double at_centre(const Refinement& r) { return r.length - slope_of(r.shortens) * r.radius; }

double length_at(const Refinement& r, Vec3 x) {
  return std::max(r.length, at_centre(r) + slope_of(r.shortens) * distance(x, r.x));
}

}  // namespace

double box_distance(const Box3& box, Vec3 p) {
  const auto outside = [](double lo, double hi, double x) { return x < lo ? lo - x : x > hi ? x - hi : 0.0; };
  return norm(
      Vec3{outside(box.lo.x, box.hi.x, p.x), outside(box.lo.y, box.hi.y, p.y), outside(box.lo.z, box.hi.z, p.z)});
}

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
  for (const Refinement& r : places_) shortest_ = std::min(shortest_, r.length);
  if (!places_.empty()) build(0, static_cast<std::int32_t>(places_.size()));
}

/// Appends the node of these places and all below it; returns its number.
std::int32_t RefinementTree::build(std::int32_t first, std::int32_t last) {
  const auto own = static_cast<std::int32_t>(nodes_.size());
  Node node{{}, at_centre(places_[first]), first, last, 0};
  for (std::int32_t i = first; i < last; ++i) {
    node.box.add(places_[i].x);
    node.shortest = std::min(node.shortest, at_centre(places_[i]));
  }
  nodes_.push_back(node);
  if (last - first <= kPlacesPerLeaf) return own;
  const int axis = longest_axis(node.box);
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(
      places_.begin() + first, places_.begin() + middle, places_.begin() + last,
      [&](const Refinement& a, const Refinement& b) { return component(a.x, axis) < component(b.x, axis); });
  build(first, middle);
  const std::int32_t right = build(middle, last);
  nodes_[own].right = right;
  return own;
}

void RefinementTree::visit(std::int32_t index, Vec3 xyz, double& length) const {
  const Node& node = nodes_[index];
  if (kRoundOff * (node.shortest + slope_ * box_distance(node.box, xyz)) > length) return;
  if (node.right) {
    visit(index + 1, xyz, length);
    visit(node.right, xyz, length);
    return;
  }
  for (std::int32_t i = node.first; i < node.last; ++i) length = std::min(length, length_at(places_[i], xyz));
}

double RefinementTree::least(Vec3 xyz, double length) const {
  if (!nodes_.empty()) visit(0, xyz, length);
  return length;
}

RefinedField::RefinedField(const SizeField& base, const std::vector<Refinement>& places)
    : base_(base), all_(places, Shortens::kAll), along_(places, Shortens::kAlong) {}

double RefinedField::size(Vec3 xyz, int& hint) const { return all_.least(xyz, base_.size(xyz, hint)); }

LocalSize RefinedField::local_on(Vec3 xyz, Vec3 normal, int& hint) const {
  LocalSize local = base_.local_on(xyz, normal, hint);
  if (local.along > local.length) local.along = std::max(local.length, along_.least(xyz, local.along));
  local.along = all_.least(xyz, local.along);
  if (local.along > local.length) return local;
  return {local.along, local.along, {}};
}

double RefinedField::min_size() const { return std::min(base_.min_size(), all_.shortest()); }

double RefinedField::slope() const { return std::max(base_.slope(), kRefinementSlope); }

}  // namespace st
