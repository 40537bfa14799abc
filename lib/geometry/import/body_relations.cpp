#include "geometry/import/body_relations.h"

#include <algorithm>
#include <set>

#include "base/log.h"
#include "geometry/import/crossing_bodies.h"
#include "geometry/import/solid_contacts.h"
#include "geometry/import/touching_bodies.h"
#include "geometry/import/unite.h"

namespace st::occt {
namespace {

std::string part_name(const ModelTables& t, FaceId f) {
  const std::string& path = t.labels.path_of(f);
  if (!path.empty()) return path;
  const std::string& group = t.labels.group_name[t.labels.face_group[f]];
  return t.face_solid[f] == kNone ? group : group + " (solid " + std::to_string(t.face_solid[f] + 1) + ")";
}

void say_what_crosses(const ModelTables& t, const std::vector<BodyCrossing>& crossings,
                      std::vector<ImportFinding>& findings) {
  for (const BodyCrossing& c : crossings)
    findings.push_back({FindingKind::kOverlap, t.face_label(c.of_edge), c.xyz, 0, false,
                        part_name(t, c.of_edge) + " and " + part_name(t, c.face)});
}

/// Solids that cross others cannot be joined where they touch.
std::set<int> crossing_solids(const ModelTables& t, const std::vector<BodyCrossing>& crossings) {
  std::set<int> solids;
  for (const BodyCrossing& c : crossings) solids.insert({t.face_solid[c.of_edge], t.face_solid[c.face]});
  return solids;
}

/// Solids that lie on each other and were not asked to be joined, group by group.
void say_what_touches(const ImportedShape& model, const ModelTables& t, const std::set<int>& left_out,
                      std::vector<ImportFinding>& findings) {
  for (std::vector<int>& group : find_touching_solids(model, t).groups) {
    std::erase_if(group, [&](int i) { return left_out.count(i) > 0; });
    if (group.size() < 2) continue;
    std::vector<FaceId> first;
    for (std::size_t k = 0; k < 2; ++k)
      first.push_back(
          static_cast<FaceId>(std::find(t.face_solid.begin(), t.face_solid.end(), group[k]) - t.face_solid.begin()));
    const Box3& box = t.face_box[first[0]];
    findings.push_back({FindingKind::kTouching, "", box.center(), box.diagonal(), false,
                        std::to_string(group.size()) + " bodies, among them " + part_name(t, first[0]) + " and " +
                            part_name(t, first[1])});
  }
}

}  // namespace

void relate_bodies(ImportedShape& model, ModelOfFile& tables, const ImportOptions& options, bool has_new_air,
                   std::vector<ImportFinding>& findings, const std::string& path, Progress& progress) {
  const auto unite = [&] {
    progress.step("uniting bodies", 0.65);
    unite_solids(model, tables, options.unite_seconds, findings, path);
  };
  if (options.unite) unite();
  progress.step("bodies that cross", 0.67);
  CrossingBodies crossings = find_crossing_bodies(model, tables.tables, tables.measures);
  if (has_new_air && !options.unite && !crossings.found.empty()) {
    unite();
    crossings = find_crossing_bodies(model, tables.tables, tables.measures);
  }
  if (crossings.n_not_compared > 0)
    log_info(
        "  " + std::to_string(crossings.n_not_compared) +
        " pairs of bodies that are near each other were not compared to the end; st-check finds crossings in the mesh");
  say_what_crosses(tables.tables, crossings.found, findings);
  const bool joins = options.join_touching || (has_new_air && !options.unite);
  const std::set<int> left_out = crossing_solids(tables.tables, crossings.found);
  progress.step("bodies that touch", 0.68);
  (joins ? join_touching_solids : join_self_touching_solids)(model, tables, left_out, findings, path);
  if (!joins && !options.unite) say_what_touches(model, tables.tables, left_out, findings);
}

}  // namespace st::occt
