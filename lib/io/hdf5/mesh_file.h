// mesh.hdf, share after share: for who need not have all of it in memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/artifact.h"
#include "io/hdf5/row_reader.h"
#include "mesh/own_triangles.h"

namespace st {

/// Some triangles of a mesh, with the nodes that these need.
struct MeshSelection {
  SurfaceMesh mesh;  ///< with labels and merged features
  TriangleId begin = 0, end = 0, first = 0;
  std::vector<NodeId> node_number;          ///< [n_nodes] in the whole mesh, ascending
  std::vector<TriangleId> triangle_number;  ///< [n_triangles] likewise

  OwnTriangles own() const { return {begin, end, first, node_number}; }
};

class MeshFile {
 public:
  /// Reads all but the rows of nodes and triangles. Throws Error(kInput) as read_mesh() does.
  explicit MeshFile(const std::string& path);

  /// What is not in rows.
  const MeshArtifact& head() const { return head_; }
  bool has_cad_faces() const { return reader_.has(kCadFaces); }
  std::int64_t n_nodes() const { return n_nodes_; }
  std::int64_t n_triangles() const { return n_triangles_; }

  /// Rows [first, first + n), as read_mesh() has them. From any thread.
  std::vector<Vec3> points(std::int64_t first, std::int64_t n) const;
  std::vector<std::uint8_t> dims(std::int64_t first, std::int64_t n) const;
  std::vector<Triangle> triangles(std::int64_t first, std::int64_t n) const;
  std::vector<FaceId> faces(std::int64_t first, std::int64_t n) const;
  std::vector<std::int32_t> groups(std::int64_t first, std::int64_t n) const;
  std::vector<FaceId> cad_faces(std::int64_t first, std::int64_t n) const { return ids(kCadFaces, first, n); }
  std::vector<Vec2> corner_uv(std::int64_t first_triangle, std::int64_t n_triangles) const;

  /// Whether this part of rows and checksums is what read_mesh() takes, nodes come by the dimension of their entities,
  /// which are below `n_entities` by dimension, and no entity is a group's that faces do not have. read_mesh() says
  /// what is wrong.
  bool is_sound(int part, int n_parts, const std::array<std::int64_t, 3>& n_entities) const;

  /// Triangles [begin, end) and all others that have a node in common with them; of nodes also all on edges and
  /// vertices. Local, on all threads; goes through all triangles of the file.
  MeshSelection share(TriangleId begin, TriangleId end) const;
  /// What of a selection is read: kPlaces: nodes of triangles and their places, and faces and groups.
  enum class Rows { kPlaces, kAll, kAllWithEdgeNodes };
  /// Triangles, ascending; kAllWithEdgeNodes: also all nodes on edges and vertices.
  MeshSelection select(std::vector<TriangleId> triangles, Rows rows) const;
  /// Calls visit(some of them) until it had all triangles of faces that are wanted, in order; kPlaces of them are read.
  void for_faces(const std::function<bool(FaceId)>& is_wanted,
                 const std::function<void(const MeshSelection&)>& visit) const;

 private:
  static constexpr const char* kCadFaces = "/VTKHDF/CellData/cad_face";
  std::vector<std::int32_t> ids(const char* name, std::int64_t first, std::int64_t n) const;
  bool are_nodes_sound(std::int64_t begin, std::int64_t end, const std::array<std::int64_t, 3>& n_entities) const;
  bool are_triangles_sound(std::int64_t begin, std::int64_t end) const;
  std::vector<TriangleId> find_neighbours(TriangleId begin, TriangleId end) const;
  void read_nodes(Rows rows, MeshSelection& share) const;

  Hdf5Reader reader_;
  RowReader rows_;
  MeshArtifact head_;
  std::int64_t n_nodes_ = 0, n_triangles_ = 0, n_edge_nodes_ = 0;
};

}  // namespace st
