#include "sizing/telling_triangles.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "sizing/length_tree.h"

namespace st {
namespace {

constexpr double kAsLittle = 1.005;  // times a length: less than the lengths of a raster differ from its samples'
constexpr std::int32_t kNobody = -1;

class Choice {
 public:
  Choice(const BackgroundMesh& mesh, double slope)
      : mesh_(mesh), slope_(slope), is_kept_(mesh.triangles.size(), 0), position_(mesh.triangles.size()) {
    std::vector<Box3> boxes(mesh.triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const std::int32_t n : mesh.triangles[t]) boxes[t].add(mesh.node_xyz[n]);
    tree_ = LengthTree(boxes, std::vector<double>(boxes.size(), std::numeric_limits<double>::infinity()));
    for (std::size_t i = 0; i < boxes.size(); ++i) position_[tree_.items()[i]] = static_cast<std::int32_t>(i);
  }

  std::vector<std::array<std::int32_t, 3>> run() {
    std::vector<std::int32_t> order(mesh_.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> least;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(order.size()); ++t) least.push_back(least_of(t));
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return least[a] < least[b]; });
    for (const std::int32_t t : order) {
      if (is_told_by(t, best_at_centre(t))) continue;
      is_kept_[t] = 1;
      tree_.lower(position_[t], least[t]);
    }
    std::vector<std::array<std::int32_t, 3>> kept;
    for (std::size_t t = 0; t < is_kept_.size(); ++t)
      if (is_kept_[t]) kept.push_back(mesh_.triangles[t]);
    return kept;
  }

 private:
  double length(std::int32_t node) const { return mesh_.node_size[node].length; }
  double least_of(std::int32_t t) const {
    const auto& n = mesh_.triangles[t];
    return std::min({length(n[0]), length(n[1]), length(n[2])});
  }
  /// Of the triangle t at x.
  double grown(std::int32_t t, Vec3 x) const {
    const auto& n = mesh_.triangles[t];
    return least_over_triangle(x, {mesh_.node_xyz[n[0]], mesh_.node_xyz[n[1]], mesh_.node_xyz[n[2]]},
                               {length(n[0]), length(n[1]), length(n[2])}, slope_);
  }
  /// The kept triangle that asks for least at the centre of t; kNobody: none asks for as little as t.
  std::int32_t best_at_centre(std::int32_t t) const {
    const auto& n = mesh_.triangles[t];
    const Vec3 centre = (mesh_.node_xyz[n[0]] + mesh_.node_xyz[n[1]] + mesh_.node_xyz[n[2]]) / 3;
    double best = kAsLittle * (length(n[0]) + length(n[1]) + length(n[2])) / 3;
    std::int32_t winner = kNobody;
    tree_.visit_from(centre, slope_, best, [&](std::int32_t other) {
      if (!is_kept_[other]) return;
      const double there = grown(other, centre);
      if (!(there < best)) return;
      best = there;
      winner = other;
    });
    return winner;
  }
  bool is_told_by(std::int32_t t, std::int32_t other) const {
    if (other == kNobody) return false;
    const auto& nodes = mesh_.triangles[t];
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](std::int32_t n) { return grown(other, mesh_.node_xyz[n]) <= kAsLittle * length(n); });
  }

  const BackgroundMesh& mesh_;
  const double slope_;
  std::vector<std::uint8_t> is_kept_;
  std::vector<std::int32_t> position_;  // of each triangle in the tree's items
  LengthTree tree_;                     // of the kept ones
};

}  // namespace

std::vector<std::array<std::int32_t, 3>> telling_triangles(const BackgroundMesh& mesh, double slope) {
  const auto is_stretched = [](const LocalSize& s) { return s.along > s.length; };
  if (std::any_of(mesh.node_size.begin(), mesh.node_size.end(), is_stretched)) return mesh.triangles;
  return Choice(mesh, slope).run();
}

}  // namespace st
