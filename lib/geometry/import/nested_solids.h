// Solids inside others.
#pragma once

#include <TopoDS_Shape.hxx>
#include <TopoDS_Solid.hxx>
#include <functional>
#include <vector>

#include "base/vec.h"

namespace st::occt {

struct NestedSolid {
  TopoDS_Solid inner, outer;
};

/// Whether what lies in a cavity of a solid is inside it.
enum class Cavities { kInside, kOutside };

/// Solids of the shape inside another one, in their order, each with the first of those: all their vertices are inside,
/// or on the boundary but not all of them. `is_asked`: by its box, whether an inner solid is of interest; null: all
/// are. Cost: vertices of solids whose box lies in another one's.
std::vector<NestedSolid> nested_solids(const TopoDS_Shape& shape, Cavities cavities,
                                       const std::function<bool(const Box3&)>& is_asked = {});

}  // namespace st::occt
