#include "sizing/blanking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "unit/sizing/sampled_field.h"

namespace st {
namespace {

/// A closed surface, normals out.
struct BlankedSurface {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  SurfaceView view() const { return {points, triangles}; }
};

/// A box whose sides are cut into n x n squares.
BlankedSurface box_surface(Vec3 lo, Vec3 hi, int n) {
  BlankedSurface s;
  const Vec3 d = hi - lo;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const auto at = [&](int i, int j) {
      const double u = double(i) / n, v = double(j) / n, w = side % 2;
      const Vec3 x = axis == 0 ? Vec3{w, u, v} : axis == 1 ? Vec3{v, w, u} : Vec3{u, v, w};
      s.points.push_back(lo + Vec3{x.x * d.x, x.y * d.y, x.z * d.z});
      return static_cast<NodeId>(s.points.size() - 1);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const NodeId a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), e = at(i, j + 1);
        if (side % 2) {
          s.triangles.push_back({{a, b, c}});
          s.triangles.push_back({{a, c, e}});
        } else {
          s.triangles.push_back({{a, c, b}});
          s.triangles.push_back({{a, e, c}});
        }
      }
  }
  return s;
}

constexpr double kLargest = 0.5, kSlope = 0.2;

std::shared_ptr<test::SampledField> size_with(const std::vector<RasterBox>& boxes, const BlankedSurface* surface,
                                              BlankSide side = BlankSide::kInside) {
  return test::sample_field(boxes, kSlope, kLargest, [&](const Neighbours& neighbours, Blanking& blanking) {
    if (surface) blanking = blank_cells(neighbours, surface->view(), side);
  });
}

double size_at(const test::SampledField& s, Vec3 x) { return OctreeField(s.data, nullptr).SizeField::size(x); }

/// A fine spot, and boxes that only make cells of their edge everywhere.
std::vector<RasterBox> fine_spot(Vec3 at, float cell) {
  std::vector<RasterBox> boxes{{at, 0.01F, 0.01F, pack_cause(CauseKind::kEdge, 0)}};
  for (double x = 0.5 * cell; x < 1; x += cell)
    for (double y = 0.5 * cell; y < 1; y += cell)
      for (double z = 0.5 * cell; z < 1; z += cell)
        boxes.push_back({{x, y, z}, 0.5F * cell, static_cast<float>(kLargest), pack_cause(CauseKind::kFace, 0)});
  return boxes;
}

TEST(Blanking, colours_what_lies_inside_outside_and_between) {
  const Vec3 lo{0.21, 0.32, 0.23}, hi{0.74, 0.81, 0.69};
  for (const BlankSide side : {BlankSide::kInside, BlankSide::kOutside}) {
    const BlankedSurface surface = box_surface(lo, hi, 5);
    const auto s = size_with(fine_spot({0.9, 0.9, 0.9}, 0.07F), &surface, side);
    const OctreeView octree = s->raster.shape.view();
    int n_blanked = 0, n_cut = 0;
    for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf) {
      const Vec3 c = octree.leaf_center(leaf);
      const double h = 0.5 * octree.cell_edge(octree.leaf_levels[leaf]);
      const auto is_between = [&](double margin) {
        return c.x > lo.x - margin && c.x < hi.x + margin && c.y > lo.y - margin && c.y < hi.y + margin &&
               c.z > lo.z - margin && c.z < hi.z + margin;
      };
      const bool is_in = is_between(-h), is_out = !is_between(h);
      const CellColour in = side == BlankSide::kInside ? CellColour::kBlanked : CellColour::kFlow;
      const CellColour out = side == BlankSide::kInside ? CellColour::kFlow : CellColour::kBlanked;
      ASSERT_EQ(s->blanking.colour[leaf], is_in ? in : is_out ? out : CellColour::kCut);
      n_blanked += s->blanking.colour[leaf] == CellColour::kBlanked;
      n_cut += s->blanking.colour[leaf] == CellColour::kCut;
    }
    EXPECT_GT(n_blanked, 20);
    EXPECT_GT(n_cut, 20);
  }
}

TEST(Blanking, keeps_the_inside_of_a_body_to_itself) {
  const BlankedSurface surface = box_surface({0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}, 7);
  const std::vector<RasterBox> boxes = fine_spot({0.5, 0.5, 0.5}, 0.06F);
  const auto open = size_with(boxes, nullptr), blanked = size_with(boxes, &surface);
  for (const Vec3 x : {Vec3{0.5, 0.5, 0.905}, Vec3{0.03, 0.5, 0.5}, Vec3{0.5, 0.9, 0.5}, Vec3{0.9, 0.9, 0.9}}) {
    EXPECT_LT(size_at(*open, x), 0.22);
    EXPECT_EQ(size_at(*blanked, x), kLargest);
  }
  EXPECT_LT(size_at(*blanked, {0.5, 0.5, 0.55}), 0.05);  // inside, the field goes on
}

TEST(Blanking, hides_the_outside_of_a_fluid_domain) {
  const BlankedSurface surface = box_surface({0.1, 0.1, 0.1}, {0.6, 0.6, 0.6}, 7);
  const auto blanked = size_with(fine_spot({0.9, 0.9, 0.9}, 0.06F), &surface, BlankSide::kOutside);
  EXPECT_EQ(size_at(*blanked, {0.55, 0.55, 0.55}), kLargest);
  EXPECT_EQ(size_at(*blanked, {0.6, 0.6, 0.6}), kLargest);
}

TEST(Blanking, is_no_obstacle_for_what_lies_outside) {
  const BlankedSurface surface = box_surface({0.41, 0.43, 0.42}, {0.59, 0.61, 0.58}, 4);
  const std::vector<RasterBox> boxes = fine_spot({0.9, 0.9, 0.9}, 0.04F);
  const auto open = size_with(boxes, nullptr), blanked = size_with(boxes, &surface);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    if (distance(x, {0.5, 0.52, 0.5}) < 0.2) continue;
    ASSERT_GE(size_at(*blanked, x), 0.98 * size_at(*open, x));
    if (x.x + x.y + x.z < 1.8) continue;
    ASSERT_NEAR(size_at(*blanked, x), size_at(*open, x), 0.02 * size_at(*open, x));
  }
}

/// A plate ten times thinner than the cells it lies in, wherever it lies in them.
TEST(Blanking, plate_much_thinner_than_the_cells_blocks) {
  for (const double z : {0.4531, 0.4623, 0.4711, 0.4877, 0.4999, 0.5101}) {
    const BlankedSurface plate = box_surface({-0.5, -0.5, z}, {1.5, 1.5, z + 0.006}, 40);
    const std::vector<RasterBox> boxes = fine_spot({0.5, 0.5, 0.7}, 0.0625F);
    const auto open = size_with(boxes, nullptr), blocked = size_with(boxes, &plate);
    for (double x = 0.015; x < 1; x += 0.0413)
      for (double y = 0.015; y < 1; y += 0.0413) {
        ASSERT_EQ(size_at(*blocked, {x, y, z}), kLargest) << x << " " << y << " " << z;
        ASSERT_EQ(size_at(*blocked, {x, y, z - 0.03}), kLargest);
        ASSERT_EQ(size_at(*blocked, {x, y, z - 0.2}), kLargest);
        ASSERT_NEAR(size_at(*blocked, {x, y, z + 0.006}), size_at(*open, {x, y, z + 0.006}), 0.02);
      }
    EXPECT_LT(size_at(*open, {0.5, 0.5, z - 0.1}), 0.1);
  }
}

TEST(Blanking, lengths_pass_around_the_rim_of_a_plate) {
  const double z = 0.4711;
  const BlankedSurface plate = box_surface({0.2, -0.5, z}, {0.8, 1.5, z + 0.006}, 40);
  const auto s = size_with(fine_spot({0.5, 0.5, 0.6}, 0.0625F), &plate);
  const double around = std::hypot(0.3, 0.13) + std::hypot(0.3, 0.05), at = size_at(*s, {0.5, 0.5, z - 0.05});
  EXPECT_LT(at, 0.01 + kSlope * around);  // it comes around, and is that of the straight way
}

/// A thin shell (two spheres): curved, walls thinner than a cell.
TEST(Blanking, thin_curved_shell_blocks) {
  BlankedSurface shell;
  constexpr int kRings = 40, kSectors = 80;
  for (const double radius : {0.4, 0.39}) {
    const auto base = static_cast<NodeId>(shell.points.size());
    for (int i = 0; i <= kRings; ++i)
      for (int j = 0; j < kSectors; ++j) {
        const double theta = kPi *
                             (i + (i == 0        ? 0.001
                                   : i == kRings ? -0.001
                                                 : 0)) /
                             kRings,
                     phi = 2 * kPi * j / kSectors;
        shell.points.push_back(Vec3{0.5, 0.5, 0.5} + radius * Vec3{std::sin(theta) * std::cos(phi),
                                                                   std::sin(theta) * std::sin(phi), std::cos(theta)});
      }
    const auto add = [&](NodeId a, NodeId b, NodeId c) {
      if (radius > 0.395)
        shell.triangles.push_back({{base + a, base + b, base + c}});
      else
        shell.triangles.push_back({{base + a, base + c, base + b}});
    };
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSectors; ++j) {
        const NodeId a = i * kSectors + j, b = i * kSectors + (j + 1) % kSectors, c = a + kSectors, d = b + kSectors;
        add(a, c, d);
        add(a, d, b);
      }
    for (int j = 1; j + 1 < kSectors; ++j) {  // tiny caps at the poles
      add(0, j, j + 1);
      add(kRings * kSectors, kRings * kSectors + j + 1, kRings * kSectors + j);
    }
  }
  const std::vector<RasterBox> boxes = fine_spot({0.5, 0.5, 0.5}, 0.0625F);
  const auto open = size_with(boxes, nullptr), blocked = size_with(boxes, &shell);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int n = 0, n_right = 0, n_inner = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 d = normalized({uniform(random), uniform(random), uniform(random)});
    const Vec3 outer = Vec3{0.5, 0.5, 0.5} + 0.4001 * d, inner = Vec3{0.5, 0.5, 0.5} + 0.389 * d,
               far = Vec3{0.5, 0.5, 0.5} + 0.48 * d;
    ++n;
    n_right += size_at(*blocked, outer) == kLargest;
    n_inner += size_at(*blocked, inner) < size_at(*open, inner) + 0.03;
    ASSERT_EQ(size_at(*blocked, far), kLargest);
  }
  EXPECT_EQ(n_inner, n);        // never coarser than asked for
  EXPECT_GT(n_right, 0.5 * n);  // nor finer than needed, but for corners of cells where the shell bends by more than
                                // its thickness
}

TEST(WindingNumber, is_exact_where_rays_meet_edges_and_corners) {
  const BlankedSurface box = box_surface({0, 0, 0}, {1, 1, 1}, 4);
  for (double x = 0.125; x < 1; x += 0.125)
    for (double y = 0.125; y < 1; y += 0.125)
      for (double z = 0.125; z < 1; z += 0.125) {
        ASSERT_EQ(winding_number(box.view(), {x, y, z}), 1);
        ASSERT_EQ(winding_number(box.view(), {x - 1, y, z}), 0);
        ASSERT_EQ(winding_number(box.view(), {x, y + 1, z}), 0);
      }
}

/// Samples on both sides of a plate thinner than the cells.
struct ThinPlate {
  static constexpr double kThickness = 0.006;
  const std::int32_t above = pack_cause(CauseKind::kFace, 7), below = pack_cause(CauseKind::kFace, 8);
  const double z;
  std::shared_ptr<test::SampledField> sampled;

  explicit ThinPlate(double z) : z(z) {
    const BlankedSurface plate = box_surface({-0.5, -0.5, z}, {1.5, 1.5, z + kThickness}, 40);
    std::vector<RasterBox> boxes = fine_spot({0.5, 0.5, 0.45}, 0.0625F);
    boxes.erase(boxes.begin());
    boxes.push_back({{0.5, 0.5, z + kThickness}, 0.03F, 0.2F, above, SmallNormal({0, 0, 1})});
    boxes.push_back({{0.52, 0.5, z}, 0.03F, 0.02F, below, SmallNormal({0, 0, -1})});
    sampled = test::sample_field(boxes, kSlope, kLargest, [&](const Neighbours& neighbours, Blanking& blanking) {
      blanking = blank_cells(neighbours, plate.view(), BlankSide::kInside);
      blanking.flow_along_normals = 1;
    });
  }

  void expect_each_side_to_keep_its_own() const {
    const OctreeField field(sampled->data, sampled);
    for (const double off : {0.0005, 0.02, 0.1, 0.2}) {
      EXPECT_NE(field.explain({0.5, 0.5, z + kThickness + off}).cause, below) << z << " " << off;
      EXPECT_EQ(field.explain({0.5, 0.5, z - off}).cause, below) << z << " " << off;
    }
    EXPECT_GE(field.SizeField::size({0.5, 0.5, z + 0.0065}), 0.15);
    EXPECT_LE(field.SizeField::size({0.5, 0.5, z - 0.0005}), 0.03);
  }
};

TEST(Blanking, sample_asks_for_its_length_on_its_side_of_a_thin_plate_only) {
  for (const double z : {0.4531, 0.4711, 0.4999}) {
    ThinPlate(z).expect_each_side_to_keep_its_own();
  }
}

/// Rows have links across faces alone, but where none of these is open.
TEST(Blanking, opens_links_across_faces_before_others) {
  const BlankedSurface box = box_surface({0.21, 0.32, 0.23}, {0.74, 0.81, 0.26}, 7);
  const RasterOctree raster = build_octree(test::kUnitBox, fine_spot({0.5, 0.5, 0.3}, 0.0625F));
  const Neighbours neighbours(raster.shape.view());
  const Blanking blanking = blank_cells(neighbours, box.view(), BlankSide::kInside);
  int n_faces = 0;
  for (std::int32_t site = 0; site < blanking.n_sites(); ++site) {
    std::set<std::int32_t> across, around;
    for_each_link(&blanking, neighbours, site, [&](std::int32_t to, const CellStep& step) {
      (test::is_across_face(step) ? across : around).insert(to);
    });
    std::vector<std::int32_t> each_once;  // a larger cell comes once, though it lies in several directions
    for_each_link_across_face(blanking, neighbours, site,
                              [&](std::int32_t to, const CellStep&) { each_once.push_back(to); });
    ASSERT_EQ(std::set<std::int32_t>(each_once.begin(), each_once.end()), across) << site;
    ASSERT_EQ(each_once.size(), across.size()) << site;
    if (blanking.site_links[site] == kNone) continue;  // all are open
    ASSERT_TRUE(across.empty() || around.empty()) << site;
    n_faces += static_cast<int>(across.size());
  }
  EXPECT_GT(n_faces, 1000);
}

/// Nothing is known at a hole, and nothing is blanked.
TEST(Blanking, leaves_a_hole_open_and_still_separates_what_is_far_from_it) {
  BlankedSurface plate = box_surface({-0.5, -0.5, 0.4531}, {1.5, 1.5, 0.4591}, 1);
  plate.triangles.pop_back();
  const RasterOctree raster = build_octree(test::kUnitBox, fine_spot({0.5, 0.5, 0.7}, 0.0625F));
  const OctreeView octree = raster.shape.view();
  const std::vector<Triangle> open = find_open_edges(plate.view());
  ASSERT_FALSE(open.empty());
  const Blanking blanking = blank_cells(Neighbours(octree), plate.view(), BlankSide::kInside, open);
  EXPECT_EQ(std::count(blanking.colour.begin(), blanking.colour.end(), CellColour::kBlanked), 0);
}

}  // namespace
}  // namespace st
