// What the import found in a model, and what it did about it.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec.h"

namespace st {

/// Artifacts store the numbers.
enum class FindingKind : std::uint8_t {
#define KIND(kind, name, text) kind,
#include "geometry/model/finding_kinds.h"
#undef KIND
  kOther = 255  ///< told by its text alone, or of another version
};

/// Short, for counts: "sewn".
const char* name_of(FindingKind kind);

/// One finding: what, where, what was done.
struct ImportFinding {
  FindingKind kind = FindingKind::kOther;
  std::string entity;  ///< "edge 12 "TE"" or empty
  Vec3 xyz;            ///< model unit
  double size = 0;     ///< length, width, tolerance: model unit
  bool is_repair = false;
  std::string detail = {};  ///< what is particular in the text: "14 free edges before, 0 after"

  /// As messages have it: "sewn: 14 free edges before, 0 after".
  std::string what() const;
};

/// Kind and detail as they were stored with the text; a kind that this version does not know is kOther, with the text.
void restore_kind(ImportFinding& finding, std::uint8_t kind, const std::string& detail, const std::string& what);

}  // namespace st
