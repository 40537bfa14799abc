// A shape meshed with one length everywhere, as st-mesh and st-merge would.
#pragma once

#include <string>
#include <vector>

#include "mesh/corner_uv.h"
#include "mesh/merge.h"
#include "unit/meshing/faces.h"

namespace st::test {

struct ShapeMesh {
  Model model;
  UniformField field;
  SurfaceMesh mesh;

  /// `share` of the model's diagonal is the length.
  explicit ShapeMesh(const std::string& shape, double share = 0.1)
      : model(make_model(shape)), field(share * model.tables().reference_diagonal()) {
    const ModelTables& t = model.tables();
    const EdgeMesh edges = discretise_edges(model, field);
    const MeshTopology topology(t);
    const BoundaryNumbering numbering(topology, edges);
    std::vector<FacePatch> patches;
    for (FaceId f = 0; f < t.n_faces(); ++f) patches.push_back(patch(f, numbering));
    OrientationReport report;
    mesh = merge_patches({edges, t.vertex_xyz, t.edge_vertices, patches, t.labels.face_group}, report);
    mesh.labels = t.labels;
  }

  FacePatch patch(FaceId f, const BoundaryNumbering& numbering) const {
    const auto surface = model.surface(f);
    const FaceBoundary boundary = make_face_boundary(model, *surface, f, numbering);
    const FaceMesh m = mesh_face(*surface, boundary, field, {});
    EXPECT_EQ(m.cause, FailureCause::kNone);
    FacePatch p;
    p.face = f;
    for (const auto& n : boundary.nodes) {
      const auto entity = numbering.entity(n.id);
      p.boundary_dim.push_back(static_cast<std::uint8_t>(entity.dim));
      p.boundary_entity.push_back(entity.entity);
      p.boundary_index.push_back(entity.index);
      ++p.n_boundary;
    }
    for (const auto& n : m.inner) {
      p.inner_xyz.push_back(n.x);
      p.inner_uv.push_back(n.uv);
      p.inner_size.push_back(n.h);
    }
    const MeshView view{boundary, m};
    std::vector<Vec2> uv;
    for (std::size_t i = 0; i < m.corners.size(); i += 3) {
      p.triangles.push_back({{m.corners[i], m.corners[i + 1], m.corners[i + 2]}});
      for (int k = 0; k < 3; ++k) uv.push_back(view.uv(m.corners[i + k]));
    }
    set_corner_uvs(uv, p);
    return p;
  }

  /// The field's lengths at the nodes.
  std::vector<double> wanted(const SizeField& f) const {
    std::vector<double> sizes;
    for (const Vec3 x : mesh.node_xyz) sizes.push_back(f.size(x));
    return sizes;
  }
};

struct BoxMesh : ShapeMesh {
  BoxMesh() : ShapeMesh("box") {}
};

/// With solids whose surfaces have seams, poles and an apex.
inline const char* const kSolids[] = {"box",   "cylinder",         "sphere",           "cone",
                                      "torus", "drilled_cylinder", "mirrored_cylinder"};

}  // namespace st::test
