// From a CAD file to a model: reading, repair, tables, and what was found on the way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "geometry/model/finding.h"
#include "geometry/model/groups.h"
#include "geometry/model/mirror.h"
#include "geometry/model/model.h"
#include "geometry/model/model_state.h"

namespace st {

/// The air around the model, and the plane of its halves, as options say it.
struct AirOptions {
  std::string symmetry;  ///< "y=0", "x=2-" ...: close (and where needed cut) the model at this plane; empty: none
  std::string mirror;    ///< likewise: one half becomes the image of the other; empty: none
  std::string farfield;  ///< "box:20", "sphere:50": the fluid around the model, out to this far field; empty: none
  std::string replace_farfield;      ///< likewise, in place of the one that the file has; empty: keep it
  std::string flow_domain = "auto";  ///< "auto": air around a body is recognised by its shape where no name says so;
                                     ///< "yes": it is there; "no": it is not looked for

  /// A symmetry plane, a mirror or a far field gives faces other numbers.
  bool changes_numbers() const {
    return !mirror.empty() || !symmetry.empty() || !farfield.empty() || !replace_farfield.empty();
  }
};

struct ImportOptions {
  std::string unit;             ///< target unit name; empty: the file's own
  std::string small = "0.01%";  ///< length: edges shorter and faces narrower than this are listed
  std::string sew;          ///< length: largest gap between free edges that sewing closes; empty: 0.01% of the diagonal
  bool check_only = false;  ///< also run OpenCASCADE's checker
  AirOptions air;
  bool join_touching = false;     ///< solids that touch get common faces and edges
  bool unite = false;             ///< bodies that overlap become one, before that
  double unite_seconds = 60;      ///< no union begins later
  bool cap = false;               ///< openings in planes get faces
  bool require_closed = false;    ///< Error(kGeometry) for a model that is open after repairs
  std::vector<GroupRule> groups;  ///< empty: those of the file
  double feature_deg = 30;        ///< of facets: faces meet where neighbours' normals differ by more
  std::string smooth;             ///< of facets: length by which noise moves them at most; empty: they stay
};

/// Faces that bound the air which the file itself has.
struct AirFaces {
  int n_farfield = 0, n_symmetry = 0, n_interface = 0;
  bool is_by_shape = false;  ///< no name said so
  bool is_replaced = false;  ///< by a new far field: these faces are gone
  std::string doubt;         ///< why what looks like air is taken for a part; or empty

  /// "6 faces are farfield, 1 face is symmetry".
  std::string in_words() const;
};

struct ImportResult {
  ModelTables tables;
  std::vector<std::byte> brep;
  FacetShape facets;  ///< instead, of a model of facets
  std::vector<ImportFinding> findings;
  std::vector<std::int32_t> file_faces;  ///< [n_faces] number of each in the file, from 0; kNone: the import made it
  std::string format;                    ///< "STEP", "IGES", "BREP"
  bool is_closed = false;                ///< at least one shell and no free edge
  EdgeUses edge_uses;
  Mirror mirror;                  ///< empty: not asked for
  AirFaces air;                   ///< none where the import made it
  bool has_assumed_unit = false;  ///< the file names no unit, and that of ImportOptions was taken as it
  double area = 0, volume = 0;    ///< model unit squared, cubed (volume 0 when open)

  int n_repairs() const { return static_cast<int>(std::ranges::count_if(findings, &ImportFinding::is_repair)); }
};

/// Reads a STEP, IGES or BREP file (recognised by content). Throws Error(kInput) for a missing, empty or unreadable
/// file or a directory, Error(kGeometry) when there is no face in it.
ImportResult import_model(const std::string& path, const ImportOptions& options);

}  // namespace st
