#include "geometry/import/file_numbers.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "base/threads.h"
#include "geometry/import/cad_reader.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

void require(const std::string& text, const std::string& format) {
  const TemporaryDirectory dir;
  std::ofstream(dir / "a.cad") << text;
  occt::require_sound_numbers(dir / "a.cad", format);
}

/// A line of parameters, as IGES has it.
std::string parameters(std::string text, char section = 'P') {
  text.resize(72, ' ');
  return text + section + "      1\n";
}

TEST(FileNumbers, refuses_what_no_reader_ends_on) {
  EXPECT_ERROR(require("#1=X();\n#2=CARTESIAN_POINT('',(0.,NAN,1.));", "STEP"), kGeometry,
               "line 2 has the number NAN;");
  for (const char* number :
       {"1.E300", "-1.E+300", "1e400", "1.E9999999999", "inf", "-Infinity", "nan", "-NaN", "1.#INF"})
    EXPECT_ERROR(require("#2=CIRCLE('',#1," + std::string(number) + ");", "STEP"), kGeometry, number);
  EXPECT_ERROR(require("2 0 0 1 0 -0 1 -nan\n", "BREP"), kGeometry, "-nan");
  EXPECT_ERROR(require("Ve\n1e-7\n0 1e300 0\n", "BREP"), kGeometry, "line 3 has the number 1e300;");
  EXPECT_ERROR(require(parameters("116,0.,1.D300,0.;"), "IGES"), kGeometry, "1.D300");
  EXPECT_ERROR(require(parameters("116,0.,NAN,0.;"), "IGES"), kGeometry, "NAN");
}

TEST(FileNumbers, takes_small_numbers_infinity_of_opencascade_and_names) {
  EXPECT_NO_THROW(
      require("#2=CIRCLE('1.E300 , NAN ,',#300,1.E-300);#3=LINE('',1.E+003,2.E+100,-2.E100,1.E-9999999999);", "STEP"));
  EXPECT_NO_THROW(require("#2=X('it''s , NAN ,',(1.,2.),$,*,.INF.,LENGTH_MEASURE(1.79769313486232E+308));", "STEP"));
  EXPECT_NO_THROW(require("1 2e+100 -2e+100 1e-310 Infos in nanometre\n", "BREP"));
  EXPECT_NO_THROW(require(parameters("406,1,9HNAN 1E300,1.D+02;") + parameters("inf ,NAN,1E300,", 'S'), "IGES"));
  EXPECT_NO_THROW(require("\nOpen CASCADE Topology V3\n nan ", "BREP"));
  EXPECT_NO_THROW(require("", "STEP"));
}

TEST(FileNumbers, tells_the_first_line_of_a_long_file_whoever_scans_it) {
  std::string text;
  for (int line = 1; line <= 90'000; ++line)
    text += line == 50'000 || line == 80'000 ? "0 " + std::to_string(line) + "e300\n" : "0.125 17 3.5e-3\n";
  for (const int n_threads : {1, 3}) {
    set_thread_count(n_threads);
    EXPECT_ERROR(require(text, "BREP"), kGeometry, "line 50000 has the number 50000e300;");
  }
  set_thread_count(1);
  text.erase(text.find("50000e300"), 9);
  EXPECT_ERROR(require(text, "BREP"), kGeometry, "line 80000 has the number 80000e300;");
  const std::string up_to_a_piece((1 << 18) - 3, ' ');
  EXPECT_ERROR(require(up_to_a_piece + "1e300 2\n3\n", "BREP"), kGeometry, "line 1 has the number 1e300;");
  EXPECT_NO_THROW(require(std::string(1'000'000, '7'), "BREP"));
}

TEST(FileNumbers, refuses_exponents_that_step_does_not_have) {
  for (const char* number : {"1.5e-05", "-1e5", "2E3", "+.5e+1"})
    EXPECT_ERROR(require("#2=CARTESIAN_POINT('',(0.," + std::string(number) + ",1.));", "STEP"), kGeometry,
                 std::string("the number ") + number + ", which OpenCASCADE reads wrong");
  EXPECT_NO_THROW(require("#2=CARTESIAN_POINT('1e5',(0.,1.5E-05,-.5E+1)); #3=X(.E.,3,'2E3',\"1E3\");", "STEP"));
  EXPECT_NO_THROW(require("2 0 0 1.5e-05 2E3\n", "BREP"));
  EXPECT_NO_THROW(require(parameters("116,0.,1e5,2E3;"), "IGES"));
}

TEST(FileNumbers, stop_the_reading_of_a_file) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "box.step", "MM");
  std::stringstream text;
  text << std::ifstream(dir / "box.step").rdbuf();
  const std::string was = text.str(), vector = "VECTOR('',";
  const std::size_t at = was.find("1.)", was.find(vector));
  std::ofstream(dir / "bad.step") << was.substr(0, at) + "1.E400" + was.substr(at + 2);
  EXPECT_ERROR(occt::read_cad(dir / "bad.step"), kGeometry, "has the number 1.E400;");
}

}  // namespace
}  // namespace st
