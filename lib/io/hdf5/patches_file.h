// patches.hdf, patch after patch: for who need not have all of them in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/hdf5/artifact.h"
#include "io/hdf5/row_reader.h"

namespace st {

/// Rows of all patches, those of one after those of the other.
struct PatchRows {
  RowPlace boundary_dim, boundary_entity, boundary_index, inner_xyz, inner_uv, inner_size, nodes, uv_corner, own_uv;
  RowPlace inner_previous, triangle_previous;  ///< where st-remesh made the patches
};

class PatchesFile {
 public:
  /// Reads all but the patches, and verifies all checksums. Throws Error(kInput) as read_patches() does.
  explicit PatchesFile(const std::string& path);

  const std::string& path() const { return reader_.path(); }
  /// What is not in patches, which are empty.
  PatchesArtifact& rest() { return rest_; }
  const PatchesArtifact& rest() const { return rest_; }

  std::size_t n_patches() const { return face_.size(); }
  FaceId face(std::size_t patch) const { return face_[patch]; }
  std::int64_t inner_begin(std::size_t patch) const { return inner_[patch]; }
  std::int64_t n_inner(std::size_t patch) const { return inner_[patch + 1] - inner_[patch]; }
  std::int64_t triangle_begin(std::size_t patch) const { return triangle_[patch]; }
  std::int64_t n_triangles(std::size_t patch) const { return triangle_[patch + 1] - triangle_[patch]; }

  /// Face and boundary. From any thread. Throws Error(kInput).
  FacePatch boundary(std::size_t patch) const;
  /// And inner_xyz and triangles; checked.
  FacePatch shape(std::size_t patch) const;
  /// Triangles, inner_uv and what else corner_uv() needs; checked.
  FacePatch corners(std::size_t patch) const;
  /// All of a patch; checked.
  FacePatch whole(std::size_t patch) const;
  const PatchRows& rows() const { return rows_; }
  const RowReader& row_reader() const { return row_reader_; }
  const Hdf5Reader& reader() const { return reader_; }

 private:
  void find_rows();

  Hdf5Reader reader_;
  RowReader row_reader_;
  PatchesArtifact rest_;
  std::vector<FaceId> face_;
  std::vector<std::int64_t> boundary_, inner_, triangle_, own_uv_;  // [n_patches+1]
  PatchRows rows_;
};

}  // namespace st
