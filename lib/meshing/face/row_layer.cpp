#include "meshing/face/row_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "meshing/face/stretch.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kNearNode = 0.55;  // of a row's height: nearer to other nodes no node is laid,
constexpr double kNearSide = 0.45;  // nor to edges that must stay

}  // namespace

std::int32_t RowLayer::insert(const MeshNode& p, std::int32_t from) {
  if (w_.is_runaway()) return kNone;
  const std::int32_t at = m_.seen_from(from, p.p);
  if (at == kNone || m_.triangles[at].state != kUnfinished || !m_.find_cavity(p.p, metric_of(p), at)) return kNone;
  if (is_crowded(p, distance(p.x, m_.nodes[from].x))) return kNone;
  m_.nodes.push_back(p);
  m_.added_node();
  const auto added = static_cast<std::int32_t>(m_.nodes.size()) - 1;
  m_.fill_cavity(added);
  return added;
}

bool RowLayer::is_crowded(const MeshNode& p, double height) const {
  return std::any_of(m_.ring().begin(), m_.ring().end(), [&](const Triangulation::RingEdge& e) {
    const Vec3 a = m_.nodes[e.a].x, b = m_.nodes[e.b].x;
    return distance(p.x, a) < kNearNode * height || (e.constrained && segment_distance(p.x, a, b) < kNearSide * height);
  });
}

bool RowLayer::lay(const std::vector<std::array<std::int32_t, 3>>& corners) {
  std::vector<std::pair<std::int32_t, std::int32_t>> fresh;
  const auto fix = [&](std::int32_t a, std::int32_t b) {
    if (m_.is_fixed(a, b)) return true;
    if (!m_.force_side(a, b)) return false;
    fresh.push_back({a, b});
    return true;
  };
  bool is_free = true;
  for (const auto& [a, b, c] : corners) is_free = is_free && fix(a, b) && fix(b, c) && fix(c, a);
  for (const auto& [a, b, c] : corners) is_free = is_free && m_.left_of(a, b).second == c;
  for (const auto& [a, b] : fresh)
    if (!is_free) m_.release_side(a, b);
  for (const auto& [a, b, c] : corners)
    if (is_free) m_.triangles[m_.left_of(a, b).first].state = kLaid;
  return is_free;
}

void RowLayer::settle(std::int32_t n, double height, double width) {
  MeshNode& node = m_.nodes[n];
  node.is_laid = true;
  node.h = std::min(node.request, height * 1.25);
  const double most = std::max(1.0, 1.3 * width / node.h), own = aspect_of(node);
  if (!(own > most)) return;
  w_.shortened.push_back({n, node.squeeze});
  node.squeeze = std::sqrt((1 - 1 / (most * most)) / (1 - 1 / (own * own))) * node.squeeze;
}

}  // namespace st
