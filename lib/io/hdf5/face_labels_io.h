// Labels of faces in artifacts.
#pragma once

#include "base/face_labels.h"
#include "io/hdf5/hdf5_file.h"

namespace st {

/// Datasets /st/group/attributes, /st/part/*, /st/face/part, /st/table/*, /st/edge_group/*, /st/vertex_group/*:
/// docs/artifacts.md. What is empty is left out.
void write_labels(Hdf5Writer& w, const FaceLabels& labels);

/// Empty where the artifact holds none. Throws Error(kInput) for numbers that do not fit.
FaceLabels read_labels(const Hdf5Reader& r, std::size_t n_faces, std::size_t n_groups);

/// Roles of the main groups; of an artifact that holds none, those of their names.
std::vector<std::string> read_roles(const Hdf5Reader& r, const std::vector<std::string>& group_name);

}  // namespace st
