#include "meshing/engine/section_search.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "meshing/engine/rank_batches.h"
#include "support/meshed.h"

namespace st {
namespace {

using test::Meshed;

/// The patches of a box, the first one pushed through the other side, as a section each.
struct CrossedBox {
  CrossedBox() : numbering(meshed.numbering()) {
    std::vector<FacePatch> patches = meshed.result.patches;
    const Box3 all = meshed.model.tables().box();
    for (Vec3& x : patches[0].inner_xyz) x += 2.5 * (all.center() - meshed.model.tables().face_box[0].center());
    for (FacePatch& p : patches)
      sections.push_back(store.put({std::move(p)}, 0, 1, meshed.result.edges, meshed.model.tables().vertex_xyz));
  }
  FacetPairs find(const SectionJob& job) const {
    const SectionSearch search(store, test::one_rank, numbering, sections);
    return search.find(job, search.near_others({job})[0]).pairs;
  }

  Meshed meshed{"box", 8};
  BoundaryNumbering numbering;
  PatchStore store{test::one_rank};
  std::vector<PatchPlace> sections;
};

TEST(SectionSearch, finds_triangles_of_both_sections_of_a_job) {
  const CrossedBox box;
  std::size_t n_found = 0;
  for (std::int32_t other = 1; other < 6; ++other)
    for (const FacetPair& p : box.find({0, other})) {
      EXPECT_EQ(std::pair(p.a.face, p.b.face), std::pair(box.sections[0].face, box.sections[other].face));
      EXPECT_EQ(p.factor, FacetPair::kUnknown);
      ++n_found;
    }
  EXPECT_GT(n_found, 0u);
  EXPECT_TRUE(box.find({1, 2}).empty());
  EXPECT_TRUE(box.find({3, 3}).empty());
}

TEST(SectionSearch, has_the_corners_of_each_triangle) {
  const CrossedBox box;
  const SectionSearch search(box.store, test::one_rank, box.numbering, box.sections);
  const std::vector<Facet> facets = {{box.sections[2].face, 0}, {box.sections[2].face, 5}};
  const std::vector<FacetCorners> corners = search.corners(facets);
  ASSERT_EQ(corners.size(), 2u);
  const FacePatch& patch = box.meshed.result.patches[2];
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(corners[1].places.x[k],
              node_place(box.numbering.edges, box.numbering.tables.vertex_xyz, patch, patch.triangles[5].n[k]));
}

TEST(SectionSearch, puts_pairs_of_the_same_faces_together) {
  const FacetPairs pairs = {{{0, 1}, {2, 0}}, {{0, 4}, {2, 1}}, {{0, 1}, {3, 0}}};
  const std::vector<FacetPairs> groups = by_faces(pairs);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].size(), 2u);
  EXPECT_TRUE(by_faces({}).empty());
}

TEST(RankBatches, have_jobs_of_one_rank_each_and_all_of_them) {
  const std::vector<std::int32_t> ranks = {0, 1, 1, 0, 2};
  const auto batches = batches_of(
      ranks, [](std::int32_t rank) { return rank; }, [](std::int32_t rank) { return rank == 1 ? 20'000.0 : 1.0; });
  std::set<std::size_t> jobs;
  for (const RankBatch& batch : batches)
    for (const std::size_t job : batch.jobs) {
      EXPECT_EQ(ranks[job], batch.home);
      EXPECT_TRUE(jobs.insert(job).second);
    }
  EXPECT_EQ(jobs.size(), ranks.size());
  EXPECT_EQ(batches.size(), 4u) << "a heavy job fills a batch";
  const NamedTasks tasks = tasks_of(batches, "kind");
  EXPECT_EQ(batches[tasks.order.front()].home, 1);
  EXPECT_EQ(tasks.home.size(), batches.size());
}

}  // namespace
}  // namespace st
