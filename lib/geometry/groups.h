// Groups of faces that a user asks for: selections by name, part, colour, layer, place and surface, in one or several tables.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/length.h"
#include "geometry/surface.h"

namespace st {

struct ModelTables;

/// A coordinate as a user gives it: in the model unit, or with a unit of its own.
struct CoordinateSpec {
  double value = 0;  ///< model unit, or metres
  bool is_in_metres = false;
};

/// Lower corner, upper corner.
using BoxSpec = std::array<CoordinateSpec, 6>;

/// One entry of a groups file. A face must meet every kind of selection that is given, of each kind any item. An entry without selection
/// speaks of the group of its name that the CAD file made. Entries of one name and table make one group together.
struct GroupRule {
  std::string where;                        ///< for messages: "groups.toml:12"
  std::string name;                         ///< UTF-8, not empty
  std::string table;                        ///< empty: the main table, whose groups the mesh is made of
  std::vector<std::string> faces;           ///< 1-based ids "17", ranges "17-20", or glob patterns on face names
  std::vector<std::string> parts, paths;    ///< glob patterns on part names, on assembly paths
  std::vector<std::string> layers, groups;  ///< glob patterns on layers, on the groups that the CAD file made
  std::vector<std::int32_t> colors;         ///< 0xRRGGBB
  std::vector<SurfaceType> surfaces;
  std::optional<BoxSpec> inside, touching;  ///< the face lies in the box; its bounding box meets the box
  std::optional<std::string> role;          ///< one of group_roles(); else from the name
  std::optional<LengthSpec> tolerance;      ///< kept as attribute "tolerance", model unit
  std::string attributes = "{}";            ///< free keys and values: one JSON object
  bool is_optional = false;                 ///< matching nothing is no error
};

/// "wall", "symmetry", "farfield", "inlet", "outlet", "periodic", "interface", "other".
const std::vector<std::string>& group_roles();

/// "plane", "cylinder" ... in the order of SurfaceType.
const std::vector<std::string>& surface_type_names();

/// Puts faces into the groups of the rules: main groups in the order of their first face, faces that no rule of the main table names keep
/// their group; other tables in the order of the rules. Returns the names of optional groups without a face.
/// Throws Error(kUsage) naming rule and face for a rule or an item of it that matches nothing, an id that does not exist, a face in two
/// groups of one table, two entries of a group that disagree, an absolute length in a model without a unit.
std::vector<std::string> apply_groups(const std::vector<GroupRule>& rules, ModelTables& tables);

}  // namespace st
