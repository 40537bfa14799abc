#include "stages/remeshed_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/disjoint_sets.h"
#include "base/text.h"

namespace st {
namespace {

Vec3 middle_of(const SurfaceMesh& m, TriangleId t) {
  const NodeId* n = m.triangles[t].n;
  return (m.node_xyz[n[0]] + m.node_xyz[n[1]] + m.node_xyz[n[2]]) / 3;
}

RemeshedPlace place_of(const SurfaceMesh& m, const std::vector<TriangleId>& triangles) {
  RemeshedPlace place;
  place.n_triangles = static_cast<std::int64_t>(triangles.size());
  Vec3 middle;
  std::map<std::int32_t, std::int64_t> of_group;
  for (const TriangleId t : triangles) {
    middle += middle_of(m, t);
    ++of_group[m.triangle_group[t]];
  }
  middle = middle / static_cast<double>(triangles.size());
  place.group = std::max_element(of_group.begin(), of_group.end(), [](const auto& a, const auto& b) {
                  return a.second < b.second;
                })->first;
  place.xyz = middle_of(m, *std::min_element(triangles.begin(), triangles.end(), [&](TriangleId a, TriangleId b) {
                          return distance(middle_of(m, a), middle) < distance(middle_of(m, b), middle);
                        }));
  return place;
}

std::string group_name(const SurfaceMesh& m, std::int32_t group) {
  const auto& names = m.labels.group_name;
  return group >= 0 && static_cast<std::size_t>(group) < names.size() ? names[group] : std::to_string(group + 1);
}

}  // namespace

std::vector<RemeshedPlace> find_remeshed_places(const SurfaceMesh& mesh, std::span<const char> marked) {
  DisjointSets sets(mesh.n_nodes());
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 1; marked[t] && k < 3; ++k) sets.join(mesh.triangles[t].n[0], mesh.triangles[t].n[k]);
  std::map<std::int32_t, std::vector<TriangleId>> by_set;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    if (marked[t]) by_set[sets.find(mesh.triangles[t].n[0])].push_back(t);
  std::vector<RemeshedPlace> places;
  for (const auto& [set, triangles] : by_set) places.push_back(place_of(mesh, triangles));
  std::stable_sort(places.begin(), places.end(),
                   [](const RemeshedPlace& a, const RemeshedPlace& b) { return a.n_triangles > b.n_triangles; });
  return places;
}

std::string places_text(const SurfaceMesh& mesh, const std::vector<RemeshedPlace>& places) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), kMost); ++i) {
    const RemeshedPlace& p = places[i];
    text += fmt::format("{}group {}: {} at ({:.6g} {:.6g} {:.6g})", i ? "; " : "", group_name(mesh, p.group),
                        counted(p.n_triangles, "triangle"), p.xyz.x, p.xyz.y, p.xyz.z);
  }
  if (places.size() > kMost) text += fmt::format("; and {} more, see --json", places.size() - kMost);
  return text;
}

nlohmann::json places_json(const SurfaceMesh& mesh, const std::vector<RemeshedPlace>& places) {
  nlohmann::json json = nlohmann::json::array();
  for (const RemeshedPlace& p : places)
    json.push_back(
        {{"group", group_name(mesh, p.group)}, {"triangles", p.n_triangles}, {"at", {p.xyz.x, p.xyz.y, p.xyz.z}}});
  return json;
}

}  // namespace st
