#include "stages/wing_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/length.h"
#include "base/sort_once.h"
#include "base/text.h"
#include "features/station_gaps.h"

namespace st {
namespace {

std::vector<const UnusedTrailing*> longest_first(std::span<const UnusedTrailing> unused) {
  std::vector<const UnusedTrailing*> order;
  for (const UnusedTrailing& u : unused) order.push_back(&u);
  std::stable_sort(order.begin(), order.end(),
                   [](const UnusedTrailing* a, const UnusedTrailing* b) { return a->length > b->length; });
  return order;
}

std::vector<std::int32_t> from_one(std::vector<std::int32_t> ids) {
  for (std::int32_t& id : ids) ++id;
  return ids;
}

/// "edges 3, 8, 9 and 4 more".
std::string listed(std::vector<std::int32_t> numbers) {
  constexpr std::size_t kNamed = 8;
  const std::size_t n = numbers.size();
  numbers.resize(std::min(n, kNamed));
  return fmt::format("{} {}{}", n == 1 ? "edge" : "edges", fmt::join(numbers, ", "),
                     n > kNamed ? fmt::format(" and {} more", n - kNamed) : "");
}

/// A file of sizes that says what edges are, on one line.
std::string rule_for(std::vector<std::int32_t> numbers, const char* meaning) {
  constexpr std::size_t kNamed = 12;
  const std::size_t n = numbers.size();
  numbers.resize(std::min(n, kNamed));
  return fmt::format("size = [{{ edges = [{}{}], {} }}]", fmt::join(numbers, ", "), n > kNamed ? ", ..." : "", meaning);
}

/// Length of its noses before slots and flaps, model unit.
double front_length(const LiftingSurface& wing) {
  double length = 0;
  for (const ChordEdge& front : wing.front)
    for (std::size_t i = 1; i < front.stations.size(); ++i)
      length += distance(front.stations[i - 1].nose, front.stations[i].nose);
  return length;
}

/// Measured stations of a lifting surface.
nlohmann::json stations_json(const LiftingSurface& wing) {
  nlohmann::json list = nlohmann::json::array();
  const auto place = [](Vec3 x) { return nlohmann::json{x.x, x.y, x.z}; };
  for (const ChordEdge& edge : wing.trailing)
    for (const ChordStation& s : edge.stations)
      if (s.is_measured) list.push_back({{"trailing", place(s.trailing)}, {"nose", place(s.nose)}, {"chord", s.chord}});
  return list;
}

/// Of one surface: each that is long, or how many short ones there are where they are too much together.
std::vector<std::string> open_parts(const LiftingSurface& wing) {
  std::vector<std::string> parts;
  const std::vector<UncoveredStretch> stretches = uncovered_stretches(wing);
  for (const UncoveredStretch& open : stretches)
    if (open.length > kShortStretch * wing.span)
      parts.push_back(fmt::format("{:.2g} % of the span at edge {}", 100 * open.length / wing.span, open.edge + 1));
  if (!parts.empty() || stretches.empty() || wing.covered() >= 1 - kShortStretch) return parts;
  const auto longest = std::ranges::max_element(stretches, {}, &UncoveredStretch::length);
  return {fmt::format("{:.2g} % of the span in {}, the longest at edge {}", 100 * (1 - wing.covered()),
                      counted(static_cast<std::int64_t>(stretches.size()), "short stretch", "short stretches"),
                      longest->edge + 1)};
}

}  // namespace

nlohmann::json wings_json(std::span<const LiftingSurface> wings) {
  nlohmann::json list = nlohmann::json::array();
  for (const LiftingSurface& wing : wings) {
    std::vector<std::int32_t> edges, inside, leading, bases;
    for (const ChordEdge& edge : wing.trailing) {
      (edge.is_inside ? inside : edges).push_back(edge.edge + 1);
      if (edge.base != kNone) bases.push_back(edge.base + 1);
    }
    sort_once(bases);
    for (const EdgeId e : wing.leading) leading.push_back(e + 1);
    list.push_back({{"trailing_edges", edges},
                    {"inside_along", inside},
                    {"leading_edges", leading},
                    {"bases", bases},
                    {"faces", from_one(wing.faces)},
                    {"stations", stations_json(wing)},
                    {"is_blunt", wing.is_blunt},
                    {"has_noses", wing.has_noses},
                    {"is_declared", wing.is_declared},
                    {"span", wing.span},
                    {"noses_alone", front_length(wing)},
                    {"chord", {wing.least_chord, wing.median_chord, wing.largest_chord}}});
  }
  return list;
}

std::string used_line(std::size_t n_wings, std::span<const UnusedTrailing> unused) {
  if (unused.empty()) return "";
  std::map<std::string, int> reasons;
  for (const UnusedTrailing& u : unused) ++reasons[u.why];
  std::string why;
  for (const auto& [reason, n] : reasons) why += fmt::format("{}{} because {}", why.empty() ? "" : ", ", n, reason);
  return fmt::format("  trailing edges: of {} sets found, {} used as lifting surfaces; left out are {}",
                     n_wings + unused.size(), n_wings, why);
}

std::vector<std::string> unused_lines(std::span<const UnusedTrailing> unused, std::size_t most,
                                      const std::string& unit) {
  std::vector<std::string> lines;
  for (const UnusedTrailing* u : longest_first(unused)) {
    if (lines.size() == most) {
      lines.push_back(fmt::format("  and {} more trailing edges without a lifting surface", unused.size() - most));
      break;
    }
    lines.push_back(fmt::format("  no lifting surface at trailing {}, length {:.4g}{}: {}", listed(from_one(u->edges)),
                                u->length, in_unit(unit), u->why));
  }
  return lines;
}

std::string declared_warning(const UnusedTrailing& declared) {
  return fmt::format(
      "a rule names {} as trailing or leading: without effect, since no plane cuts anything thin behind it ({}); give "
      "it lmax instead",
      listed(from_one(declared.edges)), declared.why);
}

std::string unused_warning(std::span<const UnusedTrailing> unused, double reference_diagonal, const std::string& unit) {
  std::vector<EdgeId> edges;
  double length = 0;
  for (const UnusedTrailing* u : longest_first(unused)) {
    if (u->length < kLongTrailing * reference_diagonal) break;
    if (!u->may_be_wing || u->is_declared) continue;
    for (const EdgeId e : from_one(u->edges)) edges.push_back(e);
    length += u->length;
  }
  if (edges.empty()) return "";
  std::sort(edges.begin(), edges.end());
  const bool is_one = edges.size() == 1;
  return fmt::format(
      "{}, {:.4g}{} long, {} to no lifting surface and {} the lengths of other edges; if {} a wing's, say so in a file "
      "for --sizes: {}",
      counted(static_cast<std::int64_t>(edges.size()), "trailing edge"), length, in_unit(unit),
      is_one ? "belongs" : "belong", is_one ? "gets" : "get", is_one ? "it is" : "they are",
      rule_for(edges, "trailing_edge = true"));
}

nlohmann::json unused_json(std::span<const UnusedTrailing> unused) {
  nlohmann::json list = nlohmann::json::array();
  for (const UnusedTrailing& u : unused)
    list.push_back({{"edges", from_one(u.edges)}, {"length", u.length}, {"reason", u.why}});
  return list;
}

std::string wing_line(const LiftingSurface& wing, const std::string& edge_size, const std::string& unit) {
  const std::string own_unit = in_unit(unit);
  const std::vector<ChordEdge>& edges = wing.edges();
  const std::string kind = wing.trailing.empty() ? "leading edge" : "trailing edge";
  const std::string inside = edges.front().is_inside ? " inside faces, beside edge" : "";
  const int first = edges.front().edge + 1;
  const std::string which = edges.size() == 1 ? fmt::format("{}{} {}", kind, inside, first)
                                              : fmt::format("{} {}s{} from edge {} on", edges.size(), kind,
                                                            inside.empty() ? "" : inside + "s", first);
  return fmt::format("  lifting surface{}: {}, {}, span {:.4g}{}, chord {:.4g} to {:.4g}{}; {} along {}",
                     wing.is_declared ? " by a rule" : "", which,
                     wing.is_round   ? "round"
                     : wing.is_blunt ? "blunt"
                                     : "sharp",
                     wing.span, own_unit, wing.least_chord, wing.largest_chord, own_unit, edge_size,
                     wing.has_noses
                         ? wing.covered() < 1 - kShortStretch
                               ? fmt::format("edge and nose, which is seen on {:.0f} %", 100 * wing.covered())
                               : "edge and nose"
                         : "the edge, no nose is seen");
}

std::string sheet_warning(std::span<const EdgeId> free_edges) {
  if (free_edges.empty()) return "";
  const std::vector<EdgeId> numbers = from_one({free_edges.begin(), free_edges.end()});
  return fmt::format(
      "no lifting surface is looked for on sheets without thickness, which end at the free {}; give these lengths in a "
      "file for --sizes: {}",
      listed(numbers), rule_for(numbers, "lmax = \"0.1%\""));
}

std::string seam_warning(std::span<const EdgeId> seams) {
  if (seams.empty()) return "";
  return fmt::format(
      "what is closed at {} looks like a blade, but has no edge at its trailing edge: both ends get the "
      "lengths "
      "of their curvature; cut the face along its trailing edge in the CAD system",
      listed(from_one({seams.begin(), seams.end()})));
}

std::string noseless_warning(std::span<const LiftingSurface> wings) {
  std::vector<EdgeId> edges;
  std::vector<std::string> parts;
  for (const LiftingSurface& wing : wings) {
    if (wing.is_declared) continue;
    if (!wing.has_noses)
      for (const ChordEdge& edge : wing.trailing) edges.push_back(edge.edge + 1);
    else
      for (std::string& part : open_parts(wing)) parts.push_back(std::move(part));
  }
  constexpr std::size_t kNamed = 8;
  if (parts.size() > kNamed) {
    const std::string more = fmt::format("{} more stretches", parts.size() - kNamed);
    parts.resize(kNamed);
    parts.push_back(more);
  }
  std::sort(edges.begin(), edges.end());
  if (!edges.empty()) parts.insert(parts.begin(), "the trailing " + listed(edges));
  if (parts.empty()) return "";
  return fmt::format(
      "no nose is seen before {}: noses there get the lengths of their curvature; name those that are edges with "
      "leading_edge = true in a file for --sizes{}",
      fmt::join(parts, ", "),
      edges.empty() ? "" : ", and for trailing edges that are none write " + rule_for(edges, "trailing_edge = false"));
}

}  // namespace st
