#include "sizing/source_set.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sizing/octree.h"
#include "sizing/source_types.h"

namespace st {

double SourceSet::min_size() const {
  double least = std::numeric_limits<double>::infinity();
  for (const SourceSpec& s : sources)
    if (const SourceType* type = find_source_type(s.kind)) least = std::min(least, type->make(s, slope)->min_size());
  if (!background.is_empty())
    for (const LocalSize& s : background.node_size) least = std::min(least, s.length);
  return least;
}

std::shared_ptr<const SourceTree> SourceSet::tree() const {
  if (is_empty()) return nullptr;
  std::vector<SourceTree::Entry> entries;
  for (const SourceSpec& spec : sources)
    entries.push_back(
        {make_source(spec, slope), pack_cause(CauseKind::kSource, static_cast<std::int32_t>(entries.size()))});
  if (!background.is_empty()) entries.push_back({make_background(background, slope), pack_cause(CauseKind::kOther, 0)});
  return std::make_shared<SourceTree>(std::move(entries));
}

}  // namespace st
