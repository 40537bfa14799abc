// Wings, tails, blades and nacelle lips: trailing edge, nose, chord and span, station by station.
#pragma once

#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "features/wing_edges.h"

namespace st {

/// A place on a trailing edge.
struct ChordStation {
  double share = 0;          ///< of the edge's length, from its start, in [0, 1]
  Vec3 trailing = {};        ///< on the edge, model unit
  double chord = 0;          ///< from there to the nose, model unit, > 0
  bool is_measured = false;  ///< false: taken over from stations around, where the profile ends in something else
  bool is_hidden = false;    ///< has no nose of its own: that is in another body, or what is there is too thick a root
  Vec3 nose = {};            ///< on the CAD within the facets' deflection; of measured stations only
  FaceId nose_face = kNone;
  FaceId tail_face = kNone;  ///< of a trailing edge inside faces: the one there
};

/// The chords along one CAD edge, a trailing edge or a declared leading one: stations in ascending order of `share`,
/// first 0 and last 1.
struct ChordEdge {
  EdgeId edge = kNone;
  FaceId base = kNone;    ///< of a blunt edge: the narrow face between it and its partner
  bool is_half = false;   ///< a plane of symmetry cuts the base in two: the partner is the edge's own image
  double base_width = 0;  ///< median, model unit
  std::vector<ChordStation> stations;
  bool is_inside = false;  ///< the trailing edge runs inside faces, where the stations are, and `edge` along the span

  static auto fields(auto& e) { return std::tie(e.edge, e.base, e.is_half, e.base_width, e.stations, e.is_inside); }

  /// Local chord at a share of the edge's length, linear between stations, model unit.
  double chord_at(double share) const;
};

/// A local chord, and how far away it runs; model unit.
struct NearestChord {
  double chord = 0, distance = 0;
};

/// Whether trailing edges without noses count.
enum class Noseless : unsigned char {
  kOfAircraft,  ///< where the model has another lifting surface, or the edge is declared
  kAll
};

/// A lifting surface: all trailing edges that hang together, pieces, kinks and both sides of a blunt one alike.
struct LiftingSurface {
  bool is_blunt = false;
  bool is_round = false;     ///< its trailing edge runs inside faces
  bool has_noses = true;     ///< false: no station is measured; chords are as far as the part behind the edge is thin
  bool is_declared = false;  ///< some of its edges are, by the user
  std::vector<ChordEdge> trailing;          ///< ascending by edge
  std::vector<EdgeId> leading;              ///< CAD edges along the nose, ascending; a nose inside a face has none
  std::vector<ChordEdge> declared_leading;  ///< of these the declared ones, with the chords there; none measured
  std::vector<ChordEdge> front = {};  ///< noses before slots, flaps and notches, which no own trailing edge is behind:
                                      ///< no edges, inside faces, `trailing` of a station is its nose
  std::vector<FaceId> faces;  ///< that measured profiles cross, and that no concave edge parts from the trailing
                              ///< edge, ascending
  double span = 0;            ///< along the trailing edge, model unit
  double least_chord = 0, median_chord = 0, largest_chord = 0;  ///< model unit

  static auto fields(auto& s) {
    return std::tie(s.is_blunt, s.is_round, s.has_noses, s.is_declared, s.trailing, s.leading, s.declared_leading,
                    s.front, s.faces, s.span, s.least_chord, s.median_chord, s.largest_chord);
  }

  /// The measured station whose chord passes nearest to a place, the first of several; nullptr: none is measured. Cost:
  /// linear in stations.
  const ChordStation* nearest_station(Vec3 x) const;
  /// Trailing edges; of a nose alone the leading one.
  const std::vector<ChordEdge>& edges() const { return trailing.empty() ? declared_leading : trailing; }
  /// Least, median and largest of those measured. Precondition: there are any.
  void set_chords(const std::vector<double>& chords);
  /// Share of the trailing edges' length with noses, without stretches that have none of their own: of the way between
  /// two stations each of them has half.
  double covered() const;
  /// Its chord, and how far away it runs; of the nearest station where none is measured.
  NearestChord nearest_chord(Vec3 x) const;
};

/// Trailing edges that hang together and make no lifting surface, or are no part of the one that the others make.
struct UnusedTrailing {
  std::vector<EdgeId> edges;  ///< ascending
  double length = 0;          ///< of all, model unit
  std::string why;            ///< in plain words
  bool may_be_wing = true;    ///< false: rims, bodies of revolution and what is too short
  bool is_declared = false;   ///< by the user, without effect; such leading edges stand here, too
};

/// Lifting surfaces behind the trailing edges among `edges`: those whose profiles (features/profile.h) are a wing's at
/// half of the way along the edges or more, at 24 stations on each, and whose span is at least half their chord. Of a
/// chain that shows less, the edges that show as much each; edges with a base above 6 per cent of the chord are left
/// out. What may be a wing's and shows no nose may be thin yet (features/thin_surface.h). Slender ones that run out to
/// a point beside a far larger one are none, unless declared. Profiles are cut square to an axis of the model, each
/// edge to its own, and square to the edge where that shows none or clearly fewer. By first edge. Collective; `edges`
/// and what is returned are of rank 0. `unused`: gets the trailing edges that belong to none. Cost: a coarse
/// triangulation of the walls that profiles cross, unless `roles` has one of all, and the profiles, as tasks; the rest
/// is rank 0's. `small`: trailing edges that are too short for these facets (find_wing_edges()); each has its own.
std::vector<LiftingSurface> find_lifting_surfaces(const Model& model, const FaceRoles& roles,
                                                  std::span<const WingEdge> edges,
                                                  const Executor& executor = SerialExecutor(),
                                                  std::vector<UnusedTrailing>* unused = nullptr,
                                                  Noseless noseless = Noseless::kOfAircraft,
                                                  std::span<const WingEdge> small = {});

/// Appends the leading ones of `edges` that run along the noses of a surface. Local.
void add_leading(const Model& model, std::span<const WingEdge> edges, LiftingSurface& surface);

/// An edge, and the chord there.
struct EdgeWithChord {
  EdgeId edge = kNone;
  double chord = 0;  ///< model unit
};

/// Edges around the first and the last measured profile along the span: between faces of the surface and others, near
/// the chord of that end, and no trailing or leading edges. Ascending. A tip that is pinched has none. Local.
std::vector<EdgeWithChord> find_end_rims(const Model& model, const LiftingSurface& wing);

}  // namespace st
