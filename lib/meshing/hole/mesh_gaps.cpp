#include "meshing/hole/mesh_gaps.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace st {
namespace {

/// Mixes two node ids; the exclusive or over sides that each occur twice is 0.
std::uint64_t side_hash(NodeId a, NodeId b) {
  const auto [low, high] = std::minmax(a, b);
  std::uint64_t h = (static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high)) * 0x9e3779b97f4a7c15ULL;
  h ^= h >> 29;
  h *= 0xbf58476d1ce4e5b9ULL;
  return h ^ h >> 32;
}

/// [n_edges] 1: an odd number of faces uses the edge.
std::vector<char> rim_edges(const ModelTables& t) {
  std::vector<char> is_rim(t.n_edges(), 0);
  for (const EdgeId e : t.coedge_edge) is_rim[e] ^= 1;
  return is_rim;
}

bool may_have_gaps(const HoleMesh& m, const std::vector<char>& is_rim) {
  std::uint64_t sum = 0;
  for (const Triangle& t : m.mesh.triangles)
    sum ^= side_hash(t.n[0], t.n[1]) ^ side_hash(t.n[1], t.n[2]) ^ side_hash(t.n[2], t.n[0]);
  for (const CadSegment& s : m.segments)
    if (is_rim[s.edge]) sum ^= side_hash(s.low, s.high);
  return sum != 0;
}

}  // namespace

std::vector<OpenSide> find_open_sides(const HoleMesh& m) {
  const std::vector<char> is_rim = rim_edges(m.tables);
  if (!may_have_gaps(m, is_rim)) return {};
  std::vector<OpenSide> sides, open;
  for (std::size_t i = 0; i < m.mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(m.mesh.triangles[i].n[k], m.mesh.triangles[i].n[(k + 1) % 3]);
      sides.push_back({low, high, m.mesh.triangle_face[i]});
    }
  std::sort(sides.begin(), sides.end(), [](const OpenSide& a, const OpenSide& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  for (std::size_t i = 0, end; i < sides.size(); i = end) {
    for (end = i + 1; end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high;) ++end;
    bool is_on_rim = false;
    for (const CadSegment& s : m.segments_between(sides[i].low, sides[i].high)) is_on_rim |= is_rim[s.edge] != 0;
    if ((end - i) % 2 && !is_on_rim) open.push_back(sides[i]);
  }
  return open;
}

}  // namespace st
