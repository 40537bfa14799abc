// Places in messages.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "base/vec.h"

namespace st {

/// "(1, 2.5, 0)".
inline std::string place(Vec3 x) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", x.x, x.y, x.z);
  return text;
}

/// Counts places and keeps the first.
struct Places {
  std::int64_t count = 0;
  std::vector<Vec3> first;
  void add(Vec3 x) {
    constexpr std::size_t kKept = 4;
    ++count;
    if (first.size() < kKept) first.push_back(x);
  }
  std::string text() const {
    std::string result;
    for (const Vec3& x : first) result.append(result.empty() ? "" : ", ").append(place(x));
    return count > static_cast<std::int64_t>(first.size()) ? result.append(", ...") : result;
  }
};

}  // namespace st
