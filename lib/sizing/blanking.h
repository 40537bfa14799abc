// What is no flow: the cells inside a closed surface, and the links between cells that the surface separates.
#pragma once

#include <cstdint>
#include <vector>

#include "sizing/cut_cells.h"
#include "sizing/neighbours.h"

namespace st {

/// What a cell is, as stored and exported.
enum class CellColour : std::uint8_t { kFlow = 0, kCut = 1, kBlanked = 2 };

/// Which side of a closed surface is no flow.
enum class BlankSide { kInside, kOutside };

/// A surface that separates flow from no flow, normals out of its inside.
struct BlankSurface {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  BlankSide side = BlankSide::kInside;

  SurfaceView view() const { return {points, triangles}; }
};

/// A cell in which the surface separates two parts of the flow (a wall thinner than the cell): which of them a point
/// belongs to.
struct CellSplit {
  float normal[3] = {0, 0, 0};  ///< unit, towards the first part
  float offset = 0;  ///< the plane normal . x = offset between them; x counts from the cell's centre, model unit
  float margin = 0;  ///< points closer to the plane may belong to either, model unit, >= 0
};

/// Links to the neighbours of a cell in the order of Neighbours::for_each: bit k is set when a length passes to the
/// k-th.
struct OpenLinks {
  std::uint64_t to_first = 0;   ///< to its first part, or its only one
  std::uint64_t to_second = 0;  ///< to its second part
};

/// An octree with a closed surface in it. Sites are what lengths belong to: the leaves (in split ones their first
/// part), then the second parts of split leaves.
struct Blanking {
  std::vector<CellColour> colour;        ///< [n_leaves]
  std::vector<std::int32_t> split_leaf;  ///< [n_split] ascending
  std::vector<CellSplit> split;          ///< [n_split]
  std::vector<std::int32_t> site_links;  ///< [n_leaves + n_split] row of `links`; kNone: all links are open, to first
                                         ///< parts. In rows those across faces alone, unless none of these is open
  std::vector<OpenLinks> links;
  // Not stored:
  std::vector<std::int32_t> cut_index;  ///< [n_leaves] kNone: not cut
  std::vector<Vec3> sheet;              ///< [n_cut] unit, into the flow, where the cell meets one sheet of the surface;
                                        ///< else zero
  double flow_along_normals = 0;        ///< 1: normals of the model point into the flow, -1: out of it, 0: unknown

  std::int32_t n_sites() const { return static_cast<std::int32_t>(site_links.size()); }
  /// kNone: not split.
  std::int32_t find_split(std::int32_t leaf) const;
};

/// Cells that the surface cuts, one ray per region for the rest, colouring; then the links near the surface: a length
/// passes between flow and flow where the surface does not lie between, from flow to what is blanked, never from there
/// to flow. Where the surface separates the flow in a cell, the cell has two parts (more are taken together).
/// Precondition: oriented surface (normals out of its inside), closed but for `open_edges`: where these lie cells count
/// as not cut, and if there are any nothing is blanked. Local; a few microseconds per cut cell.
Blanking blank_cells(const Neighbours& neighbours, const SurfaceView& surface, BlankSide side,
                     std::span<const Triangle> open_edges = {});

/// Edges along which not as many triangles run one way as the other, each as a triangle with a repeated node.
/// Precondition: triangles that touch have common nodes.
std::vector<Triangle> find_open_edges(const SurfaceView& surface);

/// Calls f(site, step) for each site that a length passes to from `site`. `blanking` may be null: each leaf is a site.
template <class F>
void for_each_link(const Blanking* blanking, const Neighbours& neighbours, std::int32_t site, F&& f) {
  const std::int32_t n_leaves = blanking ? static_cast<std::int32_t>(blanking->colour.size()) : site + 1;
  const std::int32_t row = blanking ? blanking->site_links[site] : kNone;
  if (row == kNone) return neighbours.for_each(site, f);
  const OpenLinks open = blanking->links[row];
  std::uint64_t bit = 1;
  neighbours.for_each(site < n_leaves ? site : blanking->split_leaf[site - n_leaves],
                      [&](std::int32_t other, const CellStep& step) {
                        if (open.to_first & bit) f(other, step);
                        if (open.to_second & bit) f(n_leaves + blanking->find_split(other), step);
                        bit <<= 1;
                      });
}

/// Likewise, the links across faces of cells alone, in the same order.
template <class F>
void for_each_link_across_face(const Blanking& blanking, const Neighbours& neighbours, std::int32_t site, F&& f) {
  const auto n_leaves = static_cast<std::int32_t>(blanking.colour.size());
  const std::int32_t row = blanking.site_links[site];
  const OpenLinks open = row == kNone ? OpenLinks{~std::uint64_t{0}, 0} : blanking.links[row];
  neighbours.for_each_across_face_numbered(site < n_leaves ? site : blanking.split_leaf[site - n_leaves],
                                           [&](std::int32_t other, const CellStep& step, int n) {
                                             if (open.to_first >> n & 1) f(other, step);
                                             if (open.to_second >> n & 1)
                                               f(n_leaves + blanking.find_split(other), step);
                                           });
}

}  // namespace st
