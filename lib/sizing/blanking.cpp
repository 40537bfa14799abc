#include "sizing/blanking.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "base/boxes.h"
#include "base/disjoint_sets.h"
#include "base/limits.h"
#include "base/pieces.h"
#include "base/predicates.h"
#include "base/threads.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

constexpr int kSamples = 9;  // points of a cell that tell its parts apart: near its corners, and the centre
// Of the half edge; irregular, so that surfaces aligned with the cells rarely hit them.
constexpr double kSampleX = 0.9371, kSampleY = 0.9423, kSampleZ = 0.9497, kSampleCentre = 0.0137;
constexpr std::int8_t kNoFlow = -1;
constexpr std::size_t kCellsPerPiece = 8'192;
constexpr std::size_t kCutCellsPerPiece = 1'024;  // likewise of cells that take microseconds each
constexpr double kRounded = 1e-6;                 // half edges: far more than clipped corners are rounded by
constexpr double kSheetCosine = 0.8;              // of triangles with their mean normal: no two of them face each other

/// A leaf as a cube.
struct Cube {
  Vec3 center;
  double half = 0;

  Vec3 sample(int s) const {
    if (s == 8) return center + kSampleCentre * half * Vec3{1, 0.7, 0.4};
    return center +
           half * Vec3{s & 1 ? kSampleX : -kSampleX, s & 2 ? kSampleY : -kSampleY, s & 4 ? kSampleZ : -kSampleZ};
  }
  /// The point of the cube, a share of it around its centre, that is nearest to x.
  Vec3 closest(Vec3 x, double share = 1) const {
    const double h = share * half;
    const auto clamp = [h](double v, double c) { return std::clamp(v, c - h, c + h); };
    return {clamp(x.x, center.x), clamp(x.y, center.y), clamp(x.z, center.z)};
  }
  Vec3 nearest(Vec3 x) const { return closest(x, 0.94); }
};

/// The parts of the flow in a cut cell, by samples.
struct CellParts {
  std::array<std::int8_t, kSamples> part = {-1, -1, -1, -1, -1, -1, -1, -1, -1};  // 0, 1 or kNoFlow
  std::array<Vec3, 2> spare;  // of each part a point of the flow, where no sample is one
  std::array<bool, 2> has_spare = {false, false};

  bool has(int p) const { return has_spare[p] || std::find(part.begin(), part.end(), p) != part.end(); }
};

/// A triangle of the surface in the cell at hand.
struct Piece {
  TriangleId triangle = kNone;
  ClippedTriangle polygon;
  Vec3 middle, area;  // area: towards the flow
  Box3 box;           // of the polygon
};

/// What a thread needs for the cells at hand.
struct Scratch {
  std::vector<Piece> pieces;
  std::unordered_map<std::int32_t, CellParts> sheet_parts;  // by cut cell, once they are asked for
  std::unordered_map<std::uint64_t, bool> ways;             // by two cells and their parts
};

/// What a piece knows of its cells helps the next ones in it: pieces are shorter only where several threads share them.
std::size_t cut_cells_per_piece() { return threads_of_pieces() > 1 ? kCutCellsPerPiece : kCellsPerPiece; }

/// Links of some sites, in order.
struct LinkRows {
  std::vector<std::int32_t> site;
  std::vector<OpenLinks> links;
};

class Blanker {
 public:
  Blanker(const Neighbours& neighbours, const SurfaceView& surface, BlankSide side,
          std::span<const Triangle> open_edges)
      : open_edges_(open_edges),
        octree_(neighbours.octree()),
        neighbours_(neighbours),
        surface_(surface),
        flow_sign_(side == BlankSide::kInside ? 1 : -1) {}

  Blanking run() {
    cut_ = find_cut_cells(octree_, surface_);
    leave_holes_open();
    box_triangles();
    colour_cut_cells();
    run_jobs({[&] {  // looks at cut cells alone
                find_sheets();
                find_parts();
              },
              [&] { colour_the_rest(); }});
    link_sites();
    result_.cut_index = std::move(cut_index_);
    result_.sheet = std::move(sheet_);
    return std::move(result_);
  }

 private:
  Cube cube(std::int32_t leaf) const {
    return {octree_.leaf_center(leaf), 0.5 * octree_.cell_edge(octree_.leaf_levels[leaf])};
  }
  bool is_cut(std::int32_t leaf) const { return result_.colour[leaf] == CellColour::kCut; }

  /// Where the surface has an open edge nothing is known: such cells count as not cut.
  void leave_holes_open() {
    if (open_edges_.empty()) return;
    const CutCells open = find_cut_cells(octree_, {surface_.points, open_edges_});
    CutCells kept;
    for (std::int32_t i = 0; i < cut_.n_cut(); ++i) {
      if (std::binary_search(open.leaf.begin(), open.leaf.end(), cut_.leaf[i])) continue;
      const std::span<const TriangleId> triangles = cut_.triangles(i);
      kept.leaf.push_back(cut_.leaf[i]);
      kept.triangle.insert(kept.triangle.end(), triangles.begin(), triangles.end());
      kept.offsets.push_back(static_cast<std::int64_t>(kept.triangle.size()));
    }
    cut_ = std::move(kept);
  }

  void colour_cut_cells() {
    result_.colour.assign(octree_.leaf_keys.size(), CellColour::kFlow);
    cut_index_.assign(octree_.leaf_keys.size(), kNone);
    for (std::int32_t i = 0; i < cut_.n_cut(); ++i) {
      result_.colour[cut_.leaf[i]] = CellColour::kCut;
      cut_index_[cut_.leaf[i]] = i;
    }
  }

  /// An open surface has no inside: all is flow.
  std::vector<CellColour> colours_at(std::span<const Vec3> points) const {
    std::vector<CellColour> colours(points.size(), CellColour::kFlow);
    if (!open_edges_.empty()) return colours;
    const std::vector<int> winding = winding_numbers(surface_, points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((winding[i] > 0) != (flow_sign_ < 0)) colours[i] = CellColour::kBlanked;
    return colours;
  }

  /// One ray for each region of uncut cells that hang together at faces, and its colour for all of them.
  void colour_the_rest() {
    const std::size_t n = octree_.leaf_keys.size();
    std::vector<std::int32_t> region(n, kNone);  // the lowest cell that hangs together with it in its piece
    std::vector<std::vector<CellPair>> between((n + kCellsPerPiece - 1) / kCellsPerPiece);
    parallel_for(n, kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
      flood(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), region, between[begin / kCellsPerPiece]);
    });
    DisjointSets regions(octree_.n_leaves());
    for (const std::vector<CellPair>& pairs : between)
      for (const auto& [seed, other] : pairs) regions.join(seed, region[other]);
    colour_regions(region, regions);
    parallel_for(n, kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t leaf = begin; leaf < end; ++leaf)
        if (region[leaf] != kNone && region[leaf] != static_cast<std::int32_t>(leaf))
          result_.colour[leaf] = result_.colour[region[leaf]];
    });
  }

  using CellPair = std::pair<std::int32_t, std::int32_t>;

  /// Regions of the cells of a piece, and what lies across faces in a piece ahead of it, by the region beside it.
  void flood(std::int32_t begin, std::int32_t end, std::vector<std::int32_t>& region,
             std::vector<CellPair>& between) const {
    std::vector<std::int32_t> front;
    for (std::int32_t seed = begin; seed < end; ++seed) {
      if (is_cut(seed) || region[seed] != kNone) continue;
      front.assign(1, seed);
      region[seed] = seed;
      while (!front.empty()) {
        const std::int32_t leaf = front.back();
        front.pop_back();
        neighbours_.for_each_across_face(leaf, [&](std::int32_t other, const CellStep&) {
          if (other >= end || is_cut(other)) return;
          if (other < begin) return between.emplace_back(seed, other), void();
          if (region[other] != kNone) return;
          region[other] = seed;
          front.push_back(other);
        });
      }
    }
  }

  /// Of the first cell of each region in its piece.
  void colour_regions(const std::vector<std::int32_t>& region, DisjointSets& regions) {
    std::vector<std::int32_t> seeds, first;  // first: of all pieces, and of each
    std::vector<Vec3> centers;
    for (std::int32_t leaf = 0; leaf < octree_.n_leaves(); ++leaf) {
      if (region[leaf] != leaf) continue;
      first.push_back(leaf);
      if (regions.find(leaf) != leaf) continue;
      seeds.push_back(leaf);
      centers.push_back(octree_.leaf_center(leaf));
    }
    const std::vector<CellColour> colour = colours_at(centers);
    for (std::size_t i = 0; i < seeds.size(); ++i) result_.colour[seeds[i]] = colour[i];
    for (const std::int32_t leaf : first) result_.colour[leaf] = result_.colour[regions.find(leaf)];
  }

  /// Boxes of the triangles: most are passed over by them.
  void box_triangles() {
    constexpr float kWider = std::numeric_limits<float>::epsilon(), kLeast = std::numeric_limits<float>::min();
    const auto wider = [](float v) { return kWider * std::abs(v) + kLeast; };
    const auto below = [&](double v) { return static_cast<float>(v) - wider(static_cast<float>(v)); };
    const auto above = [&](double v) { return static_cast<float>(v) + wider(static_cast<float>(v)); };
    boxes_.resize(surface_.triangles.size());
    parallel_for(boxes_.size(), kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Box3 box;
        for (int k = 0; k < 3; ++k) box.add(surface_.corner(static_cast<TriangleId>(i), k));
        boxes_[i] = {below(box.lo.x), below(box.lo.y), below(box.lo.z),
                     above(box.hi.x), above(box.hi.y), above(box.hi.z)};
      }
    });
  }

  /// Whether no triangle of the leaf meets the segment pq.
  bool is_open(Vec3 p, Vec3 q, std::int32_t leaf) const {
    const std::int32_t cut = cut_index_[leaf];
    if (cut == kNone) return true;
    Box3 way;
    way.add(p);
    way.add(q);
    for (std::int64_t i = cut_.offsets[cut]; i < cut_.offsets[cut + 1]; ++i) {
      const TriangleId t = cut_.triangle[i];
      const TriangleBox& b = boxes_[t];
      if (b.lo_x > way.hi.x || b.hi_x < way.lo.x || b.lo_y > way.hi.y || b.hi_y < way.lo.y || b.lo_z > way.hi.z ||
          b.hi_z < way.lo.z)
        continue;
      if (segment_meets_triangle(p, q, surface_.corner(t, 0), surface_.corner(t, 1), surface_.corner(t, 2)))
        return false;
    }
    return true;
  }

  // --- cells with one sheet of the surface ---

  /// Most cut cells meet one sheet, all of whose triangles look the same way. Of a closed surface such a cell has one
  /// part of the flow, and passes lengths to its neighbours whose sheet looks that way, too: between two sheets that
  /// look the same way lies a third one.
  void find_sheets() {
    sheet_.resize(cut_.leaf.size());
    if (!open_edges_.empty()) return;
    std::vector<Vec3> normal(surface_.triangles.size());
    parallel_for(normal.size(), kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) normal[t] = flow_sign_ * normal_of(static_cast<TriangleId>(t));
    });
    parallel_for(sheet_.size(), kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        sheet_[i] = sheet_of(cut_.triangles(static_cast<std::int32_t>(i)), normal);
    });
  }

  /// Zero where they look different ways.
  static Vec3 sheet_of(std::span<const TriangleId> triangles, const std::vector<Vec3>& normal) {
    Vec3 sum;
    for (const TriangleId t : triangles) sum += normal[t];
    if (!(norm2(sum) > 0)) return {};
    const Vec3 mean = normalized(sum);
    const auto looks_along = [&](TriangleId t) { return dot(normal[t], mean) > kSheetCosine; };
    return std::all_of(triangles.begin(), triangles.end(), looks_along) ? mean : Vec3{};
  }

  /// Zero for a triangle without area.
  Vec3 normal_of(TriangleId t) const {
    const Vec3 area =
        cross(surface_.corner(t, 1) - surface_.corner(t, 0), surface_.corner(t, 2) - surface_.corner(t, 0));
    return norm2(area) > 0 ? normalized(area) : Vec3{};
  }

  bool is_sheet(std::int32_t cut) const { return norm2(sheet_[cut]) > 0; }

  /// Whether sheets alone tell that lengths pass between the first parts of two cells, one of them cut.
  bool is_one_side(std::int32_t a, std::int32_t b) const {
    const std::int32_t cut_a = cut_index_[a], cut_b = cut_index_[b];
    if (cut_a == kNone) return is_before_sheet(a, b);
    if (cut_b == kNone) return is_before_sheet(b, a);
    return dot(sheet_[cut_a], sheet_[cut_b]) > 0;
  }

  /// Whether the sheet of a cell looks towards a cell that is not cut.
  bool is_before_sheet(std::int32_t uncut, std::int32_t leaf) const {
    const std::int32_t cut = cut_index_[leaf];
    if (!is_sheet(cut)) return false;
    const Vec3 x = octree_.leaf_center(uncut);
    const std::span<const TriangleId> all = cut_.triangles(cut);
    return std::all_of(all.begin(), all.end(),
                       [&](TriangleId t) { return dot(sheet_[cut], x - surface_.corner(t, 0)) > 0; });
  }

  // --- parts of cut cells ---

  void find_parts() {
    struct SplitCells {
      std::vector<std::int32_t> leaf;
      std::vector<CellSplit> split;
    };
    const std::size_t n = static_cast<std::size_t>(cut_.n_cut()), n_per_piece = cut_cells_per_piece();
    parts_.resize(n);
    std::vector<SplitCells> pieces((n + n_per_piece - 1) / n_per_piece);
    parallel_for(n, n_per_piece, [&](std::size_t begin, std::size_t end) {
      Scratch scratch;
      SplitCells& own = pieces[begin / n_per_piece];
      for (auto i = static_cast<std::int32_t>(begin); i < static_cast<std::int32_t>(end); ++i) {
        if (is_sheet(i)) continue;  // see parts()
        parts_[i] = parts_of(i, scratch.pieces);
        if (!parts_[i].has(1)) continue;
        own.leaf.push_back(cut_.leaf[i]);
        own.split.push_back(split_cell(i, scratch.pieces));
      }
    });
    for (const SplitCells& own : pieces) {
      result_.split_leaf.insert(result_.split_leaf.end(), own.leaf.begin(), own.leaf.end());
      result_.split.insert(result_.split.end(), own.split.begin(), own.split.end());
    }
  }

  /// Those of sheets are found when they are asked for.
  const CellParts& parts(std::int32_t cut, Scratch& scratch) const {
    if (!is_sheet(cut)) return parts_[cut];
    const auto [it, is_new] = scratch.sheet_parts.try_emplace(cut);
    if (is_new) it->second = parts_of(cut, scratch.pieces);
    return it->second;
  }

  /// Leaves the surface in the cell in `pieces`.
  CellParts parts_of(std::int32_t i, std::vector<Piece>& pieces) const {
    const Cube cell = cube(cut_.leaf[i]);
    clip(i, cell, pieces);
    std::array<Vec3, kSamples> sample;
    for (int s = 0; s < kSamples; ++s) sample[s] = cell.sample(s);
    const std::array<int, kSamples> group = connect_samples(sample, cut_.leaf[i]);
    constexpr int kVotes = 3;  // of a group's samples: no triangle lies between them
    std::array<int, kSamples> vote{}, count{};
    for (int s = 0; s < kSamples; ++s)
      if (++count[group[s]] <= kVotes) vote[group[s]] += sign_at(cell, sample[s], pieces);
    std::array<int, 2> largest{kNone, kNone};  // groups of flow
    for (int g = 0; g < kSamples; ++g) {
      if (count[g] == 0 || vote[g] <= 0) continue;
      if (largest[0] == kNone || count[g] > count[largest[0]]) {
        largest[1] = largest[0];
        largest[0] = g;
      } else if (largest[1] == kNone || count[g] > count[largest[1]]) {
        largest[1] = g;
      }
    }
    std::array<Vec3, kSamples> outlook;
    if (std::any_of(group.begin(), group.end(),
                    [&](int g) { return vote[g] > 0 && g != largest[0] && g != largest[1]; }))
      outlook = outlooks(cell, group, pieces);
    const auto is_second = [&](int g) {  // further groups go with those that see the surface from the same side
      if (largest[1] == kNone || g == largest[0]) return false;
      return g == largest[1] || dot(outlook[g], outlook[largest[1]]) > dot(outlook[g], outlook[largest[0]]);
    };
    CellParts parts;
    for (int s = 0; s < kSamples; ++s) {
      const int g = group[s];
      parts.part[s] = vote[g] <= 0 ? kNoFlow : is_second(g) ? 1 : 0;
    }
    if (largest[0] == kNone)
      set_hidden_parts(cell, pieces, !is_sheet(i), parts);
    else if (largest[1] == kNone && !is_sheet(i))
      set_hidden_part(cell, pieces, parts);
    return parts;
  }

  /// Where no sample is flow: surfaces that clip corners of the cell, a wall between them at most.
  static void set_hidden_parts(const Cube& cell, const std::vector<Piece>& pieces, bool may_be_two, CellParts& parts) {
    const Piece* first = find_largest_piece(pieces, [](const Piece&) { return true; });
    set_spare(cell, first, 0, parts);
    if (!may_be_two || !first) return;
    const std::vector<bool> is_first = connected_with(pieces, cell.half, [&](const Piece& p) { return &p == first; });
    const Piece* second = find_largest_piece(pieces, [&](const Piece& piece) {
      return !is_first[&piece - pieces.data()] && dot(piece.area, parts.spare[0] - piece.middle) <= 0;
    });
    if (second) set_spare(cell, second, 1, parts);
  }

  /// [n_pieces] those from which a way over the surface in the cell leads to a piece that `is_start` is true for.
  template <class IsStart>
  static std::vector<bool> connected_with(const std::vector<Piece>& pieces, double half, const IsStart& is_start) {
    std::vector<bool> is_connected(pieces.size(), false);
    std::vector<std::size_t> front;
    const auto add = [&](std::size_t i) {
      is_connected[i] = true;
      front.push_back(i);
    };
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (is_start(pieces[i])) add(i);
    while (!front.empty()) {
      const Piece& from = pieces[front.back()];
      front.pop_back();
      for (std::size_t i = 0; i < pieces.size(); ++i)
        if (!is_connected[i] && have_common_corner(from, pieces[i], half)) add(i);
    }
    return is_connected;
  }

  static bool have_common_corner(const Piece& a, const Piece& b, double half) {
    const double near = kRounded * half;
    if (!meet(a.box, b.box, near)) return false;
    for (int i = 0; i < a.polygon.n; ++i)
      for (int k = 0; k < b.polygon.n; ++k)
        if (norm2(a.polygon.corner[i] - b.polygon.corner[k]) <= near * near) return true;
    return false;
  }

  static const Piece* nearest_piece(Vec3 x, const std::vector<Piece>& pieces) {
    const Piece* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces)
      if (const double distance2 = norm2(piece.middle - x); !nearest || distance2 < least) {
        nearest = &piece;
        least = distance2;
      }
    return nearest;
  }

  /// Of each group of samples, unit: the normal of the pieces of the surface that are nearest to them, into the flow.
  static std::array<Vec3, kSamples> outlooks(const Cube& cell, const std::array<int, kSamples>& group,
                                             const std::vector<Piece>& pieces) {
    std::array<Vec3, kSamples> sum;
    for (int s = 0; s < kSamples; ++s)
      if (const Piece* nearest = nearest_piece(cell.sample(s), pieces)) sum[group[s]] += normalized(nearest->area);
    for (Vec3& v : sum) v = normalized(v);
    return sum;
  }

  static Box3 box_of(const ClippedTriangle& polygon) {
    Box3 box;
    for (int k = 0; k < polygon.n; ++k) box.add(polygon.corner[k]);
    return box;
  }

  /// Triangles of the cell, cut off at its sides.
  void clip(std::int32_t i, const Cube& cell, std::vector<Piece>& pieces) const {
    pieces.clear();
    for (const TriangleId t : cut_.triangles(i)) {
      const Vec3 a = surface_.corner(t, 0), b = surface_.corner(t, 1), c = surface_.corner(t, 2);
      const ClippedTriangle polygon = clip_triangle(a, b, c, cell.center, cell.half);
      if (polygon.n < 3) continue;
      Vec3 area;
      for (int k = 1; k + 1 < polygon.n; ++k)
        area += 0.5 * cross(polygon.corner[k] - polygon.corner[0], polygon.corner[k + 1] - polygon.corner[0]);
      if (!(norm2(area) > 0)) continue;
      pieces.push_back({t, polygon, polygon.middle(), flow_sign_ * area, box_of(polygon)});
    }
  }

  /// For each sample the lowest one that it is connected with along the cell's edges and diagonals.
  std::array<int, kSamples> connect_samples(const std::array<Vec3, kSamples>& sample, std::int32_t leaf) const {
    std::array<int, kSamples> group;
    std::iota(group.begin(), group.end(), 0);
    const auto join = [&](int a, int b) {
      if (group[a] == group[b] || !is_open(sample[a], sample[b], leaf)) return;
      const auto [low, high] = std::minmax(group[a], group[b]);
      const int from = high, to = low;
      for (int& g : group)
        if (g == from) g = to;
    };
    for (int axis = 1; axis < 8; axis *= 2)
      for (int s = 0; s < 8; ++s)
        if (!(s & axis)) join(s, s | axis);
    for (int s = 0; s < 8; ++s) join(s, 8);
    return group;
  }

  /// 1: flow, -1: not, 0: nothing to tell it by. The first triangle on the way to the nearest piece of the surface
  /// decides.
  int sign_at(const Cube& cell, Vec3 x, const std::vector<Piece>& pieces) const {
    const Piece* nearest = nearest_piece(x, pieces);
    if (!nearest) return 0;
    Box3 way;
    way.add(x);
    way.add(nearest->middle);
    double first = std::numeric_limits<double>::infinity();
    int sign = 0;
    for (const Piece& piece : pieces) {
      if (&piece != nearest && !meet(way, piece.box, kRounded * cell.half)) continue;
      const Vec3 a = surface_.corner(piece.triangle, 0), b = surface_.corner(piece.triangle, 1),
                 c = surface_.corner(piece.triangle, 2);
      const double from = orient3d(a, b, c, x);
      if (from == 0) continue;
      double t = 1;
      if (&piece != nearest) {
        const double to = orient3d(a, b, c, nearest->middle);
        if ((from > 0 && to > 0) || (from < 0 && to < 0)) continue;
        t = from / (from - to);
      }
      if (!(t < first) || (&piece != nearest && !line_meets_triangle(x, nearest->middle, a, b, c))) continue;
      first = t;
      sign = from > 0 ? 1 : -1;
    }
    return flow_sign_ * sign;
  }

  /// Null: none is wanted.
  template <class IsWanted>
  static const Piece* find_largest_piece(const std::vector<Piece>& pieces, const IsWanted& is_wanted) {
    const Piece* largest = nullptr;
    for (const Piece& piece : pieces)
      if (is_wanted(piece) && (!largest || norm2(piece.area) > norm2(largest->area))) largest = &piece;
    return largest;
  }

  /// A surface that turns its back to all samples of the flow bounds a part of its own, too thin for a sample; rather
  /// one that is not connected with what they see.
  static void set_hidden_part(const Cube& cell, const std::vector<Piece>& pieces, CellParts& parts) {
    const auto is_seen = [&](const Piece& piece) {
      for (int s = 0; s < kSamples; ++s)
        if (parts.part[s] == 0 && dot(piece.area, cell.sample(s) - piece.middle) > 0) return true;
      return false;
    };
    const Piece* hidden = find_largest_piece(pieces, [&](const Piece& piece) { return !is_seen(piece); });
    if (!hidden) return;
    const std::vector<bool> is_connected = connected_with(pieces, cell.half, is_seen);
    if (const Piece* apart =
            find_largest_piece(pieces, [&](const Piece& piece) { return !is_connected[&piece - pieces.data()]; }))
      hidden = apart;
    set_spare(cell, hidden, 1, parts);
  }

  /// A point just off the surface, in the flow.
  static void set_spare(const Cube& cell, const Piece* piece, int part, CellParts& parts) {
    constexpr double kOff = 1e-3;  // of the half edge
    parts.spare[part] = piece ? piece->middle + kOff * cell.half * normalized(piece->area) : cell.center;
    parts.has_spare[part] = true;
  }

  /// The plane between the surface that looks to the first part and the one that looks to the second.
  CellSplit split_cell(std::int32_t i, const std::vector<Piece>& pieces) const {
    const Cube cell = cube(cut_.leaf[i]);
    std::array<Vec3, 2> sum;
    std::array<int, 2> count{};
    const auto add = [&](int p, Vec3 x) {
      if (p == kNoFlow) return;
      sum[p] += x;
      ++count[p];
    };
    for (int s = 0; s < kSamples; ++s) add(parts_[i].part[s], cell.sample(s));
    for (const int p : {0, 1})
      if (parts_[i].has_spare[p]) add(p, parts_[i].spare[p]);
    const Vec3 across = sum[0] / count[0] - sum[1] / count[1];
    Vec3 normal;
    for (const Piece& piece : pieces) normal += (dot(piece.area, across) < 0 ? -1.0 : 1.0) * piece.area;
    normal = norm2(normal) > 0 ? normalized(normal) : normalized(across);
    double lowest_first = std::numeric_limits<double>::infinity(), highest_second = -lowest_first;
    for (const Piece& piece : pieces)
      for (int k = 0; k < piece.polygon.n; ++k) {
        const double height = dot(normal, piece.polygon.corner[k] - cell.center);
        if (dot(piece.area, normal) > 0)
          lowest_first = std::min(lowest_first, height);
        else
          highest_second = std::max(highest_second, height);
      }
    if (!std::isfinite(lowest_first)) lowest_first = highest_second;
    if (!std::isfinite(highest_second)) highest_second = lowest_first;
    const auto f = [](double v) { return static_cast<float>(v); };
    return {{f(normal.x), f(normal.y), f(normal.z)},
            f(0.5 * (lowest_first + highest_second)),
            f(std::max(0.0, 0.5 * (highest_second - lowest_first)))};
  }

  // --- links ---

  /// Leaves that touch a cut cell at a face or are cut, ascending.
  std::vector<std::int32_t> near_leaves() const {
    std::vector<std::uint8_t> is_near(octree_.leaf_keys.size(), 0);
    const auto mark = [&](std::int32_t leaf) { std::atomic_ref(is_near[leaf]).store(1, std::memory_order_relaxed); };
    parallel_for(cut_.leaf.size(), kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        mark(cut_.leaf[i]);
        neighbours_.for_each_across_face(cut_.leaf[i], [&](std::int32_t other, const CellStep&) { mark(other); });
      }
    });
    std::vector<std::int32_t> near;
    for (std::int32_t leaf = 0; leaf < octree_.n_leaves(); ++leaf)
      if (is_near[leaf]) near.push_back(leaf);
    return near;
  }

  /// Rows of all sites that touch a cut cell at a face or are cut; those of second parts follow all others.
  void link_sites() {
    const std::int32_t n = octree_.n_leaves(), n_split = static_cast<std::int32_t>(result_.split_leaf.size());
    require_countable(result_.colour.size() + result_.split_leaf.size(), "cells and parts of cells");
    result_.site_links.assign(static_cast<std::size_t>(n + n_split), kNone);
    const std::vector<std::int32_t> near = near_leaves();
    const std::size_t n_per_piece = cut_cells_per_piece(), n_pieces = (near.size() + n_per_piece - 1) / n_per_piece;
    std::vector<LinkRows> pieces(2 * n_pieces);
    parallel_for(near.size(), n_per_piece, [&](std::size_t begin, std::size_t end) {
      Scratch scratch;
      LinkRows &rows = pieces[begin / n_per_piece], &of_second = pieces[n_pieces + begin / n_per_piece];
      std::int32_t split = static_cast<std::int32_t>(
          std::lower_bound(result_.split_leaf.begin(), result_.split_leaf.end(), near[begin]) -
          result_.split_leaf.begin());
      for (std::size_t i = begin; i < end; ++i) {
        add_row(near[i], near[i], 0, scratch, rows);
        if (split < n_split && result_.split_leaf[split] == near[i])
          add_row(n + split++, near[i], 1, scratch, of_second);
      }
    });
    for (const LinkRows& rows : pieces)
      for (std::size_t i = 0; i < rows.site.size(); ++i) {
        result_.site_links[rows.site[i]] = static_cast<std::int32_t>(result_.links.size());
        result_.links.push_back(rows.links[i]);
      }
  }

  void add_row(std::int32_t site, std::int32_t leaf, int part, Scratch& scratch, LinkRows& rows) const {
    const OpenLinks across_faces = open_links(leaf, part, true, scratch);
    const bool has_any = (across_faces.to_first | across_faces.to_second) != 0;
    rows.site.push_back(site);
    rows.links.push_back(has_any ? across_faces : open_links(leaf, part, false, scratch));
  }

  OpenLinks open_links(std::int32_t leaf, int part, bool across_faces, Scratch& scratch) const {
    OpenLinks open;
    std::int32_t last = kNone;
    std::array<std::uint64_t, 2> last_open{};
    const auto add = [&](std::int32_t other, int n) {
      if (other != last) last_open = {passes(leaf, part, other, 0, scratch), passes(leaf, part, other, 1, scratch)};
      last = other;
      open.to_first |= last_open[0] << n;
      open.to_second |= last_open[1] << n;
    };
    int n = 0;
    if (across_faces)
      neighbours_.for_each_across_face_numbered(
          leaf, [&](std::int32_t other, const CellStep&, int of_all) { add(other, of_all); });
    else
      neighbours_.for_each(leaf, [&](std::int32_t other, const CellStep&) { add(other, n++); });
    return open;
  }

  bool passes(std::int32_t from, int from_part, std::int32_t to, int to_part, Scratch& scratch) const {
    if (to_part == 1 && !(is_cut(to) && !is_sheet(cut_index_[to]) && parts_[cut_index_[to]].has(1))) return false;
    if (result_.colour[to] == CellColour::kBlanked) return true;
    if (result_.colour[from] == CellColour::kBlanked) return false;
    if (!is_cut(from) && !is_cut(to)) return true;
    if (from_part == 0 && to_part == 0 && is_one_side(from, to)) return true;
    return from < to ? is_open_way(from, from_part, to, to_part, scratch)
                     : is_open_way(to, to_part, from, from_part, scratch);
  }

  /// sees(), which is the same both ways: found for one row, kept until the other asks.
  bool is_open_way(std::int32_t a, int part_a, std::int32_t b, int part_b, Scratch& scratch) const {
    const auto key = static_cast<std::uint64_t>(2 * static_cast<std::int64_t>(a) + part_a) << 32 |
                     static_cast<std::uint64_t>(2 * static_cast<std::int64_t>(b) + part_b);
    const auto [it, is_new] = scratch.ways.try_emplace(key, false);
    if (is_new) return it->second = sees(a, part_a, b, part_b, scratch);
    const bool is_open = it->second;
    scratch.ways.erase(it);
    return is_open;
  }

  /// Whether the surface leaves a way between two parts: tried between their points that are nearest to the other, and
  /// once more.
  bool sees(std::int32_t a, int part_a, std::int32_t b, int part_b, Scratch& scratch) const {
    const Cube cube_a = cube(a), cube_b = cube(b);
    const auto near_a = [&](Vec3 x, const Vec3* without = nullptr) {
      return nearest_point({a, part_a}, cube_a, x, without, scratch);
    };
    const auto near_b = [&](Vec3 x) { return nearest_point({b, part_b}, cube_b, x, nullptr, scratch); };
    const Vec3 from_a = near_a(cube_b.center), to_b = near_b(from_a);
    if (is_way(a, from_a, b, to_b, cube_a, cube_b)) return true;
    const Vec3 from_b = near_b(cube_a.center), to_a = near_a(from_b);
    if (!(from_b == to_b && to_a == from_a) && is_way(a, to_a, b, from_b, cube_a, cube_b)) return true;
    const Vec3 second = near_a(cube_b.center, &from_a);
    return is_way(a, second, b, near_b(second), cube_a, cube_b);
  }

  /// Through a point that both cells have, so that each leg stays in its cell.
  bool is_way(std::int32_t a, Vec3 from, std::int32_t b, Vec3 to, const Cube& cube_a, const Cube& cube_b) const {
    const Vec3 common = cube_b.closest(cube_a.closest(0.5 * (from + to)));
    return is_open(from, common, a) && is_open(common, to, b);
  }

  /// Of the samples of a part, but `without`, the one nearest to x; in an uncut cell any point.
  struct LeafPart {
    std::int32_t leaf;
    int part;
  };
  Vec3 nearest_point(LeafPart at, const Cube& own, Vec3 x, const Vec3* without, Scratch& scratch) const {
    const auto [leaf, part] = at;
    if (!is_cut(leaf)) return own.nearest(x);
    const CellParts& parts = this->parts(cut_index_[leaf], scratch);
    if (parts.has_spare[part]) return parts.spare[part];
    Vec3 nearest = without ? *without : own.center;
    double least = std::numeric_limits<double>::infinity();
    const Vec3 low = own.sample(0), high = own.sample(7), from_low = low - x, from_high = high - x;
    const double dx2[2] = {from_low.x * from_low.x, from_high.x * from_high.x},
                 dy2[2] = {from_low.y * from_low.y, from_high.y * from_high.y},
                 dz2[2] = {from_low.z * from_low.z, from_high.z * from_high.z};
    const auto look_at = [&](double distance2, Vec3 y) {
      if (distance2 >= least || (without && y == *without)) return;
      least = distance2;
      nearest = y;
    };
    for (int s = 0; s < kSamples - 1; ++s)
      if (parts.part[s] == part)
        look_at(dx2[s & 1] + dy2[s >> 1 & 1] + dz2[s >> 2 & 1],
                {s & 1 ? high.x : low.x, s & 2 ? high.y : low.y, s & 4 ? high.z : low.z});
    if (parts.part[kSamples - 1] == part) look_at(norm2(own.sample(kSamples - 1) - x), own.sample(kSamples - 1));
    return nearest;
  }

  struct TriangleBox {
    float lo_x, lo_y, lo_z, hi_x, hi_y, hi_z;
  };

  const std::span<const Triangle> open_edges_;
  const OctreeView& octree_;
  const Neighbours& neighbours_;
  const SurfaceView& surface_;
  const int flow_sign_;  // +1: the flow lies where the normals point to
  CutCells cut_;
  std::vector<TriangleBox> boxes_;       // [n_triangles]
  std::vector<std::int32_t> cut_index_;  // [n_leaves] kNone: not cut
  std::vector<Vec3> sheet_;              // [n_cut] unit, into the flow, where the cell meets one sheet; else zero
  std::vector<CellParts> parts_;         // [n_cut]
  Blanking result_;
};

}  // namespace

std::int32_t Blanking::find_split(std::int32_t leaf) const {
  const auto it = std::lower_bound(split_leaf.begin(), split_leaf.end(), leaf);
  return it != split_leaf.end() && *it == leaf ? static_cast<std::int32_t>(it - split_leaf.begin()) : kNone;
}

std::vector<Triangle> find_open_edges(const SurfaceView& surface) {
  constexpr std::size_t kNodesPerPiece = 2'048;
  const EdgeTable edges(surface.triangles, static_cast<std::int64_t>(surface.points.size()));
  std::vector<std::vector<Triangle>> pieces((surface.points.size() + kNodesPerPiece - 1) / kNodesPerPiece);
  parallel_for(surface.points.size(), kNodesPerPiece, [&](std::size_t begin, std::size_t end) {
    edges.for_each_edge(static_cast<NodeId>(begin), static_cast<NodeId>(end),
                        [&](NodeId low, NodeId high, std::span<const SideId> sides) {
                          std::ptrdiff_t balance = 0;
                          for (const SideId side : sides)
                            balance += side_start(surface.triangles, side) == low ? 1 : -1;
                          if (balance != 0) pieces[begin / kNodesPerPiece].push_back({{low, high, high}});
                        });
  });
  std::vector<Triangle> open;
  for (const std::vector<Triangle>& piece : pieces) open.insert(open.end(), piece.begin(), piece.end());
  return open;
}

Blanking blank_cells(const Neighbours& neighbours, const SurfaceView& surface, BlankSide side,
                     std::span<const Triangle> open_edges) {
  return Blanker(neighbours, surface, side, open_edges).run();
}

}  // namespace st
