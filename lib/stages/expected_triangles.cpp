#include "stages/expected_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/error.h"
#include "base/local_size.h"
#include "base/log.h"
#include "sizing/size_field.h"

namespace st {
namespace {

constexpr std::size_t kMostQueries = 20000;    // of the field, on a whole mesh
constexpr std::size_t kFacesNamed = 5;         // in a warning
constexpr double kShare = 0.8;                 // of the memory
constexpr double kTilesOfMesh = 16;            // of a mesh that is one face
constexpr double kSmallTile = 8'000;           // triangles: cuts of smaller ones cost more than 2 %
constexpr double kLargeTile = 25'000;          // triangles: data of larger ones leave the caches
constexpr double kMeshBytesPerTriangle = 150;  // of st-mesh, measured (docs/dev/bench.md)

}  // namespace

double expected_triangles(std::span<const double> face_weight) {
  return kTrianglesPerWeight * std::accumulate(face_weight.begin(), face_weight.end(), 0.0);
}

double usual_tile(double n_triangles) { return std::clamp(n_triangles / kTilesOfMesh, kSmallTile, kLargeTile); }

std::string heaviest_faces(std::span<const double> face_weight, std::span<const std::string> face_name) {
  std::vector<std::size_t> order(face_weight.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return face_weight[a] > face_weight[b]; });
  const double all = std::accumulate(face_weight.begin(), face_weight.end(), 0.0);
  std::string text;
  for (std::size_t k = 0; k < std::min(order.size(), kFacesNamed); ++k) {
    const std::size_t f = order[k];
    const bool has_name = f < face_name.size() && !face_name[f].empty();
    text += fmt::format("{}{:.2g} % on face {}{}", k > 0 ? ", " : "", 100 * face_weight[f] / all, f + 1,
                        has_name ? " \"" + face_name[f] + "\"" : "");
  }
  return text;
}

void report_expected_triangles(std::span<const double> face_weight, std::span<const std::string> face_name,
                               std::optional<int> limit, const std::string& sizing, double many) {
  const double n = expected_triangles(face_weight);
  if (!std::isfinite(n))
    throw Error(ExitCode::kUsage, fmt::format("{}: these sizes need more triangles than can be counted; use a larger "
                                              "--scale, or larger lengths of st-raster",
                                              sizing));
  if (!(n > (limit ? *limit : many))) return;
  const std::string text =
      fmt::format("{}: these sizes need about {:.3g} triangles: {}", sizing, n, heaviest_faces(face_weight, face_name));
  const std::string ways = "use --target-triangles or a larger --scale, or a larger --lmin of st-raster";
  if (limit) throw Error(ExitCode::kUsage, fmt::format("{}; --max-triangles is {}: {}", text, *limit, ways));
  log_warning(fmt::format("{}; for fewer {}", text, ways));
}

std::vector<double> face_weights_on(const SurfaceMesh& mesh, const SizeField& field, FaceId n_faces) {
  std::vector<double> weight(static_cast<std::size_t>(n_faces));
  const auto step = static_cast<TriangleId>(1 + mesh.triangles.size() / kMostQueries);
  int hint = 0;
  for (TriangleId t = 0; t < mesh.n_triangles(); t += step) {
    const NodeId* n = mesh.triangles[t].n;
    const Vec3 a = mesh.node_xyz[n[0]], b = mesh.node_xyz[n[1]], c = mesh.node_xyz[n[2]];
    const LocalSize size = field.local_on((a + b + c) / 3, normalized(cross(b - a, c - a)), hint);
    const double area = 0.5 * norm(cross(squeezed(b - a, size.squeeze()), squeezed(c - a, size.squeeze())));
    weight[mesh.triangle_face[t]] += static_cast<double>(step) * area / (size.length * size.length);
  }
  return weight;
}

void require_countable_mesh(const ModelTables& tables, std::span<const double> face_weight,
                            std::span<const FaceId> faces, const std::string& sizing, double limit) {
  if (face_weight.size() != static_cast<std::size_t>(tables.n_faces()) || face_weight.empty()) return;
  std::vector<double> weight(face_weight.begin(), face_weight.end());  // of faces that are not meshed: 0
  if (!faces.empty()) weight.assign(weight.size(), 0.0);
  for (const FaceId f : faces) weight[f] = face_weight[f];
  const double n = expected_triangles(weight);
  if (n <= limit) return;
  const auto heaviest = static_cast<FaceId>(std::max_element(weight.begin(), weight.end()) - weight.begin());
  const double n_heaviest = kTrianglesPerWeight * weight[heaviest];
  throw Error(ExitCode::kUsage, fmt::format("{}: these sizes need about {:.3g} triangles ({:.3g} of them on {}), but a "
                                            "mesh can have at most {:.0f}{}; {}",
                                            sizing, n, n_heaviest, tables.face_label(heaviest), limit,
                                            limit < static_cast<double>(kMaxTriangles) ? " in the memory here" : "",
                                            n_heaviest > limit ? "use larger lengths, or a larger --scale of st-prolong"
                                                               : "use larger lengths, or mesh parts with --faces"));
}

double most_triangles_in(double memory) {
  return std::min(static_cast<double>(kMaxTriangles), kShare * memory / kMeshBytesPerTriangle);
}

}  // namespace st
