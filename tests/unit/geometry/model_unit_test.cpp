#include "geometry/import/model_unit.h"

#include <gtest/gtest.h>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(ModelUnit, is_the_one_asked_for_or_that_of_the_file) {
  EXPECT_EQ(choose_unit(25.4, "").name, "in");
  EXPECT_EQ(choose_unit(1000, "MM").name, "mm");
  EXPECT_DOUBLE_EQ(choose_unit(1000, "mm").shape_units, 1);
  EXPECT_DOUBLE_EQ(choose_unit(1000, "m").shape_units, 1000);
  EXPECT_EQ(choose_unit(std::nullopt, "").name, "");
}

TEST(ModelUnit, of_a_file_without_one_leaves_its_numbers) {
  const ModelUnit unit = choose_unit(std::nullopt, "ft");
  EXPECT_DOUBLE_EQ(unit.shape_units, 1);
  EXPECT_DOUBLE_EQ(unit.in_m.value(), 0.3048);
  EXPECT_ERROR(choose_unit(std::nullopt, "parsec"), kUsage, "parsec");
}

}  // namespace
}  // namespace st
