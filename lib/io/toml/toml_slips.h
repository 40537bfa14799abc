// What people write in TOML files that is no TOML.
#pragma once

#include <cstddef>
#include <string>

namespace st {

/// What to do about a line (from 1) of `text` that the parser has refused, "; ..."; empty where nothing is known. A
/// length with a unit without quotes (lmax = 2%) is a slip of which the parser says nothing that helps.
std::string say_toml_slip(const std::string& text, std::size_t line_number);

}  // namespace st
