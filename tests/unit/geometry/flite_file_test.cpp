// Reading and writing of FLITE text.
#include "geometry/flite/flite_file.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "unit/geometry/flite_models.h"

namespace st {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

/// The message for a text that must be refused.
std::string refusal(const std::string& text) {
  const TemporaryDirectory dir;
  try {
    read_flite(test::write_text(dir, text));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kInput);
    return e.what();
  }
  return "";
}

void expect_refused(const std::string& text, const std::string& why) {
  const std::string message = refusal(text);
  EXPECT_NE(message.find(why), std::string::npos) << "message: " << message << "\nexpected: " << why;
}

constexpr const char* kTriangle =
    "title 5 7\n 3 1\nCurves\n 1 1\n 2\n 0 0 0 99\n +1.0D+00 0.0 0.0\n 2 1\n 2\n 1 0 0\n 0 1+0 0\n 4 1\n 2\n 0 1 0\n 0 "
    "0 0\n"
    "Surfaces  \n 1 1\n 2 2\n -2 -2 0\n 2 -2 0\n -2 2 0\n 2 2 0\nMesh Generation\n 3 1 0 0\nSegments\n 1 1 1\n 2 2 1\n "
    "3 4 1\n"
    "Surfaces\n 9 1 1 1\n 3\n 3\n -1 2\n\n";

TEST(FliteFile, survives_writing_and_reading_without_loss) {
  FliteFile file = test::box_file();
  file.curves[3].points[1] = {1.0 / 3, 2e-17, -1.23456789012345e8};
  const TemporaryDirectory dir;
  const FliteFile again = read_flite(test::write_text(dir, flite_text(file)));
  EXPECT_EQ(flite_text(again), flite_text(file));
  EXPECT_LE(distance(again.curves[3].points[1], file.curves[3].points[1]), 1e-7);
  EXPECT_EQ(again.regions[4].segments, file.regions[4].segments);
  EXPECT_EQ(again.surfaces[2].n_second, 4);
}

TEST(FliteFile, reads_fortran_numbers_wrapped_lists_signs_and_extra_columns) {
  const TemporaryDirectory dir;
  const FliteFile file = read_flite(test::write_text(dir, kTriangle));
  EXPECT_EQ(file.curves[0].points[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(file.curves[1].points[1], (Vec3{0, 1, 0}));
  EXPECT_EQ(file.curves[2].id, 4);
  EXPECT_EQ(file.regions[0].id, 9);
  EXPECT_EQ(file.regions[0].segments, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(file.regions[0].line, 30);
}

TEST(FliteFile, is_recognised_by_content) {
  const std::string text = flite_text(test::box_file());
  EXPECT_TRUE(is_flite(text));
  EXPECT_TRUE(is_flite(text.substr(0, 100)));
  EXPECT_TRUE(is_flite(kTriangle));
  EXPECT_FALSE(is_flite("solid x\n facet normal 0 0 1\n outer loop\n"));
  EXPECT_FALSE(is_flite("1 2 3\n4 5 6\n7 8 9\n"));
  EXPECT_FALSE(is_flite("ISO-10303-21;\nHEADER;\nFILE\n"));
  EXPECT_FALSE(is_flite(std::string("Geometry\n 1 1\nCurves\n\0", 23)));
  EXPECT_FALSE(is_flite(""));
}

TEST(FliteFile, refuses_what_is_damaged_with_its_line) {
  const std::string good = kTriangle;
  EXPECT_EQ(refusal(good), "");
  expect_refused(replaced(good, "3 1\nCurves", "3 x\nCurves"), "line 2: '3 x' where curves and surfaces should be");
  expect_refused(replaced(good, "3 1\nCurves", "0 1\nCurves"), "0 curves and surfaces should be positive");
  expect_refused(replaced(good, "3 1\nCurves", "2000000000 1\nCurves"), "cut off or damaged");
  expect_refused(replaced(good, " 2\n 0 0 0 99", " 1\n 0 0 0 99"),
                 "line 5: curve 1 of 3: 1 points; a curve has at least 2");
  expect_refused(replaced(good, "0 0 0 99", "0 zero 0 99"),
                 "line 6: curve 1 of 3: '0 zero 0 99' where the coordinates x y z should be");
  expect_refused(replaced(good, "0 0 0 99", "0 nan 0 99"), "where the coordinates");
  expect_refused(replaced(good, "0 0 0 99", "0 1e300 0 99"), "where the coordinates");
  expect_refused(replaced(good, " 4 1\n", " 2 1\n"), "curve 3 of 3: the number 2 comes twice");
  expect_refused(replaced(good, " 2 2\n -2", " 2 99\n -2"), "198 points announced");
  expect_refused(replaced(good, " 2 2\n -2", " 1 4\n -2"), "a grid of 1 x 4 points");
  expect_refused(replaced(good, "3 4 1\n", "3 3 1\n"), "segment 3 of 3: there is no curve 3");
  expect_refused(replaced(good, "9 1 1 1", "9 5 1 1"), "region 1 of 1: there is no surface 5");
  expect_refused(replaced(good, " -1 2\n", " -1 8\n"), "line 33: region 1 of 1: there is no segment 8");
  expect_refused(replaced(good, " 3\n 3\n -1", " 4\n 3\n -1"), "cut off");
  expect_refused(replaced(good, " 3\n 3\n -1", " 44\n 3\n -1"), "44 boundary segments of 3 in the file");
}

TEST(FliteFile, refuses_every_beginning_of_itself) {
  const std::string good = flite_text(test::box_file(2, 2));
  for (std::size_t n = 1; n + 2 < good.size(); n += 97) EXPECT_FALSE(refusal(good.substr(0, n)).empty()) << n;
}

}  // namespace
}  // namespace st
