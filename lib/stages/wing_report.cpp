#include "stages/wing_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace st {
namespace {

std::vector<const UnusedTrailing*> longest_first(std::span<const UnusedTrailing> unused) {
  std::vector<const UnusedTrailing*> order;
  for (const UnusedTrailing& u : unused) order.push_back(&u);
  std::stable_sort(order.begin(), order.end(),
                   [](const UnusedTrailing* a, const UnusedTrailing* b) { return a->length > b->length; });
  return order;
}

std::vector<EdgeId> numbers_of_edges(const UnusedTrailing& u) {
  std::vector<EdgeId> numbers;
  for (const EdgeId e : u.edges) numbers.push_back(e + 1);
  return numbers;
}

/// "edges 3, 8, 9 and 4 more".
std::string names_of(const UnusedTrailing& u) {
  constexpr std::size_t kNamed = 8;
  std::vector<EdgeId> numbers = numbers_of_edges(u);
  const std::size_t n = numbers.size();
  numbers.resize(std::min(n, kNamed));
  return fmt::format("{} {}{}", n == 1 ? "edge" : "edges", fmt::join(numbers, ", "),
                     n > kNamed ? fmt::format(" and {} more", n - kNamed) : "");
}

}  // namespace

std::vector<std::string> unused_lines(std::span<const UnusedTrailing> unused, std::size_t most) {
  std::vector<std::string> lines;
  for (const UnusedTrailing* u : longest_first(unused)) {
    if (lines.size() == most) {
      lines.push_back(fmt::format("  and {} more trailing edges without a lifting surface", unused.size() - most));
      break;
    }
    lines.push_back(
        fmt::format("  no lifting surface at trailing {}, length {:.4g}: {}", names_of(*u), u->length, u->why));
  }
  return lines;
}

std::string unused_warning(std::span<const UnusedTrailing> unused, double reference_diagonal) {
  std::vector<EdgeId> edges;
  double length = 0;
  for (const UnusedTrailing* u : longest_first(unused)) {
    if (u->length < kLongTrailing * reference_diagonal) break;
    if (!u->may_be_wing) continue;
    for (const EdgeId e : numbers_of_edges(*u)) edges.push_back(e);
    length += u->length;
  }
  if (edges.empty()) return "";
  constexpr std::size_t kNamed = 12;
  const std::size_t n = edges.size();
  std::sort(edges.begin(), edges.end());
  edges.resize(std::min(n, kNamed));
  return fmt::format(
      "{} trailing edges, {:.4g} long, belong to no lifting surface and get the lengths of other edges; if they are a "
      "wing's, give them their own by a rule in --sizes: [[size]] edges = [{}{}] lmax = \"LENGTH\"",
      n, length, fmt::join(edges, ", "), n > kNamed ? ", ..." : "");
}

nlohmann::json unused_json(std::span<const UnusedTrailing> unused) {
  nlohmann::json list = nlohmann::json::array();
  for (const UnusedTrailing& u : unused)
    list.push_back({{"edges", numbers_of_edges(u)}, {"length", u.length}, {"reason", u.why}});
  return list;
}

}  // namespace st
