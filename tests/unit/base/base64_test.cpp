#include "base/base64.h"

#include <gtest/gtest.h>

#include <string_view>

namespace st {

static std::string of(std::string_view text) { return base64(std::as_bytes(std::span(text))); }

TEST(Base64, has_the_examples_of_its_standard) {
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Base64, takes_bytes_beyond_ascii) { EXPECT_EQ(of("\xff\xfe"), "//4="); }

}  // namespace st
