// Edges of a loop that run back beside the one before them, within the CAD's tolerance.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <optional>
#include <vector>

namespace st::occt {

/// Two edges that follow each other in a loop, there and back beside each other; all as the loop runs.
struct EdgeSpur {
  TopoDS_Edge shorter, longer;
  TopoDS_Edge rest;  ///< of the longer one, beyond the other's end; null where both end at one vertex
  double gap = 0;    ///< between them, model unit
};

/// The first spur in which the shorter one lies within `distance` (model unit) of the longer one all along, and one of
/// both is of `added`. `loop`: from head to tail or not, oriented. `rest` has the longer one's curves and the other
/// one's end vertex, whose tolerance reaches it.
std::optional<EdgeSpur> find_spur(const std::vector<TopoDS_Edge>& loop, const std::vector<TopoDS_Edge>& added,
                                  double distance);

/// `loop` without the spur.
std::vector<TopoDS_Edge> without_spur(std::vector<TopoDS_Edge> loop, const EdgeSpur& spur);

/// Adds the trimming curve on a face that `edge` lies on within `distance`, and raises its tolerance to what is left
/// between them; false where there is none. A trimming curve that is there stays.
bool add_pcurve(const TopoDS_Edge& edge, const TopoDS_Face& face, double distance);

/// `face` (forward), a neighbour at the longer edge: it has the rest and the shorter one in its place. nullopt where
/// the face then does not have the area that it had, but for what lies between the edges.
std::optional<TopoDS_Face> with_common_edge(const TopoDS_Face& face, const EdgeSpur& spur);

}  // namespace st::occt
