#include "meshing/engine/crossing_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "base/log.h"
#include "base/share.h"
#include "base/threads.h"
#include "geometry/shape/wall_gap.h"
#include "mesh/corner_uv.h"
#include "mesh/merge.h"
#include "mesh/patch_crossing.h"
#include "mesh/touching_triangles.h"
#include "meshing/engine/refinement_policy.h"

namespace st {
namespace {

using Policy = RefinementPolicy;

constexpr double kPerMeasurement = 1000;  // triangles: the search among so many takes as long

std::int64_t key_of(const BoundaryNumbering& numbering, std::int32_t id) {
  const BoundaryNumbering::Entity e = numbering.entity(id);
  return boundary_key(e.dim, e.entity, e.index);
}

/// Such faces meet, and where they cross beside what they share no length parts them.
bool share_a_vertex(const ModelTables& t, FaceId a, FaceId b) {
  const std::set<VertexId> of_a = vertices_of(t, a), of_b = vertices_of(t, b);
  return std::any_of(of_a.begin(), of_a.end(), [&](VertexId v) { return of_b.contains(v); });
}

}  // namespace

BoundarySegments::BoundarySegments(const BoundaryNumbering& numbering) {
  const EdgeMesh& edges = numbering.edges;
  const auto key = [&](EdgeId e, std::int32_t index) { return key_of(numbering, numbering.edge_node(e, index)); };
  for (EdgeId e = 0; e < numbering.tables.n_edges(); ++e) {
    const std::int32_t n = edges.n_nodes(e);
    const bool is_own = !numbering.topology.strip_closed_at(e);  // the nodes inside it are its own
    for (std::int32_t i = 1; i < n; i += is_own && i == 1 && n > 2 ? n - 2 : 1) {
      const auto [a, b] = std::minmax({key(e, i - 1), key(e, i)});
      at_ends_.push_back({a, b});
    }
  }
  std::sort(at_ends_.begin(), at_ends_.end());
}

bool BoundarySegments::contain(std::int64_t a, std::int64_t b) const {
  constexpr std::int64_t kOnEdge = std::int64_t{1} << 62;
  return (b == a + 1 && a >= kOnEdge) || std::binary_search(at_ends_.begin(), at_ends_.end(), std::pair{a, b});
}

std::vector<Chord> find_chords(const BoundarySegments& segments, const FacePatch& patch, std::int64_t first) {
  constexpr std::size_t kPerPiece = 65'536;
  std::vector<std::vector<Chord>> found(patch.triangles.size() / kPerPiece + 1);
  parallel_for(patch.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) {
        const NodeId m = patch.triangles[i].n[k], n = patch.triangles[i].n[(k + 1) % 3];
        if (std::max(m, n) >= patch.n_boundary) continue;
        const auto [a, b] = std::minmax({boundary_key(patch, m), boundary_key(patch, n)});
        if (segments.contain(a, b)) continue;
        found[begin / kPerPiece].push_back(
            {a, b, {patch.face, static_cast<std::int32_t>(first + static_cast<std::int64_t>(i))}});
      }
  });
  std::vector<Chord> chords;
  for (const auto& some : found) chords.insert(chords.end(), some.begin(), some.end());
  return chords;
}

std::vector<std::pair<Facet, Facet>> find_repeated_chords(std::vector<Chord> chords,
                                                          std::span<const char> face_is_fresh) {
  const auto key = [](const Chord& c) { return std::tuple(c.a, c.b, c.facet.face, c.facet.index); };
  std::sort(chords.begin(), chords.end(), [&](const Chord& c, const Chord& d) { return key(c) < key(d); });
  std::vector<std::pair<Facet, Facet>> pairs;
  for (std::size_t i = 0, j = 0; i < chords.size(); i = j) {
    while (j < chords.size() && chords[j].a == chords[i].a && chords[j].b == chords[i].b) ++j;
    const Facet first = chords[i].facet, last = chords[j - 1].facet;
    if (j - i >= 3 && first.face != last.face && (face_is_fresh[first.face] || face_is_fresh[last.face]))
      pairs.push_back({first, last});
  }
  return pairs;
}

RefinementPoint halve_triangle(Vec3 a, Vec3 b, Vec3 c) {
  return {(a + b + c) / 3, 0.5 * std::max({distance(a, b), distance(b, c), distance(c, a)})};
}

/// What the tasks of one run need.
struct CrossingSearch::Search {
  const PatchStore& store;
  const Executor& executor;
  const BoundaryNumbering& numbering;
  const std::vector<PlacedPatch>& sections;  // of all patches: by face, by number
  const BoundarySegments segments{numbering};

  std::shared_ptr<const StoredPatch> own(std::int32_t s) const {
    return store.get(sections[s].face, sections[s].place);
  }
  /// The section that has the triangle.
  std::int32_t section_of(const Facet& facet) const {
    const auto after = std::upper_bound(sections.begin(), sections.end(), facet, [](const Facet& f, const auto& s) {
      return std::pair<FaceId, std::int64_t>(f.face, f.index) < std::pair(s.face, s.place.begin.triangle);
    });
    return static_cast<std::int32_t>(after - sections.begin()) - 1;
  }
  Facet facet(std::int32_t s, std::int32_t triangle) const {
    return {sections[s].face, static_cast<std::int32_t>(sections[s].place.begin.triangle + triangle)};
  }
  /// The rank that has more to lose by sending.
  std::int32_t home(const Job& job) const {
    const PatchPlace &a = sections[job.a].place, &b = sections[job.b].place;
    return a.n_triangles < b.n_triangles ? b.rank : a.rank;
  }
  /// About the time it takes.
  double weight(const Job& job) const {
    constexpr double kAcross = 0.1, kAlways = 500;  // triangles
    const double n = sections[job.a].place.n_triangles;
    return kAlways + (job.a == job.b ? n : kAcross * (n + sections[job.b].place.n_triangles));
  }

  Found within(std::int32_t s) const {
    const auto stored = own(s);
    const FacePatch& p = stored->section.patch;
    const std::vector<Vec3> xyz = node_places(numbering.edges, numbering.tables.vertex_xyz, p);
    const std::int32_t begin[] = {0, static_cast<std::int32_t>(p.triangles.size())}, body[] = {0};
    Found found;
    bool was_ended = false;
    for (const TrianglePair& pair : find_crossing_patches({xyz, p.triangles, begin, body}, was_ended))
      add(facet(s, pair.a), facet(s, pair.b), pair.n_shared, found.pairs);
    if (was_ended) found.ended.push_back({p.face, p.face});
    found.chords = find_chords(segments, p, sections[s].place.begin.triangle);
    return found;
  }

  /// Of `s`, at its rank: what is near `others`.
  PatchPart near(std::int32_t s, const PatchBlocks& others, bool is_of_one_face) const {
    const auto stored = own(s);
    return part_of(numbering.edges, numbering.tables.vertex_xyz, stored->section, stored->blocks,
                   stored->blocks.meeting(others), is_of_one_face);
  }
  /// What another rank asks for: corners of triangles, or what is near boxes.
  Bytes answer(const Bytes& request) const {
    std::vector<Facet> facets;
    std::int32_t s = 0;
    std::vector<Box3> boxes;
    bool is_of_one_face = false;
    unpack(request, facets, s, boxes, is_of_one_face);
    if (!facets.empty()) return packed(corners(facets));
    return packed(near(s, PatchBlocks(std::move(boxes)), is_of_one_face));
  }

  /// Of the two sections of a job, the one on this rank, and the other one.
  std::array<std::int32_t, 2> here_and_there(const Job& job) const {
    return store.is_own(sections[job.a].place) ? std::array{job.a, job.b} : std::array{job.b, job.a};
  }
  bool is_of_one_face(const Job& job) const { return sections[job.a].face == sections[job.b].face; }

  /// For each job what of the other section is near that of this rank, whoever has it. All others are asked at once:
  /// where faces are small, most of the time would go into waiting for one answer after the other.
  std::vector<PatchPart> near_others(const std::vector<Job>& jobs) const {
    std::vector<PatchPart> parts(jobs.size());
    std::vector<Request> requests;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      if (jobs[i].a == jobs[i].b) continue;
      const auto [here, there] = here_and_there(jobs[i]);
      const PatchPlace& place = sections[there].place;
      const auto other = own(here);
      if (store.is_own(place)) {
        parts[i] = near(there, other->blocks, is_of_one_face(jobs[i]));
        executor.has_own(PackedSize::of(parts[i]));
        continue;
      }
      std::vector<Box3> boxes;
      for (const PatchBlocks::Meeting& m : other->blocks.meeting(place.box)) boxes.push_back(other->blocks[m.block]);
      if (boxes.empty()) continue;
      requests.push_back({place.rank, packed(std::vector<Facet>(), there, boxes, is_of_one_face(jobs[i]))});
      asked.push_back(i);
    }
    const std::vector<Bytes> answers = executor.ask(requests);
    for (std::size_t k = 0; k < asked.size(); ++k) unpack(answers[k], parts[asked[k]]);
    return parts;
  }

  /// `other`: of near_others().
  Found between(const Job& job, const PatchPart& other) const {
    const auto [here, there] = here_and_there(job);
    const bool has_a = here == job.a;
    Found found;
    if (other.triangle.empty()) return found;
    const PatchPart near_here = near(here, PatchBlocks(other.boxes), is_of_one_face(job));
    const PatchPart &a = has_a ? near_here : other, &b = has_a ? other : near_here;
    const TwoParts both = join_parts(a, b);
    const auto n_first = static_cast<std::int32_t>(a.triangle.size());
    bool was_ended = false;
    for (const TrianglePair& pair : find_crossings_between(both.points, both.triangles, n_first, was_ended))
      add(facet(job.a, a.triangle[pair.a]), facet(job.b, b.triangle[pair.b - n_first]), pair.n_shared, found.pairs);
    if (was_ended) found.ended.push_back({sections[job.a].face, sections[job.b].face});
    return found;
  }
  Found find(const Job& job, const PatchPart& other) const {
    Found found = job.a == job.b ? within(job.a) : between(job, other);
    if (!found.ended.empty())
      for (FacetPair& p : found.pairs) p.factor = kHopeless;
    return found;
  }

  /// The corners of a triangle of this rank.
  Corners corners(const Facet& facet) const {
    const std::int32_t s = section_of(facet);
    const auto stored = own(s);
    const FacePatch& p = stored->section.patch;
    const auto t = static_cast<std::size_t>(facet.index - sections[s].place.begin.triangle);
    const NodeId* n = p.triangles[t].n;
    Corners corners{{}, std::max({n[0], n[1], n[2]}) < p.n_boundary};
    for (std::size_t k = 0; k < 3; ++k) {
      corners.places.x[k] = node_place(numbering.edges, numbering.tables.vertex_xyz, p, n[k]);
      corners.places.uv[k] = corner_uv(p, 3 * t + k);
    }
    return corners;
  }
  /// The corners of triangles of one face, whoever has them.
  std::vector<Corners> corners(const std::vector<Facet>& facets) const {
    std::vector<Corners> all(facets.size());
    std::map<std::int32_t, std::vector<std::size_t>> elsewhere;  // by rank
    for (std::size_t i = 0; i < facets.size(); ++i)
      if (const PatchPlace& place = sections[section_of(facets[i])].place; store.is_own(place))
        all[i] = corners(facets[i]);
      else
        elsewhere[place.rank].push_back(i);
    for (const auto& [rank, numbers] : elsewhere) {
      std::vector<Facet> asked;
      for (const std::size_t i : numbers) asked.push_back(facets[i]);
      std::vector<Corners> answer;
      unpack(executor.ask({{rank, packed(asked, std::int32_t{0}, std::vector<Box3>(), false)}})[0], answer);
      for (std::size_t k = 0; k < numbers.size(); ++k) all[numbers[k]] = answer[k];
    }
    return all;
  }
  /// The face is one section.
  bool is_whole(std::int32_t s) const {
    const auto n = static_cast<std::int32_t>(sections.size());
    return (s == 0 || sections[s - 1].face != sections[s].face) &&
           (s + 1 == n || sections[s + 1].face != sections[s].face);
  }

  /// With two common nodes: folded flat onto each other. With one they only meet there.
  static void add(const Facet& a, const Facet& b, int n_shared, FacetPairs& pairs) {
    if (n_shared != 1) pairs.push_back({a, b, n_shared > 0 ? kHalve : kUnknown});
  }
};

namespace {

/// Jobs of one rank that make up a task.
struct Batch {
  std::int32_t home;
  double weight = 0;
  std::vector<std::size_t> jobs;
};

/// So many that a message is worth it, not so many that one is long.
template <class Job, class Home, class Weight>
std::vector<Batch> batches_of(const std::vector<Job>& jobs, const Home& home, const Weight& weight) {
  constexpr double kEnough = 20'000;
  std::map<std::int32_t, Batch> open;  // by rank
  std::vector<Batch> batches;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Batch& batch = open.try_emplace(home(jobs[i]), Batch{home(jobs[i]), 0, {}}).first->second;
    batch.jobs.push_back(i);
    batch.weight += weight(jobs[i]);
    if (batch.weight < kEnough) continue;
    batches.push_back(std::move(batch));
    open.erase(batches.back().home);
  }
  for (auto& [rank, batch] : open) batches.push_back(std::move(batch));
  return batches;
}

NamedTasks tasks_of(const std::vector<Batch>& batches, const char* kind) {
  NamedTasks tasks;
  std::vector<double> weight;
  for (const Batch& batch : batches) {
    tasks.home.push_back(batch.home);
    weight.push_back(batch.weight);
  }
  tasks.order = heaviest_first(weight);
  tasks.label = [kind](std::int32_t task) { return TaskLabel{kind, task}; };
  return tasks;
}

}  // namespace

/// Those of faces that changed, and every two that meet of which one is of such a face. Local, on rank 0.
std::vector<CrossingSearch::Job> CrossingSearch::jobs_of(const std::vector<PlacedPatch>& sections) const {
  std::vector<Job> jobs;
  std::vector<Box3> boxes;
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(sections.size()); ++s) {
    boxes.push_back(sections[s].place.box);
    if (face_is_fresh_[sections[s].face]) jobs.push_back({s, s});
  }
  for (const auto& [s, t] : meeting_pairs(boxes)) {
    const FaceId f = sections[s].face, g = sections[t].face;
    if ((face_is_fresh_[f] || face_is_fresh_[g]) && (face_body_[f] == face_body_[g] || may_be_apart(f, g)))
      jobs.push_back({s, t});
  }
  return jobs;
}

/// Collective. Of rank 0's places, on every rank.
std::vector<PlacedPatch> CrossingSearch::sections_of(const std::vector<FacePlace>& places) const {
  std::vector<PlacedPatch> sections;
  if (executor_.is_root())
    for (std::size_t f = 0; f < places.size(); ++f)
      for (const PatchPlace& place : places[f].sections)
        if (place.is_there()) sections.push_back({static_cast<FaceId>(f), place});
  share(executor_, sections);
  return sections;
}

void CrossingSearch::run(const BoundaryNumbering& numbering, const std::vector<FacePlace>& places) {
  const std::vector<PlacedPatch> sections = sections_of(places);
  std::vector<Job> jobs;
  if (executor_.is_root()) jobs = jobs_of(sections);
  share(executor_, jobs);
  const Search search{store_, executor_, numbering, sections};
  const std::vector<Batch> batches = batches_of(
      jobs, [&](const Job& job) { return search.home(job); }, [&](const Job& job) { return search.weight(job); });
  NamedTasks tasks = tasks_of(batches, "crossings");
  tasks.answer = [&](const Bytes& request) { return search.answer(request); };
  std::erase_if(pairs_, [&](const FacetPair& p) { return face_is_fresh_[p.a.face] || face_is_fresh_[p.b.face]; });
  for (std::size_t f = 0; f < chords_.size(); ++f)
    if (face_is_fresh_[f]) chords_[f].clear();
  FacetPairs fresh;
  std::set<std::array<FaceId, 2>> ended;
  executor_.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        Found all;
        std::vector<Job> own;
        for (const std::size_t i : batches[task].jobs) own.push_back(jobs[i]);
        const std::vector<PatchPart> others = search.near_others(own);
        for (std::size_t i = 0; i < own.size(); ++i) {
          Found found = search.find(own[i], others[i]);
          measure_whole_faces(own[i], search, found);
          all.pairs.insert(all.pairs.end(), found.pairs.begin(), found.pairs.end());
          all.chords.insert(all.chords.end(), found.chords.begin(), found.chords.end());
          all.touching.insert(all.touching.end(), found.touching.begin(), found.touching.end());
          all.ended.insert(all.ended.end(), found.ended.begin(), found.ended.end());
        }
        return packed(all);
      },
      [&](std::int32_t, Bytes&& bytes) {
        Found found;
        unpack(bytes, found);
        fresh.insert(fresh.end(), found.pairs.begin(), found.pairs.end());
        for (const Chord& c : found.chords) chords_[c.facet.face].push_back(c);
        for (const auto& [a, b] : found.touching) touching_.insert({a, b});
        ended.insert(found.ended.begin(), found.ended.end());
      });
  say_ended(ended);
  if (executor_.is_root()) {
    std::vector<Chord> chords;
    for (const std::vector<Chord>& some : chords_) chords.insert(chords.end(), some.begin(), some.end());
    for (const auto& [a, b] : find_repeated_chords(std::move(chords), face_is_fresh_)) fresh.push_back({a, b, kHalve});
  }
  const auto in_order = [](const FacetPair& p, const FacetPair& q) { return p.key() < q.key(); };
  std::sort(fresh.begin(), fresh.end(), in_order);
  fresh = measured(fresh, search);
  pairs_.insert(pairs_.end(), fresh.begin(), fresh.end());
  std::sort(pairs_.begin(), pairs_.end(), in_order);
  std::fill(face_is_fresh_.begin(), face_is_fresh_.end(), 0);
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
std::vector<CrossingSearch::Corners> CrossingSearch::corners(std::vector<Facet> facets, const Search& search) const {
  share(executor_, facets);
  if (facets.empty()) return {};
  const std::vector<Batch> batches = batches_of(
      facets, [&](const Facet& f) { return search.sections[search.section_of(f)].place.rank; },
      [](const Facet&) { return 1; });
  std::vector<Corners> all(executor_.is_root() ? facets.size() : 0);
  executor_.run_named_tasks(
      tasks_of(batches, "corners"),
      [&](std::int32_t task) {
        std::vector<Corners> own;
        for (const std::size_t i : batches[task].jobs) own.push_back(search.corners(facets[i]));
        return packed(own);
      },
      [&](std::int32_t task, Bytes&& bytes) {
        std::vector<Corners> own;
        unpack(bytes, own);
        for (std::size_t k = 0; k < own.size(); ++k) all[batches[task].jobs[k]] = own[k];
      });
  return all;
}

/// The first pairs whose walls are not measured, and pairs from all over the others.
std::vector<RefinementPoint> CrossingSearch::places_to_refine(const BoundaryNumbering& numbering,
                                                              const std::vector<FacePlace>& places) {
  const std::vector<PlacedPatch> sections = sections_of(places);
  const Search search{store_, executor_, numbering, sections};
  std::vector<Facet> facets;
  std::vector<std::pair<double, double>> how;  // factor and triangles of each
  const auto add = [&](const FacetPair& p, double n_triangles) {
    for (const Facet& f : {p.a, p.b}) {
      facets.push_back(f);
      how.push_back({p.factor, n_triangles});
    }
  };
  FacetPairs apart;
  for (const FacetPair& p : pairs_) {
    if (p.a.face == p.b.face && face_is_given_up_[p.a.face]) continue;
    if (p.factor > 0) apart.push_back(p);
    if (p.factor == kHalve && facets.size() < kFacePolicy.max_crossing_places) add(p, 1);
  }
  const std::size_t step = 2 * apart.size() / Policy::kMaxWallPlaces + 1;
  for (std::size_t i = 0; i < apart.size(); i += step) add(apart[i], Policy::kAround * static_cast<double>(step));
  const std::vector<Corners> all = corners(std::move(facets), search);
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
RefinementPoint CrossingSearch::refinement_of(const Corners& t, double factor, double covering) {
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
         !touching_.contains(std::minmax(a, b));
}

/// Local. Walls that are whole are measured where they are compared: bodies in contact cross in many places.
void CrossingSearch::measure_whole_faces(const Job& job, const Search& search, Found& found) const {
  if (found.pairs.empty() || job.a == job.b || !search.is_whole(job.a) || !search.is_whole(job.b)) return;
  const FaceId a = search.sections[job.a].face, b = search.sections[job.b].face;
  if (share_a_vertex(model_.tables(), a, b)) return;
  std::sort(found.pairs.begin(), found.pairs.end(),
            [](const FacetPair& p, const FacetPair& q) { return p.key() < q.key(); });
  found.pairs = measured_pair_of_faces(std::move(found.pairs), search);
  if (found.pairs.empty()) found.touching.push_back({a, b});
}

/// Collective. With their factors, without pairs where two bodies meet. `pairs`: sorted, of rank 0.
CrossingSearch::FacetPairs CrossingSearch::measured(const FacetPairs& pairs, const Search& search) {
  const auto is_unknown = [](const FacetPair& p) { return p.factor == kUnknown; };
  FacetPairs known, unknown;  // those that share a vertex, and those whose walls are to be measured
  for (const FacetPairs& some : by_faces(pairs)) {
    const FaceId a = some[0].a.face, b = some[0].b.face;
    const bool is_known = a == b || std::ranges::none_of(some, is_unknown) || share_a_vertex(model_.tables(), a, b);
    for (FacetPair p : some) {
      if (is_known && p.factor == kUnknown) p.factor = kHalve;
      (is_known ? known : unknown).push_back(p);
    }
  }
  share(executor_, unknown);
  const std::vector<FacetPairs> groups = by_faces(unknown);
  if (groups.empty()) return known;
  const auto home = [&](const FacetPairs& p) { return search.sections[search.section_of(p[0].a)].place.rank; };
  const std::vector<Batch> batches =
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
        for (const std::size_t i : batches[task].jobs) touching_.insert({groups[i][0].a.face, groups[i][0].b.face});
        for (const FacetPair& p : kept) touching_.erase({p.a.face, p.b.face});
        known.insert(known.end(), kept.begin(), kept.end());
      });
  return known;
}

/// Sorted pairs, those of each two faces together.
std::vector<CrossingSearch::FacetPairs> CrossingSearch::by_faces(const FacetPairs& pairs) {
  std::vector<FacetPairs> groups;
  for (const FacetPair& p : pairs) {
    if (groups.empty() || groups.back()[0].a.face != p.a.face || groups.back()[0].b.face != p.b.face)
      groups.emplace_back();
    groups.back().push_back(p);
  }
  return groups;
}

/// Pairs of two faces, at a rank that has one of them. Where these are of two bodies, some places tell whether
/// the bodies meet everywhere.
CrossingSearch::FacetPairs CrossingSearch::measured_pair_of_faces(FacetPairs kept, const Search& search) const {
  constexpr std::size_t kTried = 16;  // of two bodies: none apart, and they meet
  constexpr std::size_t kMostMeasured = 1000;
  const FaceId a = kept[0].a.face, b = kept[0].b.face;
  const bool is_one_body = face_body_[a] == face_body_[b];
  const double tolerance = meeting_distance(model_.tables(), a, b);
  const auto factor_of = [&](const std::optional<WallGap>& gap) {
    if (gap && gap->is_apart) return gap->factor < Policy::kLeastFactor ? kHopeless : gap->factor;
    return is_one_body ? kHalve : kMeets;
  };
  const auto measure_every = [&](std::size_t step) {
    constexpr std::size_t kPerPiece = 2;  // each takes some tenths of a millisecond
    std::vector<std::size_t> some;
    std::vector<Facet> of_a, of_b;
    for (std::size_t i = 0; i < kept.size(); i += step) {
      if (kept[i].factor != kUnknown) continue;
      some.push_back(i);
      of_a.push_back(kept[i].a);
      of_b.push_back(kept[i].b);
    }
    const std::vector<Corners> at_a = search.corners(of_a), at_b = search.corners(of_b);
    parallel_for(some.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      const auto surface_a = model_.surface(a), surface_b = model_.surface(b);
      for (std::size_t i = begin; i < end; ++i)
        kept[some[i]].factor =
            factor_of(measure_gap(*surface_a, at_a[i].places, *surface_b, at_b[i].places, tolerance));
    });
  };
  if (!is_one_body) {
    measure_every(std::max<std::size_t>(1, kept.size() / kTried));
    if (std::all_of(kept.begin(), kept.end(),
                    [](const FacetPair& p) { return p.factor == kMeets || p.factor == kUnknown; }))
      return {};
  }
  measure_every(kept.size() / kMostMeasured + 1);
  for (FacetPair& p : kept)
    if (p.factor == kUnknown) p.factor = is_one_body ? kHalve : kMeets;
  std::erase_if(kept, [](const FacetPair& p) { return p.factor == kMeets; });
  return kept;
}

std::vector<std::int64_t> CrossingSearch::n_pairs_within() const {
  std::vector<std::int64_t> n(face_body_.size(), 0);
  for (const FacetPair& p : pairs_)
    if (p.a.face == p.b.face) ++n[p.a.face];
  return n;
}

std::vector<FaceId> CrossingSearch::crossing_faces(bool others_too) const {
  std::set<FaceId> faces;
  for (const FacetPair& p : pairs_)
    if (p.a.face == p.b.face || others_too) faces.insert({p.a.face, p.b.face});
  return {faces.begin(), faces.end()};
}

std::vector<FaceId> CrossingSearch::touching_faces() const {
  std::set<FaceId> faces;
  for (const auto& [a, b] : touching_) faces.insert({a, b});
  return {faces.begin(), faces.end()};
}

std::vector<std::size_t> CrossingSearch::crossing_in(FaceId f, bool others_too) const {
  std::set<std::size_t> triangles;
  for (const FacetPair& p : pairs_) {
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
  WeldedPatches m = weld_patches(numbering.edges, numbering.tables.vertex_xyz, welded);
  std::vector<TouchingPair> touching;
  for (const FacetPair& p : pairs_) {
    const Triangle &a = m.triangles[m.patch_begin[place.at(p.a.face)] + p.a.index],
                   &b = m.triangles[m.patch_begin[place.at(p.b.face)] + p.b.index];
    if (std::none_of(std::begin(a.n), std::end(a.n), [&](NodeId n) { return std::ranges::count(b.n, n) > 0; }))
      touching.push_back({a, b, meeting_distance(model_.tables(), p.a.face, p.b.face)});
  }
  std::vector<FaceId> changed;
  if (!st::move_touching_apart(touching, m.n_boundary, m.points)) return changed;
  for (auto& [f, patch] : patches) {
    const std::vector<Vec3> before = patch.inner_xyz;
    const std::size_t at = place[f];
    for (std::int32_t i = m.inner_begin[at]; i < m.inner_begin[at + 1]; ++i)
      patch.inner_xyz[m.inner[i]] = m.points[m.n_boundary + i];
    if (patch.inner_xyz != before) changed.push_back(f);
  }
  return changed;
}

}  // namespace st
