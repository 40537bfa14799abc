#include "features/smooth_edges.h"

#include <algorithm>

namespace st {

std::vector<std::uint8_t> find_smooth_edges(const Model& model, const Executor& executor) {
  constexpr std::size_t kPerTask = 64;
  SmoothEdges edges(model);
  std::vector<std::uint8_t> is_smooth(static_cast<std::size_t>(model.tables().n_edges()));
  const auto n_tasks = (is_smooth.size() + kPerTask - 1) / kPerTask;
  executor.run_tasks(
      static_cast<std::int32_t>(n_tasks), heaviest_first(std::vector<double>(n_tasks, 1)),
      [&](std::int32_t task) {
        const std::size_t first = kPerTask * static_cast<std::size_t>(task);
        std::vector<std::uint8_t> own(std::min(kPerTask, is_smooth.size() - first));
        for (std::size_t i = 0; i < own.size(); ++i) own[i] = edges(static_cast<EdgeId>(first + i));
        return packed(own);
      },
      [&](std::int32_t task, Bytes&& bytes) {
        std::vector<std::uint8_t> own;
        unpack(bytes, own);
        std::copy(own.begin(), own.end(), is_smooth.begin() + static_cast<std::ptrdiff_t>(kPerTask) * task);
      });
  return is_smooth;
}

bool is_smooth_half_way(const Model& model, EdgeId e, std::span<const FaceId> faces, double most) {
  const ModelTables& t = model.tables();
  const double middle = 0.5 * (t.edge_range[2 * e] + t.edge_range[2 * e + 1]);
  std::vector<Vec3> normals;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FaceId f = faces[k];
    if (std::ranges::count(faces.first(k), f) > 0) continue;  // a seam
    for (const CoedgeId c : t.coedges(f)) {
      if (t.coedge_edge[c] != e) continue;
      const Vec3 n = surface_normal(*model.surface(f), model.pcurve(f, c)->point(middle));
      normals.push_back(t.face_is_reversed[f] ? -n : n);
    }
  }
  return normals.size() == 2 && angle_between(normals[0], normals[1]) <= most;
}

}  // namespace st
