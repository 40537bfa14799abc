#include "mesh/patch_section.h"

#include <numeric>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "mesh/merge.h"

namespace st {
namespace {

constexpr std::size_t kPerPiece = 65'536;

}  // namespace

FacePatch rows_of(FacePatch&& section, std::span<const PatchPlace> places, std::size_t own) {
  FacePatch p = std::move(section);
  if (places.size() == 1) return p;
  const std::int32_t n_boundary = places.back().n_boundary, n_own = p.n_own();
  std::vector<std::int32_t> ids = std::exchange(p.boundary_number, {}), n_inner;
  const bool has_all = ids.empty();
  if (has_all) {
    ids.resize(p.n_boundary);
    std::iota(ids.begin(), ids.end(), 0);
  }
  for (const PatchPlace& place : places) n_inner.push_back(place.n_inner);
  const std::vector<NodeId> number = PatchNumbers::of_sections(n_boundary, n_inner).of_piece(own, ids, n_own, p.owner);
  parallel_for(p.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (NodeId& n : p.triangles[t].n) n = number[n];
  });
  for (std::int32_t& corner : p.uv_corner) corner += static_cast<std::int32_t>(3 * places[own].triangle_begin);
  p.inner_xyz.resize(n_own);
  p.inner_uv.resize(n_own);
  p.inner_size.resize(n_own);
  p.owner = {};
  if (!has_all) {
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
