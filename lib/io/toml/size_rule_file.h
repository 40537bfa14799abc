// Rules of sizes for parts of a model, as TOML.
#pragma once

#include <string>
#include <vector>

#include "sizing/size_rules.h"

namespace st {

/// Rules of a file, in its order.
struct SizeRuleFile {
  std::vector<SizeRule> rules;
  std::string hash;  ///< of the file's bytes
};

/// Reads the tables [[size]] and [[st-raster.size]] of a file; what else an option file may hold is passed over. Throws
/// Error(kInput) for a file that cannot be read, Error(kUsage) with file and line for what is no rule.
SizeRuleFile read_size_rules(const std::string& path);

}  // namespace st
