#include "geometry/model/facets.h"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "base/assert.h"
#include "base/equal_points.h"
#include "base/packer.h"
#include "geometry/brep/compound.h"
#include "geometry/model/brep_facets.h"
#include "geometry/model/model_editor.h"

namespace st {
namespace {

constexpr double kSame = 1e-7;  // of the box of all nodes: nearer ones are one
constexpr std::size_t kFacesPerTask = 64;

void add_face(const TopoDS_Face& face, FaceId id, Facets& facets) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) return;
  const auto first = static_cast<std::int32_t>(facets.xyz.size());
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    const gp_Pnt p = mesh->Node(i).Transformed(location.Transformation());
    facets.xyz.push_back({p.X(), p.Y(), p.Z()});
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> n;
    mesh->Triangle(i).Get(n[0], n[1], n[2]);
    facets.triangle.push_back({first + n[0] - 1, first + n[1] - 1, first + n[2] - 1});
    facets.face.push_back(id);
  }
}

/// Sorts the nodes that are not yet in along_x into it.
void extend_along_x(Facets& facets) {
  std::vector<std::int32_t>& order = facets.along_x;
  const auto n_known = static_cast<std::ptrdiff_t>(order.size());
  order.resize(facets.xyz.size());
  std::iota(order.begin() + n_known, order.end(), static_cast<std::int32_t>(n_known));
  const auto is_before = [&](std::int32_t a, std::int32_t b) { return facets.xyz[a].x < facets.xyz[b].x; };
  std::stable_sort(order.begin() + n_known, order.end(), is_before);
  std::inplace_merge(order.begin(), order.begin() + n_known, order.end(), is_before);
}

/// Nodes that nearly coincide, along any axis of space by sorting, become the first of them.
void weld(Facets& facets) {
  Box3 box;
  for (const Vec3& x : facets.xyz) box.add(x);
  const double tolerance = kSame * box.diagonal();
  extend_along_x(facets);
  const std::vector<std::int32_t>& order = facets.along_x;
  std::vector<std::int32_t> one(facets.xyz.size(), kNone);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (one[order[i]] != kNone) continue;
    one[order[i]] = order[i];
    const Vec3 x = facets.xyz[order[i]];
    for (std::size_t j = i + 1; j < order.size() && facets.xyz[order[j]].x - x.x <= tolerance; ++j)
      if (one[order[j]] == kNone && distance(facets.xyz[order[j]], x) <= tolerance) one[order[j]] = order[i];
  }
  for (auto& triangle : facets.triangle)
    for (std::int32_t& node : triangle) node = one[node];
}

/// Nodes from `n_nodes` on become the first at their place, in triangles from `n_triangles` on. Those before are looked
/// at no more, as facets may come face by face.
void join_equal(std::size_t n_nodes, std::size_t n_triangles, Facets& facets) {
  std::vector<std::int32_t>& slots = facets.along_x;
  const auto slot_of = [&](Vec3 x) -> std::int32_t& {
    std::size_t i = hash_of_place(x) % slots.size();
    while (slots[i] != kNone && !(facets.xyz[slots[i]] == x)) i = (i + 1) % slots.size();
    return slots[i];
  };
  if (2 * facets.xyz.size() > slots.size()) {  // all go into a larger table
    slots.assign(4 * facets.xyz.size(), kNone);
    n_nodes = 0;
  }
  for (std::size_t n = n_nodes; n < facets.xyz.size(); ++n)
    if (std::int32_t& first = slot_of(facets.xyz[n]); first == kNone) first = static_cast<std::int32_t>(n);
  for (std::size_t t = n_triangles; t < facets.triangle.size(); ++t)
    for (std::int32_t& node : facets.triangle[t]) node = slot_of(facets.xyz[node]);
}

/// Those of some faces, not welded.
Facets facets_of(const Model::Impl& brep, std::span<const FaceId> ids, const FacetLimits& limits) {
  Facets facets;
  try {
    std::vector<TopoDS_Shape> faces;
    for (const FaceId f : ids) faces.push_back(brep.faces(f + 1));
    BRepBuilderAPI_Copy copy(occt::compound_of(faces), false);  // the model itself keeps no triangles
    put_facets(copy.Shape(), limits, FacetsGo::kToFaces);
    for (const FaceId f : ids) add_face(TopoDS::Face(copy.ModifiedShape(brep.faces(f + 1))), f, facets);
  } catch (const Standard_Failure&) {
    return {};
  }
  return facets;
}

/// Those that the model itself is made of.
Facets own_facets(const FacetShape& shape, std::span<const FaceId> ids) {
  Facets facets;
  for (const FaceId f : ids) {
    const auto first = static_cast<std::int32_t>(facets.xyz.size());
    for (const std::int32_t n : shape.nodes(f)) facets.xyz.push_back(shape.node_xyz[n]);
    for (const Corners& c : shape.triangles(f)) {
      facets.triangle.push_back({first + c[0], first + c[1], first + c[2]});
      facets.face.push_back(f);
    }
  }
  return facets;
}

/// Those of one face stay in order.
void sort_by_face(Facets& facets) {
  const auto begin = facets.face.begin(), end = facets.face.end(), middle = std::is_sorted_until(begin, end);
  if (middle == end) return;
  std::vector<std::size_t> order(facets.face.size());
  std::iota(order.begin(), order.end(), 0);
  const auto is_before = [&](std::size_t a, std::size_t b) { return facets.face[a] < facets.face[b]; };
  if (std::is_sorted(middle, end))  // some were added
    std::inplace_merge(order.begin(), order.begin() + (middle - begin), order.end(), is_before);
  else
    std::stable_sort(order.begin(), order.end(), is_before);
  const std::vector<std::array<std::int32_t, 3>> triangle = std::move(facets.triangle);
  const std::vector<FaceId> face = std::move(facets.face);
  facets.triangle.clear();
  facets.face.clear();
  for (const std::size_t i : order) {
    facets.triangle.push_back(triangle[i]);
    facets.face.push_back(face[i]);
  }
}

/// Those of the CAD's own faces, for the faces that they are part of.
Facets facets_of_cad(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                     const Executor& executor) {
  const std::vector<FaceId>& face_of = ModelEditor::brep(model).joined.face_of;
  std::vector<std::uint8_t> in_cad;
  for (const FaceId f : face_of) in_cad.push_back(is_wanted[static_cast<std::size_t>(f)]);
  Facets own = make_facets(model.cad(), in_cad, limits, executor);
  for (FaceId& f : own.face) f = face_of[static_cast<std::size_t>(f)];
  return own;
}

}  // namespace

Facets make_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                   const Executor& executor) {
  Facets facets;
  add_facets(model, is_wanted, limits, executor, facets);
  return facets;
}

void add_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                const Executor& executor, Facets& facets) {
  join_facets(model, make_unjoined_facets(model, is_wanted, limits, executor), facets);
}

Facets make_unjoined_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                            const Executor& executor) {
  if (&model.cad() != &model) return facets_of_cad(model, is_wanted, limits, executor);
  ST_ASSERT(limits.deflection > 0 && is_wanted.size() == static_cast<std::size_t>(model.tables().n_faces()));
  const Model::Impl& brep = ModelEditor::brep(model);
  std::vector<FaceId> ids;
  for (std::size_t f = 0; f < is_wanted.size(); ++f)
    if (is_wanted[f]) ids.push_back(static_cast<FaceId>(f));
  if (!model.facets().empty()) return own_facets(model.facets(), ids);
  const auto n_tasks = static_cast<std::int32_t>((ids.size() + kFacesPerTask - 1) / kFacesPerTask);
  std::vector<Facets> parts(static_cast<std::size_t>(n_tasks));
  executor.run_tasks(
      n_tasks, heaviest_first(std::vector<double>(parts.size(), 1)),
      [&](std::int32_t task) {
        const std::span<const FaceId> all(ids), rest = all.subspan(kFacesPerTask * static_cast<std::size_t>(task));
        return packed(facets_of(brep, rest.first(std::min(rest.size(), kFacesPerTask)), limits));
      },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, parts[static_cast<std::size_t>(task)]); });
  Facets facets;
  for (Facets& part : parts) append_facets(std::move(part), facets);
  return facets;
}

void append_facets(Facets&& more, Facets& all) {
  const auto first = static_cast<std::int32_t>(all.xyz.size());
  all.xyz.insert(all.xyz.end(), more.xyz.begin(), more.xyz.end());
  for (const auto& t : more.triangle) all.triangle.push_back({first + t[0], first + t[1], first + t[2]});
  all.face.insert(all.face.end(), more.face.begin(), more.face.end());
}

void join_facets(const Model& model, Facets&& unjoined, Facets& facets) {
  const std::size_t n_nodes = facets.xyz.size(), n_triangles = facets.triangle.size();
  append_facets(std::move(unjoined), facets);
  model.facets().empty() ? weld(facets) : join_equal(n_nodes, n_triangles, facets);
  sort_by_face(facets);
}

}  // namespace st
