#include "meshing/engine/mesh_rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/log.h"
#include "base/progress.h"
#include "base/share.h"

namespace st {
namespace {

/// Adds the seconds of its life.
class TimeAdder {
 public:
  explicit TimeAdder(double& total) : total_(total) {}
  ~TimeAdder() { total_ += timer_.seconds(); }
  TimeAdder(const TimeAdder&) = delete;
  TimeAdder& operator=(const TimeAdder&) = delete;

 private:
  double& total_;
  Timer timer_;
};

template <class Step>
auto timed(double& total, const Step& step) {
  const TimeAdder adder(total);
  return step();
}

}  // namespace

void MeshRounds::run() {
  MeshTimes& times = result_.times;
  for (int n_rounds = 1, n_crossing_rounds = 0;; ++n_rounds) {
    executor_.begin_phase("edges");
    timed(times.edges, [&] { mesh_edges(); });
    executor_.begin_phase("regions");
    const Places wanted = timed(times.faces, [&] { return mesh_regions(); });
    ++result_.n_rounds;
    if (n_rounds == 1) n_first_ = n_meshed_;
    const bool is_last = runs_away();
    if (!is_last && policy_.refines_loops(n_rounds - n_crossing_rounds) && refine(wanted, RefinementPolicy::kLoopFloor))
      continue;
    const Places crossings = join_and_check();
    std::uint64_t n = crossings.size();
    share(executor_, n);
    const bool is_promising = RefinementPolicy::is_promising(n, is_measured(crossings));
    if (is_last || n == 0 || !policy_.refines_crossings(n_crossing_rounds++, is_promising) || is_stuck()) return;
    if (result_.n_refinements == 0 && mend_crossings()) return;
    if (!refine(crossings, policy_.crossing_floor)) return;
  }
}

/// Collective. Whether it is known what it takes to part them, at some of rank 0's places, and that is affordable.
bool MeshRounds::is_measured(const Places& places) const {
  char is = !has_said_walls_ &&
            std::any_of(places.begin(), places.end(), [](const RefinementPoint& p) { return p.factor > 0; });
  share(executor_, is);
  return is != 0;
}

/// Collective. Whether more was meshed again than refining can be worth, as on surfaces that are damaged.
bool MeshRounds::runs_away() {
  char is_over = RefinementPolicy::runs_away(n_meshed_, n_first_, n_for_walls_);
  share(executor_, is_over);
  if (is_over && executor_.is_root())
    log_warning("refining was ended after " + std::to_string(n_meshed_) + " triangles instead of " +
                std::to_string(n_first_) +
                "; folds and crossings stay: the surfaces are damaged, or walls too close together");
  return is_over != 0;
}

/// Collective. Whether as many triangles cross as some rounds ago, as where surfaces cross in the CAD. Those of walls
/// that are measured do not count: near each other they cross in ever more pairs until triangles are small enough.
bool MeshRounds::is_stuck() {
  const std::int64_t n_pairs = n_unmeasured_pairs_;
  if (n_fewest_pairs_ == 0 || RefinementPolicy::is_clearly_fewer(n_pairs, n_fewest_pairs_)) {
    n_fewest_pairs_ = n_pairs;
    n_stuck_ = 0;
  } else {
    ++n_stuck_;
  }
  char is = RefinementPolicy::is_stuck(n_stuck_, n_pairs);
  share(executor_, is);
  if (is && executor_.is_root())
    log_warning(fmt::format(
        "refining where triangles cross was ended: {} pairs of triangles cross, and {} rounds of smaller ones left not "
        "clearly fewer; surfaces cross each other there, so repair them in the CAD system",
        n_pairs, n_stuck_));
  return is != 0;
}

/// Collective. Where facets cross in the joined mesh; on rank 0.
MeshRounds::Places MeshRounds::join_and_check() {
  Progress progress("joining", 2);
  progress.step("nodes", 0);
  executor_.begin_phase("join");
  timed(result_.times.join, [&] { join(); });
  progress.step("crossing facets", 1);
  executor_.begin_phase("crossings");
  return timed(result_.times.crossing, [&] { return find_crossings(); });
}

/// Local. The places with lengths below those there so far, where it is known what it takes. None of these where that
/// is more than refining may cost.
MeshRounds::Places MeshRounds::affordable(const Places& places) {
  const RefinedField present(field_, refinements_.all());
  Places all, tries;
  double n_more = 0;  // triangles
  for (RefinementPoint p : places) {
    if (p.factor > 0) {
      int hint = 0;
      p.length = std::min(p.length, p.factor * present.local(p.x, hint).along);
      n_more += p.n_triangles / (p.factor * p.factor);
    } else {
      tries.push_back(p);
    }
    all.push_back(p);
  }
  if (RefinementPolicy::affords_walls(n_for_walls_ + n_more)) {
    n_for_walls_ += n_more;
    return all;
  }
  if (!std::exchange(has_said_walls_, true))
    log_warning(fmt::format(
        "walls lie closer together than the chords of their triangles, and to part them takes {:.0f} triangles: their "
        "triangles cross (finer sizes there, by st-raster, part them)",
        n_more));
  return tries;
}

/// Collective. Rank 0's places become part of the field, no finer than `floor` times the request. False when none
/// changes anything.
bool MeshRounds::refine(const Places& places, double floor) {
  const std::size_t n_before = refinements_.all().size();
  if (executor_.is_root())
    for (const RefinementPoint& p : affordable(places)) refinements_.add(p, floor);
  std::vector<Refinement> all = refinements_.all();
  share(executor_, all);
  refinements_.assign(std::move(all));
  const std::size_t n_new = refinements_.all().size() - n_before;
  if (n_new == 0) return false;
  executor_.begin_phase("choice");
  result_.n_refinements += static_cast<int>(n_new);
  choose_again(n_before);
  return true;
}

}  // namespace st
