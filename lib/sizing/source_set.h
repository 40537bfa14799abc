// The sources and background meshes of a size specification, as they are stored.
#pragma once

#include <memory>
#include <vector>

#include "sizing/background.h"
#include "sizing/source_tree.h"

namespace st {

/// In the octree's own frame, before scale.
struct SourceSet {
  std::vector<SourceSpec> sources;  ///< their causes count them
  BackgroundMesh background;        ///< of all files together, limited to the slope
  double slope = 0;                 ///< by which their lengths grow, > 0 where there are any

  bool is_empty() const { return sources.empty() && background.is_empty(); }
  /// Smallest length that any of them asks for; infinity where it is empty. That of the tree, without making one.
  double min_size() const;
  /// Null where it is empty.
  std::shared_ptr<const SourceTree> tree() const;
};

}  // namespace st
