// "Did you mean": the name that somebody who misspelt one had in mind.
#pragma once

#include <span>
#include <string>

namespace st {

/// The first of the names that the fewest changes of a letter (any case) turn `name` into; empty when that takes more
/// than a third of its letters.
std::string nearest_name(const std::string& name, std::span<const std::string> names);

/// ", did you mean 'flap'" for a message; empty where nothing is near.
std::string did_you_mean(const std::string& name, std::span<const std::string> names);

}  // namespace st
