#include "io/hdf5/face_labels_io.h"

#include <algorithm>
#include <functional>

#include "io/hdf5/artifact_checks.h"

namespace st {
namespace {

/// All tables behind one another.
void write_tables(Hdf5Writer& w, const std::vector<GroupTable>& tables) {
  std::vector<std::string> name, group_name, role, attributes;
  std::vector<std::int32_t> offsets = {0}, face_group;
  for (const GroupTable& t : tables) {
    name.push_back(t.name);
    group_name.insert(group_name.end(), t.group_name.begin(), t.group_name.end());
    role.insert(role.end(), t.group_role.begin(), t.group_role.end());
    attributes.insert(attributes.end(), t.group_attributes.begin(), t.group_attributes.end());
    offsets.push_back(static_cast<std::int32_t>(group_name.size()));
    face_group.insert(face_group.end(), t.face_group.begin(), t.face_group.end());
  }
  w.write_strings("/st/table/name", name);
  w.write("/st/table/group_offsets", offsets);
  w.write_strings("/st/table/group_name", group_name);
  w.write_strings("/st/table/group_role", role);
  w.write_strings("/st/table/group_attributes", attributes);
  w.write("/st/table/face_group", face_group, tables[0].face_group.size());
}

std::vector<GroupTable> read_tables(const Hdf5Reader& r, std::size_t n_faces) {
  const std::vector<std::string> name = r.read_strings("/st/table/name"),
                                 group_name = r.read_strings("/st/table/group_name"),
                                 role = r.read_string_rows("/st/table/group_role", group_name.size()),
                                 attributes = r.read_string_rows("/st/table/group_attributes", group_name.size());
  const std::vector<std::int32_t> offsets = r.read_rows<std::int32_t>("/st/table/group_offsets", name.size() + 1);
  require_offsets(r, "/st/table/group_offsets", offsets, group_name.size());
  const std::vector<std::int32_t> face_group = r.read_rows<std::int32_t>("/st/table/face_group", name.size(), n_faces);
  const auto piece = [](const auto& all, std::size_t from, std::size_t to) {
    return std::decay_t<decltype(all)>(all.begin() + static_cast<std::ptrdiff_t>(from),
                                       all.begin() + static_cast<std::ptrdiff_t>(to));
  };
  std::vector<GroupTable> tables;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const std::size_t from = offsets[i], to = offsets[i + 1];
    tables.push_back({name[i], piece(group_name, from, to), piece(role, from, to), piece(attributes, from, to),
                      piece(face_group, i * n_faces, (i + 1) * n_faces)});
    require_ids(r, "/st/table/face_group", tables.back().face_group, to - from, kNone);
  }
  return tables;
}

/// Groups of edges or vertices behind one another, under `path` ("/st/edge_group"); none: nothing.
void write_entity_groups(Hdf5Writer& w, const std::string& path, const std::vector<EntityGroup>& groups) {
  if (groups.empty()) return;
  std::vector<std::string> name, table, attributes;
  std::vector<std::int32_t> offsets = {0}, ids;
  for (const EntityGroup& g : groups) {
    name.push_back(g.name);
    table.push_back(g.table);
    attributes.push_back(g.attributes);
    ids.insert(ids.end(), g.ids.begin(), g.ids.end());
    offsets.push_back(static_cast<std::int32_t>(ids.size()));
  }
  w.write_strings(path + "/name", name);
  w.write_strings(path + "/table", table);
  w.write_strings(path + "/attributes", attributes);
  w.write(path + "/offsets", offsets);
  w.write(path + "/ids", ids);
}

std::vector<EntityGroup> read_entity_groups(const Hdf5Reader& r, const std::string& path) {
  std::vector<EntityGroup> groups;
  if (!r.has(path + "/name")) return groups;
  const std::vector<std::string> name = r.read_strings(path + "/name"),
                                 table = r.read_string_rows(path + "/table", name.size()),
                                 attributes = r.read_string_rows(path + "/attributes", name.size());
  const std::vector<std::int32_t> ids = r.read<std::int32_t>(path + "/ids"),
                                  offsets = r.read_rows<std::int32_t>(path + "/offsets", name.size() + 1);
  require_offsets(r, path + "/offsets", offsets, ids.size());
  for (std::size_t g = 0; g < name.size(); ++g) {
    groups.push_back({name[g], table[g], attributes[g], {ids.begin() + offsets[g], ids.begin() + offsets[g + 1]}});
    const auto& own = groups.back().ids;
    if (own.empty() || own.front() < 0 ||
        std::adjacent_find(own.begin(), own.end(), std::greater_equal<>()) != own.end())
      r.fail(path + "/ids", "are not those of a group: none, or not ascending");
  }
  return groups;
}

std::vector<std::string> read_roles(const Hdf5Reader& r, const std::vector<std::string>& group_name) {
  if (r.has("/st/group/role")) return r.read_string_rows("/st/group/role", group_name.size());
  std::vector<std::string> roles;
  for (const std::string& name : group_name) roles.push_back(role_of_name(name));
  return roles;
}

}  // namespace

void write_labels(Hdf5Writer& w, const FaceLabels& labels) {
  const auto& attributes = labels.group_attributes;
  if (std::any_of(attributes.begin(), attributes.end(), [](const std::string& a) { return a != "{}"; }))
    w.write_strings("/st/group/attributes", labels.group_attributes);
  if (!labels.face_part.empty()) {
    w.write_strings("/st/part/name", labels.part_name);
    w.write_strings("/st/part/path", labels.part_path);
    w.write("/st/face/part", labels.face_part);
  }
  if (!labels.tables.empty()) write_tables(w, labels.tables);
  write_entity_groups(w, "/st/edge_group", labels.edge_groups);
  write_entity_groups(w, "/st/vertex_group", labels.vertex_groups);
}

FaceLabels read_labels(const Hdf5Reader& r, std::size_t n_faces) {
  FaceLabels labels;
  labels.face_name = r.read_string_rows("/st/face/name", n_faces);
  labels.group_name = r.read_strings("/st/group/name");
  labels.group_role = read_roles(r, labels.group_name);
  const std::size_t n_groups = labels.group_name.size();
  if (r.has("/st/face/group")) labels.face_group = r.read_rows<std::int32_t>("/st/face/group", n_faces);
  require_ids(r, "/st/face/group", labels.face_group, n_groups);
  if (r.has("/st/group/attributes")) labels.group_attributes = r.read_string_rows("/st/group/attributes", n_groups);
  if (r.has("/st/face/part")) {
    labels.part_name = r.read_strings("/st/part/name");
    labels.part_path = r.read_string_rows("/st/part/path", labels.part_name.size());
    labels.face_part = r.read_rows<std::int32_t>("/st/face/part", n_faces);
    require_ids(r, "/st/face/part", labels.face_part, labels.part_name.size(), kNone);
  }
  if (r.has("/st/table/name")) labels.tables = read_tables(r, n_faces);
  labels.edge_groups = read_entity_groups(r, "/st/edge_group");
  labels.vertex_groups = read_entity_groups(r, "/st/vertex_group");
  return labels;
}

}  // namespace st
