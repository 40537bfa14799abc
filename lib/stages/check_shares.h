// st-check of a mesh that is never in memory as a whole: share by share, over ranks. Internal to the check stage.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/executor.h"
#include "base/progress.h"
#include "io/hdf5/mesh_file.h"
#include "sizing/wing_record.h"
#include "stages/check_parts.h"

namespace st {

/// Triangles of a share, about: it takes some 400 MB.
inline constexpr std::int64_t kTrianglesPerShare = 512 * static_cast<std::int64_t>(kTrianglesPerPiece);

/// Whether the mesh may be larger than one share: nothing is read. Many ranks share small ones, too.
bool is_worth_sharing(const CheckStageOptions& options, const Executor& ranks);

/// A mesh of this program that is not in memory, with its geometry and sizes.
struct SharedMesh {
  /// Throws Error(kInput), Error(kMismatch).
  explicit SharedMesh(const CheckStageOptions& options);

  MeshFile file;
  std::unique_ptr<CadSide> cad;      ///< null: not given
  std::unique_ptr<SizeField> field;  ///< likewise
  std::vector<WingRecord> wings;     ///< lifting surfaces that the sizes know
};

/// What was found of all shares.
struct SharedFindings {
  CheckBasis basis;
  CheckParts parts;                     ///< without pairs
  MeshSelection edges;                  ///< the nodes on edges and vertices alone
  MeshSelection crossing;               ///< triangles of the pairs
  std::vector<TrianglePair> pairs;      ///< of triangles of `crossing`
  std::vector<std::int32_t> component;  ///< of its nodes
  bool was_ended = false;
};

/// Collective. Everything that a mesh in memory is measured for, but for lifting surfaces: the same bits at every
/// number of ranks and shares. Each rank reads its shares from the file, with the triangles around them, one at a time.
/// On other ranks than the first `parts` are empty. Nothing on any rank where the mesh is to be measured as a whole:
/// it is too small to be shared, its triangles do not come face by face, or read_mesh() would refuse it. Only `cad`,
/// `field` and `options` of `given` count. `per_share`: triangles of a share, about.
std::optional<SharedFindings> measure_shares(const CheckBasis& given, const MeshFile& file, const Executor& ranks,
                                             Progress& progress, std::int64_t per_share = kTrianglesPerShare);

}  // namespace st
