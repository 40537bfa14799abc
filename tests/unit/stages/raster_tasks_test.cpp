// What narrow parts of faces ask for in a whole model.
#include "stages/raster_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "io/hdf5/sizing_artifact.h"
#include "support/staged.h"

namespace st {
namespace {

class NarrowParts : public testing::Test {
 protected:
  /// The smallest length of the samples.
  double least_of(const std::string& shape) {
    staged_.make_raster(shape);
    double least = 1e300;
    for (const LengthSample& s : read_raster(staged_.raster.output).samples) least = std::min<double>(least, s.length);
    return least;
  }

  test::StagedModel staged_;
};

TEST_F(NarrowParts, between_window_and_edge_ask_for_twice_their_width) {
  staged_.raster.lmax = "1";
  EXPECT_NEAR(least_of("framed_plate"), 0.2, 1e-5);
}

TEST_F(NarrowParts, that_a_rule_gives_lengths_to_ask_for_none) {
  staged_.raster.lmax = "1";
  staged_.raster.sizes = staged_.dir / "sizes.toml";
  std::ofstream(staged_.raster.sizes) << "[[size]]\nedges = [\"1-24\"]\nlmax = 0.9\n";
  EXPECT_NEAR(least_of("framed_plate"), 0.9, 1e-5);
}

TEST_F(NarrowParts, in_corners_ask_for_none) {
  staged_.raster.lmax = "1";
  EXPECT_NEAR(least_of("spiked_plate"), 1, 1e-5);
}

}  // namespace
}  // namespace st
