#include "stages/undercuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace st {
namespace {

constexpr double kRounding = 0.999;  // of a given length: nearer ones are equal
constexpr std::size_t kNamed = 3;    // causes in a message

}  // namespace

void UndercutTally::add(std::int32_t cause, double length, double lmin, Vec3 place) {
  if (!(length < kRounding * lmin)) return;
  Undercut& own = by_cause_.try_emplace(cause, Undercut{cause, 0, length, place}).first->second;
  ++own.n;
  own.least = std::min(own.least, length);
}

std::vector<Undercut> UndercutTally::take() const {
  std::vector<Undercut> all;
  for (const auto& [cause, own] : by_cause_) all.push_back(own);
  std::stable_sort(all.begin(), all.end(), [](const Undercut& a, const Undercut& b) { return a.n > b.n; });
  return all;
}

std::vector<Undercut> sample_undercuts(std::span<const LengthSample> samples, const GivenFloors& floors) {
  UndercutTally tally;
  for (const LengthSample& s : samples) tally.add(s.cause, static_cast<double>(s.length), floors.of(s.cause), s.xyz);
  return tally.take();
}

std::int64_t count(std::span<const Undercut> undercuts) {
  std::int64_t n = 0;
  for (const Undercut& u : undercuts) n += u.n;
  return n;
}

double least_of(std::span<const Undercut> undercuts) {
  double least = std::numeric_limits<double>::infinity();
  for (const Undercut& u : undercuts) least = std::min(least, u.least);
  return least;
}

std::string undercut_text(std::span<const Undercut> undercuts, const CauseNames& names, double scale) {
  std::string text;
  for (const Undercut& u : undercuts.first(std::min(kNamed, undercuts.size())))
    text += fmt::format("{}{} ({}, down to {:.4g} near ({:.5g}, {:.5g}, {:.5g}))", text.empty() ? "" : ", ",
                        cause_text(names, u.cause), u.n, scale * u.least, u.place.x, u.place.y, u.place.z);
  if (undercuts.size() > kNamed) text += fmt::format(" and {} more", undercuts.size() - kNamed);
  return text;
}

nlohmann::ordered_json undercuts_json(std::span<const Undercut> undercuts, const CauseNames& names, const char* n,
                                      double scale) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Undercut& u : undercuts)
    all.push_back({{"cause", cause_text(names, u.cause)},
                   {n, u.n},
                   {"least", scale * u.least},
                   {"place", {u.place.x, u.place.y, u.place.z}}});
  return all;
}

}  // namespace st
