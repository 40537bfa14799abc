#include "features/strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/share.h"
#include "base/threads.h"
#include "features/arc_table.h"
#include "features/strip_shape.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr int kMinStations = 32;  // intervals of a strip
constexpr int kMaxStations = 2048;
constexpr double kStationTurning = radians(10);  // of a strip's edge, between two stations
constexpr int kTurningSamples = 512;             // of an edge
constexpr int kCrossingStations = 512;           // where edges are nearer than they are exact
constexpr double kRounding = 1e-6;               // of the length: a smaller overlap is none
constexpr double kNarrow = 0.25;                 // of its length: wider faces are no strips
constexpr double kAlike = 0.2;                   // of its length: how much longer or shorter what lies across may be
constexpr double kEnd = 4;                       // widths: shorter edges are ends of a strip
constexpr double kShortEnd = 0.5;                // of the long edges: all other edges of a strip together are shorter
constexpr double kAlikeSides = 0.8;              // length of the shorter one over the longer one, at least

/// The two long edges of a face with one loop; false when there are no such two.
bool long_edges(const ModelTables& t, FaceId f, const std::vector<int>& uses, Strip& strip) {
  if (t.loops(f).size() != 1) return false;
  std::vector<EdgeId> edges(t.edges_of(f).begin(), t.edges_of(f).end());
  if (edges.size() < 2) return false;
  std::stable_sort(edges.begin(), edges.end(), [&](EdgeId a, EdgeId b) { return t.edge_length[a] > t.edge_length[b]; });
  double rest = 0;
  for (std::size_t i = 2; i < edges.size(); ++i) rest += t.edge_length[edges[i]];
  for (const EdgeId e : {edges[0], edges[1]})
    if (t.edge_is_degenerate[e] || t.edge_vertices[2 * e] == t.edge_vertices[2 * e + 1] || uses[e] != 2) return false;
  if (edges[0] == edges[1] || !are_long_sides(t.edge_length[edges[0]], t.edge_length[edges[1]], rest)) return false;
  strip.face = f;
  strip.edges[0] = std::min(edges[0], edges[1]);
  strip.edges[1] = std::max(edges[0], edges[1]);
  strip.length = t.edge_length[strip.edges[0]];
  return is_narrow(t.face_area[f], strip.length);
}

/// So many intervals that each turns little.
int count_stations(const Curve& curve) {
  std::array<Vec3, kTurningSamples + 1> d1;
  for (int i = 0; i <= kTurningSamples; ++i)
    d1[i] = curve.evaluate(curve.t_min() + (curve.t_max() - curve.t_min()) * i / kTurningSamples).d1;
  double turning = 0, at_most = 0;  // at most: tangents in place of angles
  for (int i = 0; i < kTurningSamples; ++i) {
    const double along = dot(d1[i], d1[i + 1]);
    at_most += along > 0 ? norm(cross(d1[i], d1[i + 1])) / along : kMaxStations * kStationTurning;
  }
  if (at_most < 0.99 * kMinStations * kStationTurning) return kMinStations;
  for (int i = 0; i < kTurningSamples; ++i) turning += angle_between(d1[i], d1[i + 1]);
  return std::clamp(static_cast<int>(std::ceil(turning / kStationTurning)), kMinStations, kMaxStations);
}

/// From x to the curve, near the parameter where its other edge is as long so far.
Vec3 way_across(Vec3 x, const Curve& other, double t) {
  const Vec3 facing = other.point(t) - x;
  const std::optional<double> foot = project_near(other, x, t);
  if (!foot) return facing;
  const Vec3 straight = other.point(std::clamp(*foot, other.t_min(), other.t_max())) - x;
  return norm2(straight) < norm2(facing) ? straight : facing;
}

/// At `n` equal shares of the lengths.
std::vector<Strip::Station> stations_of(const Curve& kept, const Curve& closed, bool is_opposed, int n) {
  const ArcTable a(kept), b(closed);
  std::vector<Strip::Station> stations;
  for (int i = 0; i <= n; ++i) {
    const double share = static_cast<double>(i) / n;
    const Vec3 x = kept.point(a.parameter_at(share));
    stations.push_back({x, way_across(x, closed, b.parameter_at(is_opposed ? 1 - share : share))});
  }
  return stations;
}

/// The largest width on the smaller side, where the edges cross: there the way across points back.
double largest_overlap(const std::vector<Strip::Station>& stations) {
  double largest[2] = {0, 0}, area[2] = {0, 0};
  int side = 0;
  Vec3 last{};
  for (const Strip::Station& s : stations) {
    if (!(s.width() > 0)) continue;
    if (dot(last, s.across) < 0) side = 1 - side;
    last = s.across;
    largest[side] = std::max(largest[side], s.width());
    area[side] += s.width();
  }
  return largest[area[0] > area[1]];
}

/// Edges that cross are one where they are no further apart than both are exact. What is more than that the wrong way
/// round is a fault of its own.
void measure_crossing(const ModelTables& t, const Curve& kept, const Curve& closed, Strip& strip) {
  const double tolerance = t.edge_tolerance[strip.edges[0]] + t.edge_tolerance[strip.edges[1]];
  const auto is_exact = [&](const Strip::Station& s) { return s.width() > tolerance; };
  if (std::all_of(strip.stations.begin(), strip.stations.end(), is_exact)) return;
  std::vector<Strip::Station> fine =
      stations_of(kept, closed, strip.is_opposed, std::max(kCrossingStations, static_cast<int>(strip.stations.size())));
  const double overlap = largest_overlap(fine);
  if (overlap <= kRounding * strip.length || overlap > tolerance) return;
  strip.exact = tolerance;
  strip.stations = std::move(fine);
}

void measure_widths(const Model& model, Strip& strip) {
  const auto kept = model.curve(strip.edges[0]), closed = model.curve(strip.edges[1]);
  strip.stations = stations_between(*kept, *closed, strip.is_opposed);
  measure_crossing(model.tables(), *kept, *closed, strip);
}

void measure_strip(const Model& model, Strip& strip) {
  const ModelTables& t = model.tables();
  const auto end = [&](EdgeId e, int k) { return t.vertex_xyz[t.edge_vertices[2 * e + k]]; };
  strip.is_opposed = distance(end(strip.edges[0], 0), end(strip.edges[1], 1)) +
                         distance(end(strip.edges[0], 1), end(strip.edges[1], 0)) <
                     distance(end(strip.edges[0], 0), end(strip.edges[1], 0)) +
                         distance(end(strip.edges[0], 1), end(strip.edges[1], 1));
  measure_widths(model, strip);
}

/// The two closed edges of a face that has no others but a seam; false when there are no such two.
bool closed_edges(const ModelTables& t, FaceId f, const std::vector<int>& uses, Strip& strip) {
  std::vector<EdgeId> closed;
  for (const CoedgeId c : t.coedges(f)) {
    const EdgeId e = t.coedge_edge[c];
    if (std::ranges::count(t.edges_of(f), e) == 2) continue;  // a seam
    if (t.edge_is_degenerate[e] || t.edge_vertices[2 * e] != t.edge_vertices[2 * e + 1] || uses[e] != 2) return false;
    closed.push_back(e);
  }
  if (closed.size() != 2) return false;
  strip.face = f;
  strip.edges[0] = std::min(closed[0], closed[1]);
  strip.edges[1] = std::max(closed[0], closed[1]);
  strip.length = t.edge_length[strip.edges[0]];
  return is_narrow(t.face_area[f], strip.length);
}

/// Closed edges may begin anywhere.
void measure_ring(const Model& model, Strip& ring) {
  const auto kept = model.curve(ring.edges[0]), closed = model.curve(ring.edges[1]);
  const ArcTable arc(*kept);
  const int n = count_stations(*kept);
  for (int i = 0; i <= n; ++i) {
    const Vec3 x = kept->point(arc.parameter_at(static_cast<double>(i) / n));
    ring.stations.push_back({x, closest_point(*closed, x).x - x});
  }
  const CurvePoint start = kept->evaluate(kept->t_min());
  ring.is_opposed = dot(start.d1, closed->evaluate(closest_point(*closed, start.x).t).d1) < 0;
}

/// The coedges of a loop after `single`, without short ones at both ends.
std::vector<CoedgeId> edges_across(const ModelTables& t, IdRange loop, CoedgeId single, double width) {
  std::vector<CoedgeId> rest;
  for (CoedgeId i = 1; i < loop.size(); ++i) rest.push_back(loop.first() + (single - loop.first() + i) % loop.size());
  const auto is_end = [&](CoedgeId c) { return t.edge_length[t.coedge_edge[c]] < kEnd * width; };
  while (!rest.empty() && is_end(rest.back())) rest.pop_back();
  rest.erase(rest.begin(), std::find_if_not(rest.begin(), rest.end(), is_end));
  return rest;
}

/// Of a face with one loop; false when it is none.
bool find_sides(const ModelTables& t, FaceId f, const std::vector<int>& uses, StripSides& strip) {
  if (t.loops(f).size() != 1 || t.coedges(f).empty()) return false;
  const IdRange loop = t.coedges(f);
  const auto edge = [&](CoedgeId c) { return t.coedge_edge[c]; };
  CoedgeId single = loop.first();
  for (const CoedgeId c : loop)
    if (t.edge_length[edge(c)] > t.edge_length[edge(single)]) single = c;
  const double length = t.edge_length[edge(single)];
  if (!is_narrow(t.face_area[f], length)) return false;
  strip = {f, edge(single), {}, t.face_area[f] / length};
  std::vector<CoedgeId> across = edges_across(t, loop, single, strip.width);
  double sum = 0;
  for (const CoedgeId c : across) sum += t.edge_length[edge(c)];
  if (std::abs(sum - length) > kAlike * length) return false;
  const auto is_side = [&](CoedgeId c) {
    const EdgeId e = edge(c);
    return !t.edge_is_degenerate[e] && t.edge_vertices[2 * e] != t.edge_vertices[2 * e + 1] && uses[e] == 2;
  };
  if (!is_side(single) || !std::all_of(across.begin(), across.end(), is_side)) return false;
  const auto is_reversed = [&](CoedgeId c) { return t.coedge_is_reversed[c] != 0; };
  for (const CoedgeId c : across) strip.across.push_back({edge(c), is_reversed(c) == is_reversed(single)});
  if (!is_reversed(single)) std::reverse(strip.across.begin(), strip.across.end());  // the loop comes back along it
  return true;
}

}  // namespace

Strip::Station Strip::at(double share) const {
  const double at = share * static_cast<double>(stations.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), stations.size() - 2);
  const Station &a = stations[i], &b = stations[i + 1];
  const double part = at - static_cast<double>(i);
  return {a.x + part * (b.x - a.x), a.across + part * (b.across - a.across)};
}

bool Strip::is_one_edge() const {
  return exact > 0 &&
         std::none_of(stations.begin(), stations.end(), [&](const Station& s) { return tells(s.width()); });
}

std::vector<StripSides> find_strip_sides(const ModelTables& tables) {
  const std::vector<int> uses = count_uses(tables);
  std::vector<StripSides> strips;
  for (FaceId f = 0; f < tables.n_faces(); ++f)
    if (StripSides strip; find_sides(tables, f, uses, strip)) strips.push_back(std::move(strip));
  return strips;
}

std::vector<int> count_uses(const ModelTables& t) {
  std::vector<int> uses(t.n_edges(), 0);
  for (const EdgeId e : t.coedge_edge) ++uses[e];
  return uses;
}

bool is_narrow(double area, double side) { return area < kNarrow * side * side; }

bool are_long_sides(double longer, double shorter, double ends) {
  return ends <= kShortEnd * shorter && shorter >= kAlikeSides * longer;
}

std::vector<Strip::Station> stations_between(const Curve& from, const Curve& to, bool is_opposed) {
  return stations_of(from, to, is_opposed, count_stations(from));
}

double strip_exactness(const Model& model, EdgeId first, EdgeId second, bool is_opposed) {
  Strip strip;
  strip.edges[0] = first, strip.edges[1] = second;
  strip.is_opposed = is_opposed;
  strip.length = model.tables().edge_length[first];
  measure_widths(model, strip);
  return strip.exact;
}

std::vector<Strip> find_rings(const Model& model) {
  const ModelTables& t = model.tables();
  const std::vector<int> uses = count_uses(t);
  std::vector<Strip> rings;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    Strip ring;
    if (!closed_edges(t, f, uses, ring)) continue;
    measure_ring(model, ring);
    rings.push_back(std::move(ring));
  }
  return rings;
}

Strip measured_strip(const Model& model, FaceId face, EdgeId a, EdgeId b) {
  Strip strip;
  strip.face = face;
  strip.edges[0] = std::min(a, b), strip.edges[1] = std::max(a, b);
  strip.length = model.tables().edge_length[strip.edges[0]];
  measure_strip(model, strip);
  return strip;
}

namespace {

/// Of the faces from `first` to the one before `last`.
std::vector<Strip> find_some_strips(const Model& model, const std::vector<int>& uses, std::size_t first,
                                    std::size_t last) {
  constexpr std::size_t kPerPiece = 16;
  std::vector<std::vector<Strip>> pieces((last - first) / kPerPiece + 1);
  parallel_for(last - first, kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Strip strip;
      if (!long_edges(model.tables(), static_cast<FaceId>(first + i), uses, strip)) continue;
      measure_strip(model, strip);
      pieces[begin / kPerPiece].push_back(std::move(strip));
    }
  });
  std::vector<Strip> strips;
  for (std::vector<Strip>& some : pieces) std::move(some.begin(), some.end(), std::back_inserter(strips));
  return strips;
}

}  // namespace

std::vector<Strip> find_strips(const Model& model, const Executor& executor) {
  const std::vector<int> uses = count_uses(model.tables());
  const auto n_faces = static_cast<std::size_t>(model.tables().n_faces());
  if (executor.size() == 1) return find_some_strips(model, uses, 0, n_faces);
  constexpr std::size_t kPerTask = 64;
  std::vector<std::vector<Strip>> parts((n_faces + kPerTask - 1) / kPerTask);
  executor.run_tasks(
      static_cast<std::int32_t>(parts.size()), heaviest_first(std::vector<double>(parts.size(), 1)),
      [&](std::int32_t task) {
        const std::size_t first = kPerTask * static_cast<std::size_t>(task);
        return packed(find_some_strips(model, uses, first, std::min(first + kPerTask, n_faces)));
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, parts[static_cast<std::size_t>(task)]); });
  std::vector<Strip> strips;
  for (std::vector<Strip>& some : parts) std::move(some.begin(), some.end(), std::back_inserter(strips));
  share(executor, strips);
  return strips;
}

}  // namespace st
