#include "stages/source_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/length.h"
#include "base/log.h"
#include "base/nearest_name.h"
#include "io/file/text_file.h"
#include "io/foreign/size_mesh.h"
#include "sizing/growth_limit.h"
#include "sizing/near_faces.h"

namespace st {
namespace {

/// Reference to a file that is no artifact: name and hash of its bytes.
InputRef file_ref(const std::string& role, const std::string& path) {
  const MappedBytes file(path);
  return {role, std::filesystem::path(path).filename().string(), hash_hex(file.bytes().data(), file.bytes().size())};
}

std::vector<std::string> names_of(const std::vector<SourceSpec>& sources) {
  std::vector<std::string> names;
  for (const SourceSpec& s : sources) names.push_back(s.name);
  return names;
}

/// A named source takes the place of an earlier one of its name.
void merge(std::vector<SourceSpec>& all, const SourceFile& file, const std::string& path) {
  for (const std::string& name : file.deleted) {
    const auto is_it = [&](const SourceSpec& s) { return s.name == name; };
    if (std::none_of(all.begin(), all.end(), is_it))
      throw Error(ExitCode::kUsage, fmt::format("{}: no source is named '{}'{}; nothing to delete", path, name,
                                                did_you_mean(name, names_of(all))));
    std::erase_if(all, is_it);
  }
  const std::size_t n_before = all.size();
  for (const SourceSpec& source : file.sources) {
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(n_before);
    const auto old = source.name.empty()
                         ? end
                         : std::find_if(all.begin(), end, [&](const SourceSpec& s) { return s.name == source.name; });
    if (old != end)
      *old = source;
    else
      all.push_back(source);
  }
}

/// Lowered to the slope.
void add_background(BackgroundMesh&& mesh, const Similarity& motion, const FaceCells& faces, const OctreeView& raster,
                    SourceInput& input) {
  transform(motion, mesh);
  forget_plain_metrics(mesh);
  const double slope = input.set.slope;
  const bool has_metrics = !mesh.node_metric.empty();
  if (const std::int64_t n = has_metrics ? limit_metrics(slope, mesh) : limit_growth(slope, mesh))
    log_warning(
        fmt::format("the background mesh grows faster than the slope {:g}: lengths of {} of its {} nodes are lowered",
                    slope, n, mesh.node_xyz.size()));
  if (has_metrics) keep_near_tets(faces, raster, mesh);
  if (input.set.background.is_empty())
    input.set.background = std::move(mesh);
  else
    append(mesh, input.set.background);
}

std::string label_of(const std::string& name, std::size_t number) {
  return name.empty() ? fmt::format("source {}", number + 1) : fmt::format("source {} \"{}\"", number + 1, name);
}

void warn_of_extent(SourceSpec& spec, std::size_t number) {
  const bool was_line = spec.kind == SourceKind::kLine;
  if (simplify(spec))
    log_warning(fmt::format("{}: a {}; it is taken as a {}", label_of(spec.name, number),
                            was_line ? "line without length" : "triangle without area",
                            spec.kind == SourceKind::kPoint ? "point" : "line"));
}

Vec3 clamped(Vec3 x, Vec3 lo, Vec3 hi) {
  return {std::clamp(x.x, lo.x, hi.x), std::clamp(x.y, lo.y, hi.y), std::clamp(x.z, lo.z, hi.z)};
}

/// Between two boxes; 0 where they meet.
double distance_between(const Box3& a, Vec3 lo, Vec3 hi) {
  const auto gap = [](double a_lo, double a_hi, double b_lo, double b_hi) {
    return std::max({0.0, b_lo - a_hi, a_lo - b_hi});
  };
  return norm(Vec3{gap(a.lo.x, a.hi.x, lo.x, hi.x), gap(a.lo.y, a.hi.y, lo.y, hi.y), gap(a.lo.z, a.hi.z, lo.z, hi.z)});
}

/// What is to be said of something outside: how far it is away, and what of it is felt inside.
std::string outside_text(double away, double least_inside, double far_length, const std::string& unit) {
  return fmt::format(
      "lies {:.4g}{} outside the octree, which holds the model alone: {}; is it in the model's unit and "
      "place (--transform)?",
      away, in_unit(unit),
      least_inside < far_length
          ? fmt::format("only its growth reaches in, as {:.4g}{} or more", least_inside, in_unit(unit))
          : "it has no effect");
}

/// Of another unit, for instance.
void warn_of_long(const BackgroundMesh& background, double far_length, const std::string& unit) {
  double least = background.node_size[0].length;
  for (const LocalSize& s : background.node_size) least = std::min(least, s.length);
  if (least >= far_length)
    log_warning(
        fmt::format("the background mesh asks for {:.4g}{} or more, above the largest length {:.4g}{}: it has "
                    "no effect; is it in the model's unit (--transform)?",
                    least, in_unit(unit), far_length, in_unit(unit)));
}

}  // namespace

void warn_of_places(const SourceInput& input, const OctreeView& octree, double far_length, const std::string& unit) {
  const Vec3 lo = octree.lo, hi = octree.lo + octree.edge * Vec3{1, 1, 1};
  const auto least_inside = [&](const SizeSource& source, const Box3& core) {
    double least = source.size(clamped(core.center(), lo, hi));
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 x{corner & 1 ? core.hi.x : core.lo.x, corner & 2 ? core.hi.y : core.lo.y,
                   corner & 4 ? core.hi.z : core.lo.z};
      least = std::min(least, source.size(clamped(x, lo, hi)));
    }
    return least;
  };
  for (std::size_t s = 0; s < input.set.sources.size(); ++s) {
    const SourceSpec& spec = input.set.sources[s];
    const std::unique_ptr<SizeSource> source = make_source(spec, input.set.slope);
    const SourceGrowth growth = source->growth();
    const Vec3 reach = growth.spacing.radius * Vec3{1, 1, 1};
    const Box3 core{growth.core.lo - reach, growth.core.hi + reach};
    const double away = distance_between(core, lo, hi);
    if (away > 0)
      log_warning(label_of(spec.name, s) + " " + outside_text(away, least_inside(*source, core), far_length, unit));
  }
  Box3 background;
  for (const Vec3 x : input.set.background.node_xyz) background.add(x);
  if (background.is_empty()) return;
  if (distance_between(background, lo, hi) == 0) return warn_of_long(input.set.background, far_length, unit);
  const double away = distance_between(background, lo, hi);
  log_warning("the background mesh " +
              outside_text(away, least_inside(*make_background(input.set.background, input.set.slope), background),
                           far_length, unit));
}

void warn_of_outside(const BackgroundMesh& background, const FaceCells& faces, const std::string& unit) {
  constexpr double kBesideBackground = 0.01;  // of its diagonal: surfaces of other chords lie a little beside it
  Box3 box;
  for (const Vec3 x : background.node_xyz) box.add(x);
  if (box.is_empty()) return;
  double area = 0, outside = 0, most = 0;
  for (std::size_t i = 0; i < faces.area.size(); ++i) {
    const float* c = faces.plane[i].center;
    const Vec3 x = faces.origin + Vec3{c[0], c[1], c[2]};
    const double away = norm(x - clamped(x, box.lo, box.hi));
    area += faces.area[i];
    if (away <= kBesideBackground * norm(box.hi - box.lo)) continue;
    outside += faces.area[i];
    most = std::max(most, away);
  }
  if (outside > 0)
    log_warning(
        fmt::format("{:.3g} % of the model's area lies outside the background mesh, up to {:.4g}{}: lengths "
                    "grow there from its border",
                    100 * outside / area, most, in_unit(unit)));
}

SourceInput read_sources(const std::vector<std::string>& files, const std::string& background, const Similarity& motion,
                         double slope, const ModelScale& scale, const FaceCells& faces, const OctreeView& raster) {
  SourceInput input;
  input.set.slope = slope;
  std::vector<SourceSpec>& specs = input.set.sources;
  const auto take = [&](SourceFile&& file, const std::string& path, const std::string& role) {
    merge(specs, file, path);
    add_background(std::move(file.background), motion, faces, raster, input);
    if (is_size_mesh(path))
      for (const std::string& part : files_of_size_mesh(path)) input.files.push_back(file_ref(role, part));
    else
      input.files.push_back(file_ref(role, path));
  };
  if (is_size_mesh(background))
    take({{}, read_size_mesh(background), {}}, background, "background");
  else if (!background.empty())
    take(read_background_file(background), background, "background");
  for (const std::string& path : files) take(read_source_file(path, scale), path, "sources");
  for (SourceSpec& spec : specs) {
    transform(motion, spec);
    warn_of_extent(spec, input.names.size());
    input.names.push_back(spec.name);
  }
  return input;
}

}  // namespace st
