// Models whose smooth faces are joined, for tests.
#pragma once

#include <string>

#include "geometry/model/composite_finder.h"
#include "support/shapes.h"

namespace st::test {

/// Asks for all edges between two faces of one surface type other than plane.
inline JoinRequest curved_request(const Model& cad) {
  const ModelTables& t = cad.tables();
  JoinRequest request;
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    bool is_curved = offsets[e + 1] - offsets[e] == 2 && faces[offsets[e]] != faces[offsets[e] + 1];
    for (std::int32_t i = offsets[e]; i < offsets[e + 1]; ++i)
      is_curved = is_curved && t.face_type[faces[i]] != SurfaceType::kPlane;
    request.may_join.push_back(is_curved);
  }
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
