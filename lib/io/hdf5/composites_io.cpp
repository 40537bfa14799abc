#include "io/hdf5/composites_io.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "io/hdf5/artifact_checks.h"

namespace st {
namespace {

constexpr int kCompositesVersion = 2;  // of the group /st/composites; 1: without poles

/// Name and column of each.
template <class C, class Visit>
void for_each_column(C& c, const Visit& visit) {
  visit("/st/composites/member", c.member);
  visit("/st/composites/member_offsets", c.member_offsets);
  visit("/st/composites/joined_edges", c.joined_edges);
  visit("/st/composites/joined_vertices", c.joined_vertices);
  visit("/st/composites/node_xyz", c.node_xyz);
  visit("/st/composites/node_uv", c.node_uv);
  visit("/st/composites/node_offsets", c.node_offsets);
  visit("/st/composites/triangle_nodes", c.triangle_nodes);
  visit("/st/composites/triangle_face", c.triangle_face);
  visit("/st/composites/triangle_offsets", c.triangle_offsets);
  visit("/st/composites/uv_bounds", c.uv_bounds);
  visit("/st/composites/rim_coedge", c.rim_coedge);
  visit("/st/composites/rim_offsets", c.rim_offsets);
  visit("/st/composites/rim_t", c.rim_t);
  visit("/st/composites/rim_node", c.rim_node);
  visit("/st/composites/rim_triangle", c.rim_triangle);
}

constexpr const char* kTriangleUv = "/st/composites/triangle_uv";
constexpr const char* kTrianglePole = "/st/composites/triangle_pole";

}  // namespace

void write_composites(Hdf5Writer& w, const Composites& c) {
  if (c.empty()) return;
  for_each_column(c, [&](const char* name, const auto& column) { w.write(name, column); });
  std::vector<Vec2> uv;
  for (const auto& corners : c.triangle_uv) uv.insert(uv.end(), corners.begin(), corners.end());
  w.write(kTriangleUv, uv);
  const bool has_poles = std::ranges::any_of(c.triangle_pole, [](std::int32_t pole) { return pole != kNone; });
  if (has_poles) w.write(kTrianglePole, c.triangle_pole);
  w.set_attribute("/st/composites", "version", std::int64_t{has_poles ? kCompositesVersion : 1});
}

bool has_composites(const Hdf5Reader& r) { return r.has("/st/composites/member"); }

Composites read_composites(const Hdf5Reader& r) {
  if (const std::int64_t version = r.int_attribute("/st/composites", "version"); version > kCompositesVersion)
    r.fail("/st/composites@version", std::to_string(version) + " is newer than this version of ST reads");
  Composites c;
  for_each_column(c, [&](const char* name, auto& column) {
    column = r.read<typename std::decay_t<decltype(column)>::value_type>(name);
  });
  const std::vector<Vec2> uv = r.read_rows<Vec2>(kTriangleUv, 3 * c.triangle_nodes.size());
  for (std::size_t t = 0; t < c.triangle_nodes.size(); ++t)
    c.triangle_uv.push_back({uv[3 * t], uv[3 * t + 1], uv[3 * t + 2]});
  c.triangle_pole.assign(c.triangle_nodes.size(), kNone);
  if (r.has(kTrianglePole)) c.triangle_pole = r.read<std::int32_t>(kTrianglePole);
  require_finite(r, "/st/composites/node_uv", c.node_uv);
  require_finite(r, kTriangleUv, uv);
  return c;
}

}  // namespace st
