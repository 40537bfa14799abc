// Edges of a loop that run back beside the one before them, within the CAD's tolerance.
#pragma once

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Edges that bound something, oriented as the loop of a face (taken forward) runs.
using EdgeChain = std::vector<TopoDS_Edge>;

/// One of each wire; empty where a wire cannot be walked.
std::vector<EdgeChain> chains_of(const TopoDS_Face& forward);

/// The face on the surface of `face` whose loops are the rings of each chain; nullopt where edges are no rings or meet
/// in a way that leaves a choice, or where it does not have this area within `room` (both unit of the shape, squared).
std::optional<TopoDS_Face> face_of_chains(const TopoDS_Face& face, const std::vector<EdgeChain>& chains, double area,
                                          double room);

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

/// All faces of the model at the longer edge, but for `own`, get the shorter one in its place: in `faces`, by their
/// numbers from 0, forward; faces that are in it are changed there. False where one cannot.
bool share_spur(const ImportedShape& model, const EdgeSpur& spur, const std::pair<FaceId, FaceId>& own,
                std::map<FaceId, TopoDS_Face>& faces);

}  // namespace st::occt
