// Models whose smooth faces are joined, for tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/model/composite_finder.h"
#include "support/shapes.h"

namespace st::test {

/// Outer normal half way along a coedge.
inline Vec3 normal_at(const Model& model, FaceId f, CoedgeId c) {
  const double* range = &model.tables().edge_range[2 * static_cast<std::size_t>(model.tables().coedge_edge[c])];
  const Vec3 n = surface_normal(*model.surface(f), model.pcurve(f, c)->point(0.5 * (range[0] + range[1])));
  return model.tables().face_is_reversed[f] ? -n : n;
}

/// Asks for all edges between two faces that are no planes and have the same normal there.
inline JoinRequest curved_request(const Model& cad) {
  const ModelTables& t = cad.tables();
  JoinRequest request;
  std::vector<std::vector<std::pair<FaceId, Vec3>>> sides(static_cast<std::size_t>(t.n_edges()));
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const CoedgeId c : t.coedges(f))
      if (t.face_type[f] != SurfaceType::kPlane) sides[t.coedge_edge[c]].emplace_back(f, normal_at(cad, f, c));
  for (const auto& side : sides)
    request.may_join.push_back(side.size() == 2 && side[0].first != side[1].first &&
                               angle_between(side[0].second, side[1].second) < radians(3));
  request.urgency = t.edge_length;
  request.must_end.assign(static_cast<std::size_t>(t.n_vertices()), 0);
  request.facets = {.deflection = 1e-3 * t.reference_diagonal(), .angle = radians(12), .is_exact = true};
  return request;
}

/// Of a shape by name (shapes.h).
struct Joined {
  ImportResult cad;
  Composites composites;
  Model model;

  explicit Joined(const std::string& shape)
      : cad(import_shape(shape)),
        composites(found(Model(cad.tables, cad.brep))),
        model(cad.tables, cad.brep, composites) {}

 private:
  static Composites found(const Model& model) { return find_composites(model, curved_request(model)).composites; }
};

}  // namespace st::test
