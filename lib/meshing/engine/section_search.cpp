#include "meshing/engine/section_search.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/corner_uv.h"
#include "mesh/patch_crossing.h"

namespace st {
namespace {

/// With two common nodes: folded flat onto each other. With one they only meet there.
void add(const Facet& a, const Facet& b, int n_shared, FacetPairs& pairs) {
  if (n_shared != 1) pairs.push_back({a, b, n_shared > 0 ? FacetPair::kHalve : FacetPair::kUnknown});
}

}  // namespace

std::vector<FacetPairs> by_faces(const FacetPairs& pairs) {
  std::vector<FacetPairs> groups;
  for (const FacetPair& p : pairs) {
    if (groups.empty() || groups.back()[0].a.face != p.a.face || groups.back()[0].b.face != p.b.face)
      groups.emplace_back();
    groups.back().push_back(p);
  }
  return groups;
}

void FoundCrossings::append(const FoundCrossings& more) {
  pairs.insert(pairs.end(), more.pairs.begin(), more.pairs.end());
  chords.insert(chords.end(), more.chords.begin(), more.chords.end());
  touching.insert(touching.end(), more.touching.begin(), more.touching.end());
  ended.insert(ended.end(), more.ended.begin(), more.ended.end());
}

/// The section that has the triangle.
std::int32_t SectionSearch::section_of(const Facet& facet) const {
  const auto after = std::upper_bound(sections_.begin(), sections_.end(), facet, [](const Facet& f, const auto& s) {
    return std::pair<FaceId, std::int64_t>(f.face, f.index) < std::pair(s.face, s.triangle_begin);
  });
  return static_cast<std::int32_t>(after - sections_.begin()) - 1;
}

Facet SectionSearch::facet(std::int32_t s, std::int32_t triangle) const {
  return {sections_[s].face, static_cast<std::int32_t>(sections_[s].triangle_begin + triangle)};
}

std::int32_t SectionSearch::home(const SectionJob& job) const {
  const PatchPlace &a = sections_[job.a], &b = sections_[job.b];
  return a.n_triangles < b.n_triangles ? b.rank : a.rank;
}

double SectionSearch::weight(const SectionJob& job) const {
  constexpr double kAcross = 0.1, kAlways = 500;  // triangles
  const double n = sections_[job.a].n_triangles;
  return kAlways + (job.a == job.b ? n : kAcross * (n + sections_[job.b].n_triangles));
}

FoundCrossings SectionSearch::within(std::int32_t s) const {
  const auto stored = store_.get(sections_[s]);
  const FacePatch& p = *stored;
  const std::vector<Vec3> xyz = node_places(numbering_.edges, numbering_.tables.vertex_xyz, p);
  const std::int32_t begin[] = {0, static_cast<std::int32_t>(p.triangles.size())}, body[] = {0};
  FoundCrossings found;
  bool was_ended = false;
  for (const TrianglePair& pair : find_crossing_patches({xyz, p.triangles, begin, body}, was_ended))
    add(facet(s, pair.a), facet(s, pair.b), pair.n_shared, found.pairs);
  if (was_ended) found.ended.push_back({p.face, p.face});
  found.chords = find_chords(segments_, p, sections_[s].triangle_begin);
  return found;
}

/// Of `s`, at its rank: what is near `others`.
SectionPart SectionSearch::near(std::int32_t s, const PatchBlocks& others, bool is_of_one_face) const {
  const PatchPlace& place = sections_[s];
  const auto blocks = store_.blocks(place);
  return part_of(numbering_.edges, numbering_.tables.vertex_xyz, *store_.get(place), *blocks, blocks->meeting(others),
                 is_of_one_face ? place.section : kNone);
}

/// Some triangles each, which are near each other as they come from the blocks of a section.
PatchBlocks SectionSearch::blocks_of(const FacePatch& part) const {
  constexpr std::size_t kTriangles = 16;
  std::vector<Box3> boxes((part.triangles.size() + kTriangles - 1) / kTriangles);
  for (std::size_t t = 0; t < part.triangles.size(); ++t)
    for (const NodeId n : part.triangles[t].n)
      boxes[t / kTriangles].add(node_place(numbering_.edges, numbering_.tables.vertex_xyz, part, n));
  return PatchBlocks(std::move(boxes));
}

Bytes SectionSearch::answer(const Bytes& request) const {
  std::vector<Facet> facets;
  std::int32_t s = 0;
  std::vector<Box3> boxes;
  bool is_of_one_face = false;
  unpack(request, facets, s, boxes, is_of_one_face);
  if (!facets.empty()) return packed(corners(facets));
  return packed(near(s, PatchBlocks(std::move(boxes)), is_of_one_face));
}

/// Of the two sections of a job, the one on this rank, and the other one.
std::array<std::int32_t, 2> SectionSearch::here_and_there(const SectionJob& job) const {
  return store_.is_own(sections_[job.a]) ? std::array{job.a, job.b} : std::array{job.b, job.a};
}

std::vector<SectionPart> SectionSearch::near_others(const std::vector<SectionJob>& jobs) const {
  std::vector<SectionPart> parts(jobs.size());
  std::vector<Request> requests;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i].a == jobs[i].b) continue;
    const auto [here, there] = here_and_there(jobs[i]);
    const PatchPlace& place = sections_[there];
    const auto blocks = store_.blocks(sections_[here]);
    if (store_.is_own(place)) {
      parts[i] = near(there, *blocks, is_of_one_face(jobs[i]));
      executor_.has_own(PackedSize::of(parts[i]));
      continue;
    }
    std::vector<Box3> boxes;
    for (const PatchBlocks::Meeting& m : blocks->meeting(place.box)) boxes.push_back((*blocks)[m.block]);
    if (boxes.empty()) continue;
    requests.push_back({place.rank, packed(std::vector<Facet>(), there, boxes, is_of_one_face(jobs[i]))});
    asked.push_back(i);
  }
  const std::vector<Bytes> answers = executor_.ask(requests);
  for (std::size_t k = 0; k < asked.size(); ++k) unpack(answers[k], parts[asked[k]]);
  return parts;
}

FoundCrossings SectionSearch::between(const SectionJob& job, const SectionPart& other) const {
  const auto [here, there] = here_and_there(job);
  const bool has_a = here == job.a;
  FoundCrossings found;
  if (other.patch.triangles.empty()) return found;
  const SectionPart near_here = near(here, blocks_of(other.patch), is_of_one_face(job));
  const SectionPart &a = has_a ? near_here : other, &b = has_a ? other : near_here;
  const SurfaceMesh both = weld_parts(numbering_.edges, numbering_.tables.vertex_xyz, a.patch, b.patch);
  const auto n_first = static_cast<std::int32_t>(a.patch.triangles.size());
  bool was_ended = false;
  for (const TrianglePair& pair : find_crossings_between(both.node_xyz, both.triangles, n_first, was_ended))
    add(facet(job.a, a.triangle_number[pair.a]), facet(job.b, b.triangle_number[pair.b - n_first]), pair.n_shared,
        found.pairs);
  if (was_ended) found.ended.push_back({sections_[job.a].face, sections_[job.b].face});
  return found;
}

FoundCrossings SectionSearch::find(const SectionJob& job, const SectionPart& other) const {
  FoundCrossings found = job.a == job.b ? within(job.a) : between(job, other);
  if (!found.ended.empty())
    for (FacetPair& p : found.pairs) p.factor = FacetPair::kHopeless;
  return found;
}

FacetCorners SectionSearch::corners(const Facet& facet) const {
  const std::int32_t s = section_of(facet);
  const auto stored = store_.get(sections_[s]);
  const FacePatch& p = *stored;
  const auto t = static_cast<std::size_t>(facet.index - sections_[s].triangle_begin);
  const NodeId* n = p.triangles[t].n;
  FacetCorners corners{{}, std::max({n[0], n[1], n[2]}) < p.n_boundary};
  for (std::size_t k = 0; k < 3; ++k) {
    corners.places.x[k] = node_place(numbering_.edges, numbering_.tables.vertex_xyz, p, n[k]);
    corners.places.uv[k] = corner_uv(p, 3 * t + k);
  }
  return corners;
}

std::vector<FacetCorners> SectionSearch::corners(const std::vector<Facet>& facets) const {
  std::vector<FacetCorners> all(facets.size());
  std::map<std::int32_t, std::vector<std::size_t>> elsewhere;  // by rank
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (const PatchPlace& place = sections_[section_of(facets[i])]; store_.is_own(place))
      all[i] = corners(facets[i]);
    else
      elsewhere[place.rank].push_back(i);
  for (const auto& [rank, numbers] : elsewhere) {
    std::vector<Facet> asked;
    for (const std::size_t i : numbers) asked.push_back(facets[i]);
    std::vector<FacetCorners> answer;
    unpack(executor_.ask({{rank, packed(asked, std::int32_t{0}, std::vector<Box3>(), false)}})[0], answer);
    for (std::size_t k = 0; k < numbers.size(); ++k) all[numbers[k]] = answer[k];
  }
  return all;
}

bool SectionSearch::is_whole(std::int32_t s) const {
  const auto n = static_cast<std::int32_t>(sections_.size());
  return (s == 0 || sections_[s - 1].face != sections_[s].face) &&
         (s + 1 == n || sections_[s + 1].face != sections_[s].face);
}

}  // namespace st
