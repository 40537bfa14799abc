// Labels of faces in artifacts.
#pragma once

#include "base/face_labels.h"
#include "io/hdf5/hdf5_file.h"

namespace st {

/// Datasets /st/group/attributes, /st/part/*, /st/face/part, /st/table/*, /st/edge_group/*, /st/vertex_group/*:
/// docs/artifacts.md. What is empty is left out.
void write_labels(Hdf5Writer& w, const FaceLabels& labels);

/// The same with names of faces, the main groups and, where the artifact holds them, the main groups of faces. Roles of
/// an artifact that holds none are those of the groups' names. Throws Error(kInput) for numbers that do not fit.
FaceLabels read_labels(const Hdf5Reader& r, std::size_t n_faces);

}  // namespace st
