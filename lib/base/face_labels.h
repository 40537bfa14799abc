// What CAD files and users say of faces: names, main groups and their roles, parts, attributes of groups, further
// tables of groups, groups of edges and of vertices.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/ids.h"

namespace st {

/// A second, third ... division of the faces into groups, beside the main one. Groups count from 0 within their table.
struct GroupTable {
  std::string name;                           ///< letters, digits, '_' and '-'; unique
  std::vector<std::string> group_name;        ///< [n_groups] UTF-8, unique
  std::vector<std::string> group_role;        ///< [n_groups] as of the main groups
  std::vector<std::string> group_attributes;  ///< [n_groups] one JSON object each, "{}": none
  std::vector<std::int32_t> face_group;       ///< [n_faces] kNone: in no group of this table
  bool operator==(const GroupTable&) const = default;
};

/// A group of edges or of vertices, in the main or a further table.
struct EntityGroup {
  std::string name;               ///< UTF-8; in its table no other group has it, of whatever entities
  std::string table;              ///< as GroupTable::name, empty: the main table
  std::string attributes = "{}";  ///< one JSON object, "{}": none
  std::vector<std::int32_t> ids;  ///< [n >= 1] 0-based, ascending; an edge or vertex is in one group of a table
  bool operator==(const EntityGroup&) const = default;
};

/// Labels of a model or mesh, empty where nobody said anything.
struct FaceLabels {
  std::vector<std::string> face_name;         ///< [n_faces] UTF-8, empty when the file has none
  std::vector<std::int32_t> face_group;       ///< [n_faces] main group: by the groups file, else face name, else part
                                              ///< name, else "default"; mesh.hdf holds it by triangle instead
  std::vector<std::string> group_name;        ///< [n_groups] of the main groups, UTF-8
  std::vector<std::string> group_role;        ///< [n_groups] one of group_roles() (groups.h): by the groups file, else
                                              ///< role_of_name(); in a mesh perhaps empty: those of the names
  std::vector<std::string> group_attributes;  ///< [n_groups] of the main groups: one JSON object each, "{}": none; or
                                              ///< empty
  std::vector<GroupTable> tables;             ///< in the order of the groups file
  std::vector<std::string> part_name;         ///< [n_parts] UTF-8; instances of a part have the same name
  std::vector<std::string> part_path;    ///< [n_parts] "assembly/sub#2/bolt#3": unique; #k is the k-th of that name in
                                         ///< its assembly
  std::vector<std::int32_t> face_part;   ///< [n_faces] kNone: of no part; or empty: no parts
  std::vector<EntityGroup> edge_groups;  ///< in the order of the groups file
  std::vector<EntityGroup> vertex_groups;  ///< likewise

  /// Name and path of the part of a face; empty when it has none.
  const std::string& part_of(FaceId f) const;
  const std::string& path_of(FaceId f) const;
  bool operator==(const FaceLabels&) const = default;
};

/// Labels of some faces, in this order; groups and parts keep their numbers, groups of edges and vertices all they
/// have.
FaceLabels select_labels(const FaceLabels& labels, std::span<const FaceId> faces);

/// Labels of `n_first` faces and, behind them, of `n_second` others. Tables of one name become one, groups of one name
/// and role in them and in the main one, too; parts stay apart, those of `second` with a path that `first` has get the
/// next free number. Groups of edges and vertices stay those of `first`.
FaceLabels append_labels(const FaceLabels& first, std::int32_t n_first, const FaceLabels& second,
                         std::int32_t n_second);

/// Groups of those ids that have a place in `place` ([n ids of the whole] kNone: none), under that number; groups left
/// empty go.
std::vector<EntityGroup> select_groups(const std::vector<EntityGroup>& groups, std::span<const std::int32_t> place);

/// Adds groups whose ids are raised by `shift`, behind all ids of `to`; those of one name and table become one.
void append_groups(std::vector<EntityGroup>& to, const std::vector<EntityGroup>& more, std::int32_t shift);

/// Whether the name is this one or matches this glob pattern (`*`, `?`, `[abc]`); no name matches nothing.
bool name_matches(const std::string& pattern, const std::string& name);

/// Faces of the main groups whose names match a glob pattern; where none does, of the groups of further tables ("hot",
/// or "bc:hot" with the name of the table), else of parts with such a name, else of parts with such a path. [n_faces]
/// 1: in it; empty: nothing matches.
std::vector<std::uint8_t> find_faces(const std::string& pattern, const FaceLabels& labels);

/// Ids, ascending, of the groups of edges (or vertices) in the main table whose names match a glob pattern; where none
/// does, of those in further tables ("te", or "bc:te" with the name of the table). Empty: nothing matches.
std::vector<std::int32_t> find_members(const std::string& pattern, const std::vector<EntityGroup>& groups);

/// Of a pattern that no group of faces matches, for messages: " (it names a group of edges)", "... of vertices)", else
/// the group or part that was meant, ", did you mean 'flap'"; empty where none is near.
std::string say_other_kind(const std::string& pattern, const FaceLabels& labels);

/// Tolerance of each face: the largest that its groups have as attribute "tolerance" in any table. [n_faces] model
/// unit, 0: none; empty: no group has one.
std::vector<double> face_tolerances(const FaceLabels& labels);

/// `path`, or the first of path#2, path#3 ... that `taken` lacks.
std::string unique_path(const std::string& path, const std::vector<std::string>& taken);

/// Role that whole words of a name give, whatever their case: "far field", "farfield" -> "farfield"; "symmetry", "sym",
/// "symm", "SymmetryPlane", "symm-y0" -> "symmetry"; all else, "asymmetry" and "symbol" too, -> "wall". A word is a run
/// of letters; a capital behind a small letter begins a new one.
std::string role_of_name(const std::string& name);

/// Role of a main group: its own, or where none is stored that of its name.
std::string role_of(const FaceLabels& labels, std::size_t group);

/// Whether faces of this role bound the air and not the body: "farfield", "symmetry".
bool is_outer_role(const std::string& role);

}  // namespace st
