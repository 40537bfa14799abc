#include "base/number_option.h"

#include <sstream>

#include "base/assert.h"
#include "base/error.h"

namespace st {

std::string NumberOption::refusal(double value) const {
  char open = 0, comma = 0, close = 0;
  double lo = 0, hi = 0;
  std::istringstream(interval) >> open >> lo >> comma >> hi >> close;
  ST_ASSERT((open == '(' || open == '[') && comma == ',' && (close == ')' || close == ']'));
  if ((open == '(' ? value > lo : value >= lo) && (close == ')' ? value < hi : value <= hi)) return "";
  std::ostringstream text;
  text << "must be in " << interval << ", not " << value;
  return text.str();
}

void NumberOption::require(std::optional<double> value) const {
  const std::string text = value ? refusal(*value) : "";
  if (!text.empty()) throw Error(ExitCode::kUsage, std::string(flag).append(": ").append(text));
}

}  // namespace st
