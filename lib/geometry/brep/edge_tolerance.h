// How far edges may be from their curves.
#pragma once

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>

namespace st::occt {

/// The largest tolerance of its edges.
inline double max_edge_tolerance(const TopoDS_Shape& shape) {
  double tolerance = 0;
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next())
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(e.Current())));
  return tolerance;
}

}  // namespace st::occt
