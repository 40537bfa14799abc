// Meshes for other programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/hdf5/node_values.h"
#include "mesh/mid_nodes.h"
#include "mesh/quad_pairs.h"
#include "mesh/surface_mesh.h"
#include "sizing/size_field.h"

namespace st {

/// Text or binary, where a format has both.
enum class Encoding { kOfFormat, kText, kBinary };

/// What is written how.
struct ExportOptions {
  std::string format;  ///< a suffix without its first dot ("msh2"); empty: the suffix of the file
  Encoding encoding = Encoding::kOfFormat;
  bool has_quads = false;        ///< quadrilaterals are wanted
  bool has_mid_nodes = false;    ///< elements of second order are wanted
  bool has_parameters = false;   ///< t on edges and (u,v) on faces are wanted
  double feature_angle_deg = 0;  ///< .eMesh: sides between faces that turn by at least this are features
  std::string unit;              ///< of the coordinates: "mm" ...; empty: unknown
};

/// Something measured of each triangle, for formats that show it (.vtu).
struct TriangleValues {
  std::string name;                ///< of the array: "quality"
  std::vector<float> of_triangle;  ///< [n_triangles]
};

/// A mesh as elements.
struct ExportMesh {
  const SurfaceMesh& mesh;
  const QuadPairs& elements;
  const MidNodes& mid_nodes;  ///< empty: straight elements; else of every side of every element
  std::span<const TriangleValues> values = {};
  std::span<const NodeValues> node_values = {};
};

/// Whether export_mesh() knows a format by the suffix of this path.
bool has_export_suffix(const std::string& path);

/// Throws Error(kUsage) unless a format is known that has all that is wanted: encoding, quadrilaterals, second order.
void require_export_format(const std::string& path, const ExportOptions& options);

/// The suffixes of all formats, without those that say the encoding or are another one's: ".stl .vtu".
std::string export_suffixes();

/// Exports by suffix (docs/st-export.md). Names of faces, groups and parts go into all that can hold them. Elements are
/// in the order triangles, quadrilaterals (.msh, .cgns, .obj: in blocks). Returns what the format has no room for, for
/// a message: "names of groups (3)"; empty when nothing is lost. Throws Error(kUsage) as above, Error(kOutput).
std::vector<std::string> export_mesh(const std::string& path, const ExportMesh& mesh, const ExportOptions& options);
std::vector<std::string> export_mesh(const std::string& path, const SurfaceMesh& mesh);

/// What export_mesh() writes besides `path`: the list of boundaries of .ugrid. Throws as require_export_format().
std::vector<std::string> files_beside(const std::string& path, const ExportOptions& options);

/// The path of one group's file: "wing.ascii.stl" and "TAIL" give "wing_TAIL.ascii.stl".
std::string path_of_group(const std::string& path, const std::string& word);

/// Names of all groups as words that no other group has: "a b" and "a_b" become "a_b" and "a_b_2". Bytes that a file
/// name or a CGNS node cannot have ('/') become '_', too.
std::vector<std::string> group_words(const SurfaceMesh& mesh);

/// The requested size at each node as Medit's .sol: a length, or the metric where `field` is stretched. Throws
/// Error(kOutput).
void export_sol(const std::string& path, const SurfaceMesh& mesh, const SizeField& field);

}  // namespace st
