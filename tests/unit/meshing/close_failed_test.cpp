#include "meshing/engine/close_failed.h"

#include <gtest/gtest.h>

#include "base/threads.h"
#include "unit/meshing/put_faces.h"

namespace st {
namespace {

/// A box put together again, two of its faces failed.
struct Holes : test::PutFaces {
  static constexpr FaceId kOne = 1, kOther = 4;
  const UniformField field{4};
  const Refinements refinements{field};
  std::map<FaceId, std::string> left_out;

  Holes() : PutFaces("box", 4) {
    FaceOutcome failed;
    failed.cause = FailureCause::kShortLoops;
    for (const FaceId f : {kOne, kOther}) faces.set(f, FacePlace(), failed);
  }
  void close() {
    close_failed({meshed.model, field, refinements, left_out, [](FaceId) { return WorkLimit(); }}, faces);
  }
};

TEST(CloseFailed, closes_faces_as_they_were_by_their_loops) {
  Holes holes;
  ASSERT_TRUE(holes.faces.has_holes());
  holes.close();
  EXPECT_FALSE(holes.faces.has_holes());
  for (const FaceId f : {Holes::kOne, Holes::kOther}) {
    EXPECT_TRUE(holes.faces.outcome(f).is_closed);
    EXPECT_TRUE(holes.faces.outcome(f).is_near);
    EXPECT_GT(n_triangles_of(holes.faces.place(f)), 0);
  }
}

TEST(CloseFailed, is_the_same_on_more_threads) {
  Holes one, four;
  one.close();
  set_thread_count(4);
  four.close();
  set_thread_count(1);
  for (const FaceId f : {Holes::kOne, Holes::kOther})
    EXPECT_EQ(packed(one.faces.bring({f}).at(f)), packed(four.faces.bring({f}).at(f)));
}

TEST(CloseFailed, leaves_holes_where_faces_are_left_out) {
  Holes holes;
  holes.left_out[Holes::kOther] = "meshing it ended an earlier run";
  holes.close();
  EXPECT_TRUE(holes.faces.outcome(Holes::kOne).is_closed);
  EXPECT_TRUE(holes.faces.outcome(Holes::kOther).is_hole());
}

}  // namespace
}  // namespace st
