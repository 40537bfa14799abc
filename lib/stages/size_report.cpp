#include "stages/size_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/length.h"
#include "base/near_face_name.h"
#include "base/text.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/hdf5/sizing_artifact.h"
#include "sizing/near_faces.h"
#include "stages/size_tally.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostCauses = 10;  // lines of the table of causes

/// "x,y,z", separated by commas, semicolons or blanks; false: something else.
bool parse_point(std::string_view text, Vec3& xyz) {
  double v[3];
  const char *at = text.data(), *end = at + text.size();
  const auto skip = [&](std::string_view what) {
    while (at != end && what.find(*at) != std::string_view::npos) ++at;
  };
  for (double& x : v) {
    skip(" \t,;+");
    const auto [next, error] = std::from_chars(at, end, x);
    if (error != std::errc() || !std::isfinite(x)) return false;
    at = next;
  }
  skip(" \t\r,;");
  xyz = {v[0], v[1], v[2]};
  return at == end;
}

bool is_inside(const OctreeView& octree, Vec3 x) {
  const Vec3 d = x - octree.lo;
  return std::min({d.x, d.y, d.z}) >= 0 && std::max({d.x, d.y, d.z}) <= octree.edge;
}

Json to_json(Vec3 v) { return {v.x, v.y, v.z}; }
std::string to_text(Vec3 v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

/// The raster of a sizing artifact, `path` or the one in the folder of the sizing.
RasterArtifact read_own_raster(const std::string& artifact, const ArtifactHeader& sizing, std::string path) {
  InputRef own;
  for (const InputRef& input : sizing.inputs)
    if (input.role == "raster") own = input;
  if (path.empty()) {
    path = std::filesystem::path(artifact).replace_filename(own.name).string();
    if (!std::filesystem::is_regular_file(path))
      throw Error(ExitCode::kInput,
                  fmt::format("{}: its raster {} is not there; give it with --raster FILE", artifact, path));
  }
  RasterArtifact raster = read_raster(path);
  if (raster.header.content_hash != own.hash)
    throw Error(ExitCode::kMismatch,
                fmt::format("{} was not made from {}; give its own raster with --raster FILE", artifact, path));
  return raster;
}

/// [n_faces] 1: of this group or part (find_faces), or, where there is none, of this name.
std::vector<std::uint8_t> find_named_faces(const std::string& name, const RasterArtifact& raster) {
  std::vector<std::uint8_t> is_in = find_faces(name, raster.model.labels);
  if (!is_in.empty()) return is_in;
  for (const std::string& face_name : raster.model.labels.face_name) is_in.push_back(face_name == name);
  if (std::find(is_in.begin(), is_in.end(), 1) == is_in.end())
    throw Error(ExitCode::kUsage, fmt::format("--why '{}': no group of faces, part or face has this name{}; "
                                              "st-info geometry.hdf --groups lists them",
                                              name, say_other_name(name, raster.model.labels)));
  return is_in;
}

/// What the field requires of the faces that are 1 in `is_in`.
GroupSizes sizes_of_faces(const std::string& name, const std::vector<std::uint8_t>& is_in, const RasterArtifact& raster,
                          const OctreeField& field) {
  std::vector<std::int32_t> group;
  for (const std::uint8_t in : is_in) group.push_back(in ? 0 : kNone);
  SizeTally tally({name}, std::move(group));
  face_weights(raster.model.faces, raster.octree.shape.view(), field, [&](const SizedPart& part) { tally.add(part); });
  const std::vector<GroupSizes> groups = tally.groups(1, field.frame().scale);
  return groups.empty() ? GroupSizes{name, 0, 0, 0, {}} : groups[0];
}

/// What is said of the size at a point.
struct PointSize {
  Vec3 x;
  SizeExplanation why;
  std::string cause;
  bool is_inside;  ///< the octree's box
  double slope;
};

/// Of the nearest face, where lengths depend on it.
Vec3 normal_at(const std::string& artifact, const OctreeField& field, Vec3 x) {
  if (!field.has_metrics()) return {};
  const SizingArtifact sizing = read_sizing(artifact);
  return sizing.frame.rotated(normal_near(sizing.model.faces, sizing.shape.view(), sizing.frame.inverse()(x)));
}

PointSize find_size(const std::string& artifact, const OctreeField& field, Vec3 x) {
  const SizeExplanation why = field.explain(x, normal_at(artifact, field, x));
  const bool is_in_box = is_inside(field.data().octree, field.frame().inverse()(x));
  return {x, why, cause_text(read_cause_names(artifact), why.cause), is_in_box, field.slope()};
}

/// `unit`: "" or " mm".
std::string size_text(const PointSize& p, const std::string& unit) {
  const SizeExplanation& why = p.why;
  std::string text = fmt::format("length {:.6g}{}\n", why.length, unit);
  if (why.along > why.length)
    text += fmt::format("  along     {:.6g}{} in direction {}\n", why.along, unit, to_text(why.direction));
  if (!p.is_inside) text += "  outside the box of the octree: lengths grow by the slope from there on\n";
  text +=
      fmt::format("  gradient  {}, {:.3g} along it (slope {:g})\n", to_text(why.gradient), norm(why.gradient), p.slope);
  text += fmt::format("  cause     {}", p.cause);
  if (why.cause != kNone)
    text += fmt::format(", which requires {:.6g}{} near {}, {:.4g}{} away", why.origin_length, unit,
                        to_text(why.origin), distance(p.x, why.origin), unit);
  return text + fmt::format("\n  cell      {}, level {}, edge {:.6g}{}", why.leaf + 1, why.level, why.cell_edge, unit);
}

Json size_json(const std::string& artifact, const PointSize& p) {
  const double away = distance(p.x, p.why.origin);
  return {{"tool", "st-info"},
          {"artifact", artifact},
          {"xyz", to_json(p.x)},
          {"is_inside", p.is_inside},
          {"length", p.why.length},
          {"along", {{"length", p.why.along}, {"direction", to_json(p.why.direction)}}},
          {"gradient", to_json(p.why.gradient)},
          {"slope", p.slope},
          {"cause", p.cause},
          {"origin", {{"length", p.why.origin_length}, {"xyz", to_json(p.why.origin)}, {"distance", away}}},
          {"cell", {{"id", p.why.leaf + 1}, {"level", p.why.level}, {"edge", p.why.cell_edge}}}};
}

}  // namespace

StageSummary run_size_at(const std::string& artifact, const std::string& text) {
  Vec3 x;
  if (!parse_point(text, x))
    throw Error(ExitCode::kUsage, fmt::format("--at '{}': not a point; write three numbers, such as 1.5,0,-2", text));
  const MappedSizing sizing = map_sizing(artifact);
  const PointSize size = find_size(artifact, *sizing.field, x);
  const std::string unit = in_unit(sizing.header.unit);
  StageSummary summary;
  summary.line = fmt::format("{} at {}: {}", artifact, to_text(x), size_text(size, unit));
  summary.json = json_text(size_json(artifact, size));
  return summary;
}

StageSummary run_size_why(const std::string& artifact, const std::string& group, const std::string& raster_path) {
  const MappedSizing sizing = map_sizing(artifact);
  const RasterArtifact raster = read_own_raster(artifact, sizing.header, raster_path);
  const CauseNames names = read_cause_names(artifact);
  const std::vector<std::uint8_t> is_in = find_named_faces(group, raster);
  const auto n_faces = std::count(is_in.begin(), is_in.end(), 1);
  const GroupSizes sizes = sizes_of_faces(group, is_in, raster, *sizing.field);
  const std::string unit = in_unit(sizing.header.unit);
  StageSummary summary;
  summary.line = fmt::format("{}, \"{}\": {}, about {:.0f} triangles, least length {:.4g}{}, median {:.4g}{}", artifact,
                             group, counted(n_faces, "face"), sizes.triangles, sizes.least, unit, sizes.median, unit);
  for (const std::string& line : cause_lines(sizes, names, kMostCauses)) summary.line += "\n" + line;
  const Json json = {{"tool", "st-info"},
                     {"artifact", artifact},
                     {"name", group},
                     {"faces", n_faces},
                     {"expected_triangles", sizes.triangles},
                     {"least", sizes.least},
                     {"median", sizes.median},
                     {"causes", causes_json(sizes, names)}};
  summary.json = json_text(json);
  return summary;
}

std::size_t sample_sizes(const OctreeField& field, const CauseNames& names, const std::string& points,
                         const std::string& output) {
  refuse_pipe(points);
  std::ifstream in(points);
  if (!in) throw Error(ExitCode::kInput, points + ": cannot be read; check name and permissions");
  TemporaryFile temporary(output);
  std::ofstream out(temporary.name());
  out << "x,y,z,length,gradient_x,gradient_y,gradient_z,cause\n";
  std::size_t n = 0, number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    Vec3 x;
    if (!parse_point(line, x)) {
      if (n == 0 && number == 1) continue;  // a heading
      throw Error(ExitCode::kInput, fmt::format("{}:{}: three numbers expected, not '{}'", points, number, line));
    }
    const SizeExplanation why = field.explain(x);
    std::string cause = cause_text(names, why.cause);
    for (std::size_t k = 0; (k = cause.find('"', k)) != std::string::npos; k += 2) cause.insert(k, 1, '"');
    out << fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},\"{}\"\n", x.x, x.y, x.z, why.length, why.gradient.x,
                       why.gradient.y, why.gradient.z, cause);
    ++n;
  }
  out.close();
  if (!out) throw Error(ExitCode::kOutput, output + ": cannot be written; check free space and permissions");
  temporary.commit();
  return n;
}

}  // namespace st
