// Groups that a user asks for, of faces by name, part, colour, layer, place and surface, of edges and vertices by
// number, name, place and the groups they lie on; in one or several tables.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/length.h"
#include "geometry/shape/surface.h"

namespace st {

struct ModelTables;

/// A coordinate as a user gives it: in the model unit, or with a unit of its own.
struct CoordinateSpec {
  double value = 0;  ///< model unit, or metres
  bool is_in_metres = false;
};

/// Lower corner, upper corner.
using BoxSpec = std::array<CoordinateSpec, 6>;

/// Which entities a group holds: those that meet every kind of selection that is given, of each kind any item.
struct GroupCriteria {
  std::vector<std::string> faces;           ///< 1-based ids "17", ranges "17-20", or glob patterns on face names
  std::vector<std::string> parts, paths;    ///< glob patterns on part names, on assembly paths
  std::vector<std::string> layers, groups;  ///< glob patterns on layers, on the groups that the CAD file made
  std::vector<std::int32_t> colors;         ///< 0xRRGGBB
  std::vector<SurfaceType> surfaces;
  std::vector<std::string> edges;     ///< of edges: as `faces`
  std::vector<std::string> vertices;  ///< of vertices: 1-based ids and ranges
  std::vector<std::string> between;   ///< of edges: two groups or parts, glob patterns: between a face of the one and
                                      ///< one of the other
  std::vector<std::string> rim;       ///< of edges: groups or parts; the outline of all their faces together
  std::vector<std::string> on;  ///< of edges and vertices: groups or parts of whose faces, vertices also groups of
                                ///< whose edges
  std::optional<BoxSpec> inside, touching;  ///< the entity lies in the box; its bounding box meets the box
};

/// One entry of a groups file. An entry without selection speaks of the group of its name that the CAD file made, one
/// of edges of the edges of its name. Entries of one name and table make one group together.
struct GroupRule {
  std::string where;                ///< for messages: "groups.toml:12"
  std::string name;                 ///< UTF-8, not empty
  EntityDim of = EntityDim::kFace;  ///< what the group holds
  std::string table;                ///< empty: the main table, whose groups the mesh is made of
  GroupCriteria selection;
  std::optional<std::string> role;      ///< of faces: one of group_roles(); else from the name
  std::optional<LengthSpec> tolerance;  ///< of faces: kept as attribute "tolerance", model unit
  std::string attributes = "{}";        ///< free keys and values: one JSON object
  bool is_optional = false;             ///< matching nothing is no error
};

/// "wall", "symmetry", "farfield", "inlet", "outlet", "periodic", "interface", "other".
const std::vector<std::string>& group_roles();

/// "plane", "cylinder" ... in the order of SurfaceType.
const std::vector<std::string>& surface_type_names();

/// A group that was allowed to have nothing in it, and has nothing.
struct EmptyGroup {
  std::string name;
  EntityDim of = EntityDim::kFace;
  bool operator==(const EmptyGroup&) const = default;
};

/// Puts faces, edges and vertices into the groups of the rules. Main groups of faces are in the order of their first
/// face, faces that no rule of the main table names keep their group; other tables, groups of edges and of vertices are
/// in the order of the rules. Those of edges see the groups of faces, those of vertices also those of edges, wherever
/// they stand. `edge_box` [n_edges]: needed by boxes of edges. Returns the optional groups without a member. Throws
/// Error(kUsage) naming rule and entity for a rule or an item of it that matches nothing, an id that does not exist, an
/// entity in two groups of one table, groups of two kinds with one name in a table, two entries of a group that
/// disagree, an absolute length in a model without a unit.
std::vector<EmptyGroup> apply_groups(const std::vector<GroupRule>& rules, ModelTables& tables,
                                     std::span<const Box3> edge_box = {});

/// Edges, ascending, between a face of the one and a face of the other of two selections of faces ([n_faces] 1: in it).
/// Faces that both have count where their main groups differ.
std::vector<EdgeId> edges_between(const std::vector<std::uint8_t>& first, const std::vector<std::uint8_t>& second,
                                  const ModelTables& tables);

}  // namespace st
