#include "meshing/topology/mesh_topology.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/error.h"

namespace st {
namespace {

void require_ids(const std::vector<std::int32_t>& ids, std::int32_t n, const char* what) {
  for (const std::int32_t id : ids)
    if (id < 0 || id >= n)
      throw Error(ExitCode::kMismatch, std::string("merged ") + what + " " + std::to_string(id + 1) +
                                           " is not in the geometry; mesh the model again");
}

void require_ids(const MergedFeatures& merged, const ModelTables& t) {
  require_ids(merged.edge, t.n_edges(), "edge");
  require_ids(merged.strip_kept, t.n_edges(), "edge");
  require_ids(merged.strip_closed, t.n_edges(), "edge");
  require_ids(merged.strip_face, t.n_faces(), "face");
}

}  // namespace

MeshTopology::MeshTopology(const ModelTables& tables, MergedFeatures merged)
    : tables_(tables), merged_(std::move(merged)) {
  require_ids(merged_, tables_);
  DisjointSets sets(tables_.n_vertices());
  for (const EdgeId e : merged_.edge) {
    sets.join(tables_.edge_vertices[2 * e], tables_.edge_vertices[2 * e + 1]);
    tables_.edge_is_degenerate[e] = 1;
  }
  const auto is_ring = [&](EdgeId e) { return tables_.edge_vertices[2 * e] == tables_.edge_vertices[2 * e + 1]; };
  for (std::size_t s = 0; s < merged_.strip_face.size(); ++s) {
    const auto kept = 2 * static_cast<std::size_t>(merged_.strip_kept[s]),
               closed = 2 * static_cast<std::size_t>(merged_.strip_closed[s]);
    if (is_ring(merged_.strip_kept[s]) && is_ring(merged_.strip_closed[s]))
      sets.join(tables_.edge_vertices[kept], tables_.edge_vertices[closed]);
    else if (std::ranges::equal_range(merged_.strip_face, merged_.strip_face[s]).size() > 1)  // around a ledge
      for (const std::size_t k : {0, 1})
        sets.join(tables_.edge_vertices[kept + k],
                  tables_.edge_vertices[closed + (merged_.strip_is_opposed[s] ? 1 - k : k)]);
  }
  for (VertexId& v : tables_.edge_vertices) v = sets.find(v);
  const std::size_t n_strips = merged_.strip_face.size();
  if (n_strips == 0) return;
  strip_of_face_.assign(tables_.n_faces(), kNone);
  strip_of_kept_.assign(tables_.n_edges(), kNone);
  strip_of_closed_.assign(tables_.n_edges(), kNone);
  for (std::size_t s = 0; s < n_strips; ++s) {
    strips_.push_back(
        {merged_.strip_face[s], merged_.strip_kept[s], merged_.strip_closed[s], merged_.strip_is_opposed[s] != 0});
    strip_of_face_[strips_[s].face] = strip_of_kept_[strips_[s].kept] = strip_of_closed_[strips_[s].closed] =
        static_cast<std::int32_t>(s);
  }
}

}  // namespace st
