#include "stages/orientation_warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"

namespace st {

std::string list_faces(std::span<const FaceId> faces) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(faces.size(), kShown); ++i)
    text += (i ? ", " : "") + std::to_string(faces[i] + 1);
  return faces.size() > kShown ? fmt::format("{} and {} more", text, faces.size() - kShown) : text;
}

void warn_of_changes(const OrientationReport& report) {
  if (!report.turned_faces.empty())
    log_warning(fmt::format("{} faces were turned to agree with their neighbours: {}", report.turned_faces.size(),
                            list_faces(report.turned_faces)));
  if (report.turned_components)
    log_warning(fmt::format("{} parts were inside out and are turned: faces {}", report.turned_components,
                            list_faces(report.inside_out_faces)));
  if (report.n_one_sided)
    log_warning(
        fmt::format("{} parts are one-sided (like a Moebius strip) and cannot be oriented", report.n_one_sided));
}

}  // namespace st
