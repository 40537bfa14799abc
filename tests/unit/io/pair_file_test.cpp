#include "io/toml/pair_file.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "io/file/text_file.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class PairFiles : public testing::Test {
 protected:
  std::vector<PairSpec> read(const std::string& text) const {
    write_text_file(dir_ / "pairs.toml", text);
    return read_pair_file(dir_ / "pairs.toml");
  }
  std::string refusal(const std::string& keys) const {
    try {
      read("[[pair]]\n" + keys + "\n");
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      return e.what();
    }
    return "";
  }
  TemporaryDirectory dir_;
};

TEST_F(PairFiles, have_translations_and_rotations_about_a_point) {
  const auto pairs = read(
      "threads = 2\n[[pair]]\na = \"left\"\nb = \"right\"\ntranslate = [0, 0, 10]\n"
      "[[pair]]\na = \"s1\"\nb = \"s2\"\nrotate = \"x 90deg\"\nat = [0, 1, 0]\n");
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].a, "left");
  EXPECT_EQ(pairs[0].motion({1, 2, 3}).z, 13);
  EXPECT_LT(distance(pairs[1].motion({5, 2, 0}), {5, 1, 1}), 1e-15);
}

TEST_F(PairFiles, are_refused_with_file_line_and_key) {
  EXPECT_NE(refusal("a = \"x\"\nb = \"y\"").find("pairs.toml:1"), std::string::npos);
  EXPECT_NE(refusal("a = \"x\"\ntranslate = [1, 2, 3]").find("needs a and b"), std::string::npos);
  EXPECT_NE(refusal("a = \"x\"\nb = \"y\"\nrotate = \"x 20\"").find("rotate: an axis"), std::string::npos);
  EXPECT_NE(refusal("a = \"x\"\nb = \"y\"\nrotate = \"q 20deg\"").find("rotate: an axis"), std::string::npos);
  EXPECT_NE(refusal("a = \"x\"\nb = \"y\"\nat = [0, 0, 0]\ntranslate = [1, 2, 3]").find("at: "), std::string::npos);
  EXPECT_NE(refusal("a = \"x\"\nb = \"y\"\nrotat = \"x 20deg\"").find("did you mean"), std::string::npos);
  EXPECT_NE(refusal("a = \"x\"\nb = \"y\"\ntranslate = [1, 2]").find("[x, y, z]"), std::string::npos);
  EXPECT_THROW(read("threads = 2\n"), Error) << "no pair";
}

}  // namespace
}  // namespace st
