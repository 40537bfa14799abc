// Presets: settings for a purpose, as option files that are built in.
#pragma once

#include <string>
#include <vector>

namespace st {

/// A preset: its name, what it is for, and the option file that it stands for.
struct Preset {
  std::string name, purpose, options;
};

/// From coarse to fine.
const std::vector<Preset>& presets();

/// "preview | euler | rans | fine".
std::string preset_names();

/// Throws Error(kUsage) for a name that no preset has.
const Preset& find_preset(const std::string& name);

}  // namespace st
