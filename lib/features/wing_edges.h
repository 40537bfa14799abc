// Edges that look like trailing and leading edges of wings, blades and nacelle lips.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/executor.h"
#include "features/face_roles.h"
#include "features/strip.h"
#include "geometry/model/model.h"

namespace st {

enum class WingEdgeKind : unsigned char {
  kSharpTrailing,  ///< two faces meet at 60 degrees of material or less
  kBluntTrailing,  ///< a long edge of a narrow face between two faces that look away from each other
  kLeading  ///< inside a rounded nose: the normal turns by 45 degrees and more to either side, and the bend flattens
            ///< out
};

/// "sharp trailing edge", "blunt trailing edge", "leading edge". Here, so that rules alone need no search of edges.
constexpr const char* name_of(WingEdgeKind kind) {
  switch (kind) {
    case WingEdgeKind::kSharpTrailing:
      return "sharp trailing edge";
    case WingEdgeKind::kBluntTrailing:
      return "blunt trailing edge";
    default:
      return "leading edge";
  }
}

struct WingEdge {
  EdgeId edge = kNone;
  WingEdgeKind kind = WingEdgeKind::kSharpTrailing;
  Vec3 middle = {};     ///< on the edge, model unit
  double length = 0;    ///< model unit
  double angle = 0;     ///< of the material between the faces, radians; median over the edge
  double size = 0;      ///< model unit: width of a blunt edge, median nose radius of a leading edge; 0 for a sharp edge
  FaceId base = kNone;  ///< of a blunt edge: the narrow face
  FaceId mirror = kNone;     ///< the symmetry plane that cuts the wing in two along this edge, or along its base
  bool is_declared = false;  ///< by the user, whatever its shape
};

/// What the user says of an edge.
enum class EdgeMeaning : unsigned char { kTrailing, kNoTrailing, kLeading };

struct DeclaredEdge {
  EdgeId edge = kNone;
  EdgeMeaning meaning = EdgeMeaning::kTrailing;
  FaceId base = kNone;  ///< of a trailing edge: the narrow face that is said to be its base
};

/// Ascending by edge. Dihedral angle and curvature decide, at nine places along each edge, most of which must agree;
/// edges of one kind that hang together count only when they are at least 1/200 of the reference diagonal long
/// altogether. A sharp leading edge cannot be told from a trailing edge and counts as one. Material is where the
/// normals point away from, except in a model with a far field, where it is outside of the domain. Where a plane of
/// symmetry cuts a fin in two, the other half counts as if it were there; other edges of symmetry planes and those of
/// far fields are left out. `strips`: those of the model, by find_strips(). Collective: some edges are a task; complete
/// on rank 0, empty elsewhere. `small`: gets the trailing edges that are too short, down to a tenth of that.
/// `has_hollow`: gets, on rank 0, whether there are edges that were trailing ones if the material were on the other
/// side: of holes. Cost: some hundred evaluations per edge of a nose.
std::vector<WingEdge> find_wing_edges(const Model& model, const FaceRoles& roles, std::span<const Strip> strips,
                                      const Executor& executor = SerialExecutor(),
                                      std::vector<WingEdge>* small = nullptr, bool* has_hollow = nullptr);

/// Sets what the user says, the later of two winning: adds edges, marks them as declared, or takes them out. Both long
/// edges of a base belong together: of one that is named, or of a narrow face with corners along both of them. Local.
void declare_edges(const Model& model, const FaceRoles& roles, std::span<const Strip> strips,
                   std::span<const DeclaredEdge> declared, std::vector<WingEdge>& edges);

}  // namespace st
