#include "stages/orientation_warnings.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/log.h"

namespace st {
namespace {

TEST(OrientationWarnings, list_the_first_faces_by_their_numbers) {
  EXPECT_EQ(list_faces({}), "");
  EXPECT_EQ(list_faces(std::vector<FaceId>{2, 16}), "3, 17");
  EXPECT_EQ(list_faces(std::vector<FaceId>{0, 1, 2, 3, 4}), "1, 2, 3, 4, 5");
  EXPECT_EQ(list_faces(std::vector<FaceId>{0, 1, 2, 3, 4, 7, 9}), "1, 2, 3, 4, 5 and 2 more");
}

TEST(OrientationWarnings, say_what_was_turned_and_what_cannot_be) {
  const auto said = [](const OrientationReport& report) {
    set_verbosity(Verbosity::kNormal);
    testing::internal::CaptureStderr();
    warn_of_changes(report);
    set_verbosity(Verbosity::kQuiet);  // as other tests of stages want it
    return testing::internal::GetCapturedStderr();
  };
  OrientationReport report;
  EXPECT_EQ(said(report), "");
  report.turned_faces = {4};
  report.turned_components = 1;
  report.inside_out_faces = {0, 1};
  report.n_one_sided = 2;
  EXPECT_EQ(said(report),
            "warning: 1 face was turned to agree with its neighbours: 5\n"
            "warning: 1 part was inside out and is turned: faces 1, 2\n"
            "warning: 2 parts are one-sided (like a Moebius strip) and cannot be oriented\n");
}

}  // namespace
}  // namespace st
