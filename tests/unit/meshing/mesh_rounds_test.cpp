// The loop of rounds, with steps that only say what they were asked.
#include "meshing/engine/mesh_rounds.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace st {
namespace {

const SerialExecutor one_rank;
const UniformField one(1);

/// Steps that write their letters: edges, regions, join, crossings, mend, again.
class Scripted : public MeshRounds {
 public:
  using Places = std::vector<RefinementPoint>;
  using Script = std::function<Places(int call)>;

  Scripted(const RefinementPolicy& policy, MeshResult& result, Script regions, Script crossings)
      : MeshRounds(one, policy, one_rank, result), regions_(std::move(regions)), crossings_(std::move(crossings)) {}

  std::string steps;
  std::vector<std::size_t> first_refinements;
  std::uint64_t n_first = 0, n_later = 0;  // triangles of the first round, and of each later one
  std::function<int(int call)> n_unmeasured_pairs = [](int) { return 0; };
  bool mends = false;
  double shortest() const {
    double length = 1;
    for (const Refinement& r : refinements_.all()) length = std::min(length, r.length);
    return length;
  }

 private:
  void mesh_edges() override { steps += 'e'; }
  Places mesh_regions() override {
    steps += 'r';
    n_meshed_ += n_regions_ == 0 ? n_first : n_later;
    return regions_(n_regions_++);
  }
  void join() override { steps += 'j'; }
  Places find_crossings() override {
    steps += 'c';
    n_unmeasured_pairs_ = n_unmeasured_pairs(n_crossings_);
    return crossings_(n_crossings_++);
  }
  bool mend_crossings() override {
    if (mends) steps += 'm';
    return mends;
  }
  void choose_again(std::size_t first_refinement) override {
    steps += 'a';
    first_refinements.push_back(first_refinement);
  }

  Script regions_, crossings_;
  int n_regions_ = 0, n_crossings_ = 0;
};

const Scripted::Script kNothing = [](int) { return Scripted::Places(); };

/// `n` places that no other call has, far from each other.
Scripted::Places places(int call, int n) {
  Scripted::Places list;
  for (int i = 0; i < n; ++i) list.push_back({{100.0 * i, 100.0 * call, 0}, 0.5});
  return list;
}

constexpr RefinementPolicy kLimits{.max_rounds = 3,
                                   .max_crossing_rounds = 2,
                                   .max_promising_rounds = 5,
                                   .crossing_floor = 0.125,
                                   .max_crossing_places = 2000};

TEST(MeshRounds, end_after_one_round_where_nothing_is_wrong) {
  MeshResult result;
  Scripted rounds(kLimits, result, kNothing, kNothing);
  rounds.run();
  EXPECT_EQ(rounds.steps, "erjc");
  EXPECT_EQ(result.n_rounds, 1);
  EXPECT_EQ(result.n_refinements, 0);
}

TEST(MeshRounds, end_without_smaller_sizes_where_crossings_can_be_mended) {
  MeshResult result;
  const auto one_at_first = [](int call) { return places(call, call == 0 ? 1 : 0); };
  Scripted rounds(kLimits, result, kNothing, one_at_first);
  rounds.mends = true;
  rounds.run();
  EXPECT_EQ(rounds.steps, "erjcm");
  EXPECT_EQ(result.n_refinements, 0);
}

TEST(MeshRounds, do_not_mend_what_was_refined) {
  MeshResult result;
  const auto one_at_first = [](int call) { return places(call, call == 0 ? 1 : 0); };
  Scripted rounds(kLimits, result, one_at_first, [](int call) { return places(7, call == 0 ? 1 : 0); });
  rounds.mends = true;
  rounds.run();
  EXPECT_EQ(rounds.steps, "eraerjcaerjc");
}

TEST(MeshRounds, refine_regions_so_many_times_and_look_for_crossings_then) {
  MeshResult result;
  Scripted rounds(
      kLimits, result, [](int call) { return places(call, 2); }, kNothing);
  rounds.run();
  EXPECT_EQ(rounds.steps, "eraeraeraerjc");
  EXPECT_EQ(result.n_rounds, 4);
  EXPECT_EQ(result.n_refinements, 6);
  EXPECT_EQ(rounds.first_refinements, (std::vector<std::size_t>{0, 2, 4}));
}

TEST(MeshRounds, do_not_mesh_again_for_places_that_are_as_fine_already) {
  MeshResult result;
  Scripted rounds(
      kLimits, result, [](int) { return places(0, 2); }, kNothing);
  rounds.run();
  EXPECT_EQ(rounds.steps, "eraerjc");
}

TEST(MeshRounds, refine_a_crossing_down_to_its_floor) {
  MeshResult result;
  int n = 0;
  Scripted rounds(kLimits, result, kNothing, [&](int call) {
    n = call + 1;
    return Scripted::Places{{{0, 0, 0}, std::ldexp(1.0, -n)}};
  });
  rounds.run();
  EXPECT_EQ(n, 4) << "1/2, 1/4, 1/8, and once more where that is no change";
  EXPECT_EQ(rounds.shortest(), 0.125);
}

TEST(MeshRounds, give_up_sooner_where_many_triangles_cross) {
  MeshResult result;
  Scripted rounds(kLimits, result, kNothing, [](int call) { return places(call, 300); });
  rounds.run();
  EXPECT_EQ(result.n_rounds, 1 + kLimits.max_crossing_rounds);
}

TEST(MeshRounds, go_on_where_few_triangles_cross) {
  MeshResult result;
  Scripted rounds(kLimits, result, kNothing, [](int call) { return places(call, 100); });
  rounds.run();
  EXPECT_EQ(result.n_rounds, 1 + kLimits.max_promising_rounds);
}

TEST(MeshRounds, end_where_rounds_leave_as_many_pairs) {
  const auto rounds_with = [](auto n_pairs) {
    MeshResult result;
    Scripted rounds(kLimits, result, kNothing, [](int call) { return places(call, 100); });
    rounds.n_unmeasured_pairs = n_pairs;
    result.n_crossing_pairs = 5000;
    rounds.run();
    return result.n_rounds;
  };
  const int most = 1 + kLimits.max_promising_rounds;
  EXPECT_EQ(rounds_with([](int) { return 1000; }), 4) << "three rounds without success";
  EXPECT_EQ(rounds_with([](int) { return 99; }), most) << "few pairs";
  EXPECT_EQ(rounds_with([](int) { return 0; }), most) << "it is known what parts all of them";
  EXPECT_EQ(rounds_with([](int call) { return call == 2 ? 800 : 1000; }), most) << "fewer in between";
  EXPECT_EQ(rounds_with([](int call) { return call < 2 ? 1000 + 500 * call : 1000; }), 4) << "more do not count";
}

TEST(MeshRounds, count_refinements_of_regions_apart_from_those_of_crossings) {
  MeshResult result;
  Scripted rounds(
      kLimits, result, [](int call) { return places(100 + call, call % 2); },
      [](int call) { return places(call, call < 4); });
  rounds.run();
  EXPECT_EQ(rounds.steps,
            "erjca"
            "era"
            "erjca"
            "era"
            "erjca"
            "era"
            "erjca"
            "erjc");
}

TEST(MeshRounds, end_where_far_more_is_meshed_again_than_in_the_first_round) {
  constexpr std::uint64_t kFirst = 1000, kMost = 30 * kFirst + 200000;
  for (const auto& [n_later, steps] : {std::pair(kMost - kFirst, "eraeraeraerjc"), {kMost - kFirst + 1, "eraerjc"}}) {
    MeshResult result;
    Scripted rounds(
        kLimits, result, [](int call) { return places(call, 2); }, [](int call) { return places(100 + call, 0); });
    rounds.n_first = kFirst;
    rounds.n_later = n_later / (steps == std::string("eraerjc") ? 1 : 3);
    rounds.run();
    EXPECT_EQ(rounds.steps, steps);
  }
  MeshResult result;
  Scripted crossing(kLimits, result, kNothing, [](int call) { return places(call, 100); });
  crossing.n_later = kMost;
  crossing.run();
  EXPECT_EQ(crossing.steps, "erjcaerjc") << "crossings are still counted";
}

}  // namespace
}  // namespace st
