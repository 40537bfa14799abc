// The fluid around a body: symmetry plane and far field.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Of the diagonal: an edge or a face that ends this near to a symmetry plane is in it.
inline constexpr double kInSymmetryPlane = 1e-5;

/// A plane across one axis, and the side of it that is kept.
struct SymmetryPlane {
  int axis = 0;      ///< 0, 1, 2: x, y, z
  double value = 0;  ///< model unit
  int side = 0;      ///< +1, -1; 0: the side that the model is on, the positive one of a model on both
};

struct FarField {
  enum class Kind { kBox, kSphere };
  Kind kind = Kind::kBox;
  double size = 0;  ///< half the box's edge or the sphere's radius, in diagonals of the model
};

/// "y=0", "z=-1.5", "y=0+", "x=2-" of `option`. Throws Error(kUsage).
SymmetryPlane parse_symmetry(const std::string& text, const std::string& option);

/// Sets the kept side where none was asked for, by the box of the model. Returns whether the model is on both: it
/// reaches further than 1e-4 of the diagonal beyond the plane. Throws Error(kGeometry), with `prefix`, where all of it
/// is on the other side.
bool choose_side(SymmetryPlane& plane, const Box3& box, double diagonal, const std::string& prefix = "");

/// "box:20", "sphere:50" of `option`. Throws Error(kUsage) for anything else and for sizes outside [1, 1000].
FarField parse_farfield(const std::string& text, const std::string& option);

/// Cuts the model at the symmetry plane where it lies on both sides, closes it there with faces named "symmetry"; with
/// a far field the result is the fluid between the body and the outer faces named "farfield": one closed solid, normals
/// out of the fluid. Faces of the body come first, in their order; faces in the plane are new. `box` of the model
/// and its reference diagonal in the unit of the shape. Throws Error(kGeometry) with the places of free edges that are
/// not in the plane, for a model that does not reach the plane, and without a far field for a solid inside another
/// one that the plane cuts, too.
void make_flow_domain(ImportedShape& model, const Box3& box, double diagonal, const std::optional<SymmetryPlane>& plane,
                      const std::optional<FarField>& far, std::vector<ImportFinding>& findings,
                      const std::string& path);

}  // namespace st::occt
