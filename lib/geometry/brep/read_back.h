// Whether the bytes of a shape give the shape again, to the last digit.
#pragma once

#include <TopoDS_Shape.hxx>

namespace st::occt {

/// True where the shape that BinTools reads from what it wrote of this one answers every question the same. Shapes of
/// B-splines without weights and periods, planes and straight curves are looked at; for others it says false.
/// Directions are made unit vectors again when they are read, which may change their last digits.
bool is_read_back_equal(const TopoDS_Shape& shape);

}  // namespace st::occt
