#include "geometry/model/composite_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "base/sort_once.h"
#include "base/text.h"
#include "geometry/model/chart_alignment.h"
#include "geometry/model/passed_vertices.h"
#include "geometry/model/uv_facets.h"
#include "geometry/shape/chain_curve.h"
#include "geometry/shape/composite_surface.h"
#include "geometry/shape/flatten.h"

namespace st {
namespace {

constexpr std::size_t kMostFacets = 20000;  // of a chart: flatten_whole() takes no more
constexpr std::size_t kFew = 8;     // faces: a composite of so many loses its least urgent one, else half of them
constexpr double kMostBulge = 0.6;  // of its chord: how far a trimming curve leaves a chart's rim
constexpr double kOffRim = 1e-2;    // of its chord: how far a chart may be off an edge, more than its face

/// Facets of several faces, with nodes of their own.
struct FacetsOfMany {
  std::vector<std::int32_t> triangles;  ///< of the facets
  std::vector<Corners> corners;
  std::vector<Vec3> x;
  PatchTopology topology;
};

class CompositeFinder {
 public:
  CompositeFinder(const Model& cad, const JoinRequest& request)
      : cad_(cad),
        t_(cad.tables()),
        request_(request),
        uses_(static_cast<std::size_t>(t_.n_edges())),
        face_of_coedge_(static_cast<std::size_t>(t_.n_coedges())),
        is_joined_(static_cast<std::size_t>(t_.n_edges()), 0),
        part_of_(static_cast<std::size_t>(t_.n_faces())),
        parts_(static_cast<std::size_t>(t_.n_faces())) {}

  FoundComposites run() {
    find_uses();
    make_facets();
    std::vector<EdgeId> all;
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (can_join_[e]) all.push_back(e);
    grow(all, t_.n_faces());
    std::vector<std::vector<FaceId>> work = whole_parts(all);
    while (!work.empty()) {
      const std::vector<FaceId> faces = std::move(work.back());
      work.pop_back();
      const std::string why = accept(faces);
      if (why.empty()) continue;
      const std::vector<EdgeId> inside = dissolve(faces);
      grow(inside, static_cast<std::int32_t>(faces.size() <= kFew ? faces.size() - 1 : (faces.size() + 1) / 2));
      std::vector<std::vector<FaceId>> parts = whole_parts(inside);
      (parts.empty() ? found_.refused : found_.divided).push_back(named(faces) + ": " + why);
      for (auto& part : parts) work.push_back(std::move(part));
    }
    finish();
    return std::move(found_);
  }

 private:
  void find_uses() {
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      for (const CoedgeId c : t_.coedges(f)) {
        uses_[t_.coedge_edge[c]].push_back(c);
        face_of_coedge_[c] = f;
      }
  }

  FaceId side(EdgeId e, int k) const { return face_of_coedge_[uses_[e][k]]; }

  void make_facets() {
    std::vector<std::uint8_t> is_wanted(part_of_.size(), 0);
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (request_.may_join[e] && request_.urgency[e] > 0)  // other faces are in no composite
        for (const int k : {0, 1}) is_wanted[side(e, k)] = 1;
    facets_ = make_uv_facets(cad_, is_wanted, request_.facets);
    for (const FaceId f : facets_.turned) {  // each composite with it would fail
      for (const CoedgeId c : t_.coedges(f)) facets_.rim_side[c].clear();
      found_.refused.push_back(named({f}) + ": its facets turn away from it");
    }
    across_.assign(facets_.mate.size(), kNone);
    can_join_.assign(static_cast<std::size_t>(t_.n_edges()), 0);
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      if (!request_.may_join[e]) continue;
      const auto &a = facets_.rim_side[uses_[e][0]], &b = facets_.rim_side[uses_[e][1]];
      if (a.empty() || !std::ranges::equal(a, b, [&](auto s, auto o) { return facets_.fit(s, o); })) continue;
      can_join_[e] = 1;
      for (std::size_t i = 0; i < a.size(); ++i) across_[a[i]] = b[i], across_[b[i]] = a[i];
    }
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      part_of_[f] = f, parts_[f] = {f};
      if (is_wanted[f] && facets_.face_offsets[f] == facets_.face_offsets[f + 1])
        found_.refused.push_back(named({f}) + ": no facets fill it");
    }
  }

  void grow(std::vector<EdgeId> edges, std::int32_t most_faces) {
    std::erase_if(edges, [&](EdgeId e) { return !(request_.urgency[e] > 0); });
    std::ranges::stable_sort(edges, [&](EdgeId a, EdgeId b) { return request_.urgency[a] > request_.urgency[b]; });
    for (const EdgeId e : edges)
      if (!is_joined_[e]) try_edge(e, most_faces);
  }

  /// Parts of more than one face that these edges lie in, by their lowest face.
  std::vector<std::vector<FaceId>> whole_parts(const std::vector<EdgeId>& edges) const {
    std::vector<FaceId> lowest;
    for (const EdgeId e : edges)
      for (const int k : {0, 1}) lowest.push_back(part_of_[side(e, k)]);
    sort_once(lowest);
    std::vector<std::vector<FaceId>> result;
    for (const FaceId f : lowest)
      if (parts_[f].size() > 1) result.push_back(parts_[f]);
    return result;
  }

  /// Edges that may be joined between faces of these two parts, but `e`.
  std::vector<EdgeId> edges_between(FaceId a, FaceId b, EdgeId e) const {
    std::vector<EdgeId> edges;
    const FaceId small = parts_[a].size() <= parts_[b].size() ? a : b;
    for (const FaceId f : parts_[small])
      for (const EdgeId c : t_.edges_of(f)) {
        if (c == e || !can_join_[c] || is_joined_[c]) continue;
        const FaceId p = part_of_[side(c, 0)], q = part_of_[side(c, 1)];
        if ((p == a && q == b) || (p == b && q == a)) edges.push_back(c);
      }
    sort_once(edges);
    return edges;
  }

  void set(const std::vector<EdgeId>& edges, std::uint8_t value) {
    for (const EdgeId e : edges) is_joined_[e] = value;
  }

  /// Joins the parts at `e` where they are usable as one: with all edges between them, else with `e` and what still can
  /// go.
  void try_edge(EdgeId e, std::int32_t most_faces) {
    const FaceId a = part_of_[side(e, 0)], b = part_of_[side(e, 1)];
    if (a == b || static_cast<std::int32_t>(parts_[a].size() + parts_[b].size()) > most_faces) return;
    std::vector<FaceId> faces = parts_[a];
    faces.insert(faces.end(), parts_[b].begin(), parts_[b].end());
    std::ranges::sort(faces);
    const std::vector<EdgeId> others = edges_between(a, b, e);
    is_joined_[e] = 1;
    set(others, 1);
    bool is_ok = is_usable(faces);
    if (!is_ok && !others.empty()) {
      set(others, 0);
      is_ok = is_usable(faces);
      for (std::size_t i = 0; is_ok && i < others.size(); ++i) {
        is_joined_[others[i]] = 1;
        if (!is_usable(faces)) is_joined_[others[i]] = 0;
      }
    }
    if (!is_ok) return set(others, 0), set({e}, 0);
    const FaceId keep = std::min(a, b), gone = std::max(a, b);
    for (const FaceId f : faces) part_of_[f] = keep;
    parts_[gone].clear();
    parts_[keep] = std::move(faces);
  }

  /// Single faces again; the edges that were inside.
  std::vector<EdgeId> dissolve(const std::vector<FaceId>& faces) {
    std::vector<EdgeId> inside;
    for (const FaceId f : faces)
      for (const EdgeId e : t_.edges_of(f))
        if (can_join_[e] && std::ranges::binary_search(faces, side(e, 0)) &&
            std::ranges::binary_search(faces, side(e, 1)))
          inside.push_back(e);
    sort_once(inside);
    set(inside, 0);
    for (const FaceId f : faces) parts_[part_of_[f] = f] = {f};
    return inside;
  }

  FacetsOfMany unite(const std::vector<FaceId>& faces) const {
    FacetsOfMany u;
    std::vector<std::int32_t> shift(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      shift[i] = static_cast<std::int32_t>(u.triangles.size()) - facets_.face_offsets[faces[i]];
      for (std::int32_t t = facets_.face_offsets[faces[i]]; t < facets_.face_offsets[faces[i] + 1]; ++t)
        u.triangles.push_back(t);
    }
    DisjointSets sets(3 * static_cast<std::int64_t>(u.triangles.size()));
    const auto join = [&](std::int32_t s, std::int32_t o) {
      const auto own = [&](std::int32_t side) {
        const FaceId f = facets_.face[static_cast<std::size_t>(side / 3)];
        const auto at = std::ranges::lower_bound(faces, f) - faces.begin();
        return side + 3 * shift[static_cast<std::size_t>(at)];
      };
      const std::int32_t i = own(s), j = own(o);
      sets.join(i, j / 3 * 3 + (j + 1) % 3);
      sets.join(i / 3 * 3 + (i + 1) % 3, j);
    };
    for (const std::int32_t t : u.triangles)
      for (std::int32_t s = 3 * t; s < 3 * t + 3; ++s)
        if (facets_.mate[s] > s) join(s, facets_.mate[s]);
    for (const FaceId f : faces)
      for (const CoedgeId c : t_.coedges(f))
        if (is_joined_[t_.coedge_edge[c]] && uses_[t_.coedge_edge[c]][0] == c)
          for (const std::int32_t s : facets_.rim_side[c]) join(s, across_[s]);
    number(sets, u);
    u.topology = find_topology(u.x, u.corners);
    return u;
  }

  void number(DisjointSets& sets, FacetsOfMany& u) const {
    std::vector<std::int32_t> number(3 * u.triangles.size(), kNone);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(u.triangles.size()); ++i) {
      Corners own{};
      for (int k = 0; k < 3; ++k) {
        std::int32_t& id = number[static_cast<std::size_t>(sets.find(3 * i + k))];
        if (id == kNone) {
          id = static_cast<std::int32_t>(u.x.size());
          u.x.push_back(facets_.x[static_cast<std::size_t>(facets_.corners[u.triangles[i]][k])]);
        }
        own[k] = id;
      }
      u.corners.push_back(own);
    }
  }

  bool is_usable(const std::vector<FaceId>& faces) const {
    std::size_t n = 0;
    for (const FaceId f : faces) n += static_cast<std::size_t>(facets_.face_offsets[f + 1] - facets_.face_offsets[f]);
    if (n > kMostFacets) return false;
    const FacetsOfMany u = unite(faces);
    return is_disc_with_holes(u.topology) && is_shallow(u.x, u.corners, u.topology);
  }

  /// "7 faces (1, 2, 3, 4, 5 ...)".
  static std::string named(const std::vector<FaceId>& faces) {
    std::string ids = fmt::format("{} ({}", counted(static_cast<std::int64_t>(faces.size()), "face"), faces[0] + 1);
    constexpr std::size_t kNamed = 5;
    for (std::size_t i = 1; i < std::min(faces.size(), kNamed); ++i) ids += fmt::format(", {}", faces[i] + 1);
    return ids + (faces.size() > kNamed ? " ...)" : ")");
  }

  /// Why these faces cannot be one, empty where they are from here on.
  std::string accept(const std::vector<FaceId>& faces) {
    const FacetsOfMany u = unite(faces);
    auto uv = flatten_whole(u.x, u.corners, u.topology);
    if (!uv) return "they cannot be laid into a plane";
    align_chart(cad_, facets_, u.triangles, u.x, u.corners, *uv);
    Chart chart{u.x, {}, *uv, u.corners};
    std::vector<Rim> rims = rims_of(faces, u);
    const std::string why = fault(faces, u, chart, rims);
    if (why.empty()) record(faces, u, chart, rims);
    return why;
  }

  struct Rim {
    CoedgeId coedge;
    std::vector<std::int32_t> node, triangle;  ///< within the composite
  };

  std::vector<Rim> rims_of(const std::vector<FaceId>& faces, const FacetsOfMany& u) const {
    std::vector<Rim> rims;
    std::vector<std::int32_t> place(facets_.corners.size(), kNone);
    for (std::size_t i = 0; i < u.triangles.size(); ++i)
      place[static_cast<std::size_t>(u.triangles[i])] = static_cast<std::int32_t>(i);
    for (const FaceId f : faces)
      for (const CoedgeId c : t_.coedges(f)) {
        if (is_joined_[t_.coedge_edge[c]] || t_.edge_is_degenerate[t_.coedge_edge[c]]) continue;
        const bool is_reversed = (t_.coedge_is_reversed[c] != 0) != (t_.face_is_reversed[f] != 0);
        Rim rim{c, {}, {}};
        for (const std::int32_t s : facets_.rim_side[c]) {
          const std::int32_t t = place[static_cast<std::size_t>(s / 3)];
          const std::int32_t a = u.corners[t][s % 3], b = u.corners[t][(s + 1) % 3];
          rim.triangle.push_back(t);
          if (rim.node.empty()) rim.node.push_back(is_reversed ? b : a);
          rim.node.push_back(is_reversed ? a : b);
        }
        rim.triangle.push_back(kNone);
        rims.push_back(std::move(rim));
      }
    return rims;
  }

  /// Why the chart does not stand for its faces, empty where it does; bounds are those of the trimming curves.
  std::string fault(const std::vector<FaceId>& faces, const FacetsOfMany& u, const Chart& chart,
                    const std::vector<Rim>& rims) {
    CompositeSupport support;
    std::vector<std::unique_ptr<Surface>> members;
    for (const FaceId f : faces) members.push_back(cad_.surface(f));
    for (const std::int32_t t : u.triangles) {
      const auto at = std::ranges::lower_bound(faces, facets_.face[static_cast<std::size_t>(t)]) - faces.begin();
      support.member.push_back(static_cast<std::int32_t>(at));
      support.corner_uv.push_back(facets_.uv[static_cast<std::size_t>(t)]);
      support.pole.push_back(facets_.pole[static_cast<std::size_t>(t)]);
    }
    bounds_ = {};
    for (const Vec2 p : chart.uv) bounds_.add(p);
    const CompositeSurface surface(chart, std::move(support), std::move(members), {0, 1, 0, 1});
    if (!follows_facets(surface, chart)) return "their facets do not follow them";
    for (const Rim& rim : rims)
      if (!follows(surface, u, chart, rim))
        return fmt::format("the chart does not follow {}", t_.edge_label(t_.coedge_edge[rim.coedge]));
    return "";
  }

  bool follows(const CompositeSurface& surface, const FacetsOfMany& u, const Chart& chart, const Rim& rim) {
    const EdgeId e = t_.coedge_edge[rim.coedge];
    const auto face = cad_.surface(face_of_coedge_[rim.coedge]);
    const auto pcurve = cad_.pcurve(face_of_coedge_[rim.coedge], rim.coedge);
    const auto curve = cad_.curve(e);
    const std::vector<double>& t = facets_.rim_t[rim.coedge];
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      const Corners& n = chart.corners[static_cast<std::size_t>(rim.triangle[i])];
      const auto own = static_cast<std::size_t>(u.triangles[rim.triangle[i]]);
      const MemberMap map({chart.uv[n[0]], chart.uv[n[1]], chart.uv[n[2]]}, facets_.uv[own], facets_.pole[own]);
      const Vec2 a = chart.uv[rim.node[i]], b = chart.uv[rim.node[i + 1]];
      const double chord = norm(b - a);
      constexpr int kPlaces = 4;
      for (int k = 0; k <= kPlaces; ++k) {
        const double share = static_cast<double>(k) / kPlaces, at = t[i] + share * (t[i + 1] - t[i]);
        const Vec2 p = map.chart(pcurve->point(at));
        if (!(std::abs(cross(b - a, p - a)) <= kMostBulge * chord * chord)) return false;
        bounds_.add(p);
        const double most =
            std::max(kOffRim * distance(chart.x[rim.node[i]], chart.x[rim.node[i + 1]]), 2 * t_.edge_tolerance[e]);
        const Vec3 edge = curve->point(at);
        if (!(distance(surface.point(p), edge) <= most + distance(face->point(pcurve->point(at)), edge))) return false;
      }
    }
    return true;
  }

  void record(const std::vector<FaceId>& faces, const FacetsOfMany& u, const Chart& chart, std::vector<Rim>& rims) {
    Composites& c = found_.composites;
    c.member.insert(c.member.end(), faces.begin(), faces.end());
    c.member_offsets.push_back(static_cast<std::int32_t>(c.member.size()));
    for (const FaceId f : faces)
      for (const EdgeId e : t_.edges_of(f))
        if (is_joined_[e]) c.joined_edges.push_back(e);
    c.node_xyz.insert(c.node_xyz.end(), chart.x.begin(), chart.x.end());
    c.node_uv.insert(c.node_uv.end(), chart.uv.begin(), chart.uv.end());
    c.node_offsets.push_back(static_cast<std::int32_t>(c.node_xyz.size()));
    for (std::size_t i = 0; i < u.triangles.size(); ++i) {
      c.triangle_nodes.push_back(chart.corners[i]);
      c.triangle_face.push_back(facets_.face[static_cast<std::size_t>(u.triangles[i])]);
      c.triangle_uv.push_back(facets_.uv[static_cast<std::size_t>(u.triangles[i])]);
      c.triangle_pole.push_back(facets_.pole[static_cast<std::size_t>(u.triangles[i])]);
    }
    c.triangle_offsets.push_back(static_cast<std::int32_t>(c.triangle_nodes.size()));
    for (const double b : {bounds_.lo.x, bounds_.hi.x, bounds_.lo.y, bounds_.hi.y}) c.uv_bounds.push_back(b);
    for (Rim& rim : rims) rims_.push_back(std::move(rim));
  }

  void finish() {
    Composites& c = found_.composites;
    sort_once(c.joined_edges);
    std::ranges::sort(rims_, {}, &Rim::coedge);
    for (const Rim& rim : rims_) {
      c.rim_coedge.push_back(rim.coedge);
      const std::vector<double>& t = facets_.rim_t[rim.coedge];
      c.rim_t.insert(c.rim_t.end(), t.begin(), t.end());
      c.rim_node.insert(c.rim_node.end(), rim.node.begin(), rim.node.end());
      c.rim_triangle.insert(c.rim_triangle.end(), rim.triangle.begin(), rim.triangle.end());
      c.rim_offsets.push_back(static_cast<std::int32_t>(c.rim_t.size()));
    }
    c.joined_vertices = find_passed_vertices(cad_, c.joined_edges, part_of_, request_.must_end);
  }

  const Model& cad_;
  const ModelTables& t_;
  const JoinRequest& request_;
  std::vector<std::vector<CoedgeId>> uses_;
  std::vector<FaceId> face_of_coedge_;
  UvFacets facets_;
  std::vector<std::int32_t> across_;    // the side on the other face of an edge that may be joined
  std::vector<std::uint8_t> can_join_;  // edges
  std::vector<std::uint8_t> is_joined_;
  std::vector<FaceId> part_of_;  // lowest face of the part
  std::vector<std::vector<FaceId>> parts_;
  Box2 bounds_;
  std::vector<Rim> rims_;
  FoundComposites found_;
};

}  // namespace

FoundComposites find_composites(const Model& cad, const JoinRequest& request) {
  bool is_asked = false;
  for (std::size_t e = 0; e < request.may_join.size(); ++e) is_asked |= request.may_join[e] && request.urgency[e] > 0;
  return is_asked ? CompositeFinder(cad, request).run() : FoundComposites{};
}

}  // namespace st
