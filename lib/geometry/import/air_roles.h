// What the import makes of a file that has its own air: roles of its faces, and a new far field in place of the old
// one.
#pragma once

#include <optional>
#include <string>

#include "geometry/import/half_model.h"
#include "geometry/import/import.h"
#include "geometry/import/own_air.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// What --symmetry, --mirror, --farfield, --replace-farfield and --flow-domain ask for.
struct AskedAir {
  std::optional<SymmetryPlane> plane;
  std::optional<SymmetryPlane> mirror;  ///< beside the air: of all that is meshed
  std::optional<FarField> far;
  bool replaces = false;   ///< `far` takes the place of the file's own
  bool may_search = true;  ///< in what no name speaks of
  AirSearch search = AirSearch::kSure;
};

/// Throws Error(kUsage) for values that cannot be, and for both far fields together.
AskedAir parse_air(const ImportOptions& options);

/// The far field that the file has: by the names of its faces (and then those of its symmetry planes and interfaces),
/// else by shape, where `asked` allows it. Faces found by shape get their roles, and these as names where the file
/// gives none. Throws Error(kUsage) where the air is there and --farfield or, found by shape and closed, --symmetry
/// asks for it again, or where it is not there and is to be replaced; Error(kGeometry) where --flow-domain yes finds
/// none.
struct FileAir {
  OwnAir faces;
  bool is_by_shape = false;
};
AirFaces counts_of(const FileAir& air);
FileAir find_file_air(ImportedShape& model, const ModelTables& tables, const AskedAir& asked, const std::string& path);

/// Leaves the body alone: what bounds the air goes. A symmetry plane of the file stays one: `asked.plane`, unless one
/// is asked for. Throws Error(kUsage) for several of them, or one across no axis.
void remove_air(ImportedShape& model, const ModelTables& tables, const OwnAir& air, AskedAir& asked,
                const std::string& path);

}  // namespace st::occt
