#include "io/export/msh_periodic.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "mesh/pair_match.h"

namespace st {
namespace {

/// Rows of the motion as a matrix of 4 x 4.
std::array<double, 16> affine(const Similarity& s) {
  const auto& r = s.rotation;
  const Vec3 t = s.translation;
  return {r[0].x, r[0].y, r[0].z, t.x, r[1].x, r[1].y, r[1].z, t.y, r[2].x, r[2].y, r[2].z, t.z, 0, 0, 0, 1};
}

}  // namespace

std::vector<PeriodicLink> periodic_links(const SurfaceMesh& m) {
  std::vector<PeriodicLink> links;
  std::set<std::pair<int, std::int32_t>> slaves;
  for (const FacePair& p : m.merged.pairs) {
    std::map<std::tuple<int, std::int32_t, std::int32_t>, std::vector<std::pair<NodeId, NodeId>>> low;
    links.push_back({2, p.b, p.a, p.motion});
    for (const auto& [a, b] : match_pair(m, p, pair_tolerance(m)).nodes) {
      links.back().nodes.emplace_back(b, a);
      if (const int dim = m.node_entity_dim[b]; dim < 2 && m.node_entity[a] != m.node_entity[b])
        low[{dim, m.node_entity[b], m.node_entity[a]}].emplace_back(b, a);
    }
    for (auto& [key, nodes] : low) {
      const auto [dim, slave, master] = key;
      if (slaves.contains({dim, master}) || !slaves.insert({dim, slave}).second) continue;
      links.push_back({dim, slave, master, p.motion, std::move(nodes)});
    }
  }
  std::stable_sort(links.begin(), links.end(), [](const auto& x, const auto& y) { return x.dim < y.dim; });
  return links;
}

void write_periodic(Numbers& file, const SurfaceMesh& m) {
  if (m.merged.pairs.empty()) return;
  const std::vector<PeriodicLink> links = periodic_links(m);
  file.line("$Periodic");
  file.size(n_of(links)).end();
  for (const PeriodicLink& link : links) {
    file.integer(link.dim).integer(std::int64_t{link.slave} + 1).integer(std::int64_t{link.master} + 1).end();
    file.size(16);
    for (const double v : affine(link.motion)) file.real(v);
    file.end();
    file.size(n_of(link.nodes)).end();
    for (const auto& [slave, master] : link.nodes)
      file.size(std::int64_t{slave} + 1).size(std::int64_t{master} + 1).end();
  }
  file.end_section("Periodic");
}

void write_periodic2(Numbers& file, const SurfaceMesh& m) {
  if (m.merged.pairs.empty()) return;
  const std::vector<PeriodicLink> links = periodic_links(m);
  file.line("$Periodic");
  file.line(std::to_string(links.size()));
  for (const PeriodicLink& link : links) {
    file.line(fmt::format("{} {} {}", link.dim, link.slave + 1, link.master + 1));
    file.line(fmt::format("Affine {}", fmt::join(affine(link.motion), " ")));
    file.line(std::to_string(link.nodes.size()));
    for (const auto& [slave, master] : link.nodes) file.line(fmt::format("{} {}", slave + 1, master + 1));
  }
  file.line("$EndPeriodic");
}

}  // namespace st
