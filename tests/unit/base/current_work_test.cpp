#include "base/current_work.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace st {
namespace {

std::string current() {
  char text[32];
  return describe_current_work(text, sizeof text) ? text : "nothing";
}

TEST(CurrentWork, is_the_innermost_one_of_this_thread) {
  EXPECT_EQ(current(), "nothing");
  const CurrentWork face("face", 12);
  {
    const CurrentWork edge("edge", 1047);
    EXPECT_EQ(current(), "edge 1047");
    std::thread([] { EXPECT_EQ(current(), "nothing"); }).join();
  }
  EXPECT_EQ(current(), "face 12");
}

TEST(CurrentWork, fits_into_the_text_that_is_given) {
  const CurrentWork face("face", 120);
  char text[8];
  EXPECT_TRUE(describe_current_work(text, sizeof text));
  EXPECT_STREQ(text, "face 12");
  EXPECT_TRUE(describe_current_work(text, 4));
  EXPECT_STREQ(text, "fac");
}

}  // namespace
}  // namespace st
