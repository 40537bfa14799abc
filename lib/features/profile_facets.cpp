#include "features/profile_facets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "base/pieces.h"
#include "base/share.h"
#include "base/threads.h"
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
    : model_(model), roles_(roles), limits_(limits), faces_at_(model.tables()) {
  is_known_.resize(static_cast<std::size_t>(model.tables().n_faces()), 0);
}

void ProfileFacets::add_along(std::span<const WingEdge> edges, const Executor& executor) {
  constexpr std::size_t kAhead = 32;  // cuts made at once by several threads
  std::vector<WingEdge> all(edges.begin(), edges.end());
  share(executor, all);
  add_mirrors(all);
  if (const std::vector<std::vector<WingEdge>> bodies = by_body(all); bodies.size() > 1) {
    add_bodies(bodies, executor);
    return;
  }
  add(walls_along(all), executor);
  if (executor.is_root()) walk(all, threads_of_pieces() > 1 ? kAhead : 1);
}

std::vector<std::uint8_t> ProfileFacets::walls_along(std::span<const WingEdge> edges) {
  std::vector<std::uint8_t> walls(is_known_.size(), 0);
  for (const WingEdge& w : edges) take_walls_at(w.edge, nullptr, walls);
  return walls;
}

/// Those that the first cut meets from `n_done` on that meets any; that one is to be made again, through more facets.
/// So many cuts are made at once; what comes after the first is dropped.
std::vector<std::uint8_t> ProfileFacets::walls_of_next(std::span<const Cut> cuts, std::size_t n_ahead,
                                                       std::size_t& n_done) {
  constexpr std::size_t kPerPiece = 4;
  const ProfileCutter cutter(facets_);
  std::vector<std::vector<CutPlace>> ends(n_ahead);
  while (n_done < cuts.size()) {
    const std::span<const Cut> next = cuts.subspan(n_done, std::min(ends.size(), cuts.size() - n_done));
    parallel_for(next.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ends[i] = cutter.ends_of(next[i].x, next[i].normal, limits_.reach);
    });
    for (std::size_t i = 0; i < next.size(); ++i, ++n_done) {
      if (ends[i].empty()) continue;
      std::vector<std::uint8_t> walls = walls_beyond(ends[i]);
      if (std::ranges::count(walls, 1) > 0) return walls;
    }
  }
  return std::vector<std::uint8_t>(is_known_.size(), 0);
}

/// Edges of walls that hang together.
std::vector<std::vector<WingEdge>> ProfileFacets::by_body(std::span<const WingEdge> edges) const {
  DisjointSets bodies(static_cast<std::int64_t>(is_known_.size()));
  const auto is_wall = [&](FaceId f) { return roles_.role[f] == FaceRole::kWall; };
  for (EdgeId e = 0; e < model_.tables().n_edges(); ++e) {
    FaceId wall = kNone;
    for (const FaceId f : faces_at_[e]) {
      if (!is_wall(f)) continue;
      if (wall != kNone) bodies.join(wall, f);
      wall = f;
    }
  }
  std::map<FaceId, std::vector<WingEdge>> by_first;
  for (const WingEdge& w : edges)
    for (const FaceId f : faces_at_[w.edge]) {
      if (!is_wall(f)) continue;
      by_first[bodies.find(f)].push_back(w);
      break;
    }
  std::vector<std::vector<WingEdge>> all;
  for (auto& [first, own] : by_first) all.push_back(std::move(own));
  return all;
}

/// What a cut through one body meets does not depend on the others.
void ProfileFacets::add_bodies(std::span<const std::vector<WingEdge>> bodies, const Executor& executor) {
  ST_ASSERT(facets_.triangle.empty());
  constexpr std::size_t kMostTasks = 256;  // each has tables of the whole model
  const std::size_t n_per_task = (bodies.size() + kMostTasks - 1) / kMostTasks,
                    n_tasks = (bodies.size() + n_per_task - 1) / n_per_task;
  const auto of_task = [&](std::size_t task) {
    const auto rest = bodies.subspan(n_per_task * task);
    return rest.first(std::min(rest.size(), n_per_task));
  };
  std::vector<double> work(n_tasks, 0);
  for (std::size_t i = 0; i < n_tasks; ++i)
    for (const auto& edges : of_task(i)) work[i] += static_cast<double>(edges.size());
  std::vector<Facets> parts(n_tasks);
  executor.run_tasks(
      static_cast<std::int32_t>(n_tasks), heaviest_first(work),
      [&](std::int32_t task) {
        ProfileFacets own(model_, roles_, limits_);
        Facets facets;
        for (const auto& edges : of_task(static_cast<std::size_t>(task))) {
          own.clear();
          own.add_mirrors(edges);
          own.add(own.walls_along(edges), SerialExecutor());
          own.walk(edges, 1);
          append_facets(std::move(own.facets_), facets);
        }
        return packed(facets);
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, parts[static_cast<std::size_t>(task)]); });
  Facets all;
  for (Facets& part : parts) append_facets(std::move(part), all);
  for (const FaceId f : all.face) is_known_[f] = 1;
  if (executor.is_root()) join_facets(model_, std::move(all), facets_);
}

/// Until no cut meets walls without facets.
void ProfileFacets::walk(std::span<const WingEdge> edges, std::size_t n_ahead) {
  const std::vector<Cut> cuts = cuts_at(edges);
  for (std::size_t n_done = 0; add(walls_of_next(cuts, n_ahead, n_done), SerialExecutor());) {
  }
}

bool ProfileFacets::add_beyond(std::span<const CutPlace> ends, const Executor& executor) {
  return add(walls_beyond(ends), executor);
}

void ProfileFacets::add_cut(EdgeId e, Vec3 x, Vec3 normal, const Executor& executor) {
  std::vector<std::uint8_t> next(is_known_.size(), 0);
  take_walls_at(e, nullptr, next);
  add(std::move(next), executor);
  while (add_beyond(ProfileCutter(facets_).ends_of(x, normal, limits_.reach), executor)) {
  }
}

void ProfileFacets::add_mirrors(std::span<const WingEdge> edges) {
  std::vector<FaceId> mirrors;
  for (const WingEdge& w : edges)
    if (w.mirror != kNone && std::ranges::count(mirrors, w.mirror) == 0) mirrors.push_back(w.mirror);
  for (const FaceId f : mirrors) mirrors_.emplace_back(model_, f);
}

/// What a cut meets in the image of the model, its own image meets in the model.
std::vector<ProfileFacets::Cut> ProfileFacets::cuts_at(std::span<const WingEdge> edges) const {
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

std::vector<std::uint8_t> ProfileFacets::walls_beyond(std::span<const CutPlace> ends) {
  std::vector<std::uint8_t> taken(is_known_.size(), 0);
  for (const CutPlace& end : ends)
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
  for (const FaceId f : faces_at_[e]) {
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
