// The kinds of findings, as KIND(kind, its name in counts, its text in messages); "{}" in a text is the detail, and no
// text is the name. Included where KIND says what to make of them. Artifacts store the places in this list: a new kind
// comes last.
KIND(kFreeEdge, "free edge", "")                 // used by one face only
KIND(kNonManifoldEdge, "non-manifold edge", "")  // used by three faces or more
KIND(kContradiction, "faces disagree which side is outside", "")
KIND(kShortEdge, "short edge", "")  // shorter than --small
KIND(kLooseEdgeTolerance, "tolerance larger than the edge is long", "")
KIND(kOpenVertex, "edges end away from their vertex", "")
KIND(kSliverFace, "sliver face", "")  // narrower than --small
KIND(kLooseFaceTolerance, "tolerance larger than the face is wide", "")
KIND(kCrossingLoop, "loop crosses itself or another", "")  // a loop crosses itself or another
KIND(kInvalidFace, "invalid face", "invalid face ({})")    // OpenCASCADE's checker, --check
KIND(kInvalidShell, "invalid shell", "invalid shell ({})")
KIND(kInvalidSolid, "invalid solid", "invalid solid ({})")
KIND(kCrossingPart, "face passes through another part", "")  // a face passes through another part, found by st-edit
KIND(kMixedUnits, "several units of length", "the file holds several units of length; everything was converted to {}")
KIND(kEmptyGroup, "optional group without members", "optional group without {}")
KIND(kUnusedTolerance, "tolerance not used for sewing",
     "tolerance not used for sewing: the faces are named by numbers, which --symmetry and --farfield change")
KIND(kCutAtSymmetry, "cut at the symmetry plane", "")  // the model reached across the symmetry plane
KIND(kCavityLeftOut, "cavity inside a solid left out of the fluid", "")
KIND(kInnerBodyLeftOut, "body inside another left out of the fluid", "")
KIND(kDuplicateFace, "duplicated face, removed", "duplicated face, removed: it lies on {}")
KIND(kDuplicateSolid, "solid that is there twice, removed",
     "solid that is there twice, removed: it lies on solid {} of the file")
KIND(kSlit, "edges inside, on which other faces end, made slits", "")
KIND(kUnboundedRing, "ring without bounds, given its surface's own", "")
KIND(kRebuiltLoops, "loops", "loops: {} loops or faces that could not be walked were rebuilt")
KIND(kLostLoops, "loops rebuilt from their edges", "")  // loops that the reader lost
KIND(kEdgeParameters, "parameters of edges made equal to their trimming curves'",
     "parameters of {} edges made equal to their trimming curves'")
KIND(kMissingTrimmingCurves, "missing trimming curves of edges rebuilt",
     "trimming curves of {} edges were missing and rebuilt")
KIND(kProjectedCurve, "trimming curve off its edge, projected again",
     "trimming curve off its edge, projected again ({} of the distance is left)")
KIND(kRaisedTolerance, "trimming curve off its edge, tolerance of the edge raised", "")
KIND(kSewn, "sewn", "sewn: {}")  // free edges joined
KIND(kSewnByGroup, "sewn by the tolerance of their group", "sewn by the tolerance of their group: {}")
KIND(kSewingTolerance, "sewing left tolerances far above its own; trimming curves there are compared again", "")
KIND(kTurnedSolid, "solid inside out, turned", "")  // was inside out
KIND(kVoidShell, "closed shell inside another one made its void", "")
KIND(kShellMadeSolid, "closed shell made a solid", "")  // a closed shell without a solid
KIND(kJoinedBodies, "bodies that touch joined", "bodies that touch joined: {}")
KIND(kTouchingApart, "bodies that touch not joined",
     "bodies that touch not joined, each has a mesh of its own there: {}")
KIND(kTouching, "bodies touch", "bodies touch, each has a mesh of its own there: {}")
KIND(kUnited, "bodies that overlap united", "bodies that overlap united: {}")  // bodies that overlap made one
KIND(kNotUnited, "bodies that overlap not united", "bodies that overlap not united: {}")
KIND(kOverlap, "parts cross", "parts cross: {}")  // bodies that overlap, left as they are
KIND(kCrossingFaces, "faces cross", "faces cross beside their common edge: {}")
KIND(kSelfCrossingFace, "face crosses itself", "")  // a face that passes through itself
KIND(kPinchedFace, "face shrinks to a point", "face shrinks to a point and goes on turned over")
KIND(kUndoneRepair, "repair taken back", "repair taken back: {}")  // a repair that made things worse was taken back
KIND(kSpaceCurve, "edge away from its faces, made again from them", "")
KIND(kDividedSurface, "surface divided at its kinks", "surface divided at its kinks: {}")
KIND(kKinkedFace, "kink inside a face that could not be divided", "")
KIND(kEmptyFace, "face without area, left out", "")  // shrunk to a point or a line, removed
KIND(kThirdFace, "sewn where three faces or more meet", "sewn where three faces or more meet: {}")
KIND(kSheet, "sheet", "sheet: the same room, or none, is on both sides")
KIND(kSharedWall, "wall between two rooms", "")  // a face between two rooms
KIND(kImprint, "ends or lies on other faces, joined there", "ends or lies on other faces, joined there: {}")
KIND(kNoImprint, "ends or lies on other faces, not joined", "ends or lies on other faces, not joined: {}")
KIND(kNoSpaceCurve, "edge without a curve in space", "edge without a curve in space: {}")  // an edge without one
KIND(kMovedLoop, "loop in another period of its surface, moved", "loop in another period of its surface, moved by {}")
KIND(kTurnedLoop, "loop that ran the wrong way around its face, turned", "")
KIND(kOtherSide, "face on the wrong side of its loop, replaced by the rest of its surface", "")
KIND(kStrayHole, "hole outside its face, left out", "hole outside its face, left out{}")
KIND(kLeftOutFace, "face left out", "face left out: {}")
KIND(kFoldedFace, "face folds over itself", "")  // a face that folds over itself
KIND(kFarCurve, "trimming curve off its edge by more than a tolerance", "")
KIND(kMergedSliver, "face folded back onto its neighbour, merged into it",
     "face folded back onto its neighbour, merged into {}")
KIND(kMissingFile, "parts in another file, which is missing", "parts in another file, which is missing: {}")
KIND(kCapped, "opening closed", "opening closed: {}")  // --cap
KIND(kOpeningLeft, "opening left open", "opening left open: its rim of {}")
KIND(kDuplicateFacets, "duplicated facets, removed", "duplicated facets, removed: {}")
KIND(kJoinedNodes, "nodes at gaps between facets joined", "nodes at gaps between facets joined: {}")
KIND(kTurnedFacets, "facets turned", "facets turned to agree which side is outside: {}")
KIND(kMirrored, "one half made the image of the other", "one half made the image of the other: {}")
KIND(kCrossingFacets, "facets cross each other", "facets cross each other: {}")
KIND(kNullEdge, "edges without length, taken out of their loops", "edges without length, taken out of their loops: {}")
KIND(kUnread, "part of the file that is not read", "part of the file that is not read: {}")
