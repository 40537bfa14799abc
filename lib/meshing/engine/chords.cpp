#include "meshing/engine/chords.h"

#include <algorithm>
#include <tuple>

#include "base/threads.h"

namespace st {

BoundarySegments::BoundarySegments(const BoundaryNumbering& numbering) {
  const EdgeMesh& edges = numbering.edges;
  const auto key = [&](EdgeId e, std::int32_t index) {
    const BoundaryNumbering::Entity at = numbering.entity(numbering.edge_node(e, index));
    return boundary_key(at.dim, at.entity, at.index);
  };
  for (EdgeId e = 0; e < numbering.tables.n_edges(); ++e) {
    const std::int32_t n = edges.n_nodes(e);
    const bool is_own = !numbering.topology.strip_closed_at(e);  // the nodes inside it are its own
    for (std::int32_t i = 1; i < n; i += is_own && i == 1 && n > 2 ? n - 2 : 1) {
      const auto [a, b] = std::minmax({key(e, i - 1), key(e, i)});
      at_ends_.push_back({a, b});
    }
  }
  std::sort(at_ends_.begin(), at_ends_.end());
}

bool BoundarySegments::contain(NodeKey a, NodeKey b) const {
  return is_next(a, b) || std::binary_search(at_ends_.begin(), at_ends_.end(), std::pair{a, b});
}

std::vector<Chord> find_chords(const BoundarySegments& segments, const FacePatch& patch, std::int64_t first) {
  constexpr std::size_t kPerPiece = 65'536;
  std::vector<std::vector<Chord>> found(patch.triangles.size() / kPerPiece + 1);
  parallel_for(patch.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) {
        const NodeId m = patch.triangles[i].n[k], n = patch.triangles[i].n[(k + 1) % 3];
        if (std::max(m, n) >= patch.n_boundary) continue;
        const auto [a, b] = std::minmax({boundary_key(patch, m), boundary_key(patch, n)});
        if (segments.contain(a, b)) continue;
        found[begin / kPerPiece].push_back(
            {a, b, {patch.face, static_cast<std::int32_t>(first + static_cast<std::int64_t>(i))}});
      }
  });
  std::vector<Chord> chords;
  for (const auto& some : found) chords.insert(chords.end(), some.begin(), some.end());
  return chords;
}

std::vector<std::pair<Facet, Facet>> find_repeated_chords(std::vector<Chord> chords,
                                                          std::span<const char> face_is_fresh) {
  const auto key = [](const Chord& c) { return std::tuple(c.a, c.b, c.facet.face, c.facet.index); };
  std::sort(chords.begin(), chords.end(), [&](const Chord& c, const Chord& d) { return key(c) < key(d); });
  std::vector<std::pair<Facet, Facet>> pairs;
  for (std::size_t i = 0, j = 0; i < chords.size(); i = j) {
    while (j < chords.size() && chords[j].a == chords[i].a && chords[j].b == chords[i].b) ++j;
    const Facet first = chords[i].facet, last = chords[j - 1].facet;
    if (j - i >= 3 && first.face != last.face && (face_is_fresh[first.face] || face_is_fresh[last.face]))
      pairs.push_back({first, last});
  }
  return pairs;
}

}  // namespace st
