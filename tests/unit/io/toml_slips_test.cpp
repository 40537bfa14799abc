#include "io/toml/toml_slips.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(TomlSlips, lengths_without_quotes_are_known) {
  for (const char* line : {"lmax = 2%", "lmax=5mm", "lmin = 0.3%chord  # of the wing", "chord = 1e-3 m\r"})
    EXPECT_EQ(say_toml_slip(std::string("a = 1\n") + line + "\nb = 2\n", 2),
              "; a length with a unit stands in quotes, such as \"2%\" or \"5mm\"")
        << line;
}

TEST(TomlSlips, nothing_is_said_of_other_lines) {
  for (const char* line : {"", "=", "lmax =", "lmax = ", "lmax = 2", "lmax = 2 ", "lmax = 2 # mm", "lmax = \"2%", "2%"})
    EXPECT_EQ(say_toml_slip(line, 1), "") << line;
  EXPECT_EQ(say_toml_slip("lmax = 2%", 0), "");
  EXPECT_EQ(say_toml_slip("lmax = 2", 9), "");
}

}  // namespace
}  // namespace st
