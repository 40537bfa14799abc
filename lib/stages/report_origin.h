// Where the page of st-report comes from: the artifacts of the run, and what was asked for.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace st {

/// The raster that a sizing was made from, where it lies in the same folder; else empty. Throws Error as read_header().
std::string raster_beside(const std::string& sizing);

/// What each artifact says of itself, in the order given, empty names left out: [{"file", "tool", "version", "hash",
/// "options": {...}, "inputs": [{"role", "name", "hash"}, ...]}, ...]. Throws Error as read_header().
nlohmann::ordered_json origins(std::span<const std::string> artifacts);

/// [[stage, seconds], ...] in the order of the chain, of the files <stage>.seconds in a folder; "": none. Throws
/// Error(kInput) for a folder without any.
nlohmann::ordered_json stage_times(const std::string& folder);

}  // namespace st
