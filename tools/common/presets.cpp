#include "common/presets.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"

namespace st {

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = {
      {"preview", "a first look: does the CAD mesh, and where are its features?", R"(
[st-raster]
lmax = "5%"
alpha = 20
edge-size = "1%chord"
base-cells = 1
chord-cells = 15
[st-prolong]
slope = 0.3
)"},
      {"euler", "inviscid flow, and panel methods", R"(
[st-raster]
alpha = 10
edge-size = "0.3%chord"
base-cells = 2
[st-prolong]
slope = 0.2
)"},
      {"rans", "viscous flow: drag", R"(
[st-raster]
alpha = 7
edge-size = "0.1%chord"
base-cells = 4
chord-cells = 40
gap-cells = 8
max-aspect = 100
[st-prolong]
slope = 0.15
)"},
      {"fine", "viscous flow on the fine mesh of a study", R"(
[st-raster]
lmax = "1.5%"
alpha = 5
edge-size = "0.07%chord"
base-cells = 6
chord-cells = 60
gap-cells = 8
max-aspect = 100
[st-prolong]
slope = 0.12
)"},
  };
  return all;
}

std::string preset_names() {
  std::string names;
  for (const Preset& p : presets()) names += (names.empty() ? "" : ", ") + p.name;
  return names;
}

const Preset& find_preset(const std::string& name) {
  const auto& all = presets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Preset& p) { return p.name == name; });
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Preset& p : all) names.push_back(p.name);
    throw Error(ExitCode::kUsage, "--preset: unknown preset '" + name + "'" + did_you_mean(name, names) +
                                      "; use one of " + preset_names());
  }
  return *found;
}

}  // namespace st
