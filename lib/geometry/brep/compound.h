// Shapes put together.
#pragma once

#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace st::occt {

/// One compound of all the shapes (of any range), in their order.
template <class Shapes = std::vector<TopoDS_Shape>>
TopoDS_Compound compound_of(const Shapes& shapes) {
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& s : shapes) builder.Add(compound, s);
  return compound;
}

}  // namespace st::occt
