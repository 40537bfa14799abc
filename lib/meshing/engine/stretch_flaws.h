// Where stretched lengths do not fit the surface: obtuse triangles, and neighbours of very different size.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"
#include "meshing/face/face_mesher.h"
#include "meshing/face/refinements.h"
#include "sizing/size_field.h"

namespace st {

enum class FlawKind { kFar, kUnheld, kObtuse, kLarge };  ///< the worst first; see StretchFlaws
inline constexpr std::size_t kFlawKinds = 4;

struct StretchFlaw {
  Vec3 x;
  FlawKind kind;
};

struct StretchFlaws {
  std::vector<StretchFlaw> all;  ///< each as its worst kind
  // in the order of the triangles
  std::vector<RefinementPoint> stretched;  ///< where lengths along should be shorter: about angles above 150 degrees,
                                           ///< and where lengths across are not held
  std::vector<RefinementPoint> steps;      ///< likewise about steps above 2.5
  std::vector<RefinementPoint> obtuse;     ///< where angles are above 150, although lengths are alike
  std::size_t n_obtuse = 0;                ///< triangles with an angle above 140 degrees
  std::size_t n_far = 0;                   ///< of these, with one above 150 degrees
  std::size_t n_unheld = 0;                ///< places coarser than was asked for, where somebody looked for them
  std::size_t n_large = 0;                 ///< others with 2.2 squared times the area of a neighbour

  /// A place whose lengths across are not held: lengths along become shorter.
  void add_unheld(RefinementPoint place, const LocalSize& present);
  bool has_eased() const { return !stretched.empty() || !steps.empty(); }
  /// Are steps eased, too? Only where there is nothing else, or no angle above 150 degrees.
  bool eases_steps() const { return n_far == 0 || stretched.empty(); }
  /// Is `stretched` eased further around? Where lengths are not held, and nothing else is the cause.
  bool is_wide() const { return n_far == 0 && n_unheld > 0; }
  /// Is a step that is eased further around beside such a place, so that both may have one cause?
  bool is_beside_unheld(const RefinementPoint& step) const;
};

/// Of a step: eased further around.
RefinementPoint further(RefinementPoint step);

/// `present`: the lengths that the triangles were made for. `n_tries`: made before. Local, linear.
StretchFlaws find_stretch_flaws(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                const SizeField& present, int n_tries);

}  // namespace st
