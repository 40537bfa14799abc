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

constexpr double kLoopFloor = 1.0 / 16;  // of the requested length: refining loops, folds and narrow parts ends there
constexpr std::uint64_t kFewCrossings = 200;     // places
constexpr std::uint64_t kMostRepeated = 30;      // triangles of all rounds, by those of the first one
constexpr std::uint64_t kFewTriangles = 200000;  // that may be meshed again in any case
constexpr double kMostForWalls = 1.5e6;          // triangles that part walls, about
constexpr double kPerWall = 2;                   // times what parting walls should take: its rounds may mesh so many
constexpr double kPromising = 0.8;               // of the places before: as many or less is getting better

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
  std::uint64_t n_last = 0;  // places of the last search for crossings
  for (int n_rounds = 1, n_crossing_rounds = 0;; ++n_rounds) {
    executor_.begin_phase("edges");
    timed(times.edges, [&] { mesh_edges(); });
    executor_.begin_phase("regions");
    const Places wanted = timed(times.faces, [&] { return mesh_regions(); });
    ++result_.n_rounds;
    if (n_rounds == 1) n_first_ = n_meshed_;
    const bool is_last = runs_away();
    if (!is_last && n_rounds - n_crossing_rounds <= limits_.max_rounds && refine(wanted, kLoopFloor)) continue;
    const Places crossings = join_and_check();
    std::uint64_t n = crossings.size();
    share(executor_, n);
    const bool is_promising = n <= kFewCrossings || is_measured(crossings) ||
                              static_cast<double>(n) < kPromising * static_cast<double>(n_last);
    if (is_last || n == 0 ||
        n_crossing_rounds++ >= (is_promising ? limits_.max_promising_rounds : limits_.max_crossing_rounds))
      return;
    n_last = n;
    if (!refine(crossings, is_promising ? limits_.promising_floor : kCrossingFloor)) return;
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
  char is_over = static_cast<double>(n_meshed_) > most_triangles();
  share(executor_, is_over);
  if (is_over && executor_.is_root())
    log_warning("refining was ended after " + std::to_string(n_meshed_) + " triangles instead of " +
                std::to_string(n_first_) +
                "; folds and crossings stay: the surfaces are damaged, or walls too close together");
  return is_over != 0;
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
  if (n_for_walls_ + n_more < kMostForWalls) {
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

/// Of all rounds.
double MeshRounds::most_triangles() const {
  return static_cast<double>(kMostRepeated * n_first_ + kFewTriangles) + kPerWall * n_for_walls_;
}

/// Collective. Rank 0's places become part of the field, no finer than `floor` times the request. False when none
/// changes anything.
bool MeshRounds::refine(const Places& places, double floor) {
  const std::size_t n_before = refinements_.all().size();
  if (executor_.is_root())
    for (const RefinementPoint& p : affordable(places))
      refinements_.add(p, p.factor > 0 ? limits_.promising_floor : floor);
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
