// patches.hdf, written by whoever has the patches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "io/file/row_file.h"
#include "io/hdf5/artifact.h"
#include "mesh/patch_section.h"

namespace st {

/// How much room a patch takes.
struct PatchCounts {
  FaceId face = kNone;
  std::int64_t n_boundary = 0, n_inner = 0, n_triangles = 0, n_own_uv = 0;
};
PatchCounts counts_of(const FacePatch& patch);

/// Where the rows of the patches go, for all ranks.
struct PatchTarget {
  static constexpr std::size_t kArrays = 11;  ///< the last two are of what st-remesh kept

  std::string file, label;
  std::vector<std::uint64_t> begin;                             ///< [kArrays, or two less] of the arrays, bytes
  std::vector<FaceId> face;                                     ///< [n_patches] of each
  std::vector<std::int64_t> boundary, inner, triangle, own_uv;  ///< [n_patches+1] rows

  static auto fields(auto& t) {
    return std::tie(t.file, t.label, t.begin, t.face, t.boundary, t.inner, t.triangle, t.own_uv);
  }
};

/// The file, and all of it but the patches. Of one rank.
class PatchesWriter {
 public:
  /// `patches.patches` is not used; `counts`: of all patches, by face. Throws Error(kOutput), as all functions here.
  PatchesWriter(const std::string& path, const PatchesArtifact& patches, const std::vector<PatchCounts>& counts);
  ~PatchesWriter();
  PatchesWriter(const PatchesWriter&) = delete;
  PatchesWriter& operator=(const PatchesWriter&) = delete;

  const PatchTarget& target() const { return target_; }
  /// When the rows of all patches are written: the file gets its name. Returns the content hash.
  std::string commit();

 private:
  std::unique_ptr<class Hdf5Writer> writer_;
  PatchTarget target_;
};

/// The rows of patches, written into their places by any rank.
class PatchRowsFile {
 public:
  /// `target` outlives the object.
  explicit PatchRowsFile(const PatchTarget& target) : target_(target), file_(target.file, target.label) {}
  /// Writes rows of patch i of the target, in pieces of some megabytes that threads share. Callable on several threads.
  /// Precondition: they are of that face, and within its size.
  void write(std::size_t i, const FacePatch& rows, const PatchPlace& place = {}) const;
  void close() { file_.close(); }

 private:
  const PatchTarget& target_;
  RowFile file_;
};

}  // namespace st
