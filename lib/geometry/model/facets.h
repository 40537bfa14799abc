// A coarse triangulation of the CAD, for measuring: chords, thicknesses. No mesh for a flow.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "base/executor.h"
#include "geometry/model/model.h"

namespace st {

/// How closely facets follow the surfaces.
struct FacetLimits {
  double deflection = 0;       ///< largest distance from the surface, model unit, > 0
  double angle = radians(20);  ///< largest turning of the normal or tangent along a facet, radians
  bool is_exact = false;       ///< false: inside faces, only nodes between knots are made sure of, at half the cost
};

/// Triangles of faces; where two faces share an edge, their triangles share its nodes.
struct Facets {
  std::vector<Vec3> xyz;                              ///< [n_nodes] model unit
  std::vector<std::array<std::int32_t, 3>> triangle;  ///< [n_triangles] nodes, in no certain orientation
  std::vector<FaceId> face;                           ///< [n_triangles] ascending
  std::vector<std::int32_t> along_x = {};             ///< nodes by x, then by number; of a model that has facets a hash
                                                      ///< table of nodes by place. For add_facets(): not packed

  static auto fields(auto& f) { return std::tie(f.xyz, f.triangle, f.face); }
};

/// Collective. Facets of the faces with `is_wanted` ([n_faces] 1: yes), by OpenCASCADE's BRepMesh, or those of a model
/// that has its own, whatever `limits` say; complete on rank 0,
/// empty elsewhere; some faces are a task. Faces that it cannot do are left out. Cost: some microseconds per facet.
Facets make_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                   const Executor& executor = SerialExecutor());
/// Makes them in the same way, and adds them to those of other faces.
void add_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                const Executor& executor, Facets& facets);
/// Collective. Makes them in the same way, but for nodes: those of faces that share an edge may be there twice.
Facets make_unjoined_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits,
                            const Executor& executor);
/// Local. Adds others to `all`, with nodes of their own.
void append_facets(Facets&& more, Facets& all);
/// Local. Adds facets of `model` that may have nodes twice to those of other faces.
void join_facets(const Model& model, Facets&& unjoined, Facets& facets);

}  // namespace st
