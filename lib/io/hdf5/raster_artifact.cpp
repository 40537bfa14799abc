#include <algorithm>
#include <string>
#include <vector>

#include "base/threads.h"
#include "io/hdf5/raster_parts_io.h"
#include "io/hdf5/sizing_artifact.h"
#include "io/hdf5/wing_records_io.h"

namespace st {

template <>
struct Element<SampleReach> : Elements<ElementType::kFloat32, 6> {};

namespace {

constexpr int kPlainRasterVersion = 2;      // of a raster without samples
constexpr int kSampledRasterVersion = 3;    // of a complete raster with samples
constexpr int kPartialRasterVersion = 4;    // of an incomplete one; from here on not_sampled is written
constexpr int kSurfaceRasterVersion = 5;    // of one with a coarse surface, the same length in all directions
constexpr int kStretchedRasterVersion = 6;  // of one near the origin
constexpr int kFarRasterVersion = 7;        // of one far from it; up to here samples are points
constexpr const char* kNotSampled = "not_sampled";
constexpr const char* kStoredLength = "/st/octree/stored_length";
constexpr const char* kStoredCause = "/st/octree/stored_cause";
constexpr const char* kSamplePoint = "/st/sample/point";
constexpr const char* kSampleLength = "/st/sample/length";
constexpr const char* kSampleCause = "/st/sample/cause";
constexpr const char* kSampleNormal = "/st/sample/normal";
constexpr const char* kSampleReach = "/st/sample/reach";
constexpr const char* kSampleDirection = "/st/sample/direction";
constexpr const char* kSurfacePoint = "/st/surface/point";
constexpr const char* kSurfaceTriangle = "/st/surface/triangle";
constexpr const char* kFlowInside = "flow_inside";

bool is_reach(const SampleReach& r) { return are_finite(r.u) & are_finite(r.v); }

void write_samples(Hdf5Writer& file, const std::vector<LengthSample>& samples, Vec3 origin, bool has_reach,
                   bool is_stretched) {
  std::vector<float> points, lengths, along;
  std::vector<std::int32_t> causes;
  std::vector<SmallNormal> normals, directions;
  std::vector<SampleReach> reaches;
  for (const LengthSample& s : samples) {
    normals.push_back(s.normal);
    const Vec3 x = s.xyz - origin;
    for (const double c : {x.x, x.y, x.z}) points.push_back(static_cast<float>(c));
    lengths.push_back(s.length);
    causes.push_back(s.cause);
    directions.push_back(s.stretch.direction);
    along.push_back(s.stretch.along);
    reaches.push_back(s.reach);
  }
  file.write<float>(kSamplePoint, points, 3);
  file.write<float>(kSampleLength, lengths);
  file.write<std::int32_t>(kSampleCause, causes);
  file.write<SmallNormal>(kSampleNormal, normals);
  if (has_reach) file.write<SampleReach>(kSampleReach, reaches);
  if (!is_stretched) return;
  file.write<SmallNormal>(kSampleDirection, directions);
  file.write<float>(kSampleAlong, along);
}

/// Their places from the origin on which lengths count: the model's is added later.
std::vector<LengthSample> read_samples(const Hdf5Reader& file) {
  const std::vector<float> lengths = file.read<float>(kSampleLength), points = file.read<float>(kSamplePoint, 3);
  const std::vector<std::int32_t> causes = file.read_rows<std::int32_t>(kSampleCause, lengths.size());
  if (points.size() != 3 * lengths.size()) file.fail(kSamplePoint, "does not fit the number of lengths");
  std::vector<SmallNormal> normals(lengths.size());
  if (file.has(kSampleNormal)) normals = file.read_rows<SmallNormal>(kSampleNormal, lengths.size());
  require_finite(file, kSamplePoint, points);
  require_rows_to_be(file, kSampleLength, std::span<const float>(lengths), "a finite length > 0", is_positive);
  std::vector<SmallNormal> directions(lengths.size());
  std::vector<float> along(lengths.size());
  std::vector<SampleReach> reaches(lengths.size());
  if (file.has(kSampleReach)) {
    reaches = file.read_rows<SampleReach>(kSampleReach, lengths.size());
    require_rows_to_be(file, kSampleReach, std::span<const SampleReach>(reaches), "finite", is_reach);
  }
  if (file.has(kSampleAlong)) {
    directions = file.read_rows<SmallNormal>(kSampleDirection, lengths.size());
    along = file.read_rows<float>(kSampleAlong, lengths.size());
    require_lengths(file, kSampleAlong, along);
  }
  std::vector<LengthSample> samples;
  samples.reserve(lengths.size());
  for (std::size_t i = 0; i < lengths.size(); ++i)
    samples.push_back({Vec3{points[3 * i], points[3 * i + 1], points[3 * i + 2]},
                       lengths[i],
                       causes[i],
                       normals[i],
                       {directions[i], along[i]},
                       reaches[i]});
  return samples;
}

void write_surface(Hdf5Writer& file, const BlankSurface& surface) {
  file.write<Vec3>(kSurfacePoint, surface.points);
  file.write<Triangle>(kSurfaceTriangle, surface.triangles);
  file.set_attribute(kSizing, kFlowInside, std::int64_t{surface.side == BlankSide::kOutside});
}

BlankSurface read_surface(const Hdf5Reader& file) {
  BlankSurface surface{file.read<Vec3>(kSurfacePoint), file.read<Triangle>(kSurfaceTriangle), BlankSide::kInside};
  for (const Triangle& t : surface.triangles) require_ids(file, kSurfaceTriangle, t.n, surface.points.size());
  require_finite(file, kSurfacePoint, surface.points);
  if (file.int_attribute(kSizing, kFlowInside) != 0) surface.side = BlankSide::kOutside;
  return surface;
}

}  // namespace

std::string write_raster(const std::string& path, const RasterArtifact& raster) {
  ArtifactHeader header = raster.header;
  header.schema_version = raster.samples.empty() ? kPlainRasterVersion : kSampledRasterVersion;
  if (raster.n_not_sampled > 0) header.schema_version = kPartialRasterVersion;
  if (!raster.surface.triangles.empty()) header.schema_version = kSurfaceRasterVersion;
  if (raster.numbers.max_aspect > 1) header.schema_version = kStretchedRasterVersion;
  if (raster.model.faces.origin != Vec3{}) header.schema_version = kFarRasterVersion;
  const bool has_reach = std::any_of(raster.samples.begin(), raster.samples.end(),
                                     [](const LengthSample& s) { return s.reach != SampleReach{}; });
  if (has_reach) header.schema_version = kRasterVersion;
  Hdf5Writer file(path, header);
  write_numbers(file, raster.numbers);
  if (header.schema_version >= kPartialRasterVersion) file.set_attribute(kSizing, kNotSampled, raster.n_not_sampled);
  write_shape(file, raster.octree.shape);
  file.write<float>(kStoredLength, raster.octree.stored_length);
  file.write<std::int32_t>(kStoredCause, raster.octree.stored_cause);
  if (!raster.samples.empty())
    write_samples(file, raster.samples, raster.model.faces.origin, has_reach, raster.numbers.max_aspect > 1);
  if (!raster.surface.triangles.empty()) write_surface(file, raster.surface);
  write_model(file, raster.model);
  return file.commit();
}

RasterArtifact read_raster(const std::string& path) {
  const Hdf5Reader file(path, "raster", kRasterVersion);
  require_version(file, kPlainRasterVersion, "st-raster");
  RasterArtifact raster;
  raster.header = file.header();
  raster.numbers = read_numbers(file);
  if (raster.header.schema_version >= kPartialRasterVersion)
    raster.n_not_sampled = file.int_attribute(kSizing, kNotSampled);
  run_jobs({[&] {
              raster.octree.shape = read_shape(file);
              const std::size_t n = raster.octree.shape.leaf_keys.size();
              raster.octree.stored_length = file.read_rows<float>(kStoredLength, n);
              raster.octree.stored_cause = file.read_rows<std::int32_t>(kStoredCause, n);
              require_rows_to_be(file, kStoredLength, std::span<const float>(raster.octree.stored_length),
                                 "a length > 0", [](float x) { return x > 0; });
              raster.model = read_model(file, n);
            },
            [&] {
              if (file.has(kSurfaceTriangle)) raster.surface = read_surface(file);
            },
            [&] {
              if (file.has(kSamplePoint)) raster.samples = read_samples(file);
            }});
  for (LengthSample& s : raster.samples) s.xyz = raster.model.faces.origin + s.xyz;
  return raster;
}

}  // namespace st
