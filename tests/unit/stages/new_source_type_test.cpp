// A type of source that no tool knows: a class with the two methods of the paper, and an entry of the table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "io/hdf5/sizing_artifact.h"
#include "sizing/source_types.h"
#include "support/staged.h"

namespace st {
namespace {

/// Asks for its length on a circle.
class RingSource final : public SizeSource {
 public:
  RingSource(const SourceSpec& spec, double slope) : SizeSource(slope), spec_(spec) {}
  double min_size() const override { return spec_.spacing[0].length; }
  double size(Vec3 x, int&) const override {
    const Vec3 d = x - spec_.point[0], axis = normalized(spec_.half_axis[0]);
    const double height = dot(d, axis), away = norm(d - height * axis) - spec_.extent;
    return grown_length(spec_.spacing[0], slope(), std::hypot(height, away));
  }

 private:
  SourceSpec spec_;
};

const SourceType kRing{
    static_cast<SourceKind>(100),
    "ring",
    {{"at", SourceKey::kFirstPoint}, {"axis", SourceKey::kDirection}, {"extent", SourceKey::kExtent}},
    [](const SourceSpec& spec, double slope) -> std::unique_ptr<SizeSource> {
      return std::make_unique<RingSource>(spec, slope);
    }};

TEST(NewSourceType, is_read_stored_and_asked_once_it_is_in_the_table) {
  test::StagedModel staged;
  staged.prolong.sources = {staged.dir / "ring.toml"};
  std::ofstream(staged.prolong.sources[0])
      << "[[source]]\nname = \"groove\"\ntype = \"ring\"\nat = [1, 2, 3]\naxis = [0, 0, 1]\nextent = 0.5\n"
         "length = 0.01\n";
  staged.make_raster("box");
  EXPECT_THROW(staged.make_sizing(), Error);
  source_types().push_back(kRing);
  const nlohmann::json summary = staged.make_sizing();
  EXPECT_EQ(summary["sources"], 1);
  EXPECT_EQ(summary["lmin"], 0.01);
  const MappedSizing sizing = map_sizing(staged.prolong.output);
  const SizeField& field = *sizing.field;
  for (const double angle : {0.0, 1.0, 2.0}) {
    const Vec3 on_ring = Vec3{1, 2, 3} + 0.5 * Vec3{std::cos(angle), std::sin(angle), 0};
    EXPECT_NEAR(field.size(on_ring), 0.01, 1e-12);
    EXPECT_NEAR(field.size(on_ring + Vec3{0, 0, 0.05}), 0.01 + 0.05 * sizing.field->slope(), 1e-12);
  }
  EXPECT_EQ(read_cause_names(staged.prolong.output).source, (std::vector<std::string>{"groove"}));
  source_types().pop_back();
  EXPECT_THROW(read_sizing(staged.prolong.output), Error) << "of a type that is gone";
}

}  // namespace
}  // namespace st
