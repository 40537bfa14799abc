#include "stages/slope_input.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/near_face_name.h"
#include "base/text.h"
#include "stages/prolong_stage.h"

namespace st {
namespace {

constexpr NumberOption kSlope = ProlongStageOptions::kSlope;

NamedSlope parse_slope(const std::string& item) {
  const std::size_t equals = item.rfind('=');
  NamedSlope result;
  if (equals != std::string::npos) {
    result.name = trimmed(std::string_view(item).substr(0, equals));
    const auto slope = as_number(trimmed(std::string_view(item).substr(equals + 1)));
    result.slope = slope.value_or(0);
    if (slope && !result.name.empty() && kSlope.refusal(result.slope).empty()) return result;
  }
  throw Error(ExitCode::kUsage,
              fmt::format("--slope-of '{}': not understood; write NAME=S with S in {}, such as WING=0.1", item,
                          kSlope.interval));
}

/// [n_faces] 1: the face has this name, or, where none has, belongs to a group or part of it.
std::vector<std::uint8_t> faces_of(const NamedSlope& s, const RasterArtifact& raster) {
  const std::vector<std::string>& face_name = raster.model.labels.face_name;
  std::vector<std::uint8_t> is_in(face_name.size(), 0);
  for (std::size_t f = 0; f < face_name.size(); ++f) is_in[f] = face_name[f] == s.name;
  if (std::find(is_in.begin(), is_in.end(), 1) != is_in.end()) return is_in;
  is_in = find_faces(s.name, raster.model.labels);
  if (is_in.empty())
    throw Error(ExitCode::kUsage, fmt::format("--slope-of '{}': no face, group of faces or part has this name{}; "
                                              "st-info geometry.hdf --groups lists them",
                                              s.name, say_other_name(s.name, raster.model.labels)));
  return is_in;
}

/// Smallest slope that a face is given; 0: none.
std::vector<double> face_slopes(const std::vector<NamedSlope>& slopes, const RasterArtifact& raster) {
  std::vector<double> result(raster.model.labels.face_name.size(), 0);
  for (const NamedSlope& s : slopes) {
    const std::vector<std::uint8_t> is_in = faces_of(s, raster);
    for (std::size_t f = 0; f < result.size(); ++f)
      if (is_in[f]) result[f] = result[f] > 0 ? std::min(result[f], s.slope) : s.slope;
  }
  return result;
}

}  // namespace

std::vector<NamedSlope> parse_slopes(const std::string& text) {
  std::vector<NamedSlope> result;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    result.push_back(parse_slope(text.substr(from, to - from)));
    from = to + 1;
  }
  return result;
}

SlopeSeeds::SlopeSeeds(const std::vector<NamedSlope>& slopes, const RasterArtifact& raster)
    : of_face_(face_slopes(slopes, raster)), of_edge_(raster.model.edge_name.size(), 0) {
  const auto lower = [](double& slope, double other) { slope = slope > 0 ? std::min(slope, other) : other; };
  for (std::int32_t f = 0; f < raster.model.faces.n_faces(); ++f) {
    if (!(of_face_[f] > 0)) continue;
    for (std::int64_t i = raster.model.faces.offsets[f]; i < raster.model.faces.offsets[f + 1]; ++i) {
      const std::int32_t cause = raster.octree.stored_cause[raster.model.faces.leaf[i]];
      if (cause != kNone && cause_kind(cause) == CauseKind::kEdge) lower(of_edge_[cause_id(cause)], of_face_[f]);
    }
  }
}

double SlopeSeeds::of_cause(std::int32_t cause) const {
  if (cause == kNone) return 0;
  if (cause_kind(cause) == CauseKind::kFace) return of_face_[cause_id(cause)];
  return cause_kind(cause) == CauseKind::kEdge ? of_edge_[cause_id(cause)] : 0;
}

}  // namespace st
