#include "stages/run_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/log.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/foreign/size_mesh.h"
#include "io/hdf5/artifact.h"
#include "io/toml/groups_file.h"
#include "io/toml/pair_file.h"
#include "io/toml/size_rule_file.h"
#include "stages/export_stage.h"

namespace st {
namespace {

namespace fs = std::filesystem;

/// Of patches.hdf, from above: bytes per triangle (docs/design/heuristics.md).
constexpr double kPatchBytes = 200;

/// A number of triangles that was asked for: how far off a mesh may be, and how often it is made anew when it is
/// further off (docs/design/heuristics.md).
constexpr double kOffTarget = 0.03;
constexpr int kMostCorrections = 2;

class Run {
 public:
  Run(RunStageOptions options, const PlaceFile& place, const Communicator& comm)
      : o_(std::move(options)), place_(place), comm_(comm) {}

  StageSummary run() {
    if (!o_.said.empty()) json_ = nlohmann::json::parse(o_.said);
    import_model();
    size();
    mesh();
    meet_target();
    merge();
    check();
    report();
    return summarize();
  }

 private:
  std::string place(const char* name, double bytes) const { return place_(name, static_cast<std::uint64_t>(bytes)); }
  static double bytes_of(const std::string& path) {
    std::error_code none;
    const std::uintmax_t bytes = fs::file_size(path, none);
    return none ? 0 : static_cast<double>(bytes);
  }

  void import_model() {
    ImportStageOptions& o = o_.import_options;
    o.model = o_.model;
    o.output = geometry_ = place("geometry.hdf", 2 * bytes_of(o_.model));
    do_part(RunPart::kImport, o.output, [&] { return run_import(o); });
  }

  void size() {
    RasterStageOptions& r = o_.raster;
    r.geometry = geometry_;
    r.output = place("raster.hdf", bytes_of(geometry_));
    do_part(RunPart::kRaster, r.output, [&] {
      return o_.run_ranks ? o_.run_ranks(RunPart::kRaster, {geometry_}, r.output) : run_raster(r, comm_);
    });
    o_.prolong.raster = r.output;
    o_.prolong.output = sizing_ = place("sizing.hdf", 3 * bytes_of(r.output));
    prolong(o_.prolong);
  }

  void prolong(const ProlongStageOptions& p) {
    do_part(RunPart::kProlong, p.output, [&] { return run_prolong(p); });
  }

  void mesh() {
    MeshStageOptions& o = o_.mesh;
    o.geometry = geometry_;
    o.sizing = sizing_;
    o.output = place("patches.hdf", kPatchBytes * expected_triangles_);
    do_part(RunPart::kMesh, o.output, [&] {
      return o_.run_ranks ? o_.run_ranks(RunPart::kMesh, {geometry_, sizing_}, o.output) : run_mesh(o, comm_);
    });
  }

  /// st-prolong can but estimate how many triangles sizes give; the mesh itself tells how far off that was. Of small
  /// meshes, whose edges have few segments, a later one may be further off: then the nearest is made again.
  void meet_target() {
    if (!o_.prolong.target_triangles) return;
    const double target = *o_.prolong.target_triangles;
    const auto miss = [&] { return std::abs(json_["st-mesh"]["triangles"].get<double>() / target - 1); };
    ProlongStageOptions p = o_.prolong;
    const auto make_for = [&](int n_asked) {
      p.target_triangles = n_asked;
      prolong(p);
      mesh();
    };
    o_.first = RunPart::kImport;  // the mesh is there, so nothing of an earlier try is left
    int best = *p.target_triangles;
    double least = miss();
    for (int i = 0; i < kMostCorrections && miss() > kOffTarget; ++i) {
      const double n = json_["st-mesh"]["triangles"].get<double>();
      if (n == 0) return;
      log_step(fmt::format("  {:.0f} triangles, {:.1f} % off the {:.0f} asked for: sizes and mesh are made anew", n,
                           100 * miss(), target));
      make_for(static_cast<int>(std::clamp(*p.target_triangles * target / n, 4.0, 2e9)));
      if (miss() >= least) continue;
      least = miss();
      best = *p.target_triangles;
    }
    if (miss() > least) make_for(best);
    if (miss() > kOffTarget)
      log_warning(
          fmt::format("{}: {:.0f} triangles instead of the {:.0f} asked for; no scale that was tried came "
                      "nearer: take this mesh, or ask for another number",
                      o_.output, json_["st-mesh"]["triangles"].get<double>(), target));
  }

  void merge() {
    MergeStageOptions& m = o_.merge;
    m.patches = {o_.mesh.output};
    m.output = o_.output;
    do_part(RunPart::kMerge, m.output, [&] { return run_merge(m); });
  }

  void check() {
    CheckStageOptions& o = o_.check;
    o.mesh = o_.output;
    o.geometry = geometry_;
    o.sizing = sizing_;
    o.text = verbosity() == Verbosity::kVerbose ? CheckText::kWhole : CheckText::kWithWings;
    do_part(RunPart::kCheck, "", [&] { return run_check(o, o_.report.empty() ? nullptr : &checked_.json); });
  }

  void report() {
    if (o_.report.empty()) return;
    ReportStageOptions o;
    o.artifacts = {o_.output, o_.raster.output};
    o.geometry = geometry_;
    o.sizing = sizing_;
    checked_.passes = verdict_.code == ExitCode::kOk;
    o.checked = std::move(checked_);
    o.output = o_.report;
    do_part(RunPart::kReport, o.output, [&] { return run_report(o); });
  }

  template <class Work>
  void do_part(RunPart part, const std::string& output, const Work& work) {
    if (part < o_.first) return;
    o_.on_part(part);
    const std::string tool = tool_of(part);
    StageSummary s;
    try {
      s = work();
    } catch (const Error& e) {
      throw Error(e.code(), tool + ": " + e.what());
    } catch (const std::bad_alloc&) {
      throw Error(ExitCode::kMemory, out_of_memory(tool + ": ").what());
    }
    json_[tool] = nlohmann::json::parse(s.json);
    o_.on_said(json_.dump());
    if (part == RunPart::kProlong) expected_triangles_ = json_[tool]["expected_triangles"].get<double>();
    if (part == RunPart::kCheck) {
      verdict_ = std::move(s);
      return;
    }
    const std::string own = output + ": ";
    log_step(fmt::format("{:<11}{}", tool, s.line.starts_with(own) ? s.line.substr(own.size()) : s.line));
    const bool may_go_on = part != RunPart::kMesh || o_.merge.allow_incomplete;
    if (s.code != ExitCode::kOk && (part != RunPart::kMesh || !may_go_on))
      throw Error(s.code, tool + ": not everything could be done, " + cause_in_file(part) +
                              "; --allow-incomplete goes on without it, --keep FOLDER keeps what there is");
  }

  /// Faces of facets that cross each other may have no mesh.
  std::string cause_in_file(RunPart part) const {
    if (part == RunPart::kMesh)
      for (const ImportFinding& f : read_geometry(geometry_).findings)
        if (f.kind == FindingKind::kCrossingFacets)
          return fmt::format("and in the file {}, the first one near ({:.6g}, {:.6g}, {:.6g}): repair it", f.what(),
                             f.xyz.x, f.xyz.y, f.xyz.z);
    return "see above";
  }

  StageSummary summarize() {
    StageSummary s = std::move(verdict_);
    std::string files = o_.output;
    for (const std::string& path : o_.merge.exports) files += ", " + path;
    if (!o_.report.empty()) files += ", " + o_.report;
    s.line += fmt::format("\n  {:<20} {}{}", "files", files, gmsh_hint(o_.merge.exports));
    if (!o_.keep.empty()) s.line += fmt::format("; artifacts and options in {}", o_.keep);
    nlohmann::json json{{"tool", "st-run"},
                        {"model", o_.model},
                        {"output", o_.output},
                        {"passes", s.code == ExitCode::kOk},
                        {"seconds", timer_.seconds()}};
    json["triangles"] = json_["st-check"]["triangles"];
    json["failed"] = json_["st-check"]["failed"];
    json["stages"] = std::move(json_);
    s.json = json_text(json);
    return s;
  }

  RunStageOptions o_;
  const PlaceFile& place_;
  const Communicator& comm_;
  const Timer timer_;
  std::string geometry_, sizing_;
  double expected_triangles_ = 0;
  nlohmann::json json_ = nlohmann::json::object();  // what each tool says
  StageSummary verdict_;
  Verdict checked_;  // for the report
};

}  // namespace

const char* tool_of(RunPart part) {
  switch (part) {
    case RunPart::kImport:
      return "st-import";
    case RunPart::kRaster:
      return "st-raster";
    case RunPart::kProlong:
      return "st-prolong";
    case RunPart::kMesh:
      return "st-mesh";
    case RunPart::kMerge:
      return "st-merge";
    case RunPart::kCheck:
      return "st-check";
    case RunPart::kReport:
      return "st-report";
  }
  return "";
}

void require_run_inputs(const RunStageOptions& o) {
  o.raster.validate();
  o.prolong.validate();
  o.mesh.validate();
  if (!o.import_options.groups.empty()) read_groups(o.import_options.groups);
  if (!o.raster.sizes.empty()) read_size_rules(o.raster.sizes);
  if (!o.mesh.pairs.empty() && o.mesh.pairs != "auto") read_pair_file(o.mesh.pairs);
  std::vector<std::string> files = o.prolong.sources;
  if (!o.prolong.blank.empty()) files.push_back(o.prolong.blank);
  if (!o.prolong.background.empty()) files.push_back(files_of_size_mesh(o.prolong.background)[0]);
  for (const std::string& path : files) open_to_read(path);
}

void require_run_outputs(const RunStageOptions& o) {
  MergeStageOptions merge = o.merge;
  merge.output = o.output;
  require_merge_outputs(merge);
  if (!o.report.empty()) require_page(o.report);
  CheckStageOptions check = o.check;
  check.geometry = check.sizing = o.output;  // there will be some
  check.validate();
}

StageSummary run_all(const RunStageOptions& options, const PlaceFile& place, const Communicator& comm) {
  return Run(options, place, comm).run();
}

}  // namespace st
