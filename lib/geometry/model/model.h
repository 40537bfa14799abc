// The CAD model as every later stage sees it: flat topology tables plus evaluators. No OpenCASCADE type is visible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/face_labels.h"
#include "base/ids.h"
#include "base/vec.h"
#include "geometry/model/composites.h"
#include "geometry/model/facet_shape.h"
#include "geometry/model/groups.h"
#include "geometry/shape/curve.h"
#include "geometry/shape/surface.h"

namespace st {

/// Flat B-Rep tables (structure of arrays). All ids 0-based; entity k of a table is entity k+1 in artifacts and
/// messages. A new column also goes into edit_model.cpp, which takes parts of models and puts models together.
struct ModelTables {
  // vertices [n_vertices]
  std::vector<Vec3> vertex_xyz;
  std::vector<double> vertex_tolerance;  ///< model unit
  // edges [n_edges]
  std::vector<VertexId> edge_vertices;  ///< [2*n_edges] vertex at t_min, at t_max; equal for a closed edge
  std::vector<double> edge_range;       ///< [2*n_edges] t_min, t_max
  std::vector<double> edge_length;      ///< model unit; 0 for a degenerate edge
  std::vector<double> edge_tolerance;
  std::vector<std::uint8_t> edge_is_degenerate;  ///< 1: a pole; no space curve, both vertices equal
  std::vector<std::string> edge_name;            ///< UTF-8, empty when the file has none
  // faces [n_faces]; loops of face f: [face_loop_offsets[f], face_loop_offsets[f+1]); coedges of loop l likewise
  std::vector<std::int32_t> face_loop_offsets;    ///< [n_faces+1]; the outer loop comes first
  std::vector<std::int32_t> loop_coedge_offsets;  ///< [n_loops+1]; coedges in order, head to tail, interior to the left
                                                  ///< in (u,v)
  std::vector<EdgeId> coedge_edge;                ///< [n_coedges]
  std::vector<std::uint8_t> coedge_is_reversed;   ///< [n_coedges] 1: traversed from t_max to t_min
  std::vector<std::uint8_t> face_is_reversed;     ///< 1: du x dv points into the solid; triangles are flipped at output
  std::vector<SurfaceType> face_type;
  std::vector<double> face_uv_bounds;  ///< [4*n_faces] u_min, u_max, v_min, v_max
  std::vector<double> face_tolerance;
  std::vector<double> face_area;   ///< model unit squared, from the B-Rep
  std::vector<double> face_width;  ///< model unit; of the rectangle of the same area and perimeter
  std::vector<Box3> face_box;
  std::vector<std::int32_t> face_color;  ///< 0xRRGGBB, kNone when the file has none
  std::vector<std::string> face_layer;   ///< empty when the file has none
  std::vector<std::int32_t> face_shell;  ///< index of the shell (connected component of faces), kNone when loose
  std::vector<std::int32_t> face_solid;  ///< index of the solid, kNone when none
  FaceLabels labels;                     ///< names, groups, parts
  std::int32_t n_shells = 0, n_solids = 0;
  std::optional<double> volume;  ///< model unit cubed, of a closed model without faces between solids; negative where
                                 ///< normals point inward
  // unit
  std::string unit;  ///< "mm", "m", "in" ...; empty when the model has none
  std::optional<double> unit_in_m;

  std::int32_t n_vertices() const { return static_cast<std::int32_t>(vertex_xyz.size()); }
  std::int32_t n_edges() const { return static_cast<std::int32_t>(edge_length.size()); }
  std::int32_t n_faces() const { return static_cast<std::int32_t>(face_is_reversed.size()); }
  std::int32_t n_loops() const { return static_cast<std::int32_t>(loop_coedge_offsets.size()) - 1; }
  std::int32_t n_coedges() const { return static_cast<std::int32_t>(coedge_edge.size()); }
  IdRange loops(FaceId f) const { return {face_loop_offsets[f], face_loop_offsets[f + 1]}; }
  /// Whether it has no loops, because it is part of a lower face of its composite (see joined_tables.h).
  bool is_joined(FaceId f) const { return loops(f).empty(); }
  IdRange loop_coedges(LoopId l) const { return {loop_coedge_offsets[l], loop_coedge_offsets[l + 1]}; }
  /// The coedges of all its loops.
  IdRange coedges(FaceId f) const {
    return {loop_coedge_offsets[face_loop_offsets[f]], loop_coedge_offsets[face_loop_offsets[f + 1]]};
  }
  /// Of its coedges, in their order; an edge that the face uses twice appears twice.
  std::span<const EdgeId> edges_of(FaceId f) const {
    return std::span(coedge_edge).subspan(coedges(f).first(), coedges(f).size());
  }

  /// Bounding box of all faces, and of the faces whose group's role is no outer one, nor an interface in a flow domain
  /// (all faces when there is none): the reference diagonal.
  Box3 box() const;
  Box3 wall_box() const;
  double reference_diagonal() const { return wall_box().diagonal(); }
  /// "face 17 "WING_UPPER"" (1-based, name when there is one), for messages.
  std::string face_label(FaceId f) const;
  std::string edge_label(EdgeId e) const;
  /// Faces using each edge, CSR [n_edges+1] offsets and ids; a face that uses an edge twice (seam) appears twice.
  void edge_faces(std::vector<std::int32_t>& offsets, std::vector<FaceId>& faces) const;
};

/// A place where two faces meet although they share neither edge nor vertex there.
struct FaceContact {
  std::vector<Vec3> points;     ///< along a curve, one for a touching point; model unit
  bool passes_through = false;  ///< the faces cross; else they touch: tangent to each other, or one ends on the other

  static auto fields(auto& c) { return std::tie(c.points, c.passes_through); }
};

/// Tables plus evaluators, of a B-Rep or of facets. Creating evaluators is const and cheap (tens of microseconds);
/// create, use, drop.
class Model {
 public:
  /// `brep`: the bytes that import_model() made. Throws Error(kInput) when they cannot be read or do not fit the
  /// tables.
  Model(ModelTables tables, std::vector<std::byte> brep);
  /// `facets`: those that make_facet_model() made. Throws Error(kInput) when they do not fit the tables.
  Model(ModelTables tables, FacetShape facets);
  /// `cad` and `brep` as above; tables() are those in which the composites are faces. Throws Error(kInput) where they
  /// contradict each other.
  Model(ModelTables cad, std::vector<std::byte> brep, Composites composites);
  ~Model();
  Model(Model&&) noexcept;
  Model& operator=(Model&&) noexcept;

  const ModelTables& tables() const { return tables_; }
  /// Empty for a model of facets.
  const std::vector<std::byte>& brep() const { return brep_; }
  /// Empty for a model with a B-Rep.
  const FacetShape& facets() const { return facets_; }
  /// The CAD face at each place (u,v) of a face: the only one where the face is none of several.
  std::vector<FaceId> cad_faces(FaceId face, std::span<const Vec2> uv) const;
  /// The model as the CAD has it, where faces of it were joined; else itself.
  const Model& cad() const;

  /// Space curve of an edge. Precondition: not degenerate.
  std::unique_ptr<Curve> curve(EdgeId edge) const;
  /// Surface of a face, bounds = the face's uv bounds.
  std::unique_ptr<Surface> surface(FaceId face) const;
  /// Trimming curve of a coedge in its face's (u,v), parametrised like the edge.
  std::unique_ptr<Curve2d> pcurve(FaceId face, CoedgeId coedge) const;
  /// Where two faces touch or cross besides their common edges and vertices, within the larger of their tolerances and
  /// 1e-6 of the model's diagonal; empty when OpenCASCADE cannot say, and of facets. Milliseconds on analytic surfaces,
  /// up to a second on splines.
  std::vector<FaceContact> contacts(FaceId first, FaceId second) const;

  struct Impl;

 private:
  friend class ModelEditor;
  ModelTables tables_;
  std::vector<std::byte> brep_;
  FacetShape facets_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace st
