// What --layers asks for, and its lines of the report.
#include "stages/layers_check.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "mesh/layers.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

TEST(LayersRequest, is_a_height_or_a_reynolds_number_with_its_length) {
  const LengthReference metres{10, 1.0};
  EXPECT_DOUBLE_EQ(parse_layers("5mm").height(metres), 0.005);
  EXPECT_FALSE(parse_layers("5mm").growth);
  EXPECT_DOUBLE_EQ(*parse_layers("1%,1.2").growth, 1.2);
  EXPECT_DOUBLE_EQ(parse_layers("1%,1.2").height(metres), 0.1);
  const LayersRequest plate = parse_layers("Re=6e6@2.5m,1.15");
  EXPECT_DOUBLE_EQ(plate.height(metres), boundary_layer_thickness(6e6, 2.5));
  EXPECT_DOUBLE_EQ(*plate.growth, 1.15);
}

TEST(LayersRequest, is_refused_where_it_says_nothing) {
  for (const char* text : {"", "thick", "5mm,1", "5mm,x", "5mm,", "Re=6e6", "Re=-1@2m", "Re=x@2m", "-5mm", "5mm,1.2,3"})
    EXPECT_THROW(parse_layers(text), Error) << text;
}

TEST(LayersChecks, tell_walls_from_planes_and_far_fields) {
  SurfaceMesh mesh = shapes::cube(4);
  const auto nodes = [&](const char* role) {
    mesh.labels.group_role = {role};
    const std::vector<Check> checks = layers_checks(mesh, false, std::nullopt, parse_layers("1%,1.2"));
    EXPECT_EQ(checks.size(), 4u);
    return checks[0].note;
  };
  EXPECT_NE(nodes("wall").find("on 98 nodes"), std::string::npos) << nodes("wall");
  EXPECT_NE(nodes("wall").find("0.01732 high"), std::string::npos) << "1 % of the walls' diagonal";
  EXPECT_NE(nodes("farfield").find("on 0 nodes"), std::string::npos) << nodes("farfield");
  EXPECT_THROW(layers_checks(mesh, false, std::nullopt, parse_layers("5mm")), Error) << "the mesh has no unit";
}

TEST(LayersChecks, count_where_layers_do_not_fit) {
  const std::vector<Check> checks = layers_checks(shapes::cube(4), true, std::nullopt, parse_layers("0.8"));
  EXPECT_EQ(checks[3].name, "layer-room");
  EXPECT_GE(checks[3].defects.count, 6 * 9);
  EXPECT_FALSE(checks[3].fails()) << "they may be thinner there";
}

}  // namespace
}  // namespace st
