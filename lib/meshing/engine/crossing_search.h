// Triangles of patches that cross each other, as places where the sizes must become smaller.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

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

/// Remembers the pairs that it found: searched are only those with a patch made since the last search. Local.
class CrossingSearch {
 public:
  /// `face_shell` [n_faces] outlives the object: faces of different shells are not compared.
  explicit CrossingSearch(std::span<const std::int32_t> face_shell)
      : face_shell_(face_shell), face_is_fresh_(face_shell.size(), 1) {}

  /// The face's patch is another one now.
  void renew(FaceId f) { face_is_fresh_[f] = 1; }
  /// `patches` [n_faces] by face. Two places for each pair, up to some thousand.
  std::vector<RefinementPoint> run(const BoundaryNumbering& numbering, const std::vector<FacePatch>& patches);
  /// By the last run.
  int n_pairs() const { return static_cast<int>(pairs_.size()); }
  /// Triangles of the face, by their places in its patch, that cross others of it, or also of other faces; by the last
  /// run, ascending.
  std::vector<std::size_t> crossing_in(FaceId f, bool others_too) const;

 private:
  struct FacetPair {  // two triangles by face and place in its patch
    FaceId face_a, face_b;
    std::int32_t index_a, index_b;
    auto operator<=>(const FacetPair&) const = default;
  };

  std::span<const std::int32_t> face_shell_;
  std::vector<char> face_is_fresh_;  // patch made since the last run
  std::vector<FacetPair> pairs_;     // found so far and still there, sorted
};

}  // namespace st
