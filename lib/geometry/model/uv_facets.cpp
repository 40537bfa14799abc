#include "geometry/model/uv_facets.h"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "base/boxes.h"
#include "base/threads.h"
#include "geometry/brep/compound.h"
#include "geometry/model/brep_facets.h"
#include "geometry/model/model_editor.h"
#include "geometry/model/pole_band.h"
#include "geometry/shape/composite_surface.h"
#include "geometry/shape/member_map.h"

namespace st {
namespace {

/// Nodes of a coedge in a face's triangulation, along the edge.
struct Rim {
  std::vector<double> t;
  std::vector<std::int32_t> node;
};

/// Nodes that are one in space, along a line of (u,v).
struct Pole {
  std::vector<std::int32_t> node;
  bool is_along_v = false;
};

class FacetReader {
 public:
  FacetReader(const Model& model, UvFacets& facets)
      : model_(model), t_(model.tables()), brep_(ModelEditor::brep(model)), facets_(facets) {
    facets_.rim_t.resize(t_.coedge_edge.size());
    facets_.rim_side.resize(t_.coedge_edge.size());
  }

  void add(FaceId f, const TopoDS_Face& face, BRepBuilderAPI_Copy& copy) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    if (mesh.IsNull() || !mesh->HasUVNodes()) return;
    std::vector<std::pair<CoedgeId, Rim>> rims;
    std::vector<Pole> poles;
    for (const CoedgeId c : t_.coedges(f)) {
      std::optional<Rim> rim = rim_of(f, c, mesh, location, copy);
      if (!rim) return;
      if (t_.edge_is_degenerate[t_.coedge_edge[c]])
        poles.push_back({std::move(rim->node), {}});
      else
        rims.emplace_back(c, std::move(*rim));
    }
    UvFacets own = triangles(f, *mesh, location);
    for (auto& [coedge, rim] : rims)
      if (rim.node.size() == 2 && spans_poles_[t_.coedge_edge[coedge]] && !split(f, coedge, own, rim)) return;
    for (Pole& pole : poles)
      if (!find_line(*mesh, pole)) return;
    if (!poles.empty() && !close(f, own, poles, rims)) return;
    if (connect(own, rims)) append(std::move(own), rims);
  }

 private:
  /// The nodes of an edge. A seam has two rows of them, and which of its coedges has which depends on where the face
  /// comes from: that whose (u,v) lie on the trimming curve.
  Handle(Poly_PolygonOnTriangulation)
      polygon_of(FaceId f, CoedgeId c, const TopoDS_Shape& edge, const Handle(Poly_Triangulation) & mesh,
                 const TopLoc_Location& location) const {
    const auto polygon = [&](TopAbs_Orientation orientation) {
      return BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(edge.Oriented(orientation)), mesh, location);
    };
    const Handle(Poly_PolygonOnTriangulation) one = polygon(TopAbs_FORWARD), two = polygon(TopAbs_REVERSED);
    if (one == two || one.IsNull() || two.IsNull() || !one->HasParameters() || !two->HasParameters()) return one;
    const auto pcurve = model_.pcurve(f, c);
    const auto off = [&](const Handle(Poly_PolygonOnTriangulation) & p) {
      const gp_Pnt2d uv = mesh->UVNode(p->Node(1));
      return norm(pcurve->point(p->Parameter(1)) - Vec2{uv.X(), uv.Y()});
    };
    return off(two) < off(one) ? two : one;
  }

  std::optional<Rim> rim_of(FaceId f, CoedgeId c, const Handle(Poly_Triangulation) & mesh,
                            const TopLoc_Location& location, BRepBuilderAPI_Copy& copy) const {
    const TopoDS_Shape edge = copy.ModifiedShape(brep_.edges(t_.coedge_edge[c] + 1));
    const Handle(Poly_PolygonOnTriangulation) polygon = polygon_of(f, c, edge, mesh, location);
    if (polygon.IsNull() || !polygon->HasParameters() || polygon->NbNodes() < 2) return std::nullopt;
    Rim rim;
    for (int i = 1; i <= polygon->NbNodes(); ++i) {
      rim.t.push_back(polygon->Parameter(i));
      rim.node.push_back(polygon->Node(i) - 1);
    }
    if (rim.t.front() > rim.t.back()) {
      std::ranges::reverse(rim.t);
      std::ranges::reverse(rim.node);
    }
    if (std::ranges::adjacent_find(rim.t, std::greater_equal()) != rim.t.end()) return std::nullopt;
    return rim;
  }

  UvFacets triangles(FaceId f, const Poly_Triangulation& mesh, const TopLoc_Location& location) const {
    UvFacets own;
    for (int i = 1; i <= mesh.NbNodes(); ++i) {
      const gp_Pnt p = mesh.Node(i).Transformed(location.Transformation());
      own.x.push_back({p.X(), p.Y(), p.Z()});
    }
    for (int i = 1; i <= mesh.NbTriangles(); ++i) {
      std::array<int, 3> n;
      mesh.Triangle(i).Get(n[0], n[1], n[2]);  // counter-clockwise in (u,v)
      if (t_.face_is_reversed[f]) std::swap(n[1], n[2]);
      const Corners c{n[0] - 1, n[1] - 1, n[2] - 1};
      own.corners.push_back(c);
      auto& uv = own.uv.emplace_back();
      for (int k = 0; k < 3; ++k) uv[k] = {mesh.UVNode(n[k]).X(), mesh.UVNode(n[k]).Y()};
      own.face.push_back(f);
    }
    own.pole.assign(own.corners.size(), kNone);
    return own;
  }

  /// Puts nodes inside a straight edge from pole to pole: a facet at both would have no meridians. False where no facet
  /// lies at the edge.
  bool split(FaceId f, CoedgeId c, UvFacets& own, Rim& rim) const {
    constexpr int kBetweenPoles = 7;  // nodes inside a straight edge
    const std::int32_t a = rim.node[0], b = rim.node[1];
    const auto at = std::ranges::find_if(own.corners, [&](const Corners& n) {
      return std::ranges::find(n, a) != n.end() && std::ranges::find(n, b) != n.end();
    });
    if (at == own.corners.end()) return false;
    const auto t = static_cast<std::size_t>(at - own.corners.begin());
    const auto ka = static_cast<std::size_t>(std::ranges::find(*at, a) - at->begin()),
               kb = static_cast<std::size_t>(std::ranges::find(*at, b) - at->begin());
    const auto curve = model_.curve(t_.coedge_edge[c]);
    const auto pcurve = model_.pcurve(f, c);
    for (int k = kBetweenPoles; k >= 1; --k) {  // facet t keeps a, and loses b
      const double s = rim.t[0] + k * (rim.t.back() - rim.t[0]) / (kBetweenPoles + 1);
      const auto node = static_cast<std::int32_t>(own.x.size());
      own.x.push_back(curve->point(s));
      Corners rest = own.corners[t];
      auto rest_uv = own.uv[t];
      rest[ka] = own.corners[t][kb] = node;
      rest_uv[ka] = own.uv[t][kb] = pcurve->point(s);
      own.corners.push_back(rest), own.uv.push_back(rest_uv), own.pole.push_back(kNone), own.face.push_back(f);
      rim.t.insert(rim.t.begin() + 1, s), rim.node.insert(rim.node.begin() + 1, node);
    }
    return true;
  }

  /// Whether the nodes of a pole lie on a line along u or v.
  static bool find_line(const Poly_Triangulation& mesh, Pole& pole) {
    constexpr double kStraight = 1e-6;  // of its length
    const auto uv = [&](std::int32_t node) { return Vec2{mesh.UVNode(node + 1).X(), mesh.UVNode(node + 1).Y()}; };
    Box2 box;
    for (const std::int32_t n : pole.node) box.add(uv(n));
    const Vec2 size = box.hi - box.lo;
    pole.is_along_v = size.y > size.x;
    return std::min(size.x, size.y) <= kStraight * std::max(size.x, size.y) && size != Vec2{};
  }

  using Rims = std::vector<std::pair<CoedgeId, Rim>>;

  static bool close(UvFacets& own, const std::vector<Pole>& poles, Rims& rims) {
    return std::ranges::all_of(poles, [&](const Pole& pole) { return close(own, pole, rims); });
  }

  bool close(FaceId f, UvFacets& own, const std::vector<Pole>& poles, Rims& rims) const {
    UvFacets closed = own;
    Rims closed_rims = rims;
    if (close(closed, poles, closed_rims)) return own = std::move(closed), rims = std::move(closed_rims), true;
    if (poles.size() != 2 || rims.size() != 2) return false;
    if (rims[0].second.node.size() < 3 || rims[1].second.node.size() < 3) return false;
    own = band(f, own, poles, rims);
    return close(own, poles, rims);
  }

  /// Facets from edge to edge of a face between two poles: OpenCASCADE's may have two corners on one meridian.
  UvFacets band(FaceId f, const UvFacets& whole, const std::vector<Pole>& poles, const Rims& rims) const {
    UvFacets own;
    own.x = whole.x;
    std::array<PoleChain, 2> chain;
    std::map<std::int32_t, Vec2> uv;
    for (const std::size_t k : {0, 1}) {
      const auto pcurve = model_.pcurve(f, rims[k].first);
      const Rim& rim = rims[k].second;
      for (std::size_t i = 0; i < rim.node.size(); ++i) {
        uv[rim.node[i]] = pcurve->point(rim.t[i]);
        chain[k].node.push_back(rim.node[i]);
        chain[k].at.push_back(poles[0].is_along_v ? uv[rim.node[i]].x : uv[rim.node[i]].y);
      }
      if (chain[k].at.front() > chain[k].at.back())
        std::ranges::reverse(chain[k].node), std::ranges::reverse(chain[k].at);
    }
    for (Corners c : fill_pole_band(chain[0], chain[1])) {
      const double area = cross(uv[c[1]] - uv[c[0]], uv[c[2]] - uv[c[0]]);
      if ((area < 0) != (t_.face_is_reversed[f] != 0)) std::swap(c[1], c[2]);
      own.corners.push_back(c);
      own.uv.push_back({uv[c[0]], uv[c[1]], uv[c[2]]});
      own.face.push_back(f);
    }
    own.pole.assign(own.corners.size(), kNone);
    return own;
  }

  /// Makes one node of those at a pole and takes out the triangles that have no area then. False where what is left
  /// does not lie side by side around it.
  static bool close(UvFacets& own, const Pole& pole, Rims& rims) {
    const std::int32_t first = pole.node.front();
    const auto weld = [&](std::int32_t& node) {
      if (std::ranges::find(pole.node, node) != pole.node.end()) node = first;
    };
    for (auto& [coedge, rim] : rims) std::ranges::for_each(rim.node, weld);
    std::size_t n = 0;
    for (std::size_t t = 0; t < own.corners.size(); ++t) {
      Corners& c = own.corners[t];
      std::ranges::for_each(c, weld);
      const auto n_there = std::ranges::count(c, first);
      if (n_there > 1) continue;
      if (n_there == 1 &&
          !turn_to_pole(own, t, static_cast<std::int32_t>(std::ranges::find(c, first) - c.begin()), pole))
        return false;
      own.corners[n] = c, own.uv[n] = own.uv[t], own.pole[n] = own.pole[t];
      ++n;
    }
    own.corners.resize(n), own.uv.resize(n), own.pole.resize(n), own.face.resize(n);
    return true;
  }

  /// Puts corner k, at a pole, half way between the others along its line. False where that turns the triangle over.
  static bool turn_to_pole(UvFacets& own, std::size_t t, std::int32_t k, const Pole& pole) {
    if (own.pole[t] != kNone) return false;  // of two poles
    own.pole[t] = PoleCorner{k, pole.is_along_v}.code();
    Vec2& there = own.uv[t][static_cast<std::size_t>(k)];
    const Vec2 a = own.uv[t][static_cast<std::size_t>((k + 1) % 3)],
               b = own.uv[t][static_cast<std::size_t>((k + 2) % 3)];
    const double before = cross(a - there, b - there);
    (pole.is_along_v ? there.y : there.x) = pole.is_along_v ? 0.5 * (a.y + b.y) : 0.5 * (a.x + b.x);
    const auto height = [&](Vec2 p) { return pole.is_along_v ? p.x - there.x : p.y - there.y; };
    return height(a) * height(b) > 0 && before * cross(a - there, b - there) > 0;
  }

  /// Finds mates and sides along edges; false where they contradict each other.
  static bool connect(UvFacets& own, std::vector<std::pair<CoedgeId, Rim>>& rims) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> sides;
    for (std::size_t s = 0; s < 3 * own.corners.size(); ++s) {
      const Corners& c = own.corners[s / 3];
      if (!sides.emplace(std::pair(c[s % 3], c[(s + 1) % 3]), static_cast<std::int32_t>(s)).second) return false;
    }
    own.mate.assign(3 * own.corners.size(), kNone);
    std::size_t n_free = 0;
    for (const auto& [ends, side] : sides) {
      const auto other = sides.find({ends.second, ends.first});
      if (other != sides.end())
        own.mate[static_cast<std::size_t>(side)] = other->second;
      else
        ++n_free;
    }
    std::vector<std::uint8_t> is_taken(own.mate.size(), 0);
    for (auto& [coedge, rim] : rims)
      for (std::size_t i = 0; i + 1 < rim.node.size(); ++i) {
        auto side = sides.find({rim.node[i], rim.node[i + 1]});
        if (side == sides.end() || own.mate[static_cast<std::size_t>(side->second)] != kNone)
          side = sides.find({rim.node[i + 1], rim.node[i]});
        if (side == sides.end() || own.mate[static_cast<std::size_t>(side->second)] != kNone ||
            std::exchange(is_taken[static_cast<std::size_t>(side->second)], 1) != 0)
          return false;
        rim.node[i] = side->second;  // from here on the side
        --n_free;
      }
    return n_free == 0;
  }

  void append(UvFacets&& own, std::vector<std::pair<CoedgeId, Rim>>& rims) {
    const auto first_node = static_cast<std::int32_t>(facets_.x.size()),
               first_side = static_cast<std::int32_t>(3 * facets_.corners.size());
    facets_.x.insert(facets_.x.end(), own.x.begin(), own.x.end());
    for (const Corners& c : own.corners)
      facets_.corners.push_back({c[0] + first_node, c[1] + first_node, c[2] + first_node});
    facets_.uv.insert(facets_.uv.end(), own.uv.begin(), own.uv.end());
    facets_.face.insert(facets_.face.end(), own.face.begin(), own.face.end());
    facets_.pole.insert(facets_.pole.end(), own.pole.begin(), own.pole.end());
    for (const std::int32_t m : own.mate) facets_.mate.push_back(m == kNone ? kNone : m + first_side);
    for (auto& [coedge, rim] : rims) {
      rim.node.pop_back();
      for (std::int32_t& side : rim.node) side += first_side;
      facets_.rim_t[coedge] = std::move(rim.t);
      facets_.rim_side[coedge] = std::move(rim.node);
    }
  }

  const Model& model_;
  const ModelTables& t_;
  const Model::Impl& brep_;
  UvFacets& facets_;
  const std::vector<std::uint8_t> spans_poles_ = edges_between_poles(t_);  // by edge
};

bool has_turned_facet(const Surface& surface, const UvFacets& facets, std::int32_t first, std::int32_t end) {
  for (std::int32_t t = first; t < end; ++t) {
    const Corners& c = facets.corners[t];
    const std::array<Vec2, 3>& uv = facets.uv[t];
    const double side = cross(uv[1] - uv[0], uv[2] - uv[0]) < 0 ? -1 : 1;  // facets are seen from outside
    for (const std::array<double, 3>& w : kFacetPlaces) {
      const SurfacePoint p = surface.evaluate(w[0] * uv[0] + w[1] * uv[1] + w[2] * uv[2]);
      if (is_turned(facets.x[c[0]], facets.x[c[1]], facets.x[c[2]], side * cross(p.du, p.dv))) return true;
    }
  }
  return false;
}

std::vector<FaceId> find_turned(const Model& model, const UvFacets& facets, std::span<const FaceId> among) {
  std::vector<std::uint8_t> is_turned(among.size(), 0);
  parallel_for(among.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      is_turned[i] = has_turned_facet(*model.surface(among[i]), facets, facets.face_offsets[among[i]],
                                      facets.face_offsets[among[i] + 1]);
  });
  std::vector<FaceId> turned;
  for (std::size_t i = 0; i < among.size(); ++i)
    if (is_turned[i]) turned.push_back(among[i]);
  return turned;
}

class FacetMaker {
 public:
  FacetMaker(const Model& model, const std::vector<std::uint8_t>& is_wanted)
      : model_(model), is_wanted_(is_wanted), copy_(wanted_faces(), false) {}  // the model itself keeps no triangles

  UvFacets run(FacetLimits limits) {
    std::vector<FaceId> wanted;
    for (std::size_t f = 0; f < is_wanted_.size(); ++f)
      if (is_wanted_[f]) wanted.push_back(static_cast<FaceId>(f));
    UvFacets facets = make(limits, wanted);
    if (facets.turned.empty() || limits.is_exact) return facets;
    limits.is_exact = true;
    for (const FaceId f : facets.turned) BRepTools::Clean(face(f));  // others, and edges between them, keep theirs
    return make(limits, facets.turned);
  }

 private:
  TopoDS_Shape wanted_faces() const {
    std::vector<TopoDS_Shape> faces;
    for (std::size_t f = 0; f < is_wanted_.size(); ++f)
      if (is_wanted_[f])
        faces.push_back(ModelEditor::brep(model_).faces(static_cast<int>(f) + 1).Oriented(TopAbs_FORWARD));
    return occt::compound_of(faces);
  }

  TopoDS_Face face(FaceId f) const {
    return TopoDS::Face(copy_.ModifiedShape(ModelEditor::brep(model_).faces(f + 1)).Oriented(TopAbs_FORWARD));
  }

  /// `unsure`: faces of which facets may be turned.
  UvFacets make(const FacetLimits& limits, std::span<const FaceId> unsure) {
    put_facets(copy_.Shape(), limits, FacetsGo::kToAllEdges);
    UvFacets facets;
    FacetReader reader(model_, facets);
    for (std::size_t f = 0; f < is_wanted_.size(); ++f) {
      facets.face_offsets.push_back(static_cast<std::int32_t>(facets.corners.size()));
      if (is_wanted_[f]) reader.add(static_cast<FaceId>(f), face(static_cast<FaceId>(f)), copy_);
    }
    facets.face_offsets.push_back(static_cast<std::int32_t>(facets.corners.size()));
    facets.turned = find_turned(model_, facets, unsure);
    return facets;
  }

  const Model& model_;
  const std::vector<std::uint8_t>& is_wanted_;
  BRepBuilderAPI_Copy copy_;
};

}  // namespace

bool UvFacets::fit(std::int32_t a, std::int32_t b) const {
  const auto end = [&](std::int32_t s, int k) {
    return x[static_cast<std::size_t>(corners[static_cast<std::size_t>(s / 3)][(s + k) % 3])];
  };
  const double near = 0.1 * distance(end(a, 0), end(a, 1));
  return distance(end(a, 0), end(b, 1)) <= near && distance(end(a, 1), end(b, 0)) <= near;
}

UvFacets make_uv_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits) {
  try {
    return FacetMaker(model, is_wanted).run(limits);
  } catch (const Standard_Failure&) {
    UvFacets none;
    none.face_offsets.assign(is_wanted.size() + 1, 0);
    none.rim_t.resize(model.tables().coedge_edge.size());
    none.rim_side.resize(model.tables().coedge_edge.size());
    return none;
  }
}

}  // namespace st
