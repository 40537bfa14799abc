// Faces on which smaller sizes are no use: they fold or cross themselves as before.
#pragma once

#include <cstdint>
#include <vector>

#include "base/ids.h"

namespace st {

/// What rounds did for each face, by two counts: its folds, which every meshing tells, and these with the pairs of its
/// triangles that cross each other, which a search tells. A face is given up by the second meshing in a row that leaves
/// not clearly fewer than the fewest before, where much is bad or much was meshed since; by the first one where it has
/// more than four times the triangles of its first meshing, which follows the sizes and its boundary. A face that was
/// sound begins anew. Local; the same calls give the same.
class HopelessFaces {
 public:
  explicit HopelessFaces(FaceId n_faces) : efforts_(n_faces) {}

  /// The face was meshed once more.
  void add_meshed(FaceId f, std::int64_t n_triangles);
  /// What it has now; nothing happens where it was not meshed since the same was asked last. True: it is given up now.
  bool gives_up_folded(FaceId f, std::int64_t n_folds) { return gives_up(efforts_[f], efforts_[f].folds, n_folds); }
  bool gives_up_crossing(FaceId f, std::int64_t n_bad) { return gives_up(efforts_[f], efforts_[f].crossings, n_bad); }

  /// Folds of all faces that were not given up. True: they are given up now, as by a second round in a row that leaves
  /// not clearly fewer, where much was meshed since; faces that fail are not meant.
  bool gives_up_folds(std::int64_t n_folds);

  bool contains(FaceId f) const { return efforts_[f].is_hopeless; }
  /// Those that were given up, ascending.
  std::vector<FaceId> all() const;

 private:
  struct Count {
    std::int64_t fewest = 0;    // bad so far; 0: none, or not yet asked
    int n_without = 0;          // meshings since then
    std::int64_t n_before = 0;  // triangles until then
    std::int64_t n_asked = 0;   // likewise, until it was asked last
  };
  struct Effort {
    std::int64_t n_meshed = 0;  // triangles,
    std::int64_t n_first = 0;   // those of the first meshing,
    std::int64_t n_last = 0;    // and of the last one
    Count folds, crossings;
    bool is_hopeless = false;
  };
  static bool gives_up(Effort& effort, Count& count, std::int64_t n_bad);

  std::vector<Effort> efforts_;
  Count folds_;                // of all faces
  std::int64_t n_meshed_ = 0;  // triangles of all faces
};

}  // namespace st
