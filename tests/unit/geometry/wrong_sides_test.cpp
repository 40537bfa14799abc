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

TEST(WrongSides, balls_with_a_hole_at_their_seam_stay_balls) {  // their seams are mended before the healing
  expect_the_same("ball_with_stem", 0);
  expect_the_same("two_balls", 0);
  expect_the_same("ball_with_socket", 0);
}

TEST(WrongSides, round_corners_are_not_folded_back_into_their_pipe) { expect_the_same("bent_pipe", 1); }

TEST(WrongSides, thin_lenses_are_no_balls) {
  for (const char* shape : {"flat_lens", "long_lens", "dimpled_cylinder"}) expect_the_same(shape, 0);
}

/// The text of a STEP file, its first loops without edges that they pass twice.
std::string without_seams(const std::string& text, int n_loops) {
  std::string changed;
  const std::regex loop(R"(EDGE_LOOP\('',\(([#0-9,\s]*)\)\))"), number("#[0-9]+");
  auto from = text.begin();
  for (std::sregex_iterator i(text.begin(), text.end(), loop), end; i != end && n_loops > 0; ++i, --n_loops) {
    std::map<std::string, std::string> edge_of;  // by the number of its use
    const std::string uses = (*i)[1].str();
    std::smatch use;
    for (std::sregex_iterator k(uses.begin(), uses.end(), number); k != end; ++k)
      if (std::regex_search(text, use, std::regex("\n" + k->str() + R"( = ORIENTED_EDGE\('',\*,\*,(#[0-9]+),)")))
        edge_of[k->str()] = use[1].str();
    changed.append(from, (*i)[1].first);
    for (const char* comma = ""; const auto& [use_number, edge] : edge_of) {
      const auto is_same = [&, e = edge](const auto& other) { return other.second == e; };
      if (std::count_if(edge_of.begin(), edge_of.end(), is_same) > 1) continue;
      changed += comma + use_number;
      comma = ",";
    }
    from = (*i)[1].second;
  }
  return changed.append(from, text.end());
}

/// As a STEP file without seams in its first loops.
void expect_the_same_without_seams(const std::string& shape, int n_loops, std::size_t n_mended) {
  const TemporaryDirectory dir;
  test::write_brep(shape, dir / "a.brep");
  test::write_step(shape, dir / "a.step", "MM");
  std::ifstream file(dir / "a.step");
  const std::string text{std::istreambuf_iterator<char>(file), {}}, changed = without_seams(text, n_loops);
  ASSERT_LT(changed.size(), text.size());
  std::ofstream(dir / "b.step") << changed;
  const ImportResult sound = import_model(dir / "a.brep", {}), r = import_model(dir / "b.step", {});
  EXPECT_EQ(test::findings_of(r, kOtherSide).size(), n_mended) << shape;
  EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area) << shape;
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume) << shape;
}

TEST(WrongSides, of_files_without_seams_are_told_by_the_other_faces) {
  expect_the_same_without_seams("ball_with_stem", 1, 1);
  expect_the_same_without_seams("hollow_ball_with_stem", 1, 1);
}

TEST(WrongSides, of_files_without_seams_are_all_faces_where_none_lies_as_the_file_says) {
  expect_the_same_without_seams("ball_with_socket_at_seam", 2, 2);
  expect_the_same_without_seams("ring_with_dimple_at_seam", 2, 1);
}

TEST(WrongSides, of_files_without_seams_may_have_a_loop_through_one_pole) {
  expect_the_same_without_seams("ball_without_octant", 1, 1);
}

}  // namespace
}  // namespace st
