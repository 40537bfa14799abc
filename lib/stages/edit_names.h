// Names in st-edit: of its inputs, of what it is told to take, and of groups that several inputs have. Internal to
// stages.
#pragma once

#include <string>
#include <vector>

#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"

namespace st {

/// Pieces of a text between commas, blanks around them left out.
std::vector<std::string> split_names(const std::string& text);

/// Faces that `names` speaks of, ascending: a list, separated by commas, of numbers (17), ranges (3-7), names as
/// find_faces() takes them and, where these match nothing, names of faces; `*`, `?` and `[abc]` may stand in names. A
/// text that is a name as a whole is one. Throws Error(kUsage) naming `option` and the nearest name for what matches
/// nothing.
std::vector<FaceId> select_faces(const std::string& names, const ModelTables& tables, const std::string& option);

/// Names of the inputs: those given ("wing,flap"), else the stem of each file; of one called geometry.hdf that of its
/// CAD file. Unique: a later one of the same name is wing#2. Throws Error(kUsage) when not as many are given as there
/// are inputs.
std::vector<std::string> input_names(const std::string& given, const std::vector<std::string>& paths,
                                     const std::vector<GeometryArtifact>& inputs);

/// The further table of groups that says of each face which input it is of.
inline constexpr const char* kInputTable = "input";

/// Puts all faces that are in no group of the table `input` into one of this name.
void label_input(const std::string& name, ModelTables& tables);

/// Names of --join that a group of no input has are refused: throws Error(kUsage) with the nearest name. Patterns that
/// match none, and what only one input has, are warned of.
void require_join_names(const std::vector<std::string>& join, const std::vector<GeometryArtifact>& inputs);

/// Before `second` is appended to `first`: groups and paths of parts that `first` has, too, get `name` and '/' in
/// front, but for groups whose names `join` matches. Throws Error(kMismatch) for such a group of other entities or with
/// another role in `first`.
void keep_names_apart(const ModelTables& first, const std::string& name, const std::vector<std::string>& join,
                      ModelTables& second);

/// The attribute `tolerance` of all groups, a length, multiplied by `scale`.
void scale_tolerances(double scale, FaceLabels& labels);

}  // namespace st
