#include "meshing/face/failure_cause.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace st {
namespace {

TEST(FailureCause, each_has_its_own_text_and_a_remedy) {
  std::set<std::string> texts;
  constexpr int kLast = static_cast<int>(FailureCause::kUnusedBoundary);
  for (int i = 1; i <= kLast; ++i) {
    const auto cause = static_cast<FailureCause>(i);
    EXPECT_STRNE(text_of(cause), "");
    EXPECT_STRNE(remedy_of(cause), "");
    texts.insert(text_of(cause));
  }
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(kLast));
  EXPECT_STREQ(text_of(FailureCause::kNone), "");
}

TEST(FailureCause, crossing_loops_are_repaired_in_the_cad_and_narrow_parts_need_smaller_sizes) {
  EXPECT_NE(std::string(remedy_of(FailureCause::kCrossingLoops)).find("CAD system"), std::string::npos);
  EXPECT_NE(std::string(remedy_of(FailureCause::kNarrowPart)).find("smaller sizes"), std::string::npos);
}

}  // namespace
}  // namespace st
