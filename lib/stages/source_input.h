// The sources and background mesh that st-prolong is given. Internal to stages.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/hdf5/artifact.h"
#include "io/toml/source_file.h"
#include "sizing/refine.h"

namespace st {

/// Sources as fields, with their causes.
struct SourceInput {
  std::vector<std::unique_ptr<SizeSource>> owned;
  std::vector<NamedSource> sources;
  std::vector<std::string> names;  ///< of causes of kind source
  std::vector<InputRef> files;     ///< for the header
  std::vector<SourceSpec> specs;   ///< [names] as they are used
  std::size_t n_tets = 0;          ///< of the background mesh
  Box3 background;                 ///< around its nodes, in the octree's frame
  double max_aspect = 1;           ///< of the sources
};

/// Reads files in order. Sources are told apart by name; a later one replaces an earlier one; nameless ones add up.
/// `motion` brings everything into the octree's frame. `is_stretched`: an anisotropic background keeps its directions;
/// otherwise it is taken by its smallest spacings, with a warning. So is a line without length, or a triangle without
/// area, as a point or a line. Throws Error(kInput), Error(kUsage).
SourceInput read_sources(const std::vector<std::string>& files, const std::string& background, const Similarity& motion,
                         double slope, const ModelScale& scale, bool is_stretched);

/// Warns of each source whose core lies outside the root cube of the octree, and of a background mesh that does: what
/// is there is not meshed. `far_length`: longer lengths are of no interest.
void warn_of_places(const SourceInput& input, const OctreeView& octree, double far_length);

}  // namespace st
