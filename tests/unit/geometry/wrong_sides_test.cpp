// Faces of which the reader takes what is on the other side of their loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

constexpr const char* kOtherSide = "face on the wrong side of its loop";

/// As BREP, and as STEP.
void expect_the_same(const std::string& shape, std::size_t n_mended) {
  const TemporaryDirectory dir;
  test::write_brep(shape, dir / "a.brep");
  test::write_step(shape, dir / "a.step", "MM");
  const ImportResult sound = import_model(dir / "a.brep", {}), r = import_model(dir / "a.step", {});
  EXPECT_EQ(test::findings_of(r, kOtherSide).size(), n_mended) << shape;
  EXPECT_TRUE(r.is_closed) << shape;
  EXPECT_EQ(r.tables.n_faces(), sound.tables.n_faces()) << shape;
  EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area) << shape;
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume) << shape;
}

TEST(WrongSides, balls_with_a_hole_at_their_seam_stay_balls) {
  expect_the_same("ball_with_stem", 1);
  expect_the_same("two_balls", 1);
  expect_the_same("ball_with_socket", 1);  // its caps alone do not tell which is turned, the seam in the file does
}

TEST(WrongSides, round_corners_are_not_folded_back_into_their_pipe) { expect_the_same("bent_pipe", 1); }

/// The text of a STEP file, its first loop without edges that it passes twice.
std::string without_seam(std::string text) {
  std::smatch list, use;
  const std::string before = text;
  if (!std::regex_search(before, list, std::regex(R"(EDGE_LOOP\('',\(([#0-9,]*)\)\))"))) return text;
  std::map<std::string, std::string> edge_of;  // by the number of its use
  const std::string uses = list[1].str();
  const std::regex number("#[0-9]+");
  for (std::sregex_iterator i(uses.begin(), uses.end(), number), end; i != end; ++i)
    if (std::regex_search(before, use, std::regex("\n" + i->str() + R"( = ORIENTED_EDGE\('',\*,\*,(#[0-9]+),)")))
      edge_of[i->str()] = use[1].str();
  std::string kept;
  for (const auto& [use_number, edge] : edge_of) {
    const auto is_same = [&, e = edge](const auto& other) { return other.second == e; };
    if (std::count_if(edge_of.begin(), edge_of.end(), is_same) == 1) kept += (kept.empty() ? "" : ",") + use_number;
  }
  return text.replace(static_cast<std::size_t>(list.position(1)), uses.size(), kept);
}

TEST(WrongSides, of_files_without_seams_are_told_by_the_other_faces) {
  const TemporaryDirectory dir;
  test::write_step("ball_with_stem", dir / "a.step", "MM");
  std::ifstream file(dir / "a.step");
  const std::string text{std::istreambuf_iterator<char>(file), {}}, changed = without_seam(text);
  ASSERT_LT(changed.size() + 10, text.size());
  std::ofstream(dir / "b.step") << changed;
  const ImportResult sound = import_model(dir / "a.step", {}), r = import_model(dir / "b.step", {});
  EXPECT_EQ(test::findings_of(r, kOtherSide).size(), 1u);
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume);
}

}  // namespace
}  // namespace st
