// What the import found in a model, and what it did about it.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec.h"

namespace st {

/// Artifacts store the numbers: a new kind comes last, before kOther.
enum class FindingKind : std::uint8_t {
  kFreeEdge,               ///< used by one face only
  kNonManifoldEdge,        ///< used by three faces or more
  kContradiction,          ///< both faces of an edge disagree which side is outside
  kShortEdge,              ///< shorter than --small
  kLooseEdgeTolerance,     ///< tolerance larger than the edge is long
  kOpenVertex,             ///< edges end away from their vertex
  kSliverFace,             ///< narrower than --small
  kLooseFaceTolerance,     ///< tolerance larger than the face is wide
  kCrossingLoop,           ///< a loop crosses itself or another
  kInvalidFace,            ///< OpenCASCADE's checker, --check
  kInvalidShell,           ///< likewise
  kInvalidSolid,           ///< likewise
  kCrossingPart,           ///< a face passes through another part, found by st-edit
  kMixedUnits,             ///< several units of length in the file
  kEmptyGroup,             ///< a rule of the groups file that selects nothing
  kUnusedTolerance,        ///< a group's tolerance could not be used for sewing
  kCutAtSymmetry,          ///< the model reached across the symmetry plane
  kCavityLeftOut,          ///< a cavity in a solid that is no part of the fluid
  kInnerBodyLeftOut,       ///< a body inside another one, which no flow reaches
  kDuplicateFace,          ///< removed
  kDuplicateSolid,         ///< removed
  kSlit,                   ///< edges inside a face on which other faces end
  kUnboundedRing,          ///< a ring without bounds got its surface's own
  kRebuiltLoops,           ///< loops that could not be walked
  kLostLoops,              ///< loops that the reader lost
  kEdgeParameters,         ///< made equal to those of the trimming curves
  kMissingTrimmingCurves,  ///< rebuilt
  kProjectedCurve,         ///< a trimming curve off its edge, projected again
  kRaisedTolerance,        ///< a trimming curve off its edge, the edge's tolerance raised
  kSewn,                   ///< free edges joined
  kSewnByGroup,            ///< likewise, within the tolerance of a group
  kSewingTolerance,        ///< sewing left large tolerances
  kTurnedSolid,            ///< was inside out
  kVoidShell,              ///< a closed shell in another one made its void
  kShellMadeSolid,         ///< a closed shell without a solid
  kJoinedBodies,           ///< bodies that touch got common faces
  kTouchingApart,          ///< bodies that touch could not be joined
  kTouching,               ///< bodies that touch, left as they are
  kUnited,                 ///< bodies that overlap made one
  kNotUnited,              ///< bodies that could not be made one
  kOverlap,                ///< bodies that overlap, left as they are
  kCrossingFaces,          ///< faces that pass through each other beside their common edge
  kSelfCrossingFace,       ///< a face that passes through itself
  kPinchedFace,            ///< a face that shrinks to a point and goes on turned over
  kUndoneRepair,           ///< a repair that made things worse was taken back
  kSpaceCurve,             ///< a space curve away from its faces, made again
  kDividedSurface,         ///< a face, or a whole spline surface, divided at kinks
  kKinkedFace,             ///< a face with a kink inside that could not be divided
  kEmptyFace,              ///< shrunk to a point or a line, removed
  kThirdFace,              ///< free edges joined to edges that two faces have already
  kSheet,                  ///< a face with the same room, or none, on both sides
  kSharedWall,             ///< a face between two rooms
  kImprint,                ///< edges of a face run over the inside of others, which were divided along them
  kNoImprint,              ///< likewise, but they could not be divided
  kNoSpaceCurve,           ///< an edge without one
  kMovedLoop,              ///< a loop in another period of its surface, moved to its face
  kTurnedLoop,             ///< a loop that ran the wrong way around its face
  kStrayHole,              ///< a hole outside its face, left out
  kLeftOutFace,            ///< a face that cannot be meshed at all, taken out of the model
  kFoldedFace,             ///< a face that folds over itself
  kFarCurve,               ///< a trimming curve off its edge by more than a tolerance, left as it is
  kMergedSliver,           ///< a small face folded back onto its neighbour, merged into it
  kMissingFile,            ///< parts are in another file that is not there
  kOther = 255             ///< told by its text alone, or of another version
};

/// Short, for counts: "sewn".
const char* name_of(FindingKind kind);

/// One finding: what, where, what was done.
struct ImportFinding {
  FindingKind kind = FindingKind::kOther;
  std::string entity;  ///< "edge 12 "TE"" or empty
  Vec3 xyz;            ///< model unit
  double size = 0;     ///< length, width, tolerance: model unit
  bool is_repair = false;
  std::string detail = {};  ///< what is particular in the text: "14 free edges before, 0 after"

  /// As messages have it: "sewn: 14 free edges before, 0 after".
  std::string what() const;
};

/// Kind and detail as they were stored with the text; a kind that this version does not know is kOther, with the text.
void restore_kind(ImportFinding& finding, std::uint8_t kind, const std::string& detail, const std::string& what);

}  // namespace st
