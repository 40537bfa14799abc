// Options that take a number: one declaration for --help, the command line, the check of a stage and its messages.
#pragma once

#include <optional>
#include <string>

namespace st {

/// Stands below the field that it describes. The field's initial value is the default; an std::optional has none.
struct NumberOption {
  const char* flag;      ///< "--alpha"
  const char* unit;      ///< what stands for the value in --help and the docs: DEG, SECONDS; N: a count; F: a factor
  const char* interval;  ///< accepted values: "(0, 90]"
  const char* help;      ///< meaning, one line; ends in "; default: ..." where the field is an std::optional

  /// Why a value is refused; empty: it is accepted. Precondition: `interval` is well formed.
  std::string refusal(double value) const;
  /// Throws Error(kUsage) with the flag for a value outside the interval; an absent one is accepted.
  void require(std::optional<double> value) const;
};

}  // namespace st
