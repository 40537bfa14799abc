// Background meshes: lengths at the nodes of tetrahedra or triangles, as solvers and other meshers store them.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "base/similarity.h"
#include "sizing/source.h"

namespace st {

/// A symmetric tensor: xx yy zz xy yz xz.
using SymmetricTensor = std::array<double, 6>;

/// The smallest length is linear in each tetrahedron. Others are in the ratio of the log-Euclidean mean of the nodes'
/// metrics, by their weights at a place: all three with node_metric, see mean_metric(); else one longer length along a
/// direction, the shorter the less the nodes' directions agree, see MeanStretch.
struct BackgroundMesh {
  std::vector<Vec3> node_xyz;
  std::vector<LocalSize> node_size;
  std::vector<SymmetricTensor> node_metric;       ///< [nodes], of which node_size tells a part; empty: it tells all
  std::vector<std::array<std::int32_t, 4>> tets;  ///< nodes, any orientation
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< of surfaces, from which lengths grow like from the border

  bool is_empty() const { return tets.empty() && triangles.empty(); }
};

/// The lengths of a metric xx yy zz xy yz xz: its longest along its direction, the smallest in the others. Length 0
/// where it is not positive definite.
LocalSize size_of_metric(const SymmetricTensor& metric);
/// The metric that asks for these lengths.
SymmetricTensor metric_of(const LocalSize& size);
/// Nearly equal lengths are one; a direction of any length.
LocalSize uniaxial(const LocalSize& s);

/// Forgets the metrics where node_size tells all of each: no node has more than one long length.
void forget_plain_metrics(BackgroundMesh& mesh);

/// No length below `least` (model unit); the number of nodes that had one.
std::int64_t raise_lengths(double least, BackgroundMesh& mesh);

void transform(const Similarity& motion, BackgroundMesh& mesh);

/// Numbers the nodes that cells have by their first use, tetrahedra first. Returns those nodes in that order, for
/// keep_only(): places and lengths are as before.
std::vector<std::int32_t> number_used_nodes(BackgroundMesh& mesh);
/// The values of the kept nodes, in their order.
template <class Value>
void keep_only(const std::vector<std::int32_t>& kept, std::vector<Value>& values) {
  std::vector<Value> all = std::move(values);
  values.clear();
  values.reserve(kept.size());
  for (const std::int32_t n : kept) values.push_back(all[n]);
}

/// Appends the nodes and cells of another mesh; has metrics if one of them has.
void append(const BackgroundMesh& other, BackgroundMesh& mesh);

/// In the mesh the smallest of what the tetrahedra there ask for, to rounding; flat ones are passed over. Elsewhere the
/// lengths of its border, growing by the slope; likewise along the direction of what is closest on the border.
/// Metrics are kept in space, cut by the plane that is asked for. Precondition: limit_growth() of
/// sizing/growth_limit.h.
std::unique_ptr<SizeSource> make_background(BackgroundMesh mesh, double slope);

}  // namespace st
