// st-run: one command from CAD to a checked mesh, of one model or of many.
#include <optional>

#include "base/error.h"
#include "common/tool_main.h"
#include "st-run/campaign.h"
#include "st-run/one_run.h"

int main(int argc, char** argv) {
  st::CampaignOptions c;
  st::OneRun run;
  st::RunStageOptions& o = run.options;
  st::ToolMain tool("st-run", "Makes a checked surface mesh of a CAD model: all stages from st-import to st-check.");
  tool.inputs("models", c.models,
              "CAD files, one or several: .step .stp .iges .igs .brep .dat .fli; or facets: .stl .obj .ply .msh .vtu");
  tool.output(o.output, "mesh artifact to write");
  tool.outputs("--export", o.merge.exports,
               "also write the mesh to this file: a suffix that st-export knows; repeatable");
  tool.output_option("--report", o.report, "HTML page to write: the mesh in 3-D, and what was found; default: none");
  tool.folder("--keep", o.keep,
              "keep the artifacts of all stages there, and the options as st-run.toml; default: none is kept");
  tool.execution_number(c.kJobs, c.jobs);
  tool.output_option("--table", c.table,
                     "several models: table to write, one line for each; default: results.csv there");
  tool.output_option("--page", c.page, "several models: HTML page to write, worst first; default: none");
  tool.folder("--into", c.into, "several models: folder that gets a folder of results for each");
  tool.ranks();
  tool.threads();
  run.add_stages(tool);
  tool.main_options({"--export", "--report", "--keep", "--options", "--preset", "--symmetry", "--farfield", "--lmax",
                     "--lmin", "--target-triangles"});
  tool.examples({"st-run wing.step", "st-run half.step --symmetry y=0 --farfield box:20 --preset rans -o half.hdf",
                 "st-run wing.step --lmax 2% --export wing.stl --report wing.html --keep out",
                 "st-run a.step b.step c.step --jobs 2 --table results.csv --page results.html"});
  std::optional<st::Campaign> campaign;
  const auto prepare = [&] {
    if (tool.n_ranks() < 1) throw st::Error(st::ExitCode::kUsage, "--np: the number of ranks must be 1 or more");
    st::require_run_inputs(o);
    o.model = c.models[0];
    if (c.is_asked_for() || tool.is_set("--into")) campaign.emplace(c);
    campaign ? campaign->prepare(tool) : run.prepare(tool);
  };
  return tool.run_in_worker(
      argc, argv,
      {prepare, [&] { return campaign ? campaign->run() : run.run(); },
       [&] { return campaign ? std::string("st-run") : run.part(); }, [&] { return !campaign.has_value(); }});
}
