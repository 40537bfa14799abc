#include "geometry/model/finding.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace st {
namespace {

struct Wording {
  const char* name;
  const char* text;  // "{}": the detail; "": the name
};

/// [FindingKind]
constexpr Wording kWordings[] = {
#define KIND(kind, name, text) {name, text},
#include "geometry/model/finding_kinds.h"
#undef KIND
    {"other", "{}"},
};
constexpr std::size_t kKinds = std::size(kWordings) - 1;  // that are known, without kOther

constexpr std::string_view kDetail = "{}";

const Wording& wording_of(FindingKind kind) { return kWordings[std::min(static_cast<std::size_t>(kind), kKinds)]; }

}  // namespace

const char* name_of(FindingKind kind) { return wording_of(kind).name; }

std::string ImportFinding::what() const {
  const Wording& wording = wording_of(kind);
  std::string text = *wording.text ? wording.text : wording.name;
  if (const std::size_t at = text.find(kDetail); at != std::string::npos) text.replace(at, kDetail.size(), detail);
  return text;
}

void restore_kind(ImportFinding& finding, std::uint8_t kind, const std::string& detail, const std::string& what) {
  const bool is_known = kind < kKinds;
  finding.kind = is_known ? static_cast<FindingKind>(kind) : FindingKind::kOther;
  finding.detail = is_known ? detail : what;
}

}  // namespace st
