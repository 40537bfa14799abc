// The profile of a wing: where a plane cuts it, from the trailing edge to the nose.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/lists_by_key.h"
#include "geometry/model/facets.h"
#include "geometry/shape/projection.h"
#include "geometry/shape/surface.h"

namespace st {

/// A point of a cut, on a facet.
struct CutPlace {
  FaceId face = kNone;
  Vec3 x;  ///< model unit
};

/// A cut through a lifting surface.
struct Profile {
  Vec3 normal = {};                        ///< of the plane, unit
  Vec3 nose = {};                          ///< the point furthest from the trailing edge, model unit
  FaceId nose_face = kNone;                ///< that it lies on
  double chord = 0;                        ///< from the trailing edge to the nose, model unit
  double thickness = 0;                    ///< largest, over the chord
  std::vector<FaceId> faces = {};          ///< that the cut crosses, ascending
  std::vector<FaceId> near_nose = {};      ///< likewise within 2 % of the chord of the nose
  std::vector<CutPlace> beside_nose = {};  ///< half way along the pieces of the cut that end at the nose
};

/// The point of a surface on the plane through `trailing_edge` that is furthest from it, near a profile's nose, which
/// lies on facets. nullopt: it is further from there than `reach`, or outside of the surface. `guess`: (u,v) of a nose
/// nearby, or nothing; becomes that of this one. Local; some dozen evaluations, without a guess a search of the
/// surface. `grid`: of the surface, where it is asked for many noses; null: none is kept.
std::optional<Vec3> exact_nose(const Surface& surface, Vec3 trailing_edge, const Profile& profile, double reach,
                               std::optional<Vec2>& guess, SurfaceGrid* grid = nullptr);

/// A profile whose trailing edge is not given: it is the thinner end.
struct RoundProfile {
  Profile profile;
  Vec3 tail;                 ///< the end of the cut furthest from the nose, model unit
  FaceId tail_face = kNone;  ///< that it lies on
  double bluntness = 0;      ///< how thick the profile is near the tail over that near the nose, at most 1
};

/// A thin part behind an edge whose nose is not seen: it ends in a body, or in no round or sharp nose.
struct ThinPart {
  double chord = 0;   ///< as far as the cut has two sides that are near each other; model unit
  double middle = 0;  ///< how far they are apart half way, model unit
};

/// A cut that may be no profile.
struct WholeCut {
  double chord = 0;                 ///< from the edge to the furthest end on own faces, model unit
  double whole = 0;                 ///< likewise on any face
  double own_alone = 0;             ///< from the edge to the nearest place on another face, or to the end
  double thickness = 0;             ///< largest, over the chord, where the cut has two sides
  bool is_own = true;               ///< the end furthest from the edge is on an own face, too
  std::vector<FaceId> others = {};  ///< that it crosses, not own

  /// Whether another body lies just before the own nose, as ice does, and ends there.
  bool is_covered() const;
};

/// Cuts a model's facets by planes and measures what is found.
class ProfileCutter {
 public:
  /// `facets` must outlive the object. `ends` (may be null) gets the ends of all cuts that are not closed.
  explicit ProfileCutter(const Facets& facets, std::vector<CutPlace>* ends = nullptr);

  /// The part of the cut by the plane through `trailing_edge` with this unit normal that hangs together with the point,
  /// if it is the profile of a lifting surface: two sides at every station along the chord, 1 to 35 per cent thick,
  /// thickest in the middle, thin towards the trailing edge, with a rounded or sharp nose; else nullopt. `reach`: how
  /// far from the point the cut may begin, model unit. Cost: linear in the blocks of facets, and in facets of those
  /// that are cut.
  std::optional<Profile> cut(Vec3 trailing_edge, Vec3 normal, double reach) const;

  /// Likewise where the cut begins anywhere on the profile, at `at`. Same cost.
  std::optional<RoundProfile> round_profile(Vec3 at, Vec3 normal, double reach) const;

  /// The whole of the same cut: how far its ends are apart, and how thick it is half way; nullopt: it has no two sides
  /// there.
  std::optional<ThinPart> whole(Vec3 at, Vec3 normal, double reach) const;

  /// The part of the same cut that is thin; `thickest`: distance of its sides over that from the edge at most. nullopt:
  /// it is so for less than a factor of five in the distance from the edge. Same cost.
  std::optional<ThinPart> thin_part(Vec3 edge, Vec3 normal, double reach, double thickest = kThickestPart) const;

  /// The same cut whatever its shape; nullopt: there is none. `is_own`: [n_faces].
  std::optional<WholeCut> whole_cut(Vec3 edge, Vec3 normal, double reach, std::span<const std::uint8_t> is_own) const;

  /// The face of the facet that the plane cuts nearest to `at`; kNone: none within reach.
  FaceId nearest_face(Vec3 at, Vec3 normal, double reach) const;

  /// The ends of the same cut.
  std::vector<CutPlace> ends_of(Vec3 edge, Vec3 normal, double reach) const {
    std::vector<CutPlace> ends;
    part_at(edge, normal, reach, &ends);
    return ends;
  }

  static constexpr double kThickestPart = 0.35;

 private:
  /// Where the plane crosses a facet, from one of its sides to another one.
  struct Segment {
    Vec3 end[2];
    std::array<std::int32_t, 2> side[2];  ///< nodes of the mesh, ascending
    std::int32_t facet;
  };
  /// A point of a cut, and the face on which it lies.
  /// The first of equally far ones. Precondition: the cut is not empty.
  CutPlace furthest_end(const std::vector<Segment>& part, Vec3 from) const;
  static bool is_closed(const std::vector<Segment>& part);
  std::optional<Profile> profile_of(const std::vector<Segment>& part, Vec3 trailing_edge, Vec3 normal) const;
  /// Nothing where the plane does not cross it.
  std::optional<Segment> segment_of(std::int32_t facet, Vec3 origin, Vec3 normal) const;
  std::optional<Segment> nearest_segment(Vec3 origin, Vec3 normal, double reach) const;
  /// The nearest crossing of a plane so far.
  struct NearestCrossing {
    Vec3 origin, normal;
    double distance;
    std::optional<Segment> segment;
  };
  /// In the facets of a block.
  void search(std::size_t level, std::size_t block, NearestCrossing& nearest) const;
  std::vector<Segment> part_at(Vec3 origin, Vec3 normal, double reach) const {
    return part_at(origin, normal, reach, ends_);
  }
  std::vector<Segment> part_at(Vec3 origin, Vec3 normal, double reach, std::vector<CutPlace>* ends) const;

  const Facets& facets_;
  std::vector<CutPlace>* const ends_;
  std::vector<std::vector<Box3>> blocks_;  ///< of so many facets each; then of so many of these, up to one
  ListsByKey<> facets_of_;                 ///< by node
};

}  // namespace st
