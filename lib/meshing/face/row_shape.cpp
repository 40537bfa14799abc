#include "meshing/face/row_shape.h"

#include "base/predicates.h"
#include "meshing/face/row_chains.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kLeastAngle = 50;  // degrees, of a quadrilateral's corners
constexpr double kMostAngle = 130;
constexpr double kMostOblique = 0.8;  // cosine between directions that metrics see

}  // namespace

bool is_upright(const MeshNode& a, const MeshNode& b, const MeshNode& c, const MeshNode& d) {
  const MeshNode* corner[4] = {&a, &b, &c, &d};
  for (int k = 0; k < 4; ++k) {
    const MeshNode &here = *corner[k], &next = *corner[(k + 1) % 4], &last = *corner[(k + 3) % 4];
    if (orient2d(here.p, next.p, last.p) <= 0) return false;
    const double angle = degrees(turning(next.x - here.x, last.x - here.x, here.normal));
    if (!(angle > kLeastAngle && angle < kMostAngle)) return false;
  }
  return true;
}

bool is_oblique(const SizeField& field, const LocalSize& local, Vec3 along, Vec3 up) {
  if (!field.has_metrics()) return false;
  const Vec3 squeeze = local.squeeze();
  const auto product = [&](Vec3 a, Vec3 b) { return dot(a, b) - dot(squeeze, a) * dot(squeeze, b); };
  const double cosine2 = product(along, up) * product(along, up) / (product(along, along) * product(up, up));
  return cosine2 > kMostOblique * kMostOblique;
}

}  // namespace st
