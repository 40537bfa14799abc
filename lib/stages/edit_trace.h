// Which entity of which input each entity of an edited geometry is, and where findings of the inputs are now. Internal
// to stages.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/similarity.h"
#include "geometry/import/import.h"
#include "io/hdf5/artifact.h"

namespace st {

/// An entity of an input.
struct Origin {
  std::int32_t id = kNone;     ///< in the input
  std::int32_t input = kNone;  ///< number of the input
};

struct EditTrace {
  std::vector<Origin> faces, edges, vertices;

  /// Adds the entities of one more input behind the others.
  void append(const ModelTables& tables, std::int32_t input);
  /// After a part was taken: which of the entities so far each one was.
  void select(std::span<const FaceId> new_faces, std::span<const EdgeId> new_edges,
              std::span<const VertexId> new_vertices);
};

/// [2*n] as GeometryArtifact has it.
std::vector<std::int32_t> previous_ids(const std::vector<Origin>& origins);

/// Findings of the inputs with the numbers, places and sizes of the result, without those of entities that are gone and
/// of free and non-manifold edges. `motion`, [n_faces]: how each face of the result moved.
std::vector<ImportFinding> carry_findings(const std::vector<std::vector<ImportFinding>>& of_input,
                                          const EditTrace& trace, const ModelTables& result,
                                          std::span<const Similarity> motion);

}  // namespace st
