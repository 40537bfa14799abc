// Times of the sizing layer: sampling a CAD model, building and prolonging its octree, and queries.
//   sizing_bench MODEL [LMAX_PERCENT]     a CAD file, sampled at default options
//   sizing_bench --cells MILLIONS         synthetic octree: growth, blanking and query times
//   sizing_bench --open SIZING            opening a sizing artifact
//   sizing_bench --share SIZING RANKS     likewise by several processes at once, and the memory that they share
//   sizing_bench --nodes SIZING PATCHES   queries at the nodes inside faces, in the order in which st-mesh asked
//   sizing_bench --envelope RASTER SIZING MESH   the field at nodes and in space against the smallest of all samples,
//   for
//                                         a sizing made with --no-blank; steps between points near each other
//   sizing_bench --accuracy MODEL         cells and errors of the lengths at the samples for cell_per_length 1 to 8
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "base/processor_time.h"
#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "sizing/blanking.h"
#include "sizing/face_cells.h"
#include "sizing/loop_tracer.h"
#include "sizing/model_limits.h"
#include "sizing/octree_field.h"
#include "sizing/raster_curve.h"
#include "sizing/raster_face.h"
#include "sizing/sample_seeds.h"

namespace {

using namespace st;

constexpr double kSlope = 0.2;

struct Storage {
  RasterOctree raster;
  ProlongedLengths lengths;
  ConeTable cones;
};

template <class... Args>
void report(fmt::format_string<Args...> format, Args&&... args) {
  std::fputs(fmt::format(format, std::forward<Args>(args)...).c_str(), stdout);
}

/// ns per query at random points, and along a walk in steps of half the local length near the boxes.
void time_queries(const OctreeField& field, const std::vector<RasterBox>& boxes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int kQueries = 4'000'000;
  const OctreeView& octree = field.data().octree;
  std::vector<Vec3> points(kQueries);
  double sum = 0;
  const auto run = [&](const char* what) {
    const Timer timer;
    int hint = 0;
    for (const Vec3& p : points) sum += field.size(p, hint);
    report("  query {:<28} {:6.1f} ns\n", what, timer.seconds() / kQueries * 1e9);
  };
  for (Vec3& p : points) p = octree.lo + octree.edge * Vec3{uniform(random), uniform(random), uniform(random)};
  run("random in the root cube");
  for (Vec3& p : points) {
    const RasterBox& b = boxes[random() % boxes.size()];
    p = b.center + b.half * Vec3{uniform(random), uniform(random), uniform(random)};
  }
  run("random near samples");
  std::size_t at = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 8 == 0) at = (at + 1) % boxes.size();
    const RasterBox& b = boxes[at];
    points[i] = b.center + 0.5 * b.half * Vec3{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5};
  }
  run("coherent (sample by sample)");
  report("  (mean length {:.4g})\n", sum / kQueries / 3);
}

/// Of the samples of `boxes`, in the octree of `storage`, which gets cones and lengths.
OctreeFieldData prolong_samples(const std::vector<RasterBox>& boxes, double largest, Storage& storage) {
  const std::vector<LengthSample> samples = sorted_samples(boxes);
  const std::vector<float> slope(samples.size(), static_cast<float>(kSlope));
  const OctreeView octree = storage.raster.shape.view();
  storage.cones = spread_cones(Neighbours(octree), samples, slope, largest, nullptr);
  OctreeFieldData data{octree, {}, {}, kSlope, 1};
  data.set_cones(storage.cones, largest);
  storage.lengths = lengths_at_centers(data, storage.cones.at_center);
  data.cells = storage.lengths.cells;
  data.cause = storage.lengths.cause;
  return data;
}

void time_octree(const Box3& root, const std::vector<RasterBox>& boxes, double far_length) {
  const auto storage = std::make_shared<Storage>();
  const Timer build_timer;
  storage->raster = build_octree(root, boxes);
  const double build = build_timer.seconds();
  const OctreeView octree = storage->raster.shape.view();
  const Timer prolong_timer;
  const OctreeFieldData data = prolong_samples(boxes, far_length, *storage);
  const double prolong_seconds = prolong_timer.seconds(), n = static_cast<double>(octree.n_leaves());
  report("octree  {} boxes -> {} cells in {:.3f} s ({:.2g} cells/s), {:.1f} bytes per cell\n", boxes.size(),
         octree.n_leaves(), build, n / build,
         sizeof(std::uint64_t) + 1 + 32.0 / 7 + sizeof(CellLength) + sizeof(std::int32_t));
  report("prolong {:.3f} s ({:.2g} cells/s)\n", prolong_seconds, n / prolong_seconds);
  time_queries(OctreeField(data, storage), boxes);
}

/// Samples of a model at default options.
std::vector<RasterBox> sample_boxes(const Model& model, const FaceRoles& roles, double cell_per_length) {
  SamplingLimits wall;
  wall.max_length = 0.025 * roles.reference_diagonal;
  wall.min_length = wall.max_length / 64;
  wall.cell_per_length = cell_per_length;
  const ModelLimits limits = model_limits(model.tables(), roles, wall);
  std::vector<RasterBox> boxes;
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e)
    if (limits.edge[e]) raster_curve(*model.curve(e), *limits.edge[e], pack_cause(CauseKind::kEdge, e), boxes);
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    if (limits.face[f])
      raster_face(*model.surface(f), loop_polygons(model, f, limits), *limits.face[f], pack_cause(CauseKind::kFace, f),
                  boxes);
  return boxes;
}

/// The smallest length + slope * distance of all samples, one by one.
double exact_length(const std::vector<RasterBox>& boxes, Vec3 x, double largest) {
  for (const RasterBox& b : boxes) {
    const LengthSample sample{b.center, b.length, b.cause, b.normal, b.stretch, b.reach};
    largest = std::min(largest, Cone(sample, static_cast<float>(kSlope), {}).length_at(x));
  }
  return largest;
}

void bench_accuracy(const std::string& path) {
  constexpr int kPoints = 4000;
  ImportResult imported = import_model(path, {});
  const Model model(std::move(imported.tables), std::move(imported.brep));
  const FaceRoles roles = face_roles(model.tables());
  const double largest = 0.025 * roles.reference_diagonal;
  const std::vector<RasterBox> all = sample_boxes(model, roles, 1);
  std::mt19937_64 random(2);
  std::vector<Vec3> points;
  std::vector<double> exact;
  for (int i = 0; i < kPoints; ++i) {
    points.push_back(all[random() % all.size()].center);
    exact.push_back(exact_length(all, points.back(), largest));
  }
  for (const double cell_per_length : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    const std::vector<RasterBox> boxes = sample_boxes(model, roles, cell_per_length);
    const auto storage = std::make_shared<Storage>();
    storage->raster = build_octree(model.tables().box(), boxes);
    const OctreeField field(prolong_samples(boxes, largest, *storage), storage);
    std::vector<double> errors;
    double bias = 0;
    for (int i = 0; i < kPoints; ++i) {
      errors.push_back(std::log(field.SizeField::size(points[i]) / exact[i]));
      bias += errors.back() / kPoints;
    }
    double mean = 0;
    for (const double e : errors) mean += std::abs(e) / kPoints;
    std::sort(errors.begin(), errors.end());
    report(
        "cell_per_length {:1}: {:8} cells, lengths off by {:4.1f} % on the mean ({:+.1f} %), 1 to 99 %: {:.2f} to "
        "{:.2f}\n",
        cell_per_length, field.data().octree.n_leaves(), 100 * mean, 100 * bias, std::exp(errors[kPoints / 100]),
        std::exp(errors[kPoints * 99 / 100]));
  }
}

/// Share of points at which the field is off, and by how much.
void report_ratios(const char* where, std::vector<double> ratios) {
  std::sort(ratios.begin(), ratios.end());
  const std::size_t n = ratios.size();
  report("{}: field / smallest of all samples at {} points, 1 to 99 %: {:.4f} to {:.4f}, worst {:.4f} to {:.4f}\n",
         where, n, ratios[n / 100], ratios[n * 99 / 100], ratios.front(), ratios.back());
}

/// Lengths along at nodes, and at steps in a random direction.
void bench_stretch(const SizingArtifact& sizing, const OctreeField& field, const std::vector<LengthSample>& samples,
                   const std::vector<Cone>& cones, const std::vector<Vec3>& nodes) {
  constexpr int kPoints = 10'000, kSteps = 1'000'000;
  constexpr double kTurned = 0.99;  // cosine
  const Vec3 lo = sizing.shape.lo;
  const auto exact = [&](Vec3 x, Vec3 t) {
    double least = sizing.numbers.far_length;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const double length = cones[i].length, rise = cones[i].length_at(x - lo) - length;
      const auto& [direction, along] = samples[i].stretch;
      const LocalSize size{length, std::max<double>(length, along), along > 0 ? normalized(Vec3(direction)) : Vec3{}};
      if (rise < least) least = std::min(least, size.in(t) + rise);
    }
    return sizing.scale * least;
  };
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  std::vector<double> ratios, steps, turned;
  int hint = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 x = nodes[random() % nodes.size()];
    if (const LocalSize at = field.local(x, hint); at.along > at.length)
      ratios.push_back(at.along / exact(x, at.direction));
  }
  report_ratios("along at nodes", ratios);
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 x = nodes[random() % nodes.size()];
    const LocalSize at = field.local(x, hint);
    const Vec3 t = at.along > at.length ? at.direction
                                        : normalized(Vec3{uniform(random), uniform(random), uniform(random)}),
               step = 2 * at.length * Vec3{uniform(random), uniform(random), uniform(random)};
    const LocalSize to = field.local(x + step, hint);
    const bool is_turned =
        norm2(at.direction) * norm2(to.direction) > 0 && std::abs(dot(at.direction, to.direction)) < kTurned;
    (is_turned ? turned : steps).push_back(std::abs(to.in(t)-at.in(t)) / (sizing.slope * norm(step)));
  }
  for (auto* const of : {&steps, &turned}) {
    const auto n_steep = std::count_if(of->begin(), of->end(), [](double s) { return s > 1.01; });
    std::sort(of->begin(), of->end());
    report(
        "along, {} steps {}: {:.4f} % steeper than the slope by over 1 %, 99.9 % below {:.3f} times, at most {:.3f}\n",
        of->size(), of == &turned ? "over which the direction turns" : "in one direction",
        100.0 * static_cast<double>(n_steep) / static_cast<double>(of->size()), (*of)[of->size() * 999 / 1000],
        of->back());
  }
  report("along: {:.2f} cones more per cell\n",
         static_cast<double>(sizing.cones.along_of_site.size()) / sizing.shape.view().n_leaves());
}

/// Lengths at the centres of cells that touch, in the flow and away from walls where these blank.
void bench_neighbours(const SizingArtifact& sizing, const OctreeField& field) {
  constexpr double kRounded = 1 + 1e-5;
  const OctreeView octree = sizing.shape.view();
  const std::vector<CellColour>& colour = sizing.blanking.colour;
  const Neighbours neighbours(octree);
  struct Steps {
    std::int64_t n = 0, n_steep = 0;
    double steepest = 0;
  } across, others;  // faces; edges and corners
  int hint = 0;
  for (std::int32_t a = 0; a < octree.n_leaves(); ++a)
    neighbours.for_each(a, [&](std::int32_t b, const CellStep& step) {
      if (b < a || (!colour.empty() && (colour[a] != CellColour::kFlow || colour[b] != CellColour::kFlow))) return;
      const Vec3 from = octree.leaf_center(a), to = octree.leaf_center(b);
      const double change = std::abs(field.size(to, hint) - field.size(from, hint)),
                   steepness = change / (sizing.slope * sizing.scale * distance(from, to));
      Steps& of = step.length2 == 4 || step.length2 == 11 ? across : others;
      ++of.n;
      of.n_steep += steepness > kRounded;
      of.steepest = std::max(of.steepest, steepness);
    });
  for (const Steps* of : {&across, &others})
    report("{} steps between cells across {}: {} steeper than the slope, at most {:.4f} times\n", of->n,
           of == &across ? "faces" : "edges and corners", of->n_steep, of->steepest);
}

void bench_envelope(const std::string& raster_path, const std::string& sizing_path, const std::string& mesh_path) {
  constexpr int kPoints = 10'000, kSteps = 1'000'000;
  const RasterArtifact raster = read_raster(raster_path);
  const SizingArtifact sizing = read_sizing(sizing_path);
  const SurfaceMesh mesh = read_mesh(mesh_path).mesh;
  const std::unique_ptr<OctreeField> owned = sizing.field();
  const OctreeField& field = *owned;
  const OctreeView octree = sizing.shape.view();
  std::vector<Cone> cones;
  for (const LengthSample& s : raster.samples) cones.emplace_back(s, static_cast<float>(sizing.slope), octree.lo);
  const auto exact = [&](Vec3 x) {
    double least = sizing.numbers.far_length;
    for (const Cone& c : cones) least = std::min(least, c.length_at(x - octree.lo));
    return sizing.scale * least;
  };
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  std::vector<double> at_nodes, in_space, at_samples, steps;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 node = mesh.node_xyz[random() % mesh.node_xyz.size()];
    at_nodes.push_back(field.SizeField::size(node) / exact(node));
    const Vec3 away = 0.1 * octree.edge * std::pow(2 * std::abs(uniform(random)), 4) *
                      Vec3{uniform(random), uniform(random), uniform(random)};
    in_space.push_back(field.SizeField::size(node + away) / exact(node + away));
    const LengthSample& s = raster.samples[random() % raster.samples.size()];
    at_samples.push_back(field.SizeField::size(s.xyz) / exact(s.xyz));
  }
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 node = mesh.node_xyz[random() % mesh.node_xyz.size()];
    const double h = field.SizeField::size(node);
    const Vec3 step = 2 * h * Vec3{uniform(random), uniform(random), uniform(random)};
    steps.push_back(std::abs(field.SizeField::size(node + step) - h) / (sizing.slope * norm(step)));
  }
  report_ratios("nodes", at_nodes);
  report_ratios("space", in_space);
  report_ratios("samples", at_samples);
  const auto n_steep = std::count_if(steps.begin(), steps.end(), [](double s) { return s > 1.01; });
  report("steps of up to 1.7 lengths: {:.4f} % steeper than the slope by over 1 %, at most {:.3f} times\n",
         100.0 * static_cast<double>(n_steep) / kSteps, *std::max_element(steps.begin(), steps.end()));
  bench_neighbours(sizing, field);
  report("cones: {} of {} samples, {:.2f} per cell\n", sizing.cones.cone.size(), raster.samples.size(),
         static_cast<double>(sizing.cones.of_site.size()) / octree.n_leaves());
  if (field.is_stretched()) bench_stretch(sizing, field, raster.samples, cones, mesh.node_xyz);
}

void bench_model(const std::string& path, double lmax_percent) {
  const Timer import_timer;
  ImportResult imported = import_model(path, {});
  const Model model(std::move(imported.tables), std::move(imported.brep));
  const ModelTables& t = model.tables();
  report("{}: {} faces, {} edges, import {:.2f} s\n", path, t.n_faces(), t.n_edges(), import_timer.seconds());
  SamplingLimits wall;
  const FaceRoles roles = face_roles(t);
  wall.max_length = lmax_percent / 100 * roles.reference_diagonal;
  wall.min_length = wall.max_length / 64;
  const ModelLimits limits = model_limits(t, roles, wall);
  std::vector<RasterBox> boxes;
  const Timer curve_timer;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (limits.edge[e]) raster_curve(*model.curve(e), *limits.edge[e], pack_cause(CauseKind::kEdge, e), boxes);
  const std::size_t n_edge_boxes = boxes.size();
  report("edges   {} boxes in {:.3f} s\n", n_edge_boxes, curve_timer.seconds());
  const Timer face_timer;
  double loop_seconds = 0, sampled_area = 0, area = 0;
  std::int64_t n_evaluations = 0;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto& own = limits.face[f];
    if (!own) continue;
    const Timer face_seconds;
    const auto surface = model.surface(f);
    const LoopPolygons loops = loop_polygons(model, f, limits);
    loop_seconds += face_seconds.seconds();
    const FaceRasterReport r = raster_face(*surface, loops, *own, pack_cause(CauseKind::kFace, f), boxes);
    n_evaluations += r.n_evaluations;
    sampled_area += r.area;
    area += t.face_area[f];
    if (std::getenv("SIZING_BENCH_FACES"))
      report("  {:<28} type {} area {:10.4g} sampled {:10.4g} boxes {:8} evaluations {:9} {:.4f} s\n", t.face_label(f),
             static_cast<int>(surface->type()), t.face_area[f], r.area, r.n_patches, r.n_evaluations,
             face_seconds.seconds());
  }
  report("faces   {} boxes in {:.3f} s, {:.3f} s of it loops; {} evaluations; area sampled / CAD = {:.4f}\n",
         boxes.size() - n_edge_boxes, face_timer.seconds(), loop_seconds, n_evaluations, sampled_area / area);
  time_octree(t.box(), boxes, limits.far_length);
}

/// A sphere of radius 0.3 in the unit box, in n rings of 2n sectors.
void time_blanking(const Box3& root, const std::vector<RasterBox>& boxes, int n) {
  std::vector<Vec3> points{{0, 0, 0.3}, {0, 0, -0.3}};
  std::vector<Triangle> triangles;
  const auto node = [n](int i, int j) { return 2 + (i - 1) * 2 * n + (j % (2 * n)); };
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double theta = kPi * i / n, phi = kPi * j / n;
      points.push_back(0.3 * Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      if (i == 1) triangles.push_back({{0, node(1, j), node(1, j + 1)}});
      if (i == n - 1) triangles.push_back({{1, node(i, j + 1), node(i, j)}});
      if (i + 1 == n) continue;
      triangles.push_back({{node(i, j), node(i + 1, j), node(i + 1, j + 1)}});
      triangles.push_back({{node(i, j), node(i + 1, j + 1), node(i, j + 1)}});
    }
  const RasterOctree raster = build_octree(root, boxes);
  const OctreeView octree = raster.shape.view();
  const Timer timer;
  const Blanking blanking = blank_cells(Neighbours(octree), {points, triangles}, BlankSide::kInside);
  const double seconds = timer.seconds();
  const auto n_cut = std::count(blanking.colour.begin(), blanking.colour.end(), CellColour::kCut);
  report("blank   {} cells with {} triangles: {:.3f} s, {} cut ({:.1f} us each)\n", octree.n_leaves(), triangles.size(),
         seconds, n_cut, 1e6 * seconds / static_cast<double>(n_cut));
}

void time_opening(const std::string& path) {
  double best = 1e300;
  std::int32_t n = 0;
  for (int i = 0; i < 5; ++i) {
    const Timer timer;
    n = map_sizing(path).field->data().octree.n_leaves();
    best = std::min(best, timer.seconds());
  }
  report("open    {} cells in {:.1f} ms (checksums verified)\n", n, 1e3 * best);
}

/// Memory of this process, MB: all that it maps, and its share of it where others map the same.
struct Memory {
  double resident = 0, share = 0;
};

/// Of the mapped file, or of the whole process when `path` is empty.
Memory mapped_memory(const std::string& path) {
  std::ifstream maps(path.empty() ? "/proc/self/smaps_rollup" : "/proc/self/smaps");
  Memory memory;
  bool is_file = path.empty();
  for (std::string line; std::getline(maps, line);) {
    if (line.find('-') < line.find(' ')) is_file = path.empty() || line.ends_with(path);  // the head of a mapping
    if (!is_file) continue;
    if (line.starts_with("Rss:")) memory.resident += std::stod(line.substr(4)) / 1024;
    if (line.starts_with("Pss:")) memory.share += std::stod(line.substr(4)) / 1024;
  }
  return memory;
}

/// Where `n` processes wait for each other, once.
class Meeting {
 public:
  explicit Meeting(int n) : n_(n) { must(pipe(door_) == 0 && pipe(answer_) == 0); }
  void wait(int rank) const {
    char byte = 0;
    if (rank > 0) return must(write(door_[1], &byte, 1) == 1 && read(answer_[0], &byte, 1) == 1);
    for (int i = 1; i < n_; ++i) must(read(door_[0], &byte, 1) == 1);
    for (int i = 1; i < n_; ++i) must(write(answer_[1], &byte, 1) == 1);
  }

 private:
  static void must(bool is_done) {
    if (!is_done) std::abort();
  }
  int n_, door_[2], answer_[2];
};

/// Each of `n` processes opens the sizing, asks for a length in every cell and looks at its memory while all others
/// have theirs.
void share_sizing(const std::string& path, int n) {
  const Meeting opened(n), seen(n);
  int rank = 0;
  while (rank + 1 < n && fork() == 0) ++rank;  // a chain: each makes the next
  const Memory before = mapped_memory("");
  const Timer timer;
  const std::clock_t start = std::clock();
  const MappedSizing sizing = map_sizing(path);
  const double seconds = timer.seconds(), busy = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const OctreeView& octree = sizing.field->data().octree;
  double sum = 0;
  int hint = 0;
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf)
    sum += sizing.field->size(octree.leaf_center(leaf), hint);
  opened.wait(rank);
  const Memory file = mapped_memory(path.substr(path.rfind('/') + 1)), whole = mapped_memory("");
  seen.wait(rank);
  report(
      "rank {} of {}: {} cells opened in {:.1f} ms ({:.1f} ms of it computing); file {:.1f} MB mapped, its share "
      "{:.1f} MB; everything "
      "else {:+.1f} MB (mean {:.4g})\n",
      rank, n, octree.n_leaves(), 1e3 * seconds, 1e3 * busy, file.resident, file.share,
      whole.resident - before.resident - file.resident, sum / octree.n_leaves());
  std::fflush(stdout);
  while (wait(nullptr) > 0) {
  }
}

/// What the mesher's inner loop costs: processor time of the best of twenty runs over all inner nodes.
void time_nodes(const std::string& sizing_path, const std::string& patches_path) {
  const MappedSizing sizing = map_sizing(sizing_path);
  std::vector<Vec3> nodes;
  for (const FacePatch& patch : read_patches(patches_path).patches)
    nodes.insert(nodes.end(), patch.inner_xyz.begin(), patch.inner_xyz.end());
  const auto time = [&](const char* what, const auto& length_at) {
    double best = 1e300, sum = 0;
    constexpr int kRuns = 20;
    for (int i = 0; i < kRuns; ++i) {
      const double start = thread_seconds();
      int hint = 0;
      for (const Vec3& x : nodes) sum += length_at(x, hint);
      best = std::min(best, thread_seconds() - start);
    }
    report("nodes   {} of {} cells: {:.1f} ns per query of {} (mean {:.9g})\n", nodes.size(),
           sizing.field->data().octree.n_leaves(), 1e9 * best / static_cast<double>(nodes.size()), what,
           sum / kRuns / static_cast<double>(nodes.size()));
  };
  time("the length", [&](Vec3 x, int& hint) { return sizing.field->size(x, hint); });
  time("both lengths", [&](Vec3 x, int& hint) { return sizing.field->local(x, hint).along; });
}

/// Boxes on a sphere as raster_face would place them, face after face, so many that the octree has about `millions`
/// cells.
void bench_cells(double millions) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const double smallest = 0.00119 / std::sqrt(millions), spacing = 1.3;  // in lengths
  std::vector<RasterBox> boxes;
  constexpr int kBands = 64;
  for (int band = 0; band < kBands; ++band) {
    const double z0 = -1 + 2.0 * band / kBands, length = smallest * (1 + 2 * (z0 + 1));
    const auto n = static_cast<int>(4 * kPi * 0.16 / kBands / (spacing * spacing * length * length));
    for (int i = 0; i < n; ++i) {  // along the band, so that neighbours in the list are neighbours in space
      const double z = z0 + 2.0 * uniform(random) / kBands, a = 2 * kPi * i / n,
                   r = std::sqrt(std::max(0.0, 1 - z * z));
      const float own = static_cast<float>(length);
      boxes.push_back({0.4 * Vec3{r * std::cos(a), r * std::sin(a), z}, own, own, pack_cause(CauseKind::kFace, band)});
    }
  }
  const Box3 root{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  time_octree(root, boxes, 0.1);
  for (RasterBox& box : boxes) box.center = 0.75 * box.center;  // onto the sphere that blanks
  time_blanking(root, boxes, 300);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "--cells" && argc > 2)
    bench_cells(std::atof(argv[2]));
  else if (first == "--open" && argc > 2)
    time_opening(argv[2]);
  else if (first == "--share" && argc > 3)
    share_sizing(argv[2], std::atoi(argv[3]));
  else if (first == "--nodes" && argc > 3)
    time_nodes(argv[2], argv[3]);
  else if (first == "--envelope" && argc > 4)
    bench_envelope(argv[2], argv[3], argv[4]);
  else if (first == "--accuracy" && argc > 2)
    bench_accuracy(argv[2]);
  else if (!first.empty())
    bench_model(first, argc > 2 ? std::atof(argv[2]) : 2.5);
  else
    report(
        "usage: sizing_bench MODEL [LMAX_PERCENT] | --cells MILLIONS | --open SIZING | --share SIZING RANKS | --nodes "
        "SIZING PATCHES | "
        "--envelope RASTER SIZING MESH | --accuracy MODEL\n");
}
