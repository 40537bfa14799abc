// Groups of edges and of vertices. Internal to geometry.
#pragma once

#include <span>
#include <vector>

#include "geometry/model/groups.h"
#include "geometry/model/model.h"

namespace st {

/// The part of apply_groups() for the rules of edges, or of vertices: fills t.labels.edge_groups, vertex_groups. Groups
/// of faces, and for vertices those of edges, are in `t` already. Adds the optional groups without a member to `empty`.
void apply_entity_groups(EntityDim of, const std::vector<GroupRule>& rules, ModelTables& t,
                         std::span<const Box3> edge_box, std::vector<EmptyGroup>& empty);

}  // namespace st
