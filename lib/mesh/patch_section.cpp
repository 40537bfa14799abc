#include "mesh/patch_section.h"

#include <algorithm>
#include <utility>

#include "base/threads.h"

namespace st {
namespace {

constexpr std::size_t kPerPiece = 65'536;

}  // namespace

FacePatch rows_of(PatchSection&& section, std::span<const PatchPlace> places, std::size_t own) {
  FacePatch p = std::move(section.patch);
  if (places.size() == 1) return p;
  const std::int32_t n_boundary = places.back().n_boundary;
  const std::int32_t n_local = p.n_boundary, n_own = static_cast<std::int32_t>(p.inner_xyz.size()) - section.n_foreign;
  std::vector<NodeId> foreign;  // where other sections have them
  for (const NodeKey key : std::span(section.shared_key).last(section.n_foreign)) {
    const InnerNode node = inner_node(key);
    foreign.push_back(static_cast<NodeId>(n_boundary + places[node.section].inner_begin + node.number));
  }
  const SectionNumbers number(n_local, section.boundary_number, n_own,
                              static_cast<NodeId>(n_boundary + places[own].inner_begin), std::move(foreign));
  parallel_for(p.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (NodeId& n : p.triangles[t].n) n = number(n);
  });
  for (std::int32_t& corner : p.uv_corner) corner += static_cast<std::int32_t>(3 * places[own].triangle_begin);
  p.inner_xyz.resize(n_own);
  p.inner_uv.resize(n_own);
  p.inner_size.resize(n_own);
  if (!section.is_whole_boundary) {
    p.boundary_dim.clear();
    p.boundary_entity.clear();
    p.boundary_index.clear();
  }
  p.n_boundary = n_boundary;
  return p;
}

FacePatch join_rows(std::vector<FacePatch>&& rows) {
  if (rows.size() == 1) return std::move(rows[0]);
  FacePatch whole;
  const auto append = [&](auto FacePatch::*column, FacePatch& some) {
    (whole.*column).insert((whole.*column).end(), (some.*column).begin(), (some.*column).end());
    some.*column = {};
  };
  for (FacePatch& p : rows) {
    whole.face = p.face;
    whole.n_boundary = p.n_boundary;
    append(&FacePatch::boundary_dim, p);
    append(&FacePatch::boundary_entity, p);
    append(&FacePatch::boundary_index, p);
    append(&FacePatch::inner_xyz, p);
    append(&FacePatch::inner_uv, p);
    append(&FacePatch::inner_size, p);
    append(&FacePatch::triangles, p);
    append(&FacePatch::uv_corner, p);
    append(&FacePatch::own_uv, p);
    append(&FacePatch::inner_previous, p);
    append(&FacePatch::triangle_previous, p);
  }
  return whole;
}

}  // namespace st
