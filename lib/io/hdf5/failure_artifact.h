// failures.hdf: faces that could not be meshed, to look at (docs/artifacts.md).
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/artifact.h"
#include "mesh/face_attempt.h"

namespace st {

inline constexpr int kFailuresVersion = 1;

struct FailureArtifact {
  ArtifactHeader header;
  std::vector<FaceFailure> failures;   ///< by face
  std::vector<FaceAttempt> attempts;   ///< how far each came, in the same order
  std::vector<std::string> face_name;  ///< [n_faces] of the whole model
};

/// "patches.hdf" -> "patches.failures.hdf": where the failures of a run that writes `output` are.
std::string failures_path(const std::string& output);

/// Writes the artifact, an unstructured grid of VTKHDF that ParaView opens: segments of the loops, triangles so far,
/// places. Atomic, equal content gives equal bytes. Returns the content hash. Throws Error(kOutput).
std::string write_failures(const std::string& path, const FailureArtifact& failures);

/// Removes the failures of an earlier run; a file of this name that is no such artifact stays. Throws Error(kOutput)
/// when it cannot be removed.
void remove_failures(const std::string& path);

/// The grid as a .vtu file for other programs. Throws Error(kUsage) for another suffix, Error(kInput), Error(kOutput).
void export_failures(const std::string& artifact, const std::string& output);

}  // namespace st
