#include "meshing/engine/stretch_easing.h"

#include <gtest/gtest.h>

#include "mesh/quality.h"
#include "support/meshed.h"

namespace st {
namespace {

/// Lengths of 2, in the top of a box 20 high along x so much longer.
class TopField : public SizeField {
 public:
  explicit TopField(double along) : along_(along) {}
  using SizeField::size;
  double size(Vec3, int&) const override { return 2; }
  LocalSize local(Vec3 x, int&) const override {
    return x.z > 19.9 ? LocalSize{2, along_, {1, 0, 0}} : LocalSize{2, 2, {}};
  }
  bool is_stretched() const override { return true; }
  double min_size() const override { return 2; }
  double slope() const override { return 0; }

 private:
  double along_;
};

SurfaceMesh box_with_long_top(double along) {
  set_verbosity(Verbosity::kQuiet);
  const Model model = test::make_model("box");
  const MeshTopology topology(model.tables());
  OrientationReport orientation;
  const TopField field(along);
  return test::merged(topology, mesh_regions(model, topology, field, plan_all(topology), {}, test::one_rank),
                      orientation);
}

TEST(StretchEasing, leaves_no_far_angle_and_no_large_step) {
  const std::int64_t n_plain = box_with_long_top(2).n_triangles();
  for (const double along : {8.0, 20.0, 60.0}) {
    const SurfaceMesh mesh = box_with_long_top(along);
    const QualityReport q = measure_quality(mesh, edges_of(mesh));
    EXPECT_LT(q.model.max_angle_deg, 150) << along;
    EXPECT_LT(q.jump_max, 2.5) << along;
    EXPECT_LT(mesh.n_triangles(), n_plain) << "lengths along are left";
  }
}

TEST(StretchEasing, keeps_lengths_along_where_nothing_speaks_against_them) {
  EXPECT_LT(box_with_long_top(3).n_triangles(), box_with_long_top(2).n_triangles());
}

}  // namespace
}  // namespace st
