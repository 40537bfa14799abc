#include "stages/slope_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"
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
    const std::string number = trimmed(std::string_view(item).substr(equals + 1));
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), result.slope);
    if (error == std::errc() && end == number.data() + number.size() && !result.name.empty() &&
        kSlope.refusal(result.slope).empty())
      return result;
  }
  throw Error(ExitCode::kUsage,
              fmt::format("--slope-of '{}': not understood; write NAME=S with S in {}, such as WING=0.1", item,
                          kSlope.interval));
}

/// [n_faces] 1: the face has this name, or, where none has, belongs to a group or part of it.
std::vector<std::uint8_t> faces_of(const NamedSlope& s, const RasterArtifact& raster) {
  const std::vector<std::string>& face_name = raster.names.face;
  std::vector<std::uint8_t> is_in(face_name.size(), 0);
  for (std::size_t f = 0; f < face_name.size(); ++f) is_in[f] = face_name[f] == s.name;
  if (std::find(is_in.begin(), is_in.end(), 1) != is_in.end()) return is_in;
  is_in = find_faces(s.name, raster.labels);
  if (is_in.empty())
    throw Error(ExitCode::kUsage, fmt::format("--slope-of '{}': no face, group of faces or part has this name{}; "
                                              "st-info geometry.hdf --groups lists them",
                                              s.name, say_other_kind(s.name, raster.labels)));
  return is_in;
}

/// Smallest slope that a face is given; 0: none.
std::vector<double> face_slopes(const std::vector<NamedSlope>& slopes, const RasterArtifact& raster) {
  std::vector<double> result(raster.names.face.size(), 0);
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

std::vector<float> seed_slopes(const std::vector<NamedSlope>& slopes, const RasterArtifact& raster,
                               const OctreeView& raster_octree, const OctreeView& octree) {
  const std::vector<double> of_face = face_slopes(slopes, raster);
  std::vector<float> seed(octree.leaf_keys.size(), 0);
  for (std::int32_t f = 0; f < raster.faces.n_faces(); ++f) {
    const auto slope = static_cast<float>(of_face[f]);
    if (!(slope > 0)) continue;
    for (std::int64_t i = raster.faces.offsets[f]; i < raster.faces.offsets[f + 1]; ++i) {
      const std::int32_t cell = raster.faces.leaf[i];
      const std::uint64_t key = raster_octree.leaf_keys[cell],
                          n = 1ull << (3 * (kMaxLevel - raster_octree.leaf_levels[cell]));
      for (std::int32_t leaf = octree.find_leaf(key), end = octree.find_leaf(key + n - 1); leaf <= end; ++leaf)
        seed[leaf] = seed[leaf] > 0 ? std::min(seed[leaf], slope) : slope;
    }
  }
  return seed;
}

}  // namespace st
