#include "stages/wing_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/boxes.h"
#include "mesh/group_mesh.h"
#include "stages/spanwise.h"

namespace st {
namespace {

constexpr std::size_t kTrianglesPerBlock = 256;  // whose box is looked at first

struct BlockTriangle {
  TriangleId triangle;
  Vec3 center;
  double radius, side;
};

/// Calls f(box around the middles, triangles) for blocks in order.
template <class F>
void for_each_block(const SurfaceMesh& mesh, const F& f) {
  std::vector<BlockTriangle> block;
  Box3 box;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const auto& n = mesh.triangles[t].n;
    const Vec3 a = mesh.node_xyz[n[0]], b = mesh.node_xyz[n[1]], c = mesh.node_xyz[n[2]], center = (a + b + c) / 3;
    block.push_back({t, center, std::max({distance(center, a), distance(center, b), distance(center, c)}),
                     std::max({distance(a, b), distance(b, c), distance(c, a)})});
    box.add(center);
    if (block.size() < kTrianglesPerBlock && t + 1 < mesh.n_triangles()) continue;
    f(box, std::span<const BlockTriangle>(block));
    block.clear();
    box = {};
  }
}

}  // namespace

WingReach::WingReach(const WingRecord& wing) {
  for (const WingRecord::Station& s : wing.stations)
    for (const Vec3 x : {s.nose, s.trailing}) places_.push_back({x, std::numeric_limits<double>::infinity(), 0});
  const Spanwise spanwise(wing);
  if (!wing.has_noses || spanwise.station.empty()) return;
  for (const std::size_t i : spanwise.listed()) {
    const WingRecord::Station& s = *spanwise.station[i];
    noses_.push_back({s.nose, kNoseReach * s.chord});
    profiles_.push_back({s.trailing, spanwise.profile_normal(i)});
  }
}

void WingReach::look_at(const SurfaceMesh& mesh) {
  for_each_block(mesh, [&](const Box3& box, std::span<const BlockTriangle> block) {
    for (Place& place : places_) {
      if (distance2(place.xyz, box) >= place.nearest * place.nearest) continue;
      for (const BlockTriangle& b : block)
        if (const double d = distance(b.center, place.xyz); d < place.nearest) place.nearest = d, place.side = b.side;
    }
  });
}

std::vector<TriangleId> WingReach::within(const SurfaceMesh& mesh) const {
  std::vector<TriangleId> kept;
  std::vector<Ball> all = noses_, near;
  for (const Place& place : places_) all.push_back(place.reach());
  for_each_block(mesh, [&](const Box3& box, std::span<const BlockTriangle> block) {
    near.clear();
    for (const Ball& ball : all)
      if (distance2(ball.center, box) <= ball.radius * ball.radius) near.push_back(ball);
    for (const BlockTriangle& b : block) {
      const bool is_near =
          std::ranges::any_of(near, [&](const Ball& ball) { return distance(b.center, ball.center) <= ball.radius; });
      const bool is_cut = std::ranges::any_of(
          profiles_, [&](const Plane& p) { return std::abs(dot(b.center - p.point, p.normal)) <= b.radius; });
      if (is_near || is_cut) kept.push_back(b.triangle);
    }
  });
  return kept;
}

std::vector<WingMeasure> measure_wings(const MeshFile& mesh, std::span<const WingRecord> wings) {
  std::vector<WingMeasure> all;
  for (const WingRecord& wing : wings) {
    const auto is_wanted = [&](FaceId f) {
      return wing.faces.empty() || std::ranges::binary_search(wing.faces, f) ||
             std::ranges::binary_search(wing.bases, f);
    };
    WingReach reach(wing);
    const FaceLabels& labels = mesh.head().mesh.labels;
    std::vector<std::int64_t> of_groups(labels.group_name.size());
    std::int64_t n_triangles = 0;
    mesh.for_faces(is_wanted, [&](const MeshSelection& some) {
      reach.look_at(some.mesh);
      count_groups(some.mesh, wing.faces, of_groups);
      for (const FaceId f : some.mesh.triangle_face)
        n_triangles += std::ranges::binary_search(wing.faces, f) + std::ranges::binary_search(wing.bases, f);
    });
    std::vector<TriangleId> kept;
    mesh.for_faces(is_wanted, [&](const MeshSelection& some) {
      for (const TriangleId t : reach.within(some.mesh)) kept.push_back(some.triangle_number[t]);
    });
    const MeshSelection triangles = mesh.select(std::move(kept), MeshFile::Rows::kPlaces);
    WingMeasure own = std::move(measure_wings(triangles.mesh, {&wing, 1})[0]);
    if (!wing.faces.empty()) own.n_triangles = n_triangles;
    own.group = main_group(labels, of_groups);
    all.push_back(std::move(own));
  }
  return all;
}

}  // namespace st
