#include "stages/size_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/length.h"
#include "sizing/size_field.h"
#include "stages/expected_triangles.h"
#include "stages/text_table.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::vector<std::string> table_of(const std::vector<GroupSizes>& groups, const CauseNames& names, std::size_t most,
                                  bool has_triangles, const std::string& unit) {
  const std::string comma_unit = unit.empty() ? "" : ", " + unit;
  std::vector<TableRow> rows{
      {"group", "triangles", "least length" + comma_unit, "median" + comma_unit, "most because of"}};
  for (std::size_t i = 0; i < std::min(groups.size(), most); ++i) {
    const GroupSizes& g = groups[i];
    rows.push_back({g.name, fmt::format("{:.0f}", g.triangles), fmt::format("{:.4g}", g.least),
                    fmt::format("{:.4g}", g.median),
                    fmt::format("{} ({})", cause_text(names, g.causes[0].cause), percent(g.share(g.causes[0])))});
  }
  if (!has_triangles)
    for (TableRow& row : rows) row.erase(row.begin() + 1);
  std::vector<std::string> lines = aligned_columns(rows, has_triangles ? 3 : 2);
  if (groups.size() > most) lines.push_back(fmt::format("  and {} more", groups.size() - most));
  return lines;
}

}  // namespace

SizeTally::SizeTally(std::vector<std::string> names, std::vector<std::int32_t> group_of_face)
    : group_of_face_(std::move(group_of_face)) {
  for (std::string& name : names) groups_.push_back({std::move(name), {}, {}});
}

void SizeTally::add(const SizedPart& part) {
  const std::int32_t g = group_of_face_[part.face];
  if (g == kNone) return;
  Group& group = groups_[g];
  Share& share = group.causes.try_emplace(part.cause, Share{{}, part.least}).first->second;
  share.weight.add(part.weight);
  share.least = std::min(share.least, part.least);
  group.lengths.push_back({static_cast<float>(part.length()), static_cast<float>(part.area)});
}

/// The length below which half of the area lies.
double SizeTally::median(std::vector<LengthOnArea> lengths) {
  std::stable_sort(lengths.begin(), lengths.end(),
                   [](const LengthOnArea& a, const LengthOnArea& b) { return a.length < b.length; });
  double total = 0, below = 0;
  for (const LengthOnArea& l : lengths) total += static_cast<double>(l.area);
  for (const LengthOnArea& l : lengths)
    if ((below += static_cast<double>(l.area)) >= 0.5 * total) return static_cast<double>(l.length);
  return static_cast<double>(lengths.back().length);
}

GroupSizes SizeTally::sizes_of(const Group& group, double scale, double unit) {
  GroupSizes sizes{group.name, 0, std::numeric_limits<double>::infinity(), 0, {}};
  for (const auto& [cause, share] : group.causes) {
    const double triangles = kTrianglesPerWeight * share.weight.at(scale);
    sizes.causes.push_back({cause, triangles, scale * unit * share.least});
    sizes.triangles += triangles;
    sizes.least = std::min(sizes.least, sizes.causes.back().least);
  }
  sizes.median = std::max(sizes.least, scale * unit * median(group.lengths));
  for (const LengthOnArea& l : group.lengths)
    sizes.largest = std::max(sizes.largest, scale * unit * static_cast<double>(l.length));
  std::stable_sort(sizes.causes.begin(), sizes.causes.end(),
                   [](const CauseShare& a, const CauseShare& b) { return a.triangles > b.triangles; });
  return sizes;
}

std::vector<GroupSizes> SizeTally::groups(double scale, double unit) const {
  std::vector<GroupSizes> all;
  for (const Group& group : groups_)
    if (!group.causes.empty()) all.push_back(sizes_of(group, scale, unit));
  std::stable_sort(all.begin(), all.end(),
                   [](const GroupSizes& a, const GroupSizes& b) { return a.triangles > b.triangles; });
  return all;
}

SizeTally tally_by_group(const FaceLabels& labels, std::int32_t n_faces) {
  if (labels.group_name.size() > 1) return {labels.group_name, labels.face_group};
  const std::string name = labels.group_name.empty() ? "model" : labels.group_name.front();
  return {{name}, std::vector<std::int32_t>(static_cast<std::size_t>(n_faces), 0)};
}

std::vector<std::string> group_lines(const std::vector<GroupSizes>& groups, const CauseNames& names, std::size_t most,
                                     const std::string& unit) {
  return table_of(groups, names, most, true, unit);
}

std::string range_text(const std::vector<GroupSizes>& groups, const std::string& unit) {
  if (groups.empty()) return "";
  const auto least = std::min_element(groups.begin(), groups.end(),
                                      [](const GroupSizes& a, const GroupSizes& b) { return a.least < b.least; });
  const auto largest = std::max_element(groups.begin(), groups.end(),
                                        [](const GroupSizes& a, const GroupSizes& b) { return a.largest < b.largest; });
  return fmt::format(", lengths {:.4g} to {:.4g}{} on the faces", least->least, largest->largest, in_unit(unit));
}

std::vector<GroupSizes> sampled_groups(const RasterArtifact& raster) {
  SizeTally tally = tally_by_group(raster.model.labels, raster.model.faces.n_faces());
  for (FaceId f = 0; f < raster.model.faces.n_faces(); ++f)
    for (std::int64_t k = raster.model.faces.offsets[f]; k < raster.model.faces.offsets[f + 1]; ++k) {
      const std::int32_t leaf = raster.model.faces.leaf[k];
      const double length = static_cast<double>(raster.octree.stored_length[leaf]),
                   area = static_cast<double>(raster.model.faces.area[k]);
      if (std::isfinite(length))
        tally.add({f, raster.octree.stored_cause[leaf], area, length, {area / (length * length), 0}});
    }
  return tally.groups(1, 1);
}

std::vector<std::string> sampled_lines(const std::vector<GroupSizes>& groups, const CauseNames& names, std::size_t most,
                                       const std::string& unit) {
  return table_of(groups, names, most, false, unit);
}

Json groups_json(const std::vector<GroupSizes>& groups, const CauseNames& names) {
  Json all = Json::array();
  for (const GroupSizes& g : groups)
    all.push_back({{"name", g.name},
                   {"expected_triangles", g.triangles},
                   {"least", g.least},
                   {"median", g.median},
                   {"cause", cause_text(names, g.causes[0].cause)},
                   {"share", g.share(g.causes[0])}});
  return all;
}

Json sampled_json(const std::vector<GroupSizes>& groups, const CauseNames& names) {
  Json all = groups_json(groups, names);
  for (Json& group : all) group.erase("expected_triangles");
  return all;
}

Json causes_json(const GroupSizes& group, const CauseNames& names) {
  Json all = Json::array();
  for (const CauseShare& c : group.causes)
    all.push_back({{"cause", cause_text(names, c.cause)},
                   {"expected_triangles", c.triangles},
                   {"share", group.share(c)},
                   {"least", c.least}});
  return all;
}

std::vector<std::string> cause_lines(const GroupSizes& group, const CauseNames& names, std::size_t most) {
  std::vector<TableRow> rows{{"cause", "triangles", "share", "least length"}};
  const auto add = [&](const std::string& name, const CauseShare& c) {
    rows.push_back({name, fmt::format("{:.0f}", c.triangles), fmt::format("{:.1f} %", 100 * group.share(c)),
                    fmt::format("{:.4g}", c.least)});
  };
  CauseShare rest{kNone, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < group.causes.size(); ++i) {
    const CauseShare& c = group.causes[i];
    if (i < most) {
      add(cause_text(names, c.cause), c);
    } else {
      rest.triangles += c.triangles;
      rest.least = std::min(rest.least, c.least);
    }
  }
  if (group.causes.size() > most) add(fmt::format("{} more", group.causes.size() - most), rest);
  return aligned_columns(rows, 3);
}

}  // namespace st
