#include "stages/wing_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "stages/text_table.h"

namespace st {
namespace {

using nlohmann::json;

/// "0.1 0.1 0.11" of the stations of a surface; "-" where there is nothing.
template <class Value>
std::string at_stations(const WingMeasure& wing, const char* format, const Value& value) {
  std::vector<std::string> texts;
  bool is_any = false;
  for (const WingStationMeasure& s : wing.stations) {
    const double own = value(s);
    is_any |= own > 0;
    texts.push_back(own > 0 ? fmt::format(fmt::runtime(format), own) : "-");
  }
  return is_any ? fmt::format("{}", fmt::join(texts, " ")) : "-";
}

json wing_station_json(const WingStationMeasure& s) {
  const auto lengths = [&](const LengthsAt& l) -> json { return {{"normal", l.normal}, {"along", l.along}}; };
  json j{{"share", s.share},           {"xyz", {s.place.x, s.place.y, s.place.z}}, {"chord", s.chord},
         {"asked", s.asked},           {"trailing", lengths(s.trailing)},          {"nose", lengths(s.nose)},
         {"growth", s.growth},         {"turning_deg", degrees(s.turning)},        {"chord_cells", s.chord_cells},
         {"base_cells", s.base_cells}, {"asked_base_cells", s.asked_base_cells}};
  return j;
}

}  // namespace

std::string wing_table(std::span<const WingMeasure> wings, bool is_stretched) {
  constexpr std::size_t kMostWings = 30;
  if (wings.empty()) return "";
  const auto of_chord = [](double LengthsAt::*which, LengthsAt WingStationMeasure::*where) {
    return [=](const WingStationMeasure& s) { return 100 * (s.*where).*which / s.chord; };
  };
  std::vector<TableRow> rows{{"surface at", "triangles", "covered", "held", "asked", "nose, % chord", "trailing edge"}};
  if (is_stretched) rows[0].insert(rows[0].end(), {"nose along", "trailing along"});
  rows[0].insert(rows[0].end(), {"chord cells", "base cells", "growth", "turning, deg"});
  const bool has_cad = std::ranges::any_of(wings, [](const WingMeasure& w) { return w.deviation.has_value(); });
  if (has_cad) rows[0].emplace_back("off, % chord");
  for (const WingMeasure& w : wings) {
    TableRow row{fmt::format("edge {}", w.first_edge + 1),
                 std::to_string(w.n_triangles),
                 fmt::format("{:.0f} %", 100 * w.covered),
                 fmt::format("{:.0f} %", 100 * w.held),
                 at_stations(w, "{:.2g}", [](const auto& s) { return 100 * s.asked / s.chord; }),
                 at_stations(w, "{:.2g}", of_chord(&LengthsAt::normal, &WingStationMeasure::nose)),
                 at_stations(w, "{:.2g}", of_chord(&LengthsAt::normal, &WingStationMeasure::trailing))};
    if (is_stretched) {
      row.push_back(at_stations(w, "{:.2g}", of_chord(&LengthsAt::along, &WingStationMeasure::nose)));
      row.push_back(at_stations(w, "{:.2g}", of_chord(&LengthsAt::along, &WingStationMeasure::trailing)));
    }
    row.push_back(at_stations(w, "{:.0f}", [](const auto& s) { return s.chord_cells; }));
    row.push_back(at_stations(w, "{:.1f}", [](const auto& s) { return s.base_cells; }));
    row.push_back(at_stations(w, "{:.2f}", [](const auto& s) { return s.growth; }));
    row.push_back(at_stations(w, "{:.0f}", [](const auto& s) { return degrees(s.turning); }));
    if (has_cad) row.push_back(w.deviation ? fmt::format("{:.2g}", 100 * *w.deviation) : "-");
    rows.push_back(std::move(row));
    if (rows.size() > kMostWings) break;
  }
  std::string text = "  lifting surfaces, from root to tip:\n";
  for (const std::string& line : aligned_columns(rows, rows[0].size() - 1)) text += line + "\n";
  const std::size_t n_more = wings.size() + 1 - rows.size();
  return n_more ? text + fmt::format("  and {} more: see --json\n", n_more) : text;
}

std::string wing_lines(std::span<const WingMeasure> wings) {
  constexpr std::size_t kMostLines = 5;
  std::string text;
  for (const WingMeasure& w : wings.first(std::min(kMostLines, wings.size()))) {
    const auto of_chord = [&w](LengthsAt WingStationMeasure::*where) {
      return at_stations(w, "{:.2g}", [where](const auto& s) { return 100 * (s.*where).normal / s.chord; });
    };
    text +=
        fmt::format("  {:<20} nose {} % of the chord, trailing edge {} %; asked {} %, held on {:.0f} % of the span\n",
                    fmt::format("wing at edge {}{}", w.first_edge + 1, w.group.empty() ? "" : ", " + w.group),
                    of_chord(&WingStationMeasure::nose), of_chord(&WingStationMeasure::trailing),
                    at_stations(w, "{:.2g}", [](const auto& s) { return 100 * s.asked / s.chord; }), 100 * w.held);
  }
  if (wings.size() > kMostLines) text += fmt::format("  and {} more lifting surfaces\n", wings.size() - kMostLines);
  return text;
}

json wing_measures_json(std::span<const WingMeasure> wings) {
  json list = json::array();
  for (const WingMeasure& w : wings) {
    json stations = json::array();
    for (const WingStationMeasure& s : w.stations) stations.push_back(wing_station_json(s));
    json entry{{"edge", w.first_edge + 1},   {"span", w.span},      {"covered", w.covered}, {"has_noses", w.has_noses},
               {"triangles", w.n_triangles}, {"stations", stations}};
    entry["held"] = w.held;
    if (w.worst)
      entry["worst"] = {{"what", w.worst->what},
                        {"share", w.worst->share},
                        {"xyz", {w.worst->place.x, w.worst->place.y, w.worst->place.z}},
                        {"factor", w.worst->has / w.worst->asked}};
    if (w.deviation) entry["deviation"] = *w.deviation;
    list.push_back(std::move(entry));
  }
  return list;
}

std::vector<WingMiss> find_misses(std::span<const WingMeasure> wings) {
  constexpr double kMissed = 1.5;  // length over that asked for
  std::vector<WingMiss> misses;
  for (std::size_t w = 0; w < wings.size(); ++w) {
    const auto add = [&](WingMiss miss, bool is_base) {
      const double factor = is_base ? miss.asked / miss.has : miss.has / miss.asked;
      miss.wing = w;
      if (factor > kMissed) misses.push_back(miss);
    };
    for (const WingStationMeasure& s : wings[w].stations) {
      if (s.asked > 0) {
        add({w, s.share, s.place, "nose", s.nose.normal / s.chord, s.asked / s.chord}, false);
        add({w, s.share, s.place, "trailing edge", s.trailing.normal / s.chord, s.asked / s.chord}, false);
      }
      if (s.base_cells > 0) add({w, s.share, s.place, "base", s.base_cells, s.asked_base_cells}, true);
    }
    const std::optional<WingMiss>& worst = wings[w].worst;
    const auto is_worst = [&](const WingStationMeasure& s) { return s.share == worst->share; };
    if (worst && std::ranges::none_of(wings[w].stations, is_worst)) add(*worst, false);
  }
  return misses;
}

}  // namespace st
