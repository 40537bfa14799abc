// Rows of model tables for some of its entities.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// `values[ids[i]]` for each i, in rows of `n_columns`.
template <class T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<std::int32_t>& ids, int n_columns = 1) {
  std::vector<T> out;
  out.reserve(ids.size() * n_columns);
  for (const std::int32_t id : ids)
    for (int c = 0; c < n_columns; ++c) out.push_back(values[static_cast<std::size_t>(id) * n_columns + c]);
  return out;
}

/// Ids of `n_entities` entities to places in `ids`; kNone where absent.
std::vector<std::int32_t> places(const std::vector<std::int32_t>& ids, std::int32_t n_entities);

/// Columns of the faces of a part.
void select_faces(const ModelTables& t, const std::vector<FaceId>& f, ModelTables& out);

/// Columns of the edges and vertices of a part. Precondition: `out` has its faces' labels.
void select_edges(const ModelTables& t, const std::vector<EdgeId>& e, const std::vector<VertexId>& v, ModelTables& out);

}  // namespace st
