#include "meshing/engine/eased_places.h"

#include <algorithm>
#include <array>

#include "base/box_tree.h"
#include "base/disjoint_sets.h"

namespace st {
namespace {

using Count = std::array<int, kFlawKinds>;  // of flaws, by kind

class EasedPlaces {
 public:
  explicit EasedPlaces(std::span<const EasingRound> rounds) : rounds_(rounds), sets_(0) {
    for (std::size_t k = 1; k < rounds.size(); ++k)
      for (const Refinement& r : rounds[k].refinements) {
        if (contains(rounds[0].refinements, r)) continue;
        items_.push_back(r);
        round_.push_back(k);
      }
    std::vector<Box3> boxes;
    for (const Refinement& r : items_) {
      const Vec3 side{r.reach, r.reach, r.reach};
      boxes.push_back({r.x - side, r.x + side});
    }
    tree_ = BoxTree(boxes);
    sets_ = DisjointSets(static_cast<std::int64_t>(items_.size()));
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(items_.size()); ++i)
      visit_reaching(items_[i].x, [&](std::int32_t other) { sets_.join(i, other); });
  }

  std::vector<Refinement> run() {
    counts_.resize(items_.size() * rounds_.size());
    for (std::size_t k = 0; k < rounds_.size(); ++k)
      for (const StretchFlaw& flaw : rounds_[k].flaws) count(flaw, k);
    std::vector<Refinement> best = rounds_[0].refinements;
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (round_[i] == best_round(sets_.find(static_cast<std::int32_t>(i)))) best.push_back(items_[i]);
    return best;
  }

 private:
  template <class Visit>
  void visit_reaching(Vec3 x, const Visit& visit) const {
    tree_.visit_near(
        x, [](std::int32_t, double d2) { return d2 <= 0; },
        [&](std::int32_t i) {
          if (distance(items_[i].x, x) < items_[i].reach) visit(i);
        });
  }

  /// Once for each place that it is within reach of.
  void count(const StretchFlaw& flaw, std::size_t round) {
    std::vector<std::int32_t> places;
    visit_reaching(flaw.x, [&](std::int32_t i) { places.push_back(sets_.find(i)); });
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const std::int32_t place : places)
      ++counts_[place * rounds_.size() + round][static_cast<std::size_t>(flaw.kind)];
  }

  std::size_t best_round(std::int32_t place) const {
    const auto of_place = std::span(counts_).subspan(place * rounds_.size(), rounds_.size());
    return static_cast<std::size_t>(std::ranges::min_element(of_place) - of_place.begin());
  }

  std::span<const EasingRound> rounds_;
  std::vector<Refinement> items_;   // of all rounds
  std::vector<std::size_t> round_;  // [items_]
  BoxTree tree_;                    // of items_
  DisjointSets sets_;               // likewise: places
  std::vector<Count> counts_;       // [places][rounds]
};

}  // namespace

std::vector<Refinement> best_of_places(std::span<const EasingRound> rounds) { return EasedPlaces(rounds).run(); }

}  // namespace st
