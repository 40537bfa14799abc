// Sources and background meshes from files: TOML, FLITE .bac/.ba3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sizing/background.h"

namespace st {

/// What lengths in files mean in the model at hand.
struct ModelScale {
  double diagonal = 0;              ///< what per cents refer to, model unit
  std::optional<double> unit_in_m;  ///< nullopt: the model has no unit
};

/// What a file asks for.
struct SourceFile {
  std::vector<SourceSpec> sources;
  BackgroundMesh background;         ///< empty: none
  std::vector<std::string> deleted;  ///< names of sources of earlier files to leave out (TOML)
};

/// Reads a file of sources: FLITE .bac or .ba3 by suffix (with its background mesh), anything else is TOML:
///
///   [[source]]
///   name = "wake"              # a later source of the same name replaces this one; delete = true takes it away
///   type = "line"              # point line triangle box cylinder sphere disc
///   points = [[0, 0, 0], [9, 0, 0]]
///   length = "5mm"             # or one for each point; likewise radius and doubling
///   radius = 0.2               # constant up to this distance; default 0
///   doubling = 0.6             # twice the length at this distance; default: as the slope allows
///   aspect = 8                 # so many times the length along `direction`; default 1
///   direction = [1, 0, 0]      # default: along a line or the axis of a cylinder
///
/// [[st-prolong.source]] counts, too; what else an option file may hold is passed over. Coordinates and plain numbers
/// are in the model unit. A line or triangle without extent is refused in TOML; those of FLITE files stay as they are.
/// Throws Error with file and line: kUsage for TOML, kInput for the others and for what cannot be read.
SourceFile read_source_file(const std::string& path, const ModelScale& scale);

/// Reads FLITE's background mesh, .bac or .ba3, with its sources; read_size_mesh() reads others. Throws Error(kInput)
/// with file and line.
SourceFile read_background_file(const std::string& path);

}  // namespace st
