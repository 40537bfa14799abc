#include "features/smooth_edges.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace st {
namespace {

constexpr int kPlaces = 9;
constexpr double kSmooth = radians(3);  // between the normals on both sides

/// One side of an edge.
class EdgeSide {
 public:
  EdgeSide(const Model& model, FaceId face, CoedgeId coedge)
      : surface_(model.surface(face)),
        pcurve_(model.pcurve(face, coedge)),
        is_reversed_(model.tables().face_is_reversed[face] != 0) {}

  Vec3 outer_normal(double t) const {
    const Vec3 n = surface_normal(*surface_, pcurve_->point(t));
    return is_reversed_ ? -n : n;
  }

 private:
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Curve2d> pcurve_;
  bool is_reversed_;
};

/// Whether the normals of both sides agree at all places along an edge.
bool are_smooth(const EdgeSide& a, const EdgeSide& b, double t0, double t1) {
  for (int i = 0; i < kPlaces; ++i) {
    const double t = t0 + (t1 - t0) * (i + 0.5) / kPlaces;
    const Vec3 na = a.outer_normal(t), nb = b.outer_normal(t);
    if (!(norm2(na) > 0 && norm2(nb) > 0 && angle_between(na, nb) <= kSmooth)) return false;
  }
  return true;
}

}  // namespace

SmoothEdges::SmoothEdges(const Model& model)
    : model_(model),
      uses_(static_cast<std::size_t>(model.tables().n_edges())),
      answer_(uses_.size(), Answer::kNotAsked) {
  const ModelTables& t = model.tables();
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (const CoedgeId c : t.coedges(f)) uses_[t.coedge_edge[c]].push_back({f, c});
}

bool SmoothEdges::operator()(EdgeId edge) {
  const auto e = static_cast<std::size_t>(edge);
  if (answer_[e] == Answer::kNotAsked) {
    const ModelTables& t = model_.tables();
    const auto side = [&](const Use& use) { return EdgeSide(model_, use.face, use.coedge); };
    const bool is_smooth =
        uses_[e].size() == 2 && !t.edge_is_degenerate[e] &&
        are_smooth(side(uses_[e][0]), side(uses_[e][1]), t.edge_range[2 * e], t.edge_range[2 * e + 1]);
    answer_[e] = is_smooth ? Answer::kSmooth : Answer::kSharp;
  }
  return answer_[e] == Answer::kSmooth;
}

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
