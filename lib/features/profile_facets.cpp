#include "features/profile_facets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "base/share.h"
#include "base/threads.h"
#include "features/edge_places.h"

namespace st {
namespace {

constexpr std::size_t kMostAlone = 64;  // faces: to tell other ranks of fewer costs more than they could save

/// Faces with 1, ascending.
std::vector<FaceId> listed(std::span<const std::uint8_t> is_wanted) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < is_wanted.size(); ++f)
    if (is_wanted[f]) faces.push_back(static_cast<FaceId>(f));
  return faces;
}

}  // namespace

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
  add(walls_along(edges), executor);
  if (executor.size() > 1) make_ahead(edges, executor);
  const std::vector<Cut> cuts = executor.is_root() ? cuts_at(edges) : std::vector<Cut>();
  std::size_t n_done = 0;
  for (bool is_more = true; is_more;) {
    std::vector<std::uint8_t> next = walls_of_next(cuts, n_done);
    const std::vector<FaceId> faces = listed(next);
    const auto known = made_.find(faces);
    if (known != made_.end())
      join_facets(model_, std::move(made_.extract(known).mapped()), facets_);
    else if (!faces.empty() && faces.size() <= kMostAlone)  // on rank 0: others wait for the next add()
      add(std::move(next), SerialExecutor());
    else
      is_more = add(std::move(next), executor);
  }
  made_.clear();
}

std::vector<std::uint8_t> ProfileFacets::walls_along(std::span<const WingEdge> edges) {
  std::vector<std::uint8_t> walls(is_known_.size(), 0);
  for (const WingEdge& w : edges) take_walls_at(w.edge, nullptr, walls);
  return walls;
}

/// Those that the first cut meets from `n_done` on that meets any; that one is to be made again, through more facets.
/// With several threads some cuts are made ahead: what comes after the first is dropped.
std::vector<std::uint8_t> ProfileFacets::walls_of_next(std::span<const Cut> cuts, std::size_t& n_done) {
  constexpr std::size_t kAhead = 32, kPerPiece = 4;
  const ProfileCutter cutter(facets_);
  std::vector<std::vector<CutEnd>> ends(thread_count() > 1 ? kAhead : 1);
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

/// Facets depend on which faces are meshed together, and that on all cuts before. Those of bodies that hang together
/// nowhere hardly depend on each other: what each would ask for by itself is made by all ranks, and is taken where rank
/// 0 asks for just that.
void ProfileFacets::make_ahead(std::span<const WingEdge> edges, const Executor& executor) {
  std::vector<WingEdge> all(edges.begin(), edges.end());
  share(executor, all);
  const std::vector<std::vector<WingEdge>> bodies = by_body(all);
  if (bodies.size() < 2) return;
  std::vector<double> work;
  for (const auto& body : bodies) work.push_back(static_cast<double>(body.size()));
  executor.run_tasks(
      static_cast<std::int32_t>(bodies.size()), heaviest_first(work),
      [&](std::int32_t task) {
        return packed(ProfileFacets(model_, roles_, limits_).walk(bodies[static_cast<std::size_t>(task)]));
      },
      [&](std::int32_t, Bytes&& bytes) {
        std::vector<MadeFacets> made;
        unpack(bytes, made);
        for (MadeFacets& m : made) made_.try_emplace(std::move(m.faces), std::move(m.facets));
      });
}

/// Edges of walls that hang together.
std::vector<std::vector<WingEdge>> ProfileFacets::by_body(std::span<const WingEdge> edges) const {
  DisjointSets bodies(static_cast<std::int64_t>(is_known_.size()));
  const auto is_wall = [&](FaceId f) { return roles_.role[f] == FaceRole::kWall; };
  for (std::size_t e = 0; e + 1 < offsets_.size(); ++e)
    for (std::int32_t k = offsets_[e], wall = kNone; k < offsets_[e + 1]; ++k) {
      if (!is_wall(edge_faces_[k])) continue;
      if (wall != kNone) bodies.join(wall, edge_faces_[k]);
      wall = edge_faces_[k];
    }
  std::map<FaceId, std::vector<WingEdge>> by_first;
  for (const WingEdge& w : edges)
    for (std::int32_t k = offsets_[w.edge]; k < offsets_[w.edge + 1]; ++k) {
      if (!is_wall(edge_faces_[k])) continue;
      by_first[bodies.find(edge_faces_[k])].push_back(w);
      break;
    }
  std::vector<std::vector<WingEdge>> all;
  for (auto& [first, own] : by_first) all.push_back(std::move(own));
  return all;
}

/// What add_along() asks for one after the other, but for the first.
std::vector<ProfileFacets::MadeFacets> ProfileFacets::walk(std::span<const WingEdge> edges) {
  add(walls_along(edges), SerialExecutor());
  const std::vector<Cut> cuts = cuts_at(edges);
  std::vector<MadeFacets> made;
  for (std::size_t n_done = 0;;) {
    const std::vector<std::uint8_t> next = walls_of_next(cuts, n_done);
    std::vector<FaceId> faces = listed(next);
    if (faces.empty()) return made;
    Facets facets = make_unjoined_facets(model_, next, limits_.facets, SerialExecutor());
    made.push_back({std::move(faces), facets});
    join_facets(model_, std::move(facets), facets_);
  }
}

bool ProfileFacets::add_beyond(std::span<const CutEnd> ends, const Executor& executor) {
  return add(walls_beyond(ends), executor);
}

void ProfileFacets::add_cut(EdgeId e, Vec3 x, Vec3 normal, const Executor& executor) {
  std::vector<std::uint8_t> next(is_known_.size(), 0);
  take_walls_at(e, nullptr, next);
  add(std::move(next), executor);
  while (add_beyond(ProfileCutter(facets_).ends_of(x, normal, limits_.reach), executor)) {
  }
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
