#include "meshing/engine/crossing_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/log.h"
#include "base/share.h"
#include "base/threads.h"
#include "geometry/shape/wall_gap.h"
#include "mesh/merge.h"
#include "mesh/touching_triangles.h"
#include "meshing/engine/rank_batches.h"
#include "meshing/engine/refinement_policy.h"

namespace st {
namespace {

using Policy = RefinementPolicy;

constexpr double kPerMeasurement = 1000;  // triangles: the search among so many takes as long

/// Such faces meet, and where they cross beside what they share no length parts them.
bool share_a_vertex(const ModelTables& t, FaceId a, FaceId b) {
  const std::set<VertexId> of_a = vertices_of(t, a), of_b = vertices_of(t, b);
  return std::any_of(of_a.begin(), of_a.end(), [&](VertexId v) { return of_b.contains(v); });
}

}  // namespace

RefinementPoint halve_triangle(Vec3 a, Vec3 b, Vec3 c) {
  return {(a + b + c) / 3, 0.5 * std::max({distance(a, b), distance(b, c), distance(c, a)})};
}

/// Those of faces that changed, and every two that meet of which one is of such a face. Local, on rank 0.
std::vector<SectionJob> CrossingSearch::jobs_of(const std::vector<PatchPlace>& sections) const {
  std::vector<SectionJob> jobs;
  std::vector<Box3> boxes;
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(sections.size()); ++s) {
    boxes.push_back(sections[s].box);
    if (found_.face_is_fresh[sections[s].face]) jobs.push_back({s, s});
  }
  for (const auto& [s, t] : meeting_pairs(boxes)) {
    const FaceId f = sections[s].face, g = sections[t].face;
    if ((found_.face_is_fresh[f] || found_.face_is_fresh[g]) && (face_body_[f] == face_body_[g] || may_be_apart(f, g)))
      jobs.push_back({s, t});
  }
  return jobs;
}

/// Collective. Of rank 0's places, on every rank.
std::vector<PatchPlace> CrossingSearch::sections_of(const std::vector<FacePlace>& places) const {
  std::vector<PatchPlace> sections;
  if (executor_.is_root())
    for (const FacePlace& face : places)
      for (const PatchPlace& place : face)
        if (place.is_there()) sections.push_back(place);
  share(executor_, sections);
  return sections;
}

void CrossingSearch::run(const BoundaryNumbering& numbering, const std::vector<FacePlace>& places) {
  const std::vector<PatchPlace> sections = sections_of(places);
  std::vector<SectionJob> jobs;
  if (executor_.is_root()) jobs = jobs_of(sections);
  share(executor_, jobs);
  const SectionSearch search(store_, executor_, numbering, sections);
  const std::vector<RankBatch> batches = batches_of(
      jobs, [&](const SectionJob& job) { return search.home(job); },
      [&](const SectionJob& job) { return search.weight(job); });
  NamedTasks tasks = tasks_of(batches, "crossings");
  tasks.answer = [&](const Bytes& request) { return search.answer(request); };
  std::erase_if(found_.pairs,
                [&](const FacetPair& p) { return found_.face_is_fresh[p.a.face] || found_.face_is_fresh[p.b.face]; });
  for (std::size_t f = 0; f < found_.chords.size(); ++f)
    if (found_.face_is_fresh[f]) found_.chords[f].clear();
  FacetPairs fresh;
  std::set<std::array<FaceId, 2>> ended;
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        FoundCrossings all;
        std::vector<SectionJob> own;
        for (const std::size_t i : batches[task].jobs) own.push_back(jobs[i]);
        const std::vector<SectionPart> others = search.near_others(own);
        for (std::size_t i = 0; i < own.size(); ++i) {
          FoundCrossings found = search.find(own[i], others[i]);
          measure_whole_faces(own[i], search, found);
          all.append(found);
        }
        return packed(all);
      },
      [&](std::int32_t, Bytes&& bytes) {
        FoundCrossings found;
        unpack(bytes, found);
        fresh.insert(fresh.end(), found.pairs.begin(), found.pairs.end());
        for (const Chord& c : found.chords) found_.chords[c.facet.face].push_back(c);
        for (const auto& [a, b] : found.touching) found_.touching.insert({a, b});
        ended.insert(found.ended.begin(), found.ended.end());
      });
  say_ended(ended);
  if (executor_.is_root()) {
    std::vector<Chord> chords;
    for (const std::vector<Chord>& some : found_.chords) chords.insert(chords.end(), some.begin(), some.end());
    for (const auto& [a, b] : find_repeated_chords(std::move(chords), found_.face_is_fresh))
      fresh.push_back({a, b, FacetPair::kHalve});
  }
  const auto in_order = [](const FacetPair& p, const FacetPair& q) { return p.key() < q.key(); };
  std::sort(fresh.begin(), fresh.end(), in_order);
  fresh = measured(fresh, search);
  found_.pairs.insert(found_.pairs.end(), fresh.begin(), fresh.end());
  std::sort(found_.pairs.begin(), found_.pairs.end(), in_order);
  std::fill(found_.face_is_fresh.begin(), found_.face_is_fresh.end(), 0);
}

/// Local, on rank 0.
void CrossingSearch::say_ended(const std::set<std::array<FaceId, 2>>& faces) const {
  const ModelTables& t = model_.tables();
  for (const auto& [a, b] : faces)
    log_warning(
        fmt::format("{}{}: too many of its triangles lie in others; the search for crossings was ended and "
                    "nothing is refined there (look at the face in the CAD system)",
                    t.face_label(a), a == b ? "" : " and " + t.face_label(b)));
}

/// Collective. Corners of these triangles (rank 0's choice) on rank 0.
std::vector<FacetCorners> CrossingSearch::corners(std::vector<Facet> facets, const SectionSearch& search) const {
  share(executor_, facets);
  if (facets.empty()) return {};
  const std::vector<RankBatch> batches = batches_of(
      facets, [&](const Facet& f) { return search.home(f); }, [](const Facet&) { return 1; });
  std::vector<FacetCorners> all(executor_.is_root() ? facets.size() : 0);
  executor_.run_named_tasks(
      tasks_of(batches, "corners"),
      [&](std::int32_t task) {
        std::vector<FacetCorners> own;
        for (const std::size_t i : batches[task].jobs) own.push_back(search.corners(facets[i]));
        return packed(own);
      },
      [&](std::int32_t task, Bytes&& bytes) {
        std::vector<FacetCorners> own;
        unpack(bytes, own);
        for (std::size_t k = 0; k < own.size(); ++k) all[batches[task].jobs[k]] = own[k];
      });
  return all;
}

/// The first pairs whose walls are not measured, and pairs from all over the others.
std::vector<RefinementPoint> CrossingSearch::places_to_refine(const BoundaryNumbering& numbering,
                                                              const std::vector<FacePlace>& places) {
  const std::vector<PatchPlace> sections = sections_of(places);
  const SectionSearch search(store_, executor_, numbering, sections);
  std::vector<Facet> facets;
  std::vector<std::pair<double, double>> how;  // factor and triangles of each
  const auto add = [&](const FacetPair& p, double n_triangles) {
    for (const Facet& f : {p.a, p.b}) {
      facets.push_back(f);
      how.push_back({p.factor, n_triangles});
    }
  };
  FacetPairs apart;
  for (const FacetPair& p : found_.pairs) {
    if (p.a.face == p.b.face && face_is_given_up_[p.a.face]) continue;
    if (p.factor > 0) apart.push_back(p);
    if (p.factor == FacetPair::kHalve && facets.size() < kFacePolicy.max_crossing_places) add(p, 1);
  }
  const std::size_t step = 2 * apart.size() / Policy::kMaxWallPlaces + 1;
  for (std::size_t i = 0; i < apart.size(); i += step) add(apart[i], Policy::kAround * static_cast<double>(step));
  const std::vector<FacetCorners> all = corners(std::move(facets), search);
  std::vector<RefinementPoint> refined;
  for (std::size_t i = 0; i < all.size(); ++i) {
    refined.push_back(refinement_of(all[i], how[i].first, Policy::kCovering + Policy::kWider * n_asked_));
    refined.back().n_triangles = how[i].second;
  }
  ++n_asked_;
  return refined;
}

/// The longest side times `factor` where there is one, `covering` halves of it around. Else half of it; half the
/// shortest side, or a quarter of the longest, where the triangle spans its face from boundary to boundary.
RefinementPoint CrossingSearch::refinement_of(const FacetCorners& t, double factor, double covering) {
  const auto& [a, b, c] = t.places.x;
  RefinementPoint place = halve_triangle(a, b, c);
  if (factor > 0) return {place.x, 2 * factor * place.length, covering * place.length, factor};
  if (!t.is_spanning) return place;
  const auto [shortest, longest] = std::minmax({distance(a, b), distance(b, c), distance(c, a)});
  place.length = 0.5 * std::max(shortest, 0.5 * longest);
  return place;
}

/// Plane walls have chords of their own shape: triangles of two bodies cross there where the CAD does.
bool CrossingSearch::may_be_apart(FaceId a, FaceId b) const {
  const ModelTables& t = model_.tables();
  return is_across_ && !(t.face_type[a] == SurfaceType::kPlane && t.face_type[b] == SurfaceType::kPlane) &&
         !found_.touching.contains(std::minmax(a, b));
}

/// Local. Walls that are whole are measured where they are compared: bodies in contact cross in many places.
void CrossingSearch::measure_whole_faces(const SectionJob& job, const SectionSearch& search,
                                         FoundCrossings& found) const {
  if (found.pairs.empty() || job.a == job.b || !search.is_whole(job.a) || !search.is_whole(job.b)) return;
  const FaceId a = search.face(job.a), b = search.face(job.b);
  if (share_a_vertex(model_.tables(), a, b)) return;
  std::sort(found.pairs.begin(), found.pairs.end(),
            [](const FacetPair& p, const FacetPair& q) { return p.key() < q.key(); });
  found.pairs = measured_pair_of_faces(std::move(found.pairs), search);
  if (found.pairs.empty()) found.touching.push_back({a, b});
}

/// Collective. With their factors, without pairs where two bodies meet. `pairs`: sorted, of rank 0.
FacetPairs CrossingSearch::measured(const FacetPairs& pairs, const SectionSearch& search) {
  const auto is_unknown = [](const FacetPair& p) { return p.factor == FacetPair::kUnknown; };
  FacetPairs known, unknown;  // those that share a vertex, and those whose walls are to be measured
  for (const FacetPairs& some : by_faces(pairs)) {
    const FaceId a = some[0].a.face, b = some[0].b.face;
    const bool is_known = a == b || std::ranges::none_of(some, is_unknown) || share_a_vertex(model_.tables(), a, b);
    for (FacetPair p : some) {
      if (is_known && p.factor == FacetPair::kUnknown) p.factor = FacetPair::kHalve;
      (is_known ? known : unknown).push_back(p);
    }
  }
  share(executor_, unknown);
  const std::vector<FacetPairs> groups = by_faces(unknown);
  if (groups.empty()) return known;
  const auto home = [&](const FacetPairs& p) { return search.home(p[0].a); };
  const std::vector<RankBatch> batches =
      batches_of(groups, home, [](const FacetPairs& p) { return kPerMeasurement * static_cast<double>(p.size()); });
  NamedTasks tasks = tasks_of(batches, "walls");
  tasks.answer = [&](const Bytes& request) { return search.answer(request); };
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        FacetPairs kept;
        for (const std::size_t i : batches[task].jobs) {
          const FacetPairs some = measured_pair_of_faces(groups[i], search);
          kept.insert(kept.end(), some.begin(), some.end());
        }
        return packed(kept);
      },
      [&](std::int32_t task, Bytes&& bytes) {
        FacetPairs kept;
        unpack(bytes, kept);
        for (const std::size_t i : batches[task].jobs)
          found_.touching.insert({groups[i][0].a.face, groups[i][0].b.face});
        for (const FacetPair& p : kept) found_.touching.erase({p.a.face, p.b.face});
        known.insert(known.end(), kept.begin(), kept.end());
      });
  return known;
}

/// Pairs of two faces, at a rank that has one of them. Where these are of two bodies, some places tell whether
/// the bodies meet everywhere.
FacetPairs CrossingSearch::measured_pair_of_faces(FacetPairs kept, const SectionSearch& search) const {
  constexpr std::size_t kTried = 16;  // of two bodies: none apart, and they meet
  constexpr std::size_t kMostMeasured = 1000;
  const FaceId a = kept[0].a.face, b = kept[0].b.face;
  const bool is_one_body = face_body_[a] == face_body_[b];
  const double tolerance = meeting_distance(model_.tables(), a, b);
  const auto factor_of = [&](const std::optional<WallGap>& gap) {
    if (gap && gap->is_apart) return gap->factor < Policy::kLeastFactor ? FacetPair::kHopeless : gap->factor;
    return is_one_body ? FacetPair::kHalve : FacetPair::kMeets;
  };
  const auto measure_every = [&](std::size_t step) {
    constexpr std::size_t kPerPiece = 2;  // each takes some tenths of a millisecond
    std::vector<std::size_t> some;
    std::vector<Facet> of_a, of_b;
    for (std::size_t i = 0; i < kept.size(); i += step) {
      if (kept[i].factor != FacetPair::kUnknown) continue;
      some.push_back(i);
      of_a.push_back(kept[i].a);
      of_b.push_back(kept[i].b);
    }
    const std::vector<FacetCorners> at_a = search.corners(of_a), at_b = search.corners(of_b);
    parallel_for(some.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      const auto surface_a = model_.surface(a), surface_b = model_.surface(b);
      for (std::size_t i = begin; i < end; ++i)
        kept[some[i]].factor =
            factor_of(measure_gap(*surface_a, at_a[i].places, *surface_b, at_b[i].places, tolerance));
    });
  };
  if (!is_one_body) {
    measure_every(std::max<std::size_t>(1, kept.size() / kTried));
    if (std::all_of(kept.begin(), kept.end(), [](const FacetPair& p) {
          return p.factor == FacetPair::kMeets || p.factor == FacetPair::kUnknown;
        }))
      return {};
  }
  measure_every(kept.size() / kMostMeasured + 1);
  for (FacetPair& p : kept)
    if (p.factor == FacetPair::kUnknown) p.factor = is_one_body ? FacetPair::kHalve : FacetPair::kMeets;
  std::erase_if(kept, [](const FacetPair& p) { return p.factor == FacetPair::kMeets; });
  return kept;
}

std::vector<std::int64_t> CrossingSearch::n_pairs_within() const {
  std::vector<std::int64_t> n(face_body_.size(), 0);
  for (const FacetPair& p : found_.pairs)
    if (p.a.face == p.b.face) ++n[p.a.face];
  return n;
}

std::vector<FaceId> CrossingSearch::crossing_faces(bool others_too) const {
  std::set<FaceId> faces;
  for (const FacetPair& p : found_.pairs)
    if (p.a.face == p.b.face || others_too) faces.insert({p.a.face, p.b.face});
  return {faces.begin(), faces.end()};
}

std::vector<FaceId> CrossingSearch::touching_faces() const {
  std::set<FaceId> faces;
  for (const auto& [a, b] : found_.touching) faces.insert({a, b});
  return {faces.begin(), faces.end()};
}

std::vector<std::size_t> CrossingSearch::crossing_in(FaceId f, bool others_too) const {
  std::set<std::size_t> triangles;
  for (const FacetPair& p : found_.pairs) {
    if (p.a.face != p.b.face && !others_too) continue;
    if (p.a.face == f) triangles.insert(static_cast<std::size_t>(p.a.index));
    if (p.b.face == f) triangles.insert(static_cast<std::size_t>(p.b.index));
  }
  return {triangles.begin(), triangles.end()};
}

std::vector<FaceId> CrossingSearch::move_touching_apart(const BoundaryNumbering& numbering,
                                                        std::map<FaceId, FacePatch>& patches) const {
  std::vector<const FacePatch*> welded;
  std::map<FaceId, std::size_t> place;  // in these
  for (const auto& [f, patch] : patches) {
    place[f] = welded.size();
    welded.push_back(&patch);
  }
  auto [mesh, numbers] = weld_patches(numbering.edges, numbering.tables.vertex_xyz, welded);
  std::vector<TouchingPair> touching;
  for (const FacetPair& p : found_.pairs) {
    const Triangle &a = mesh.triangles[numbers.triangle_begin[place.at(p.a.face)] + p.a.index],
                   &b = mesh.triangles[numbers.triangle_begin[place.at(p.b.face)] + p.b.index];
    if (std::none_of(std::begin(a.n), std::end(a.n), [&](NodeId n) { return std::ranges::count(b.n, n) > 0; }))
      touching.push_back({a, b, meeting_distance(model_.tables(), p.a.face, p.b.face)});
  }
  std::vector<FaceId> changed;
  if (!st::move_touching_apart(touching, numbers.n_boundary(), mesh.node_xyz)) return changed;
  for (auto& [f, patch] : patches) {
    const std::vector<Vec3> before = patch.inner_xyz;
    const std::vector<NodeId> number = numbers.of_patch(numbering.edges, patch, place[f]);
    for (std::size_t i = 0; i < before.size(); ++i)
      if (const NodeId n = number[patch.n_boundary + i]; n != kNone) patch.inner_xyz[i] = mesh.node_xyz[n];
    if (patch.inner_xyz != before) changed.push_back(f);
  }
  return changed;
}

}  // namespace st
