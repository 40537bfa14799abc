// The table of source types.
#include "sizing/source_types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace st {
namespace {

TEST(SourceTypes, have_names_and_numbers_of_their_own) {
  std::set<std::string> names;
  std::set<SourceKind> kinds;
  for (const SourceType& type : source_types()) {
    names.insert(type.name);
    kinds.insert(type.kind);
    EXPECT_EQ(find_source_type(type.kind), &type);
    EXPECT_EQ(find_source_type(std::string(type.name)), &type);
    EXPECT_TRUE(type.n_spacings >= 1 && type.n_spacings <= 3);
  }
  EXPECT_EQ(names.size(), source_types().size());
  EXPECT_EQ(kinds.size(), source_types().size());
  EXPECT_EQ(find_source_type("ring"), nullptr);
  EXPECT_EQ(find_source_type(static_cast<SourceKind>(99)), nullptr);
  EXPECT_EQ(source_type_names(), "point, line, triangle, box, cylinder, sphere or disc");
}

TEST(SourceTypes, make_a_source_of_their_lengths) {
  for (const SourceType& type : source_types()) {
    SourceSpec spec;
    spec.kind = type.kind;
    spec.point = {{{0, 0, 0}, {1, 2, 3}, {1, 0, 0}}};
    spec.half_axis = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    spec.extent = 0.1;
    spec.spacing = {{{0.03, 0, 0}, {0.02, 0, 0}, {0.01, 0, 0}}};
    EXPECT_EQ(type.make(spec, 0.2)->min_size(), spec.spacing[static_cast<std::size_t>(type.n_spacings) - 1].length);
    EXPECT_EQ(type.make(spec, 0.2)->slope(), 0.2);
  }
}

TEST(SourceTypes, say_what_is_wrong_and_complete_the_rest) {
  SourceSpec box;
  box.kind = SourceKind::kBox;
  box.point = {{{1, 2, 3}, {3, 6, 9}, {}}};
  ASSERT_EQ(find_source_type(box.kind)->complete(box), "");
  EXPECT_EQ(box.point[0], (Vec3{2, 4, 6}));
  EXPECT_EQ(box.half_axis[1], (Vec3{0, 2, 0}));
  box.point = {{{1, 2, 3}, {3, 2, 9}, {}}};
  EXPECT_NE(find_source_type(box.kind)->complete(box).find("lo must be below hi"), std::string::npos);
}

}  // namespace
}  // namespace st
