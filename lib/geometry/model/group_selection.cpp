#include "geometry/model/group_selection.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/boxes.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "base/required_unit.h"
#include "base/text.h"
#include "geometry/model/model.h"

namespace st {
namespace {

constexpr double kBoxSlack = 1e-6;  // of the model's diagonal: bounding boxes are made of samples and tolerances
constexpr const char* kWhereNamesAre = "; st-info geometry.hdf --groups lists names; or write optional = true";

double coordinate(const GroupRule& rule, const CoordinateSpec& c, const ModelTables& t) {
  if (!c.is_in_metres) return c.value;
  if (!t.unit_in_m) fail_group(rule, "the model has no unit; give plain numbers, or --unit");
  return c.value / *t.unit_in_m;
}

}  // namespace

void fail_group(const GroupRule& rule, const std::string& what) {
  const std::string group =
      "group \"" + rule.name + "\"" + (rule.table.empty() ? "" : " of table \"" + rule.table + "\"");
  throw Error(ExitCode::kUsage, rule.where + ": " + group + ": " + what);
}

void require_unit(const GroupRule& rule, const std::optional<double>& unit_in_m) {
  if (rule.tolerance) require_unit(*rule.tolerance, unit_in_m, rule.where + ": tolerance");
  for (const auto* box : {&rule.selection.inside, &rule.selection.touching})
    for (std::size_t i = 0; *box && i < (*box)->size(); ++i)
      if ((**box)[i].is_in_metres && !unit_in_m)
        fail_group(rule, "the model has no unit; give plain numbers, or --unit");
}

void GroupSelection::keep(const std::function<bool(std::int32_t)>& is_wanted) {
  has_selection_ = true;
  for (std::size_t i = 0; i < chosen_.size(); ++i) chosen_[i] = chosen_[i] && is_wanted(static_cast<std::int32_t>(i));
}

void GroupSelection::keep(const Mask& wanted) {
  keep([&](std::int32_t i) { return wanted[i] != 0; });
}

void GroupSelection::add_matches(const char* key, const std::string& item, const Name& name, Mask& wanted) const {
  bool is_used = false;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (name_matches(item, name(static_cast<std::int32_t>(i)))) wanted[i] = is_used = true;
  if (is_used || rule_.is_optional) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < wanted.size(); ++i) names.push_back(name(static_cast<std::int32_t>(i)));
  fail_group(rule_, std::string(key) + ": '" + item + "' matches nothing" + did_you_mean(item, names) + kWhereNamesAre);
}

void GroupSelection::select_names(const char* key, const std::vector<std::string>& items, const Name& name) {
  if (items.empty()) return;
  Mask wanted(chosen_.size(), 0);
  for (const std::string& item : items) add_matches(key, item, name, wanted);
  keep(wanted);
}

void GroupSelection::select_items(const char* key, const std::vector<std::string>& items,
                                  const std::vector<std::string>& names) {
  if (items.empty()) return;
  const std::string plural = key;
  const auto n = static_cast<std::int64_t>(chosen_.size());
  Mask wanted(chosen_.size(), 0);
  for (const std::string& item : items) {
    const auto range = as_range(item);
    if (!range) {
      if (names.empty()) fail_group(rule_, plural + ": '" + item + "' is not a number; " + plural + " have no names");
      add_matches(
          key, item, [&](std::int32_t i) -> const std::string& { return names[i]; }, wanted);
      continue;
    }
    if (range->first < 1 || range->second > n || range->first > range->second)
      fail_group(rule_,
                 plural + ": " + item + " does not exist, there are " + plural + " 1 to " + std::to_string(n) +
                     "; options such as --symmetry change numbers: use those of an import with the same options");
    std::fill(wanted.begin() + (range->first - 1), wanted.begin() + range->second, 1);
  }
  keep(wanted);
}

Box3 GroupSelection::box_of(const BoxSpec& spec) const {
  double c[6];
  for (int i = 0; i < 6; ++i) c[i] = coordinate(rule_, spec[i], t_);
  const double slack = kBoxSlack * t_.box().diagonal();
  return {{c[0] - slack, c[1] - slack, c[2] - slack}, {c[3] + slack, c[4] + slack, c[5] + slack}};
}

void GroupSelection::select_boxes(std::span<const Box3> box, std::span<const double> tolerance) {
  if (rule_.selection.inside)
    keep([&, chosen = box_of(*rule_.selection.inside)](std::int32_t i) {
      return !box[i].is_empty() && contains(chosen, box[i], tolerance[i]);
    });
  if (rule_.selection.touching)
    keep([&, chosen = box_of(*rule_.selection.touching)](std::int32_t i) {
      return !box[i].is_empty() && meet(chosen, box[i]);
    });
}

GroupSelection::Mask GroupSelection::take(const std::string& when_empty) {
  const bool is_empty = std::find(chosen_.begin(), chosen_.end(), 1) == chosen_.end();
  if (is_empty && !rule_.is_optional) fail_group(rule_, when_empty + kWhereNamesAre);
  return std::move(chosen_);
}

}  // namespace st
