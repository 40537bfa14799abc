// Triangles of patches that cross each other, as places where the sizes must become smaller.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "geometry/model/bodies.h"
#include "geometry/model/model.h"
#include "mesh/crossing.h"
#include "mesh/merge.h"
#include "meshing/face/face_boundary.h"

namespace st {

/// Pairs of triangles of two faces about one chord: an edge between the same two nodes on boundaries inside both faces,
/// sorted, at least one face fresh. Two faces along common edges, too flat for a node inside, lie on each other there.
/// `mesh`: the patches by face.
std::vector<TrianglePair> find_repeated_chords(const BoundaryNumbering& numbering, const WeldedPatches& mesh,
                                               std::span<const char> face_is_fresh);

/// Half the longest of a triangle's sides, at its centre.
RefinementPoint halve_triangle(Vec3 a, Vec3 b, Vec3 c);

/// Remembers the pairs that it found: searched are only those with a patch made since the last search. Triangles of
/// two bodies count where the CAD keeps these apart; parts in contact cross as they like. Local.
class CrossingSearch {
 public:
  /// The model outlives the object. `across_bodies`: bodies are compared with each other, too.
  explicit CrossingSearch(const Model& model, bool across_bodies = true)
      : model_(model),
        is_across_(across_bodies),
        face_body_(bodies_of(model.tables())),
        face_is_fresh_(face_body_.size(), 1) {}

  /// The face's patch is another one now.
  void renew(FaceId f) { face_is_fresh_[f] = 1; }
  /// `patches` [n_faces] by face. Two places for each pair that smaller triangles can part, up to some thousand.
  std::vector<RefinementPoint> run(const BoundaryNumbering& numbering, const std::vector<FacePatch>& patches);
  /// By the last run.
  int n_pairs() const { return static_cast<int>(pairs_.size()); }
  /// Triangles of the face, by their places in its patch, that cross others of it, or also of other faces; by the last
  /// run, ascending.
  std::vector<std::size_t> crossing_in(FaceId f, bool others_too) const;
  /// Moves nodes inside faces where triangles of the last run touch as the CAD does, to part them: by less than
  /// surfaces that meet are apart (meeting_distance()). Returns the places of the nodes before, by changed face; these
  /// are renewed.
  std::map<FaceId, std::vector<Vec3>> move_touching_apart(const BoundaryNumbering& numbering,
                                                          std::vector<FacePatch>& patches);

 private:
  struct FacetPair {  // two triangles by face and place in its patch
    FaceId face_a, face_b;
    std::int32_t index_a, index_b;
    double factor = 0;  // of the length that parts them; kHalve, kHopeless
    auto operator<=>(const FacetPair&) const = default;
  };

  static constexpr double kHalve = 0, kHopeless = -1, kUnknown = -2, kMeets = -3;
  using FacetPairs = std::vector<FacetPair>;

  bool may_be_apart(FaceId a, FaceId b) const;
  std::vector<RefinementPoint> places_to_refine(const WeldedPatches& mesh) const;
  FacetPairs measured(const FacetPairs& pairs, const WeldedPatches& mesh, const std::vector<FacePatch>& patches);
  FacetPairs measured_pair_of_faces(std::span<const FacetPair> pairs, const WeldedPatches& mesh,
                                    const std::vector<FacePatch>& patches) const;

  const Model& model_;
  bool is_across_;
  std::vector<std::int32_t> face_body_;
  std::set<std::pair<FaceId, FaceId>> touching_;  // of two bodies in contact, as far as known
  int n_runs_ = 0;
  std::vector<char> face_is_fresh_;  // patch made since the last run
  std::vector<FacetPair> pairs_;     // found so far and still there, sorted
};

}  // namespace st
