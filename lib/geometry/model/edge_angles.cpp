#include "geometry/model/edge_angles.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "geometry/shape/surface.h"

namespace st {
namespace {

/// One side of an edge.
class EdgeSide {
 public:
  EdgeSide(const Model& model, FaceId face, CoedgeId coedge)
      : surface_(model.surface(face)),
        pcurve_(model.pcurve(face, coedge)),
        is_reversed_(model.tables().face_is_reversed[face] != 0) {}

  Vec3 outer_normal(double t) const {
    const Vec3 n = surface_normal(*surface_, pcurve_->point(t));
    return is_reversed_ ? -n : n;
  }

 private:
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Curve2d> pcurve_;
  bool is_reversed_;
};

}  // namespace

EdgeAngles::EdgeAngles(const Model& model, double most_deg)
    : model_(model),
      most_deg_(most_deg),
      uses_(static_cast<std::size_t>(model.tables().n_edges())),
      largest_(static_cast<std::size_t>(model.tables().n_edges()), -1) {
  const ModelTables& t = model.tables();
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const CoedgeId c : t.coedges(f)) uses_[t.coedge_edge[c]].push_back({f, c});
}

double EdgeAngles::largest_deg(EdgeId e) {
  const std::atomic_ref known(largest_[e]);  // two threads may measure one edge: they find the same
  double largest = known.load(std::memory_order_relaxed);
  if (largest < 0) known.store(largest = measure(e), std::memory_order_relaxed);
  return largest;
}

double EdgeAngles::measure(EdgeId e) const {
  constexpr int kPlaces = 9;
  constexpr double kUnknown = 180;
  const ModelTables& t = model_.tables();
  if (uses_[e].size() != 2 || t.edge_is_degenerate[e]) return kUnknown;
  const FaceCoedge first = uses_[e][0], second = uses_[e][1];
  const EdgeSide a(model_, first.face, first.coedge), b(model_, second.face, second.coedge);
  const double t0 = t.edge_range[2 * e], t1 = t.edge_range[2 * e + 1];
  double largest = 0;
  for (int i = 0; i < kPlaces && largest <= most_deg_; ++i) {
    const double at = t0 + (t1 - t0) * (i + 0.5) / kPlaces;
    const Vec3 na = a.outer_normal(at), nb = b.outer_normal(at);
    if (!(norm2(na) > 0 && norm2(nb) > 0)) return kUnknown;
    largest = std::max(largest, degrees(angle_between(na, nb)));
  }
  return largest;
}

}  // namespace st
