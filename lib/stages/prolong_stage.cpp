#include "stages/prolong_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "base/log.h"
#include "io/sizing_artifact.h"

namespace st {
namespace {

void require_valid(const ProlongStageOptions& o) {
  if (!(o.slope > 0 && o.slope <= 2)) throw Error(ExitCode::kUsage, fmt::format("--slope {}: not in (0, 2]", o.slope));
  if (!(o.scale > 0) || !std::isfinite(o.scale)) throw Error(ExitCode::kUsage, fmt::format("--scale {}: not a positive number", o.scale));
}

SizingArtifact prolong_raster(const ProlongStageOptions& o, RasterArtifact&& raster) {
  SizingArtifact sizing;
  sizing.numbers = raster.numbers;
  sizing.slope = o.slope;
  sizing.scale = o.scale;
  sizing.lengths =
      prolong(raster.octree.shape.view(), raster.octree.stored_length, raster.octree.stored_cause, {o.slope, raster.numbers.far_length});
  sizing.shape = std::move(raster.octree.shape);
  sizing.names = std::move(raster.names);
  const OctreeField field({sizing.shape.view(), sizing.lengths.cells, sizing.lengths.cause, o.slope, o.scale}, nullptr);
  sizing.face_weight = face_weights(raster.faces, sizing.shape.view(), field);
  sizing.header = raster.header;
  sizing.header.schema = "sizing";
  sizing.header.tool = "st-prolong";
  sizing.header.tool_version = ST_VERSION;
  sizing.header.options_json = nlohmann::json{{"slope", o.slope}, {"scale", o.scale}}.dump();
  sizing.header.inputs = {{"raster", std::filesystem::path(o.raster).filename().string(), raster.header.content_hash}};
  return sizing;
}

/// About this many triangles: equilateral ones of the local length.
double expected_triangles(const SizingArtifact& sizing) {
  return std::accumulate(sizing.face_weight.begin(), sizing.face_weight.end(), 0.0) * 4 / std::sqrt(3.0);
}

StageSummary summarize(const ProlongStageOptions& o, const SizingArtifact& sizing, double seconds) {
  const auto [smallest, largest] = std::minmax_element(sizing.lengths.cells.begin(), sizing.lengths.cells.end(),
                                                       [](const CellLength& a, const CellLength& b) { return a.length < b.length; });
  const double lo = o.scale * smallest->length, hi = o.scale * largest->length;
  StageSummary summary;
  summary.line = fmt::format("{}: {} cells, lengths {:.4g} to {:.4g}, slope {:g}, about {:.0f} triangles, {:.2f} s", o.output,
                             sizing.lengths.cells.size(), lo, hi, o.slope, expected_triangles(sizing), seconds);
  summary.json = nlohmann::json{
      {"tool", "st-prolong"},
      {"output", o.output},
      {"cells", sizing.lengths.cells.size()},
      {"lmin", lo},
      {"lmax", hi},
      {"slope", o.slope},
      {"scale", o.scale},
      {"expected_triangles", std::llround(expected_triangles(sizing))},
      {"hash", sizing.header.content_hash},
      {"seconds",
       seconds}}.dump();
  return summary;
}

}  // namespace

StageSummary run_prolong(const ProlongStageOptions& o) {
  const Timer timer;
  require_valid(o);
  require_writable(o.output);
  SizingArtifact sizing = prolong_raster(o, read_raster(o.raster));
  sizing.header.content_hash = write_sizing(o.output, sizing);
  return summarize(o, sizing, timer.seconds());
}

}  // namespace st
