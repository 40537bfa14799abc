#include "geometry/facet/facets_of_nodes.h"

#include <numeric>

namespace st {

FacetsOfNodes::FacetsOfNodes(std::span<const Corners> corners, std::size_t n_nodes)
    : offsets_(n_nodes + 1, 0), facet_(3 * corners.size()) {
  for (const Corners& c : corners)
    for (const std::int32_t n : c) ++offsets_[n + 1];
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  std::vector<std::int32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (const std::int32_t n : corners[t]) facet_[next[n]++] = static_cast<std::int32_t>(t);
}

}  // namespace st
