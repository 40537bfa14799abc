// Where lengths are below the least length that is given for them (lmin), and because of what. Internal to stages.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/sizing_artifact.h"
#include "sizing/wing_sizes.h"

namespace st {

/// Counts them by cause.
class UndercutTally {
 public:
  /// Counts `length` where it is clearly below `lmin`; 0: none is given.
  void add(std::int32_t cause, double length, double lmin, Vec3 place);
  /// Those of most places first, then by cause.
  std::vector<Undercut> take() const;

 private:
  std::map<std::int32_t, Undercut> by_cause_;
};

/// Samples of what is smaller by itself: strips and bases.
std::vector<Undercut> sample_undercuts(std::span<const LengthSample> samples, const GivenFloors& floors);

std::int64_t count(std::span<const Undercut> undercuts);
double least_of(std::span<const Undercut> undercuts);

/// "face 3 "side" (12, down to 0.25 at (1, 2, 3)), edge 7 (...) and 4 more"; lengths times `scale`.
std::string undercut_text(std::span<const Undercut> undercuts, const CauseNames& names, double scale);

/// Every cause with its numbers; `n`: what is counted.
nlohmann::ordered_json undercuts_json(std::span<const Undercut> undercuts, const CauseNames& names, const char* n,
                                      double scale);

}  // namespace st
