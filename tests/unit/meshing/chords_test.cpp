#include "meshing/engine/chords.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/meshed.h"

namespace st {
namespace {

using test::Meshed;

TEST(Chords, repeat_where_two_flat_faces_lie_on_each_other) {
  const Meshed m("box", 200);  // every face two triangles: a chord of its own
  for (const FacePatch& p : m.result.patches) ASSERT_EQ(p.triangles.size(), 2u);
  std::vector<FacePatch> all = m.result.patches;
  const std::vector<char> fresh(6, 1), old(6, 0);
  const BoundaryNumbering numbering = m.numbering();
  const BoundarySegments segments(numbering);
  const auto pairs = [&](const std::vector<char>& is_fresh) {
    std::vector<Chord> chords;
    for (const FacePatch& p : all)
      for (const Chord& c : find_chords(segments, p)) chords.push_back(c);
    return find_repeated_chords(chords, is_fresh).size();
  };
  EXPECT_EQ(pairs(fresh), 0u);
  const FaceId last = all[5].face;
  all[5] = all[0];
  all[5].face = last;
  EXPECT_EQ(pairs(fresh), 1u) << "the chord, not the edges of the model";
  EXPECT_EQ(pairs(old), 0u);
}

TEST(Chords, are_no_segments_of_edges) {
  const Meshed m("box", 8);
  const BoundaryNumbering numbering = m.numbering();
  const BoundarySegments segments(numbering);
  for (const FacePatch& p : m.result.patches)
    for (const Chord& c : find_chords(segments, p)) {
      EXPECT_LT(c.a, c.b);
      EXPECT_FALSE(segments.contain(c.a, c.b));
      EXPECT_EQ(c.facet.face, p.face);
    }
}

}  // namespace
}  // namespace st
