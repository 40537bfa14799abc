// The whole metric of a field at a point, for formats that hold one.
#pragma once

#include "sizing/background.h"
#include "sizing/size_field.h"

namespace st {

/// What the field asks for in all directions at `xyz`. Of a field with metrics it is made of what the three planes
/// along the axes cut: exact where one metric tells all lengths, else between what each plane asks for. Where that is
/// no metric, and of other fields, that of local().
SymmetricTensor metric_in_space(const SizeField& field, Vec3 xyz, int& hint);

}  // namespace st
