#include "stages/metric_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/boxes.h"
#include "base/error.h"
#include "base/log.h"
#include "base/nearest_name.h"
#include "base/progress.h"
#include "base/text.h"
#include "io/export/metric_export.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/foreign/size_mesh.h"
#include "sizing/multiscale_metric.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

/// Of its two corners; empty without text.
std::optional<Box3> parse_box(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::istringstream in(text);
  Vec3 a, b;
  std::string rest;
  if (!(in >> a.x >> a.y >> a.z >> b.x >> b.y >> b.z) || in >> rest)
    throw Error(ExitCode::kUsage, fmt::format("--box '{}': takes two corners, 'X Y Z X Y Z'", text));
  Box3 box;
  box.add(a);
  box.add(b);
  return box;
}

void require_valid(const MetricStageOptions& o) {
  o.kNodes.require(o.nodes);
  o.kNorm.require(o.norm);
  o.kMaxAspect.require(o.max_aspect);
  o.kLeast.require(o.least);
  o.kGreatest.require(o.greatest);
  if (o.least && o.greatest && !(*o.least < *o.greatest))
    throw Error(ExitCode::kUsage, fmt::format("--lmin {:g} is not below --lmax {:g}", *o.least, *o.greatest));
}

/// A metric does not depend on the unit of its field; numbers up to one stay numbers in all that is made of them. By a
/// power of two, so that nothing is rounded.
void scale_to_one(std::vector<double>& value) {
  double largest = 0;
  for (const double v : value) largest = std::max(largest, std::abs(v));
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (double& v : value) v = std::ldexp(v, -exponent);
}

/// The mesh of all fields, and the second derivatives of each.
struct FieldSet {
  BackgroundMesh mesh;
  std::vector<std::int32_t> cell_group;                          // of the first field, see FieldMesh
  std::vector<std::pair<std::string, std::int32_t>> group_name;  // likewise
  std::vector<std::vector<SymmetricTensor>> hessian;             // [fields][nodes]
};

FieldSet read_fields(const std::vector<std::string>& files, Progress& progress) {
  FieldSet set;
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.step(files[i], static_cast<double>(i) / static_cast<double>(files.size() + 1));
    FieldMesh field = read_field_mesh(files[i]);
    if (i == 0) {
      set.mesh = std::move(field.mesh);
      set.cell_group = std::move(field.cell_group);
      set.group_name = std::move(field.group_name);
    } else if (field.mesh.node_xyz != set.mesh.node_xyz || field.mesh.tets != set.mesh.tets ||
               field.mesh.triangles != set.mesh.triangles) {
      throw Error(ExitCode::kInput,
                  fmt::format("{}: is on another mesh than {}; give fields on one mesh", files[i], files[0]));
    }
    scale_to_one(field.value);
    NodeHessians fit = fit_hessians(set.mesh, field.value);
    if (fit.n_unknown > 0)
      log_warning(fmt::format("{}: {} of {} nodes have too few others around them to tell how the field curves there",
                              files[i], fit.n_unknown, set.mesh.node_xyz.size()));
    set.hessian.push_back(std::move(fit.of_node));
  }
  return set;
}

/// Asked in order, once each.
template <class Cell, class IsOutside>
void keep_unless(const IsOutside& is_outside, std::vector<Cell>& cells) {
  std::vector<Cell> kept;
  for (const Cell& cell : cells)
    if (!is_outside(cell)) kept.push_back(cell);
  cells = std::move(kept);
}

/// The number of a group. Throws Error(kUsage) where no cell is in one of this name or number.
std::int32_t number_of_group(const MetricStageOptions& o, const FieldSet& set) {
  std::optional<double> number = as_number(o.group);
  std::vector<std::string> names;
  for (const auto& [name, of_name] : set.group_name) {
    names.push_back(name);
    if (name == o.group) number = of_name;
  }
  const auto found = std::find_if(set.cell_group.begin(), set.cell_group.end(),
                                  [&](std::int32_t g) { return number && g == *number; });
  if (found != set.cell_group.end()) return *found;
  const std::string why = set.cell_group.empty() ? "it has no groups: references of Medit, or an array 'group' of VTK"
                                                 : "no cell is in it" + did_you_mean(o.group, names);
  throw Error(ExitCode::kUsage, fmt::format("--group {}: not in {}: {}", o.group, o.fields[0], why));
}

/// Leaves the cells that are in the group and have a node in the box. Throws Error(kUsage) where there is none.
void restrict_to(const std::optional<Box3>& box, const MetricStageOptions& o, FieldSet& set) {
  std::size_t at = 0;  // among all cells: volumes have no triangles
  const bool has_group = !o.group.empty();
  const std::int32_t group = has_group ? number_of_group(o, set) : 0;
  const auto is_outside = [&](const auto& cell) {
    if (has_group && set.cell_group[at++] != group) return true;
    return box && std::none_of(cell.begin(), cell.end(),
                               [&](std::int32_t n) { return distance2(set.mesh.node_xyz[n], *box) == 0; });
  };
  keep_unless(is_outside, set.mesh.tets);
  keep_unless(is_outside, set.mesh.triangles);
  if (set.mesh.is_empty())
    throw Error(ExitCode::kUsage, fmt::format("--box '{}': no node of the {} is in it; is it in its unit?", o.box,
                                              has_group ? "group" : "mesh"));
  const std::vector<std::int32_t> kept = number_used_nodes(set.mesh);
  keep_only(kept, set.mesh.node_xyz);
  for (std::vector<SymmetricTensor>& hessian : set.hessian) keep_only(kept, hessian);
}

MetricOptions options_for(const MetricStageOptions& o, const BackgroundMesh& mesh) {
  Box3 box;
  for (const Vec3 x : mesh.node_xyz) box.add(x);
  MetricOptions options;
  options.n_nodes = o.nodes.value_or(static_cast<double>(mesh.node_xyz.size()));
  options.norm = o.norm;
  options.max_aspect = o.max_aspect;
  options.least = o.least.value_or(0);
  options.greatest = o.greatest.value_or(norm(box.hi - box.lo));
  if (!(options.least < options.greatest))
    throw Error(ExitCode::kUsage,
                fmt::format("--lmin {:g} is above the diagonal of the mesh, {:.4g}; is it in its unit?", options.least,
                            options.greatest));
  return options;
}

/// Smallest and largest length.
std::pair<double, double> length_range(const std::vector<SymmetricTensor>& metrics) {
  double least = HUGE_VAL, greatest = 0;
  for (const SymmetricTensor& m : metrics) {
    const LocalSize size = size_of_metric(m);
    least = std::min(least, size.length);
    greatest = std::max(greatest, size.along);
  }
  return {least, greatest};
}

}  // namespace

StageSummary run_metric(const MetricStageOptions& o) {
  constexpr double kSameNodes = 0.01;  // of the number that was asked for
  const Timer timer;
  require_valid(o);
  const std::optional<Box3> box = parse_box(o.box);
  const std::array<std::string, 2> files = metric_files(o.output);
  require_derived_outputs({files[0]});
  for (const std::string& file : files) require_writable(file);
  Progress progress("metric", 1);
  FieldSet set = read_fields(o.fields, progress);
  if (box || !o.group.empty()) restrict_to(box, o, set);
  const MetricOptions options = options_for(o, set.mesh);
  MultiscaleMetric metric(set.mesh, options);
  bool has_any = false;
  for (std::size_t i = 0; i < set.hessian.size(); ++i) {
    const bool curves = metric.add(set.hessian[i]);
    has_any = has_any || curves;
    if (!curves) log_warning(o.fields[i] + ": is linear everywhere and asks for nothing");
  }
  if (!has_any)
    throw Error(ExitCode::kInput, o.fields[0] +
                                      ": no field curves anywhere, so that none tells lengths; is it the "
                                      "right array?");
  const std::vector<SymmetricTensor> metrics = metric.metrics();
  const double n_nodes = metric.n_nodes();
  if (std::abs(n_nodes - options.n_nodes) > kSameNodes * options.n_nodes)
    log_warning(fmt::format("the sizes ask for about {:.0f} nodes instead of {:.0f}: --lmin and --lmax allow no other",
                            n_nodes, options.n_nodes));
  export_metric(o.output, set.mesh, metrics);
  const auto [least, greatest] = length_range(metrics);
  StageSummary summary;
  summary.line = fmt::format("{}: {} nodes with lengths {:.4g} to {:.4g}, for about {:.0f} nodes, {:.2f} s", o.output,
                             metrics.size(), least, greatest, n_nodes, timer.seconds());
  summary.json = json_text(Json{{"tool", "st-metric"},
                                {"output", o.output},
                                {"mesh", files[0]},
                                {"nodes", metrics.size()},
                                {"expected_nodes", n_nodes},
                                {"lmin", least},
                                {"lmax", greatest},
                                {"seconds", timer.seconds()}});
  return summary;
}

}  // namespace st
