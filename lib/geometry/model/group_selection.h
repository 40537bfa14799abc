// What one entry of a groups file selects. Internal to geometry.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "geometry/model/groups.h"

namespace st {

/// Throws Error(kUsage) that names the rule's place and group.
[[noreturn]] void fail_group(const GroupRule& rule, const std::string& what);

/// Throws Error(kUsage) naming rule and key for a length or coordinate with a unit of its own where the model has no
/// unit: known before anything is looked for.
void require_unit(const GroupRule& rule, const std::optional<double>& unit_in_m);

/// Narrows all entities of a kind down to those that meet every selection of a rule. All throw Error(kUsage) by
/// fail_group().
class GroupSelection {
 public:
  using Mask = std::vector<char>;  ///< [n] 1: in the selection
  using Name = std::function<const std::string&(std::int32_t)>;

  /// Starts with all of the `n` entities. Rule and tables outlive the selection.
  GroupSelection(const GroupRule& rule, const ModelTables& tables, std::int32_t n)
      : rule_(rule), t_(tables), chosen_(n, 1) {}

  void keep(const std::function<bool(std::int32_t)>& is_wanted);
  void keep(const Mask& wanted);
  /// Those whose name matches any item; every item must match some. No item: all stay.
  void select_names(const char* key, const std::vector<std::string>& items, const Name& name);
  /// Likewise, items being 1-based ids "17", ranges "17-20" or names; `names` is empty where the entities have none.
  void select_items(const char* key, const std::vector<std::string>& items, const std::vector<std::string>& names);
  /// Those that the rule's boxes hold; an empty box is in none. `tolerance`: how far an entity may stick out of
  /// `inside`.
  void select_boxes(std::span<const Box3> box, std::span<const double> tolerance);

  bool has_selection() const { return has_selection_; }
  /// The result. When it is empty and the rule not optional that is an error: `when_empty` says what is wrong.
  Mask take(const std::string& when_empty);

 private:
  void add_matches(const char* key, const std::string& item, const Name& name, Mask& wanted) const;
  Box3 box_of(const BoxSpec& spec) const;

  const GroupRule& rule_;
  const ModelTables& t_;
  Mask chosen_;
  bool has_selection_ = false;
};

}  // namespace st
