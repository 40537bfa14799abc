#include "stages/orientation_warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.h"
#include "base/text.h"

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
    log_warning(fmt::format(
        "{} turned to agree with {}: {}", counted(report.turned_faces.size(), "face was", "faces were"),
        report.turned_faces.size() == 1 ? "its neighbours" : "their neighbours", list_faces(report.turned_faces)));
  if (report.turned_components)
    log_warning(
        fmt::format("{} turned: faces {}",
                    counted(report.turned_components, "part was inside out and is", "parts were inside out and are"),
                    list_faces(report.inside_out_faces)));
  if (report.n_one_sided)
    log_warning(fmt::format("{} one-sided (like a Moebius strip) and cannot be oriented",
                            counted(report.n_one_sided, "part is", "parts are")));
}

}  // namespace st
