// JSON as text, whatever bytes its strings hold.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace st {

/// The JSON as text; indented by `indent` columns, -1: on one line. Names of files, faces and groups need not be UTF-8:
/// what is not becomes U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace st
