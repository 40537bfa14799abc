// Triangles of different shares of a mesh that cross each other. Internal to the check stage.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "base/ascending_numbers.h"
#include "base/box_tree.h"
#include "base/executor.h"
#include "io/hdf5/mesh_file.h"
#include "stages/check_parts.h"

namespace st {

/// Collective: all ranks have what all ranks gave, by rank.
template <class T>
std::vector<T> gather_for_all(const Executor& ranks, const T& own) {
  Bytes bytes;
  for (const Bytes& part : ranks.gather(packed(own))) bytes.insert(bytes.end(), part.begin(), part.end());
  ranks.broadcast(bytes);
  std::vector<T> all;
  Unpacker unpacker(bytes);
  for (int r = 0; r < ranks.size(); ++r) unpacker.get(all.emplace_back());
  return all;
}

/// Each share is covered by boxes around blocks of triangles that are near each other. All ranks know all boxes; who
/// has a share looks which of its triangles meet those of others; and who compares two shares reads these alone.
class ShareCrossings {
 public:
  ShareCrossings(const MeshFile& file, const Executor& ranks) : file_(file), ranks_(ranks) {}

  /// Local: a share of this rank, in order. All ranks have consecutive ones, in the order of ranks.
  void add(const MeshSelection& share);
  /// Collective: adds the pairs of triangles of two shares to those of the first rank, and what it took to find them.
  void find(CheckParts& parts);

 private:
  /// Boxes around blocks of one share, and where it is.
  struct Cover {
    TriangleId begin = 0, end = 0;
    std::vector<Box3> boxes;
    static auto fields(auto& c) { return std::tie(c.begin, c.end, c.boxes); }
  };
  struct Covers {
    std::vector<Cover> all;
    static auto fields(auto& c) { return std::tie(c.all); }
  };
  /// Triangles of one share that are near those of another, ascending.
  struct Near {
    std::int32_t share = 0, other = 0;
    AscendingNumbers triangles;
    static auto fields(auto& n) { return std::tie(n.share, n.other, n.triangles); }
  };
  struct NearLists {
    std::vector<Near> all;
    static auto fields(auto& n) { return std::tie(n.all); }
  };
  using NearMap = std::map<std::pair<std::int32_t, std::int32_t>, AscendingNumbers>;  // of a share, to another

  /// Those of all shares.
  struct Boxes {
    std::vector<Box3> all;
    std::vector<std::int32_t> share;  // of each
    BoxTree tree;
  };

  NearMap find_near() const;
  NearLists near_of(const Boxes& boxes, const Cover& cover, std::int32_t k) const;

  const MeshFile& file_;
  const Executor& ranks_;
  Covers own_;
};

}  // namespace st
