#include "geometry/model/unused_labels.h"

#include <initializer_list>
#include <utility>

namespace st {
namespace {

/// Renumbers the ids in use, in their order; returns for each old id the new one or kNone.
std::vector<std::int32_t> renumber(std::vector<std::int32_t>& ids, std::size_t n_old) {
  std::vector<std::int32_t> number(n_old, kNone);
  for (const std::int32_t id : ids)
    if (id != kNone) number[id] = 0;
  std::int32_t n = 0;
  for (std::int32_t& k : number)
    if (k != kNone) k = n++;
  for (std::int32_t& id : ids)
    if (id != kNone) id = number[id];
  return number;
}

/// Keeps the entries of what is in use in each of the columns; empty ones stay so.
void keep_used(const std::vector<std::int32_t>& number, std::initializer_list<std::vector<std::string>*> columns) {
  for (std::vector<std::string>* column : columns) {
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < column->size(); ++i)
      if (number[i] != kNone) kept.push_back(std::move((*column)[i]));
    *column = std::move(kept);
  }
}

std::int32_t count_used(const std::vector<std::int32_t>& number) {
  std::int32_t n = 0;
  for (const std::int32_t k : number) n += k != kNone;
  return n;
}

}  // namespace

void drop_unused(ModelTables& t) {
  FaceLabels& labels = t.labels;
  const std::size_t n_groups = t.labels.group_name.size(), n_parts = labels.part_name.size();
  keep_used(renumber(t.labels.face_group, n_groups),
            {&t.labels.group_name, &t.labels.group_role, &labels.group_attributes});
  keep_used(renumber(labels.face_part, n_parts), {&labels.part_name, &labels.part_path});
  if (labels.part_name.empty()) labels.face_part.clear();
  for (GroupTable& table : labels.tables) {
    const std::size_t n = table.group_name.size();
    keep_used(renumber(table.face_group, n), {&table.group_name, &table.group_role, &table.group_attributes});
  }
  std::erase_if(labels.tables, [](const GroupTable& table) { return table.group_name.empty(); });
  t.n_shells = count_used(renumber(t.face_shell, t.n_shells));
  t.n_solids = count_used(renumber(t.face_solid, t.n_solids));
}

}  // namespace st
