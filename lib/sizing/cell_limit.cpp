#include "sizing/cell_limit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace st {
namespace {

constexpr const char* kRemedy = "use larger lengths (--lmin, --lmax, --alpha, --chord, --sizes) or raise --max-cells";

std::string text_of(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string memory_text(double n_cells) {
  const double bytes = kRasterBytesPerCell * n_cells;
  const char* format = bytes >= 1e9   ? "%.3g GB of memory per rank"
                       : bytes >= 1e6 ? "%.3g MB of memory per rank"
                                      : "%.3g kB of memory per rank";
  return text_of(format, bytes / (bytes >= 1e9 ? 1e9 : bytes >= 1e6 ? 1e6 : 1e3));
}

double deepest_cell(const Box3& box) {
  Vec3 lo;
  double edge = 0;
  octree_root(box, lo, edge);
  return edge / kCoordinateEnd;
}

}  // namespace

void require_cells(double n_cells, std::uint64_t max_cells) {
  if (n_cells > static_cast<double>(max_cells))
    throw TooManyCells("the octree needs at least " + text_of(n_cells < 1e6 ? "%.0f" : "%.3g", std::ceil(n_cells)) +
                       " cells (" + memory_text(n_cells) + "), and at most " + std::to_string(max_cells) +
                       " are allowed; " + kRemedy);
}

void require_room_for(double n_samples, std::uint64_t max_samples) {
  if (n_samples > static_cast<double>(max_samples))
    throw TooManyCells("sampling needs at least " + text_of("%.3g", n_samples) + " samples, and the cells that are " +
                       "allowed have room for " + text_of("%.3g", static_cast<double>(max_samples)) + "; " + kRemedy);
}

void require_samples(std::uint64_t n_samples, std::uint64_t max_samples) {
  if (n_samples > max_samples)
    throw TooManyCells("sampling makes more than " + std::to_string(max_samples) +
                       " samples, which is what the cells that are allowed have room for; " + kRemedy);
}

double least_cells(const ModelTables& tables, const ModelLimits& limits) {
  const double largest_cut = std::sqrt(2.0), n_walls = 2,
               deepest = deepest_cell(tables.box());  // cut: a plane's through a unit cube
  double n = 1;
  for (std::size_t f = 0; f < limits.face.size(); ++f) {
    if (!limits.face[f]) continue;
    const double cell = std::max(deepest, limits.face[f]->cell_per_length * limits.face[f]->max_length);
    n += tables.face_area[f] / (n_walls * largest_cut * cell * cell);
  }
  return n;
}

double least_samples(const ModelTables& tables, const ModelLimits& limits) {
  constexpr double kLargestArea = 2;  // of a bent patch in a unit box; a plane one has 1.41 at most
  double n = 0;
  for (std::size_t f = 0; f < limits.face.size(); ++f) {
    if (!limits.face[f]) continue;
    const double side = patch_per_length(*limits.face[f]) * limits.face[f]->max_length;
    n += tables.face_area[f] / (kLargestArea * side * side);
  }
  return n;
}

void DepthLimit::add(const DepthLimit& other) {
  n_samples += other.n_samples;
  smallest_length = std::min(smallest_length, other.smallest_length);
  smallest_cell = std::max(smallest_cell, other.smallest_cell);
}

DepthLimit find_depth_limit(const Box3& root, std::span<const RasterBox> boxes) {
  DepthLimit limit;
  limit.smallest_cell = deepest_cell(root);
  for (const RasterBox& box : boxes) {
    if (!(limit.smallest_cell > 2.0 * box.half)) continue;
    ++limit.n_samples;
    limit.smallest_length = std::min(limit.smallest_length, box.length);
  }
  return limit;
}

}  // namespace st
