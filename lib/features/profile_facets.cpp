#include "features/profile_facets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/boxes.h"
#include "base/share.h"
#include "features/edge_places.h"

namespace st {

MirrorPlane::MirrorPlane(const Model& model, FaceId face) {
  const auto surface = model.surface(face);
  const SurfacePoint at =
      surface->evaluate({0.5 * (surface->u_min() + surface->u_max()), 0.5 * (surface->v_min() + surface->v_max())});
  x = at.x;
  normal = normalized(cross(at.du, at.dv));
}

ProfileFacets::ProfileFacets(const Model& model, const FaceRoles& roles, const ProfileLimits& limits)
    : model_(model), roles_(roles), limits_(limits) {
  is_known_.resize(static_cast<std::size_t>(model.tables().n_faces()), 0);
  model.tables().edge_faces(offsets_, edge_faces_);
}

void ProfileFacets::add_along(std::span<const WingEdge> edges, const Executor& executor) {
  std::vector<std::uint8_t> next(is_known_.size(), 0);
  for (const WingEdge& w : edges) take_walls_at(w.edge, nullptr, next);
  const std::vector<Cut> cuts = executor.is_root() ? cuts_at(edges) : std::vector<Cut>();
  std::size_t n_done = 0;
  for (bool is_first = true; add(std::move(next), executor) || is_first; is_first = false) {  // all may be known
    std::vector<CutEnd> ends;
    const ProfileCutter cutter(facets_, &ends);
    next.assign(is_known_.size(), 0);
    for (; n_done < cuts.size() && std::ranges::count(next, 1) == 0; ++n_done) {
      ends.clear();
      cutter.note_ends(cuts[n_done].x, cuts[n_done].normal, limits_.reach);
      next = walls_beyond(ends);
    }
    if (std::ranges::count(next, 1) > 0) --n_done;  // again, through more facets
  }
}

bool ProfileFacets::add_beyond(std::span<const CutEnd> ends, const Executor& executor) {
  return add(walls_beyond(ends), executor);
}

void ProfileFacets::add_cut(EdgeId e, Vec3 x, Vec3 normal, const Executor& executor) {
  std::vector<std::uint8_t> next(is_known_.size(), 0);
  take_walls_at(e, nullptr, next);
  add(std::move(next), executor);
  std::vector<CutEnd> ends;
  do {
    ends.clear();
    ProfileCutter(facets_, &ends).note_ends(x, normal, limits_.reach);
  } while (add_beyond(ends, executor));
}

/// What a cut meets in the image of the model, its own image meets in the model.
std::vector<ProfileFacets::Cut> ProfileFacets::cuts_at(std::span<const WingEdge> edges) {
  std::vector<FaceId> mirrors;
  for (const WingEdge& w : edges)
    if (w.mirror != kNone && std::ranges::count(mirrors, w.mirror) == 0) mirrors.push_back(w.mirror);
  for (const FaceId f : mirrors) mirrors_.emplace_back(model_, f);
  std::vector<Cut> cuts;
  for (const EdgePlace& place : places_along(model_, edges)) {
    const auto add = [&](Vec3 normal) {
      cuts.push_back({place.x, normal});
      for (const MirrorPlane& plane : mirrors_)
        if (edges[place.edge].mirror != kNone) cuts.push_back({place.x, plane.image_of_direction(normal)});
    };
    add(place.tangent);
    for (const Vec3& axis : roles_.own.axis)
      if (std::abs(dot(place.tangent, axis)) >= kAlongAxis) add(axis);
  }
  return cuts;
}

std::vector<std::uint8_t> ProfileFacets::walls_beyond(std::span<const CutEnd> ends) {
  std::vector<std::uint8_t> taken(is_known_.size(), 0);
  for (const CutEnd& end : ends)
    for (const EdgeId e : model_.tables().edges_of(end.face)) take_walls_at(e, &end.x, taken);
  return taken;
}

bool ProfileFacets::is_at(FaceId f, Vec3 x) const {
  const auto is_near = [&](Vec3 y) {
    return distance2(y, model_.tables().face_box[f]) <= limits_.reach * limits_.reach;
  };
  return is_near(x) ||
         std::ranges::any_of(mirrors_, [&](const MirrorPlane& plane) { return is_near(plane.image_of(x)); });
}

/// Those that are not known; `x`: that come near it (null: any).
void ProfileFacets::take_walls_at(EdgeId e, const Vec3* x, std::vector<std::uint8_t>& taken) {
  for (std::int32_t k = offsets_[e]; k < offsets_[e + 1]; ++k) {
    const FaceId f = edge_faces_[k];
    if (is_known_[f] || roles_.role[f] != FaceRole::kWall || (x && !is_at(f, *x))) continue;
    is_known_[f] = taken[f] = 1;
  }
}

bool ProfileFacets::add(std::vector<std::uint8_t> wanted, const Executor& executor) {
  share(executor, wanted);
  if (std::ranges::count(wanted, 1) == 0) return false;
  add_facets(model_, wanted, limits_.facets, executor, facets_);
  return true;
}

void ProfileFacets::clear() {
  std::ranges::fill(is_known_, std::uint8_t{0});
  mirrors_.clear();
  facets_ = {};
}

bool FacetStore::knows(FaceId f) const {
  return std::ranges::any_of(all_, [f](const auto& step) { return step.second.knows(f); });
}

void FacetStore::clear() {
  for (auto& [step, facets] : all_) facets.clear();
}

ProfileFacets& FacetStore::near(double deflection, bool is_exact) {
  constexpr std::size_t kMostKept = 50'000;  // triangles: each cut searches them
  const int step = static_cast<int>(std::lround(std::log2(deflection / roles_.reference_diagonal)));
  const double own = std::ldexp(roles_.reference_diagonal, step);
  const ProfileLimits limits{{.deflection = own, .is_exact = is_exact}, 2 * own};
  ProfileFacets& facets = all_.try_emplace({step, is_exact}, model_, roles_, limits).first->second;
  if (facets.facets().triangle.size() > kMostKept) facets.clear();
  return facets;
}

}  // namespace st
