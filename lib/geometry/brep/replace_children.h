// What a shape consists of is changed in place.
#pragma once

#include <BRep_Builder.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace st::occt {

/// Takes `old` out of a shape and adds `fresh` at its end, also where the shape is in others already.
template <class Shape>
void replace_children(TopoDS_Shape shape, const std::vector<Shape>& old, const std::vector<Shape>& fresh) {
  BRep_Builder builder;
  const bool was_free = shape.Free();
  shape.Free(true);
  for (const Shape& child : old) builder.Remove(shape, child);
  for (const Shape& child : fresh) builder.Add(shape, child);
  shape.Free(was_free);
}

}  // namespace st::occt
