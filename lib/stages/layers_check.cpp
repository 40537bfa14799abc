#include "stages/layers_check.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/required_unit.h"
#include "base/text.h"
#include "mesh/layers.h"

namespace st {
namespace {

constexpr const char* kOption = "--layers";

double number_of(const std::string& text, const char* what, double above) {
  const std::optional<double> value = as_number(text);
  if (!value || *value <= above)
    throw Error(ExitCode::kUsage, fmt::format("{}: \"{}\" is no {} above {}; write HEIGHT, HEIGHT,GROWTH or "
                                              "Re=NUMBER@LENGTH,GROWTH, such as 5mm,1.2 or Re=6e6@2.5m",
                                              kOption, text, what, above));
  return *value;
}

std::vector<LayerRole> roles_of(const SurfaceMesh& mesh) {
  std::vector<LayerRole> roles;
  for (std::size_t g = 0; g < mesh.labels.group_name.size(); ++g) {
    const std::string role = role_of(mesh.labels, g);
    roles.push_back(role == "symmetry"                          ? LayerRole::kPlane
                    : role == "farfield" || role == "interface" ? LayerRole::kNone
                                                                : LayerRole::kWall);
  }
  return roles;
}

double wall_diagonal(const SurfaceMesh& mesh, const std::vector<LayerRole>& roles) {
  Box3 box;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    if (roles[mesh.triangle_group[t]] == LayerRole::kWall)
      for (const NodeId n : mesh.triangles[t].n) box.add(mesh.node_xyz[n]);
  return box.diagonal();
}

/// What the outermost layer is against the triangles below it: volumes go on well where it is about 1.
std::string last_layer(const LayersRequest& request, double height, double median) {
  if (!request.growth || !(median > 0)) return "";
  const double last = height * (1 - 1 / *request.growth);
  return fmt::format("; the last layer of many is {:.3g}, {:.2g} of the triangles' median side", last, last / median);
}

}  // namespace

double LayersRequest::height(const LengthReference& reference) const {
  const double own = resolve_length(length, reference, kOption);
  return reynolds ? boundary_layer_thickness(*reynolds, own) : own;
}

LayersRequest parse_layers(const std::string& text) {
  LayersRequest request;
  std::string height = text;
  if (const std::size_t comma = text.rfind(','); comma != std::string::npos) {
    request.growth = number_of(text.substr(comma + 1), "growth", 1);
    height = text.substr(0, comma);
  }
  if (height.starts_with("Re=") || height.starts_with("re=")) {
    const std::size_t at = height.find('@');
    if (at == std::string::npos)
      throw Error(ExitCode::kUsage, fmt::format("{}: a Reynolds number needs the length that it refers to, such as "
                                                "Re=6e6@2.5m",
                                                kOption));
    request.reynolds = number_of(height.substr(3, at - 3), "Reynolds number", 0);
    height = height.substr(at + 1);
  }
  request.length = parse_length(height, kOption);
  return request;
}

std::vector<Check> layers_checks(const SurfaceMesh& mesh, bool has_flow_domain, const std::optional<double>& unit_in_m,
                                 const LayersRequest& request) {
  require_unit(request.length, unit_in_m, kOption);
  const std::vector<LayerRole> roles = roles_of(mesh);
  const double height = request.height({wall_diagonal(mesh, roles), unit_in_m});
  const LayersReport r = check_layers(mesh, roles, {height, has_flow_domain});
  const Vec3 at = r.widest_at;
  return {{"layer-directions", "nodes on walls without a direction that all their triangles see", r.blind, true,
           fmt::format("layers {:.4g} high on {} nodes; directions and normals differ by {:.1f} deg at most, at "
                       "({:.6g} {:.6g} {:.6g}){}",
                       height, r.n_nodes, degrees(r.widest), at.x, at.y, at.z, last_layer(request, height, r.median))},
          {"layer-fans", "edges around which layers have to fan out (flow over more than 300 deg)", r.fans, false,
           r.fans.count ? fmt::format("{:.4g} long in all", r.fan_length) : ""},
          {"layer-wedges", "edges where layers of both sides collide (walls at less than 60 deg)", r.wedges, false,
           r.wedges.count ? fmt::format("{:.4g} long in all", r.wedge_length) : ""},
          {"layer-room", "nodes with another wall nearer than two heights", r.tight, false,
           r.tight.count ? fmt::format("down to {:.3g} of that; layers have to be thinner there", r.room) : ""}};
}

}  // namespace st
