#include "geometry/import/touching_loops.h"

#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/brep/face_domain.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/import/edge_spurs.h"

namespace st::occt {
namespace {

constexpr double kMeasured = 1e-5;  // of the area: how exact integrals are

bool are_opposed(const TopoDS_Edge& a, const TopoDS_Edge& b) {
  const TopoDS_Vertex from = TopExp::FirstVertex(a, true), to = TopExp::LastVertex(a, true);
  return !from.IsNull() && !to.IsNull() && !a.IsSame(b) && !from.IsSame(to) &&
         from.IsSame(TopExp::LastVertex(b, true)) && to.IsSame(TopExp::FirstVertex(b, true));
}

/// Of an edge of each chain; those that end elsewhere are left alone.
std::vector<EdgeSpur> contacts_of(const EdgeChain& a, const EdgeChain& b) {
  std::vector<EdgeSpur> contacts;
  for (const TopoDS_Edge& e : a)
    for (const TopoDS_Edge& other : b) {
      if (!are_opposed(e, other)) continue;
      const double tolerance = 2 * std::max(BRep_Tool::Tolerance(e), BRep_Tool::Tolerance(other));
      const auto contact = find_spur({e, other}, {e}, tolerance);
      if (contact && contact->rest.IsNull()) contacts.push_back(*contact);
    }
  return contacts;
}

/// What becomes of a face and of those at its edges; forward.
struct Joined {
  std::map<FaceId, TopoDS_Face> faces;
  Vec3 place;
  double length = 0;
};

/// Most faces have none besides; walking it takes as long as all else.
bool has_one_loop(const TopoDS_Face& face) {
  int n = 0;
  for (TopoDS_Iterator w(face); w.More(); w.Next()) n += w.Value().ShapeType() == TopAbs_WIRE;
  return n < 2;
}

Joined join_loops_of(const ImportedShape& model, FaceId f) {
  Joined joined;
  const TopoDS_Face face = TopoDS::Face(model.faces(f + 1).Oriented(TopAbs_FORWARD));
  if (has_one_loop(face)) return {};
  std::vector<EdgeChain> chains = chains_of(face);
  double gaps = 0;
  for (std::size_t i = 0; i < chains.size(); ++i)
    for (std::size_t k = i + 1; k < chains.size(); ++k) {
      const std::vector<EdgeSpur> contacts = contacts_of(chains[i], chains[k]);
      if (contacts.empty()) continue;
      chains[i].insert(chains[i].end(), chains[k].begin(), chains[k].end());
      chains[k--] = std::exchange(chains.back(), {});
      chains.pop_back();
      for (const EdgeSpur& contact : contacts) {
        chains[i] = without_spur(chains[i], contact);
        if (!share_spur(model, contact, {f, f}, joined.faces)) return {};
        double t0, t1;
        const Handle(Geom_Curve) curve = BRep_Tool::Curve(contact.shorter, t0, t1);
        const double length = arc_length(*make_curve(curve, t0, t1), t0, t1);
        joined.length += length, gaps += 2 * contact.gap * length;
        joined.place = vec(curve->Value(0.5 * (t0 + t1)));
      }
    }
  if (joined.length == 0) return {};
  const double area = std::abs(integrate_face(make_domain(face), {}).area);
  const auto own = face_of_chains(face, chains, area, gaps + kMeasured * area);
  if (!own) return {};
  joined.faces[f] = *own;
  return joined;
}

}  // namespace

void join_touching_loops(ImportedShape& model, std::vector<ImportFinding>& findings) {
  for (FaceId f = 0; f < model.faces.Extent(); ++f) try {
      const Joined joined = join_loops_of(model, f);
      if (joined.faces.empty()) continue;
      const Handle(BRepTools_ReShape) reshape = new BRepTools_ReShape;
      for (const auto& [id, face] : joined.faces) reshape->Replace(model.faces(id + 1).Oriented(TopAbs_FORWARD), face);
      const TopoDS_Shape changed = reshape->Apply(model.shape);
      if (model.replace(changed, [&](const TopoDS_Shape& face) { return reshape->Apply(face); }))
        findings.push_back(
            {FindingKind::kLostLoops, "face " + std::to_string(f + 1), joined.place, joined.length, true});
    } catch (const Standard_Failure&) {  // stays as it is
    }
}

}  // namespace st::occt
