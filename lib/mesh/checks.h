// Is a merged mesh closed, manifold, oriented, free of folds and crossings? (docs/checks.md)
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/crossing.h"
#include "mesh/own_triangles.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Where a defect is.
struct DefectPlace {
  Vec3 xyz;                               ///< model unit
  FaceId face_a = kNone, face_b = kNone;  ///< 0-based CAD faces, kNone when there is no second one
  std::int64_t order = 0;                 ///< among the defects of its kind, in the order of the mesh
};

/// Defects of one kind: how many, and where the first of them are.
struct Defects {
  static constexpr std::size_t kMaxPlaces = 10;
  std::int64_t count = 0;
  std::vector<DefectPlace> first;  ///< at most kMaxPlaces, in the order of the mesh

  void add(const DefectPlace& place) {
    ++count;
    if (first.size() < kMaxPlaces) first.push_back(place);
  }
  /// Those of another share of the mesh.
  void merge(const Defects& other);

  static auto fields(auto& d) { return std::tie(d.count, d.first); }
};

/// Where the CAD itself is open or non-manifold. Empty spans: nowhere.
struct CadEdges {
  std::span<const VertexId> edge_vertices;           ///< [2*n_edges]
  std::span<const std::uint8_t> may_be_open;         ///< [n_edges] 1: used by one face only
  std::span<const std::uint8_t> may_be_nonmanifold;  ///< [n_edges] 1: used by more than two faces
};

/// What hangs together.
struct MeshParts {
  std::int64_t n_used_nodes = 0;
  std::int32_t n_components = 0;  ///< connected by common nodes
};
MeshParts count_parts(std::span<const Triangle> triangles, std::int64_t n_nodes);

/// How triangles meet.
struct TopologyReport {
  std::int64_t n_edges = 0;
  std::int64_t n_used_nodes = 0;
  std::int32_t n_components = 0;  ///< connected by common nodes
  std::int64_t euler = 0;         ///< nodes - edges + triangles (those without a repeated node)
  std::int64_t genus = 0;         ///< of all components together; meaningful when is_closed() and nothing is pinched
  Defects boundary_edges;         ///< used by one triangle
  Defects nonmanifold_edges;      ///< used by more than two
  Defects misoriented_edges;      ///< used by two triangles that run along it the same way
  Defects repeated_nodes;         ///< triangles that name a node twice
  Defects duplicate_triangles;    ///< triangles with the same three nodes as an earlier one
  Defects pinched_nodes;          ///< nodes whose triangles form more than one fan: parts that touch in a point
  std::int64_t n_cad_boundary_edges = 0;  ///< used by one triangle, where the CAD is open, too: in no list
  std::int64_t n_cad_nonmanifold_edges = 0;

  /// Closed, or open only where the CAD is, and manifold likewise.
  bool is_closed() const { return boundary_edges.count == 0 && nonmanifold_edges.count == 0; }
  bool passes() const {
    return is_closed() && misoriented_edges.count == 0 && repeated_nodes.count == 0 && duplicate_triangles.count == 0;
  }
  /// Those of another share of the mesh.
  void add(const TopologyReport& other);
  /// Sets what follows from the parts of the whole mesh.
  void set_parts(const MeshParts& parts, std::int64_t n_triangles);

  static auto fields(auto& r) {
    return std::tie(r.n_edges, r.boundary_edges, r.nonmanifold_edges, r.misoriented_edges, r.repeated_nodes,
                    r.duplicate_triangles, r.pinched_nodes, r.n_cad_boundary_edges, r.n_cad_nonmanifold_edges);
  }
};

/// Local, linear. `edges`: edges_of(mesh). Precondition: node ids within the mesh.
TopologyReport check_topology(const SurfaceMesh& mesh, const EdgeTable& edges, const CadEdges& cad = {});
/// Of a share; what set_parts() sets of a whole mesh only.
TopologyReport check_topology(const SurfaceMesh& mesh, const EdgeTable& edges, const CadEdges& cad,
                              const OwnTriangles& own);

/// Neighbours of one CAD face whose normals differ by more than this are a fold: cos(148.2 deg).
inline constexpr double kFoldCosine = -0.85;

/// Areas and volume.
struct MeshMeasure {
  double area = 0;                ///< model unit squared
  double volume = 0;              ///< model unit cubed, signed; meaningful for a closed mesh
  std::vector<double> face_area;  ///< [n_faces] by CAD face
};

/// Local, linear.
MeshMeasure measure_mesh(const SurfaceMesh& mesh);

/// What the triangles of one face in one piece add to it (kTrianglesPerPiece).
struct MeasurePart {
  FaceId face = kNone;
  double area = 0, volume = 0;
};
/// Of a share, in order; volumes are cones from `origin`, for a closed mesh any point.
std::vector<MeasurePart> measure_mesh(const SurfaceMesh& mesh, Vec3 origin, const OwnTriangles& own);
/// Of all shares, in order.
MeshMeasure measure_of(std::span<const MeasurePart> parts, std::size_t n_faces);

/// Where nodes and triangles lie.
struct ShapeReport {
  Defects zero_area;        ///< three different nodes exactly on a line
  Defects duplicate_nodes;  ///< nodes of one component at the coordinates of an earlier one, CAD vertices both apart
  Defects folds;            ///< edges between triangles of one CAD face that turn back on each other (kFoldCosine)
  bool passes() const { return zero_area.count == 0 && duplicate_nodes.count == 0 && folds.count == 0; }
  /// Those of another share of the mesh.
  void add(const ShapeReport& other);

  static auto fields(auto& r) { return std::tie(r.zero_area, r.duplicate_nodes, r.folds); }
};

/// Local, n log n. `edges`: edges_of(mesh).
ShapeReport check_shape(const SurfaceMesh& mesh, const EdgeTable& edges);
/// Of a share; duplicate nodes of a whole mesh only.
ShapeReport check_shape(const SurfaceMesh& mesh, const EdgeTable& edges, const OwnTriangles& own);

/// Of a whole mesh.
Defects find_duplicate_nodes(const SurfaceMesh& mesh);

/// Which triangles meet where they should not. Exact.
struct CrossingReport {
  Defects crossings;               ///< pairs within one component, or of one body, without a common node that have a
                                   ///< point in common
  Defects overlapping_neighbours;  ///< pairs with one or two common nodes that have more in common than these
  Defects contacts;      ///< pairs of different components that have a point in common, or of a body and a sheet that
                         ///< ends on it: parts in contact, no defect
  Defects walls;         ///< contacts where the CAD keeps the parts apart
  Defects cad_contacts;  ///< pairs of crossings and overlapping neighbours where the CAD touches itself
  bool passes() const { return crossings.count == 0 && overlapping_neighbours.count == 0; }
};

/// Answers of the CAD about pairs of triangles; they are asked in the order of the pairs. Empty: never.
struct CadOfPairs {
  std::function<bool(const TrianglePair&)> touches_itself = {};  ///< of a pair of one component
  std::function<bool(const TrianglePair&)> keeps_apart = {};     ///< of a pair of two components
  std::function<bool(const TrianglePair&)> is_one_body = {};     ///< likewise: two sides of one body
  /// Of a pair of one component where the CAD touches itself: a body, and a sheet that ends on it.
  std::function<bool(const TrianglePair&)> is_of_sheet = {};
};

/// Local, n log n; a second per million triangles.
CrossingReport check_crossings(const SurfaceMesh& mesh, const CadOfPairs& cad = {});
/// The same of pairs that were found, sorted by (a, b). `component`: [n_nodes] as node_components() has it, or empty
/// where there is no pair; `was_ended`: see find_crossing_triangles().
CrossingReport check_crossings(const SurfaceMesh& mesh, std::span<const TrianglePair> pairs,
                               std::span<const std::int32_t> component, bool was_ended, const CadOfPairs& cad);

}  // namespace st
