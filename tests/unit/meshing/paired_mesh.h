// A shape meshed with pairs of periodic faces.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "mesh/pair_match.h"
#include "meshing/topology/pair_search.h"
#include "support/meshed.h"

namespace st::test {

/// Finer near one corner, so that sides that were meshed apart would differ.
class FinerThere : public UniformField {
 public:
  FinerThere(double length, Vec3 there) : UniformField(length), there_(there) {}
  using UniformField::size;
  double size(Vec3 x, int&) const override {
    return std::min(min_size(), 0.2 * min_size() + 0.2 * distance(x, there_));
  }

 private:
  Vec3 there_;
};

/// A shape meshed with the pairs that are found in it.
struct PairedMesh {
  Model model;
  PeriodicPairs pairs;
  MeshTopology topology;
  MeshResult result;
  OrientationReport report;
  SurfaceMesh mesh;

  PairedMesh(const std::string& shape, const SizeField& field, MeshOptions options = {})
      : PairedMesh(make_model(shape), field, std::move(options)) {}
  PairedMesh(Model m, const SizeField& field, MeshOptions options)
      : model(std::move(m)), pairs(model, find_pairs(model)), topology(placed(model, pairs)) {
    set_verbosity(Verbosity::kQuiet);
    options.pairs = &pairs;
    result = mesh_regions(model, topology, field, plan_all(topology), options, one_rank);
    mesh = merged(topology, result, report);
  }

  static MeshTopology placed(const Model& model, const PeriodicPairs& pairs) {
    ModelTables t = model.tables();
    t.vertex_xyz = pairs.vertex_xyz();
    return MeshTopology(t, without_paired({}, pairs, t));
  }
  void expect_matched() const {
    EXPECT_TRUE(result.failures.empty());
    EXPECT_EQ(mesh.merged.pairs, pairs.pairs());
    expect_images(mesh);
  }
  /// Of all pairs, in a mesh of this model.
  void expect_images(const SurfaceMesh& m) const {
    for (const FacePair& p : pairs.pairs()) {
      const PairMatch match = match_pair(m, p, pair_tolerance(m));
      EXPECT_GT(match.nodes.size(), 10u);
      EXPECT_TRUE(match.alone.empty()) << match.alone.size() << " of " << match.nodes.size();
      EXPECT_TRUE(match.triangles_alone.empty()) << match.triangles_alone.size();
    }
  }
  /// Of nodes inside faces from the surface at their (u,v).
  double largest_distance() const {
    double most = 0;
    for (const FacePatch& p : result.patches) {
      const auto surface = model.surface(p.face);
      for (std::size_t i = 0; i < p.inner_xyz.size(); ++i)
        most = std::max(most, distance(surface->point(p.inner_uv[i]), p.inner_xyz[i]));
    }
    return most;
  }
};

}  // namespace st::test
