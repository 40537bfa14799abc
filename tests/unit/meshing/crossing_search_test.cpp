// Crossings of patches, searched for again after some of them changed.
#include "meshing/engine/crossing_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "meshing/engine/patch_store.h"
#include "support/meshed.h"
#include "support/patch_sections.h"

namespace st {
namespace {

using test::Meshed;

/// A search among patches of one rank.
struct Search {
  const Meshed& meshed;
  PatchStore store{test::one_rank};
  std::int64_t version = 0;
  std::vector<FacePlace> places;
  CrossingSearch search;

  explicit Search(const Meshed& m, bool across_bodies = true)
      : meshed(m), search(m.model, store, test::one_rank, across_bodies) {}
  std::vector<RefinementPoint> run(const std::vector<FacePatch>& patches) {
    ++version;
    places.clear();
    for (FacePatch p : patches)
      places.push_back(
          place_of(store.put({std::move(p)}, 0, version, meshed.result.edges, meshed.model.tables().vertex_xyz)));
    return run();
  }
  /// Each patch in two sections.
  std::vector<RefinementPoint> run_in_two(const std::vector<FacePatch>& patches) {
    ++version;
    places.clear();
    for (const FacePatch& p : patches) {
      std::vector<PatchPlace> two;
      for (FacePatch& s : test::in_two(p))
        two.push_back(store.put(std::move(s), static_cast<std::int32_t>(two.size()), version, meshed.result.edges,
                                meshed.model.tables().vertex_xyz));
      places.push_back(place_of(std::move(two)));
    }
    return run();
  }
  std::vector<RefinementPoint> run() {
    search.run(meshed.numbering(), places);
    return search.places_to_refine(meshed.numbering(), places);
  }
  int n_pairs() const { return search.n_pairs(); }
  void renew(FaceId f) { search.renew(f); }
};

/// Pushes the inside of a face of the box 60 x 40 x 20 through the other side.
void push_through(const Meshed& box, FaceId f, FacePatch& patch) {
  const Box3 all = box.model.tables().box();
  const Vec3 inward = 0.5 * (all.lo + all.hi) - box.model.tables().face_box[f].center();
  for (Vec3& x : patch.inner_xyz) x += 2.5 * inward;
}

TEST(CrossingSearch, finds_nothing_in_a_sound_mesh) {
  const Meshed m("box", 4);
  Search search(m);
  EXPECT_TRUE(search.run(m.result.patches).empty());
  EXPECT_EQ(search.n_pairs(), 0);
}

TEST(CrossingSearch, finds_a_patch_that_crosses_others_and_remembers_it) {
  const Meshed m("box", 8);
  std::vector<FacePatch> patches = m.result.patches;
  push_through(m, 0, patches[0]);
  Search search(m);
  const std::vector<RefinementPoint> places = search.run(patches);
  EXPECT_EQ(places.size(), 2u * static_cast<std::size_t>(search.n_pairs()));
  ASSERT_GT(search.n_pairs(), 0);
  const std::vector<RefinementPoint> again = search.run(patches);
  ASSERT_EQ(again.size(), places.size()) << "nothing is new, and nothing forgotten";
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_TRUE(again[i].x == places[i].x);
  patches[0] = m.result.patches[0];
  search.renew(0);
  EXPECT_TRUE(search.run(patches).empty());
}

TEST(CrossingSearch, finds_what_a_renewed_patch_crosses) {
  const Meshed m("box", 8);
  std::vector<FacePatch> patches = m.result.patches;
  Search search(m), whole(m);
  ASSERT_TRUE(search.run(patches).empty());
  push_through(m, 3, patches[3]);
  search.renew(3);
  EXPECT_EQ(search.run(patches).size(), whole.run(patches).size());
  EXPECT_GT(search.n_pairs(), 0);
}

TEST(CrossingSearch, measures_what_it_takes_to_part_bodies_and_leaves_those_in_contact) {
  MeshOptions options;
  options.parts_bodies = false;
  const Meshed pin("pin_in_bore", 2, options), boxes("two_boxes", 4, options);
  Search search(pin), within(pin, false), touching(boxes);
  const std::vector<RefinementPoint> places = search.run(pin.result.patches);
  ASSERT_GT(search.n_pairs(), 0);
  for (const RefinementPoint& p : places) {
    EXPECT_GT(p.factor, 0);
    EXPECT_LT(p.factor, 1);
    EXPECT_GT(p.radius, 0);
  }
  EXPECT_TRUE(within.run(pin.result.patches).empty());
  EXPECT_TRUE(touching.run(boxes.result.patches).empty());
  EXPECT_TRUE(touching.search.touching_faces().empty());
  const Meshed fitting("thin_pin_in_block", 3);
  Search contact(fitting);
  EXPECT_TRUE(contact.run(fitting.result.patches).empty());
  EXPECT_FALSE(contact.search.touching_faces().empty());
}

TEST(CrossingSearch, finds_in_sections_what_it_finds_in_whole_patches) {
  const Meshed m("box", 8);
  std::vector<FacePatch> patches = m.result.patches;
  Search sound(m);
  EXPECT_TRUE(sound.run_in_two(patches).empty()) << "sections of a face have common nodes";
  push_through(m, 0, patches[0]);
  Search whole(m), sections(m);
  const std::vector<RefinementPoint> places = whole.run(patches);
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(sections.run_in_two(patches).size(), places.size());
  EXPECT_EQ(sections.n_pairs(), whole.n_pairs());
  for (FaceId f = 0; f < static_cast<FaceId>(patches.size()); ++f)
    EXPECT_EQ(sections.search.crossing_in(f, true), whole.search.crossing_in(f, true));
}

TEST(CrossingSearch, finds_a_face_that_crosses_itself_from_section_to_section) {
  const Meshed m("box", 8);
  std::vector<FacePatch> patches = m.result.patches;
  std::swap(patches[2].inner_xyz.front(), patches[2].inner_xyz.back());
  Search whole(m), sections(m);
  whole.run(patches);
  sections.run_in_two(patches);
  const std::vector<std::size_t> least = whole.search.crossing_in(2, false),
                                 all = sections.search.crossing_in(2, false);
  ASSERT_FALSE(least.empty());
  EXPECT_TRUE(std::ranges::includes(all, least)) << "the cone rule hides some within one section";
}

TEST(CrossingSearch, refines_no_triangles_of_a_face_that_was_given_up_but_those_that_cross_others) {
  const Meshed m("box", 8);
  std::vector<FacePatch> patches = m.result.patches;
  std::swap(patches[2].inner_xyz.front(), patches[2].inner_xyz.back());
  push_through(m, 0, patches[0]);
  Search search(m);
  const std::size_t n_all = search.run(patches).size();
  const std::int64_t n_within = search.search.n_pairs_within()[2];
  ASSERT_GT(n_within, 0);
  search.search.give_up(2);
  const std::vector<RefinementPoint> others = search.run();
  EXPECT_EQ(others.size(), n_all - 2 * static_cast<std::size_t>(n_within));
  EXPECT_FALSE(others.empty());
}

TEST(CrossingSearch, parts_faces_that_touch_in_a_node) {
  const Meshed m("box", 8);
  std::vector<FacePatch> patches = m.result.patches;
  const Box3 all = m.model.tables().box();
  const auto is_low = [&](FaceId f) { return m.model.tables().face_box[f].hi.z < all.lo.z + 1e-6; };
  const auto is_high = [&](FaceId f) { return m.model.tables().face_box[f].lo.z > all.hi.z - 1e-6; };
  FaceId low = 0, high = 0;
  while (!is_low(low)) ++low;
  while (!is_high(high)) ++high;
  patches[high].inner_xyz.at(patches[high].inner_xyz.size() / 2).z = all.lo.z;
  Search search(m);
  search.run(patches);
  ASSERT_GT(search.n_pairs(), 0);
  std::map<FaceId, FacePatch> crossing;
  for (const FaceId f : search.search.crossing_faces(true)) crossing[f] = patches[f];
  const std::vector<FaceId> moved = search.search.move_touching_apart(m.numbering(), crossing);
  EXPECT_TRUE(std::ranges::count(moved, high));
  for (const FaceId f : moved) {
    for (std::size_t i = 0; i < patches[f].inner_xyz.size(); ++i)
      EXPECT_LT(distance(crossing[f].inner_xyz[i], patches[f].inner_xyz[i]), 2e-6 * all.diagonal());
    patches[f] = crossing[f];
    search.renew(f);
  }
  search.run(patches);
  EXPECT_EQ(search.n_pairs(), 0);
}

TEST(CrossingSearch, halves_the_longest_side_of_a_triangle_at_its_centre) {
  const RefinementPoint p = halve_triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
  EXPECT_EQ(p.length, 2.5);
  EXPECT_TRUE(p.x == (Vec3{1, 4.0 / 3, 0}));
}

TEST(CrossingSearch, refines_triangles_that_span_their_face_by_more_than_half) {
  const Meshed m("box", 200);  // every face two triangles
  std::vector<FacePatch> patches = m.result.patches;
  patches[5] = patches[0];
  patches[5].face = 5;
  Search search(m);
  const std::vector<RefinementPoint> places = search.run(patches);
  ASSERT_FALSE(places.empty());
  const double diagonal = m.model.tables().face_box[0].diagonal();
  for (const RefinementPoint& p : places) {
    EXPECT_LT(p.length, 0.49 * diagonal);
    EXPECT_GE(p.length, 0.2499 * diagonal);
  }
}

}  // namespace
}  // namespace st
