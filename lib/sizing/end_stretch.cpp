#include "sizing/end_stretch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/box_tree.h"

namespace st {
namespace {

constexpr double kMostAcross = 0.7;  // cosine: a side that lies further along the stretch does not end it

bool lies_across(Vec3 side, Vec3 direction) { return std::abs(dot(side, direction)) <= kMostAcross; }

/// The sides at which a face ends.
class EndSides {
 public:
  EndSides(std::span<const SpaceSide> sides, const std::function<bool(CoedgeId)>& ends) {
    std::copy_if(sides.begin(), sides.end(), std::back_inserter(sides_),
                 [&](const SpaceSide& s) { return ends(s.coedge); });
    tree_ = tree_of(sides_);
  }

  /// Along the nearest one across `direction` (zero: of all) that is nearer than `reach`; zero: none is.
  Vec3 near(Vec3 x, double reach, Vec3 direction) const {
    Vec3 end;
    double nearest2 = reach * reach;
    tree_.visit_near(
        x, [&](std::int32_t, double d2) { return d2 < nearest2; },
        [&](std::int32_t i) {
          const double d2 = norm2(sides_[i].nearest_to(x) - x);
          if (!(d2 < nearest2) || !lies_across(sides_[i].along, direction)) return;
          nearest2 = d2;
          end = sides_[i].along;
        });
    return end;
  }

 private:
  std::vector<SpaceSide> sides_;
  BoxTree tree_;
};

}  // namespace

double most_aspect_at(Vec3 end, Vec3 direction) {
  return end != Vec3{} && lies_across(end, direction) ? kEndAspect : std::numeric_limits<double>::infinity();
}

void bound_stretch_at_ends(std::span<const SpaceSide> sides, const std::function<bool(CoedgeId)>& ends,
                           std::size_t first, std::vector<RasterBox>& boxes, std::vector<GapPatch>& patches) {
  const EndSides of_face(sides, ends);
  for (RasterBox& box : std::span(boxes).subspan(first)) {
    const double most = kEndAspect * box.length;
    if (box.stretch.along > most && of_face.near(box.center, 2 * box.half, Vec3(box.stretch.direction)) != Vec3{})
      box.stretch.along = static_cast<float>(most);
  }
  for (GapPatch& p : patches)
    if (p.max_aspect > kEndAspect) p.end = of_face.near(p.x, std::hypot(p.s_hi - p.s_lo, p.t_hi - p.t_lo), p.way);
}

}  // namespace st
