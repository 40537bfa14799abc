#include "features/edge_places.h"

#include <algorithm>

#include "features/arc_table.h"

namespace st {

std::vector<EdgePlace> places_along(const Model& model, std::span<const WingEdge> chain) {
  std::vector<EdgePlace> places;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const auto curve = model.curve(chain[k].edge);
    const ArcTable arc(*curve);
    for (int i = 0; i < kPlacesPerEdge; ++i) {
      const double share = (i + 0.5) / kPlacesPerEdge;
      const CurvePoint p = curve->evaluate(arc.parameter_at(share));
      places.push_back({k, share, chain[k].length / kPlacesPerEdge, p.x, normalized(p.d1)});
    }
  }
  return places;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace st
