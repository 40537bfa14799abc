// The rows of a merged mesh, from patches files: no more than one patch is in memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "geometry/model/cad_places.h"
#include "io/hdf5/patches_file.h"
#include "mesh/merge_order.h"

namespace st {

/// A patch in one of several files.
struct PatchInFile {
  const PatchesFile* file = nullptr;
  std::size_t patch = 0;
  FaceId face() const { return file->face(patch); }
};

/// The patches of all files, by face. Throws Error(kMismatch) for a face that is in two files.
std::vector<PatchInFile> patches_of(const std::vector<std::unique_ptr<PatchesFile>>& files);

PatchSource source_of(const std::vector<PatchInFile>& patches);

/// `patches`, `order` and `input` outlive the columns. Columns throw Error(kInput) for contents that no mesh can have.
/// `cad`: where faces are several of the CAD, else null; outlives them, too.
MeshColumns merged_columns(const std::vector<PatchInFile>& patches, const MergeInput& input, const MergeOrder& order,
                           const CadPlaces* cad = nullptr);

/// Fills what a mesh in memory says of the CAD's faces, likewise.
void add_cad_places(const CadPlaces& cad, MeshArtifact& artifact);

}  // namespace st
