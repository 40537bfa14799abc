#include "base/required_unit.h"

#include <gtest/gtest.h>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(RequiredUnit, is_known_before_all_that_lengths_refer_to) {
  EXPECT_ERROR(require_unit(parse_length("4mm", "--lmin"), std::nullopt, "--lmin"), kUsage, "--unit");
  EXPECT_NO_THROW(require_unit(parse_length("4mm", "--lmin"), 0.001, "--lmin"));
  for (const char* text : {"4", "4%", "4%chord"})
    EXPECT_NO_THROW(require_unit(parse_length(text, "--lmin"), std::nullopt, "--lmin")) << text;
}

}  // namespace
}  // namespace st
