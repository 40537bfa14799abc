// Artifacts: HDF5 files that connect the stages. The only public face of HDF5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/model/finding.h"
#include "geometry/model/mirror.h"
#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Newest schema versions that this build reads, and those that it writes.
inline constexpr int kGeometryVersion = 2, kPatchesVersion = 2, kMeshVersion = 1;

/// An input that an artifact was made from.
struct InputRef {
  std::string role;  ///< "cad", "geometry", "raster", "sizing", "patches", "mesh"
  std::string name;  ///< file name without directory
  std::string hash;  ///< content hash of the artifact (or of the bytes of a CAD file)
};

/// What every artifact says of itself.
struct ArtifactHeader {
  std::string schema;  ///< "geometry", "raster", "sizing", "patches", "mesh"
  int schema_version = 1;
  std::string tool, tool_version;
  std::string options_json;  ///< resolved options of the stage, one JSON object
  std::string unit;          ///< empty: the model has none
  std::optional<double> unit_in_m;
  std::string content_hash;   ///< set by write_*, checked by read_*; covers content, not provenance
  std::string geometry_hash;  ///< content hash of the geometry everything goes back to (empty in geometry itself)
  std::vector<InputRef> inputs;
};

/// geometry.hdf
struct GeometryArtifact {
  ArtifactHeader header;
  ModelTables tables;
  std::vector<std::byte> brep;
  FacetShape facets;      ///< instead, of a model of facets
  Composites composites;  ///< faces of the CAD that are one in `tables`
  ModelTables cad;        ///< where there are any: the tables that go with `brep`
  Mirror mirror;          ///< of an imported model of which one half is the image of the other
  std::vector<ImportFinding> findings;
  bool is_closed = false;
  /// [2*n] What each was: id (kNone: none) and input (index into header.inputs). Of an edited geometry; of an imported
  /// one the faces, in the CAD file, where they have other numbers there; empty else. Provenance, not content.
  std::vector<std::int32_t> previous_faces, previous_edges, previous_vertices;
};

/// patches.hdf: what st-mesh and st-remesh hand to st-merge, self-contained.
struct PatchesArtifact {
  ArtifactHeader header;
  EdgeMesh edges;
  std::vector<Vec3> vertex_xyz;
  std::vector<VertexId> edge_vertices;  ///< [2*n_edges]
  std::vector<FacePatch> patches;       ///< by face id
  std::vector<FaceFailure> failures;
  MergedFeatures merged;
  FaceLabels labels;
  std::vector<std::int32_t> face_shell;
  std::vector<double> face_area;  ///< CAD area, for the check of the merged mesh
  Composites composites;          ///< of the geometry: its faces that are several of the CAD
  bool is_complete = true;        ///< every face meshed
};

/// mesh.hdf
struct MeshArtifact {
  ArtifactHeader header;
  SurfaceMesh mesh;
  bool is_complete = true;
  // where faces are several of the CAD, else empty
  std::vector<FaceId> triangle_cad_face;  ///< [n_triangles] at its middle
  std::vector<FaceId> node_cad_face;      ///< [n_nodes] kNone: on an edge or a vertex
  std::vector<Vec2> node_cad_uv;          ///< [n_nodes] on that face, 0 on edges and vertices
};

/// The rows of one array, given in pieces, in order.
template <class T>
struct Column {
  using Take = std::function<void(std::span<const T>)>;
  std::size_t n_rows = 0;
  std::function<void(const Take& take)> give;
};

/// The nodes and triangles of a mesh that are not in memory all at once. Columns are asked for from several threads.
struct MeshColumns {
  Column<Vec3> node_xyz;
  Column<std::uint8_t> node_entity_dim;
  Column<std::int32_t> node_entity;
  Column<double> node_t, node_size;
  Column<Triangle> triangles;
  Column<FaceId> triangle_face;
  Column<std::int32_t> triangle_group;
  Column<Vec2> corner_uv;
  std::optional<Column<NodeId>> node_previous;                     ///< of what st-remesh made
  std::optional<Column<TriangleId>> triangle_previous;             ///< likewise
  std::optional<Column<FaceId>> triangle_cad_face, node_cad_face;  ///< as in MeshArtifact
  std::optional<Column<Vec2>> node_cad_uv;                         ///< likewise

  std::int64_t n_nodes() const { return static_cast<std::int64_t>(node_xyz.n_rows); }
  std::int64_t n_triangles() const { return static_cast<std::int64_t>(triangles.n_rows); }
};

/// Header of any artifact; what else is in the file is for its reader to judge. Throws Error(kInput) for a missing
/// file, a directory, an empty file, a file that is no artifact, a truncated one.
ArtifactHeader read_header(const std::string& path);

/// All write_* functions: written to a temporary name in the same directory, synced, renamed; nothing is left behind on
/// failure, nor on SIGINT/SIGTERM (remove_temporaries). Equal content gives equal bytes. Return the content hash. Throw
/// Error(kOutput). All read_* functions: throw Error(kInput) naming file, dataset and remedy for a wrong kind, a wrong
/// version, truncation or a checksum that does not fit.
std::string write_geometry(const std::string& path, const GeometryArtifact& geometry);
GeometryArtifact read_geometry(const std::string& path);
std::string write_patches(const std::string& path, const PatchesArtifact& patches);
PatchesArtifact read_patches(const std::string& path);
std::string write_mesh(const std::string& path, const MeshArtifact& mesh);
/// Of `mesh` what MeshColumns do not have; its nodes are the first of them, those on vertices and edges at least.
std::string write_mesh(const std::string& path, const MeshArtifact& mesh, const MeshColumns& columns);
MeshArtifact read_mesh(const std::string& path);

/// Throws Error(kMismatch) unless both go back to the same geometry; the message names both files.
void require_same_geometry(const std::string& path_a, const ArtifactHeader& a, const std::string& path_b,
                           const ArtifactHeader& b);

}  // namespace st
