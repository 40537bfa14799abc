#include "stages/compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "base/threads.h"
#include "features/ridge_edges.h"
#include "features/smooth_edges.h"
#include "features/strip.h"
#include "geometry/model/edge_angles.h"
#include "geometry/model/edge_faces.h"
#include "geometry/model/joined_tables.h"
#include "io/foreign/triangulation_reader.h"
#include "stages/cad_view.h"
#include "stages/raster_options.h"

namespace st {
namespace {

constexpr double kSharpCorner = radians(25);  // a triangle in it has no larger angle
constexpr double kShort = 0.7;                // of the length: an edge or a width below it spoils triangles
constexpr double kAcross = 1.5;               // widths: an edge across a narrow face is no longer
constexpr double kMostEnds = 0.5;             // of its longest edge: edges at the ends of a strip together
constexpr double kKnifeDeg = 120;             // between normals: a fold to whoever reads the mesh face by face
constexpr double kChartDeflection = 1e-3;     // of the diagonal
constexpr double kChartAngle = radians(12);

/// Marks edges that groups, also of their vertices, and names keep.
std::vector<std::uint8_t> kept_edges(const ModelTables& t) {
  std::vector<std::uint8_t> is_kept(static_cast<std::size_t>(t.n_edges()), 0);
  for (EdgeId e = 0; e < t.n_edges(); ++e) is_kept[e] = !t.edge_name[e].empty();
  for (const EntityGroup& g : t.labels.edge_groups)
    for (const EdgeId e : g.ids) is_kept[e] = 1;
  std::vector<std::uint8_t> is_grouped(static_cast<std::size_t>(t.n_vertices()), 0);
  for (const EntityGroup& g : t.labels.vertex_groups)
    for (const VertexId v : g.ids) is_grouped[v] = 1;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (const std::size_t k : {0, 1})
      if (const VertexId v = t.edge_vertices[2 * static_cast<std::size_t>(e) + k]; v != kNone && is_grouped[v])
        is_kept[e] = 1;
  return is_kept;
}

/// Whether everything said of two faces is the same.
bool are_alike(const ModelTables& t, FaceId a, FaceId b) {
  const FaceLabels& l = t.labels;
  return a != b && l.face_group[a] == l.face_group[b] && (l.face_part.empty() || l.face_part[a] == l.face_part[b]) &&
         t.face_solid[a] == t.face_solid[b] && t.face_shell[a] == t.face_shell[b] &&
         std::ranges::all_of(l.tables,
                             [&](const GroupTable& table) { return table.face_group[a] == table.face_group[b]; });
}

/// Marks edges between two faces that are alike, smooth or not.
std::vector<std::uint8_t> edges_inside(const ModelTables& t) {
  std::vector<std::uint8_t> is_inside(static_cast<std::size_t>(t.n_edges()), 0);
  const std::vector<std::uint8_t> is_kept = kept_edges(t);
  const EdgeFaces faces_at(t);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    is_inside[e] = !is_kept[e] && !t.edge_is_degenerate[e] && faces_at[e].size() == 2 &&
                   are_alike(t, faces_at[e][0], faces_at[e][1]);
  return is_inside;
}

/// Finds smooth edges that force bad triangles. Whether an edge is smooth is asked last, where all else says so.
class HarmFinder {
 public:
  HarmFinder(const Model& cad, const std::vector<std::uint8_t>& is_inside, SmoothEdges& is_smooth)
      : cad_(cad),
        t_(cad.tables()),
        is_inside_(is_inside),
        is_smooth_(is_smooth),
        longest_(kDefaultMaxLength * t_.reference_diagonal()),
        harm_(static_cast<std::size_t>(t_.n_edges()), 0),
        length_(static_cast<std::size_t>(t_.n_edges()), 0) {
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      for (const CoedgeId c : t_.coedges(f)) uses_.emplace_back(t_.coedge_edge[c], std::pair(f, c));
    std::ranges::sort(uses_);
    parallel_for(static_cast<std::size_t>(t_.n_faces()), kFacesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (auto f = static_cast<FaceId>(begin); f < static_cast<FaceId>(end); ++f)
        if (std::ranges::any_of(t_.edges_of(f), [&](EdgeId e) { return is_inside_[e] != 0; })) judge(f);
    });
  }
  /// [n_edges] above 0 where an edge may be joined and does harm.
  std::vector<double> take() { return std::move(harm_); }

 private:
  static constexpr std::size_t kFacesPerPiece = 8;

  /// Two coedges of a loop that follow each other, and the vertex between them.
  struct Corner {
    VertexId vertex;
    CoedgeId in, out;
  };

  void judge(FaceId f) {
    std::vector<Corner> corners;
    for (const LoopId l : t_.loops(f)) {
      const IdRange loop = t_.loop_coedges(l);
      for (const CoedgeId c : loop) {
        if (t_.edge_is_degenerate[t_.coedge_edge[c]]) continue;
        const auto after = [&](CoedgeId at) { return loop.first() + (at - loop.first() + 1) % loop.size(); };
        CoedgeId next = after(c);
        while (t_.edge_is_degenerate[t_.coedge_edge[next]]) next = after(next);  // the corner is at a pole
        judge_corner(c, next);
        judge_width(f, c);
        corners.push_back({end_of(c), c, next});
      }
    }
    judge_contacts(corners);
  }

  /// Where loops touch, the face has a corner on either side, between edges of both.
  void judge_contacts(std::vector<Corner>& corners) {
    std::ranges::stable_sort(corners, {}, &Corner::vertex);
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t k = i + 1; k < corners.size() && corners[k].vertex == corners[i].vertex; ++k) {
        judge_corner(corners[i].in, corners[k].out);
        judge_corner(corners[k].in, corners[i].out);
      }
  }

  VertexId end_of(CoedgeId c) const {
    return t_.edge_vertices[2 * static_cast<std::size_t>(t_.coedge_edge[c]) + (t_.coedge_is_reversed[c] ? 0 : 1)];
  }

  /// Whole numbers: the sum does not depend on their order.
  void add_harm(EdgeId e, double harm) {
    if (harm > 0) std::atomic_ref(harm_[e]).fetch_add(harm, std::memory_order_relaxed);
  }

  bool may_join(EdgeId e) { return is_inside_[e] && is_smooth_(e); }

  /// Whether this is too short beside the edge, which may go.
  bool is_short(double length, EdgeId e) {
    return is_inside_[e] && length < kShort * longest_ && may_join(e) && length < kShort * length_at(e);
  }

  /// Away from the vertex between two coedges.
  Vec3 direction(CoedgeId c, bool is_end) const {
    const auto curve = cad_.curve(t_.coedge_edge[c]);
    const bool at_last = (t_.coedge_is_reversed[c] != 0) != is_end;
    const Vec3 d = curve->evaluate(at_last ? curve->t_max() : curve->t_min()).d1;
    return at_last ? -d : d;
  }

  void judge_corner(CoedgeId c, CoedgeId next) {
    const EdgeId a = t_.coedge_edge[c], b = t_.coedge_edge[next];
    if (a == b || (!is_inside_[a] && !is_inside_[b])) return;
    if (angle_between(direction(c, true), direction(next, false)) < kSharpCorner)
      for (const EdgeId e : {a, b}) add_harm(e, may_join(e) ? 1 : 0);
    for (const auto& [own, other] : {std::pair{a, b}, std::pair{b, a}})
      add_harm(own, is_short(t_.edge_length[other], own) ? 1 : 0);
  }

  /// Beyond an edge across a narrow face it is as narrow.
  void judge_width(FaceId f, CoedgeId c) {
    const EdgeId e = t_.coedge_edge[c];
    if (t_.edge_length[e] > kAcross * t_.face_width[f] && is_short(t_.face_width[f], e)) add_harm(e, 2);
  }

  /// What st-raster would ask for at an edge by default, about.
  double length_at(EdgeId e) {
    const std::atomic_ref known(length_[e]);  // two threads may measure one edge: they find the same
    double length = known.load(std::memory_order_relaxed);
    if (length > 0) return length;
    length = longest_;
    constexpr int kPlaces = 3;
    const auto [first, last] = std::equal_range(uses_.begin(), uses_.end(), std::pair(e, std::pair(0, 0)),
                                                [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto use = first; use != last; ++use) {
      const auto [f, c] = use->second;
      const auto surface = cad_.surface(f);
      const auto pcurve = cad_.pcurve(f, c);
      const double* range = &t_.edge_range[2 * static_cast<std::size_t>(e)];
      for (int i = 0; i < kPlaces; ++i) {
        const double k =
            std::abs(principal_curvature(
                         surface->evaluate2(pcurve->point(range[0] + (i + 0.5) / kPlaces * (range[1] - range[0]))))
                         .k1);
        if (k > 0) length = std::min(length, 2 * std::sin(0.5 * radians(RasterStageOptions().alpha_deg)) / k);
      }
    }
    known.store(length, std::memory_order_relaxed);
    return length;
  }

  const Model& cad_;
  const ModelTables& t_;
  const std::vector<std::uint8_t>& is_inside_;
  SmoothEdges& is_smooth_;
  double longest_;  // length that st-raster asks for where nothing is curved
  std::vector<double> harm_;
  std::vector<double> length_;                                        // of each edge, 0: not yet known
  std::vector<std::pair<EdgeId, std::pair<FaceId, CoedgeId>>> uses_;  // ascending
};

/// Keeps smooth edges between faces that some edge is to go from: others are in no composite.
void keep_smooth(const ModelTables& t, JoinRequest& request, SmoothEdges& is_smooth) {
  const EdgeFaces faces_at(t);
  std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(t.n_faces()), 0);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (request.may_join[e] && request.urgency[e] > 0)
      for (const FaceId f : faces_at[e]) is_wanted[f] = 1;
  constexpr std::size_t kEdgesPerPiece = 16;
  parallel_for(request.may_join.size(), kEdgesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (auto e = static_cast<EdgeId>(begin); e < static_cast<EdgeId>(end); ++e)
      request.may_join[e] = request.may_join[e] &&
                            std::ranges::all_of(faces_at[e], [&](FaceId f) { return is_wanted[f] != 0; }) &&
                            is_smooth(e);
  });
}

/// Takes an edge out of what may be joined; says so where it does harm.
void keep(const ModelTables& t, EdgeId e, const char* why, JoinRequest& request) {
  if (request.may_join[e] && request.urgency[e] > 0) log_info("  stays: " + t.edge_label(e) + ": " + why);
  request.may_join[e] = 0;
}

/// Whether the sides of a strip face each other along most of its rim: those of a crescent do not.
bool has_short_ends(const ModelTables& t, const StripSides& strip) {
  double sides = t.edge_length[strip.single], rim = 0;
  for (const StripSides::Side& side : strip.across) sides += t.edge_length[side.edge];
  for (const EdgeId e : t.edges_of(strip.face)) rim += t.edge_length[e];
  return rim - sides <= kMostEnds * t.edge_length[strip.single];
}

/// Narrow faces between edges that stay are apart: their widths ask for lengths, and those of a composite would not.
/// A narrower one across their end may go on in them.
void keep_strips(const ModelTables& t, JoinRequest& request) {
  std::vector<StripSides> strips = find_strip_sides(t);
  std::erase_if(strips, [&](const StripSides& strip) { return !has_short_ends(t, strip); });
  // [n_edges] width of a strip beside the edge
  std::vector<double> across(static_cast<std::size_t>(t.n_edges()), std::numeric_limits<double>::infinity());
  const auto narrow = [&](EdgeId side, double width) { across[side] = std::min(across[side], width); };
  for (const StripSides& strip : strips) {
    narrow(strip.single, strip.width);
    for (const StripSides::Side& side : strip.across) narrow(side.edge, strip.width);
  }
  for (const StripSides& strip : strips) {
    const auto stays = [&](const StripSides::Side& side) { return !request.may_join[side.edge]; };
    if (request.may_join[strip.single] || !std::ranges::all_of(strip.across, stays)) continue;
    for (const EdgeId e : t.edges_of(strip.face))
      if (!(across[e] < kShort * strip.width)) keep(t, e, "its face is narrow between edges that stay", request);
  }
}

/// Keeps smooth edges, the least urgent, by which both sides of a knife edge, such as a trailing edge, would be one
/// face.
void keep_between_knives(const Model& cad, JoinRequest& request) {
  const EdgeFaces faces_at(cad.tables());
  EdgeAngles angles(cad, kKnifeDeg);
  std::vector<EdgeId> joins, knives;
  for (EdgeId e = 0; e < cad.tables().n_edges(); ++e)
    if (request.may_join[e])
      joins.push_back(e);
    else if (faces_at[e].size() == 2 && angles.largest_deg(e) > kKnifeDeg)
      knives.push_back(e);
  std::ranges::stable_sort(joins, [&](EdgeId a, EdgeId b) { return request.urgency[a] > request.urgency[b]; });
  DisjointSets sets(cad.tables().n_faces());
  const auto sides = [&](EdgeId e) { return std::minmax({sets.find(faces_at[e][0]), sets.find(faces_at[e][1])}); };
  for (const EdgeId e : joins) {
    const auto own = sides(e);
    if (own.first != own.second && std::ranges::any_of(knives, [&](EdgeId k) { return sides(k) == own; }))
      keep(cad.tables(), e, "both sides of a knife edge would be one face", request);
    else
      sets.join(own.first, own.second);
  }
}

/// "3 faces and 7 edges after joining (12 faces became 2)" and what was refused, by reason; each composite that was
/// divided or refused is logged.
std::string said(const GeometryArtifact& geometry, const FoundComposites& found) {
  std::map<std::string, int> reasons;
  for (const std::string& why : found.divided) log_info("  divided: " + why);
  for (const std::string& why : found.refused) {
    log_info("  not joined: " + why);
    ++reasons[why.substr(std::min(why.size(), why.find("): ") + 3))];
  }
  const Composites& c = geometry.composites;
  const EntityCounts left = count_left(geometry.tables);
  std::string text = c.empty() ? "no faces joined"
                               : fmt::format("{} faces and {} edges after joining ({} faces became {})", left.faces,
                                             left.edges, c.member.size(), c.size());
  for (const auto& [why, n] : reasons) text += fmt::format(", {} refused: {}", n, why);
  return text;
}

}  // namespace

bool asks_for_composites(const std::string& word, const std::string& path) {
  if (word != "none" && word != "harm" && word != "smooth")
    throw Error(ExitCode::kUsage, "--composite " + word + ": give none, harm or smooth");
  if (word != "none" && !triangulation_format(path).empty())
    throw Error(ExitCode::kUsage, path + ": --composite needs a CAD model, and this file has facets");
  return word != "none";
}

JoinRequest join_request(const Model& cad, bool is_harm_only) {
  const ModelTables& t = cad.tables();
  JoinRequest request;
  SmoothEdges is_smooth(cad);
  request.may_join = edges_inside(t);
  request.urgency = is_harm_only ? HarmFinder(cad, request.may_join, is_smooth).take() : t.edge_length;
  keep_smooth(t, request, is_smooth);
  if (is_harm_only) keep_strips(t, request);
  if (std::ranges::count(request.may_join, 1) == 0) return request;
  for (const WingEdge& w : wing_edges_to_see(cad)) keep(t, w.edge, "a leading or trailing edge", request);
  const std::vector<std::uint8_t> is_ridge = find_ridge_edges(cad, request.may_join);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (is_ridge[e]) keep(t, e, "along a nose", request);
  if (!is_harm_only) keep_between_knives(cad, request);
  request.must_end.assign(static_cast<std::size_t>(t.n_vertices()), 0);
  for (const EntityGroup& g : t.labels.vertex_groups)
    for (const VertexId v : g.ids) request.must_end[v] = 1;
  for (const EntityGroup& g : t.labels.edge_groups)
    for (const EdgeId e : g.ids)
      for (const std::size_t k : {0, 1}) request.must_end[t.edge_vertices[2 * static_cast<std::size_t>(e) + k]] = 1;
  request.facets = {.deflection = kChartDeflection * t.reference_diagonal(), .angle = kChartAngle, .is_exact = false};
  return request;
}

std::string compose(GeometryArtifact& geometry, bool is_harm_only) {
  FoundComposites found;
  {
    Progress progress("joining faces", 1);
    progress.step("charts", 0);
    const Model cad(geometry.tables, geometry.brep);
    JoinRequest request = join_request(cad, is_harm_only);
    found = find_composites(cad, request);
    for (EdgeId e = 0; e < geometry.tables.n_edges(); ++e)
      if (!std::ranges::binary_search(found.composites.joined_edges, e))
        keep(geometry.tables, e, "its faces cannot be one", request);
  }
  if (!found.composites.empty()) {
    geometry.composites = std::move(found.composites);
    ModelTables joined = join_tables(geometry.tables, geometry.composites).tables;
    geometry.cad = std::exchange(geometry.tables, std::move(joined));
  }
  return said(geometry, found);
}

}  // namespace st
