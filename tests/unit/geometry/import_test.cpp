// import_model(): what comes out of STEP and BREP files made by OpenCASCADE.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

ImportResult import_step(const std::string& shape, const std::string& unit, const ImportOptions& options = {}) {
  const TemporaryDirectory dir;
  test::write_step(shape, dir / "model.step", unit);
  return import_model(dir / "model.step", options);
}

ImportResult import_assembly() {
  const TemporaryDirectory dir;
  test::write_named_assembly(dir / "model.step");
  return import_model(dir / "model.step", {});
}

Vec3 extent(const Box3& b) { return b.hi - b.lo; }

std::vector<FaceId> faces_of_group(const ModelTables& t, const std::string& name) {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (t.labels.group_name[t.labels.face_group[f]] == name) faces.push_back(f);
  return faces;
}

// --- units ---

struct UnitCase {
  const char *step, *name;
  double in_mm;
};

class ImportUnit : public testing::TestWithParam<UnitCase> {};

TEST_P(ImportUnit, gives_lengths_in_the_unit_of_the_file) {
  const UnitCase c = GetParam();
  const ImportResult r = import_step("box", c.step);
  EXPECT_EQ(r.tables.unit, c.name);
  ASSERT_TRUE(r.tables.unit_in_m);
  EXPECT_NEAR(*r.tables.unit_in_m, c.in_mm / 1000, 1e-12);
  EXPECT_LE(distance(extent(r.tables.box()), Vec3{60, 40, 20} / c.in_mm), 1e-5 * 60 / c.in_mm);
  EXPECT_NEAR(r.area, 8800 / (c.in_mm * c.in_mm), 1e-9 * r.area);
  EXPECT_NEAR(r.volume, 48000 / std::pow(c.in_mm, 3), 1e-9 * r.volume);
  EXPECT_NEAR(*std::max_element(r.tables.edge_length.begin(), r.tables.edge_length.end()), 60 / c.in_mm,
              1e-9 * 60 / c.in_mm);
  const Model model(r.tables, r.brep);  // the B-Rep is scaled, too
  Box3 corners;
  for (EdgeId e = 0; e < r.tables.n_edges(); ++e) corners.add(model.curve(e)->point(r.tables.edge_range[2 * e]));
  for (Vec3 v : r.tables.vertex_xyz) corners.add(v);
  EXPECT_LE(distance(extent(corners), Vec3{60, 40, 20} / c.in_mm), 1e-9 * 60 / c.in_mm);
}

INSTANTIATE_TEST_SUITE_P(, ImportUnit,
                         testing::Values(UnitCase{"MM", "mm", 1}, UnitCase{"INCH", "in", 25.4},
                                         UnitCase{"M", "m", 1000}, UnitCase{"FT", "ft", 304.8}),
                         [](const auto& info) { return std::string(info.param.step); });

TEST(Import, converts_to_the_unit_asked_for) {
  ImportOptions options;
  options.unit = "mm";
  const ImportResult r = import_step("box", "INCH", options);
  EXPECT_EQ(r.tables.unit, "mm");
  EXPECT_NEAR(r.volume, 48000, 1e-4);
}

TEST(Import, takes_the_numbers_of_a_brep_as_they_are) {
  EXPECT_EQ(test::import_shape("box").tables.unit, "");
  EXPECT_FALSE(test::import_shape("box").tables.unit_in_m);
  const TemporaryDirectory dir;
  test::write_brep("box", dir / "box.brep");
  ImportOptions options;
  options.unit = "in";
  const ImportResult r = import_model(dir / "box.brep", options);
  EXPECT_NEAR(*r.tables.unit_in_m, 0.0254, 1e-15);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
}

TEST(Import, knows_a_unit_by_all_its_names) {
  for (const auto& [given, name] : {std::pair("MM", "mm"), {"inch", "in"}, {"Metre", "m"}, {"micron", "um"}}) {
    ImportOptions options;
    options.unit = given;
    EXPECT_EQ(import_step("box", "MM", options).tables.unit, name);
  }
}

TEST(Import, refuses_an_unknown_unit) {
  const TemporaryDirectory dir;
  test::write_brep("box", dir / "box.brep");
  ImportOptions options;
  options.unit = "parsec";
  EXPECT_ERROR(import_model(dir / "box.brep", options), kUsage, "parsec");
}

// --- names, groups, instances ---

TEST(Import, groups_faces_by_their_name_else_by_their_part) {
  const ModelTables t = import_assembly().tables;
  ASSERT_EQ(t.n_faces(), 12);
  EXPECT_EQ(faces_of_group(t, "wing").size(), 1u);
  EXPECT_EQ(faces_of_group(t, "symmetry").size(), 1u);
  EXPECT_EQ(faces_of_group(t, "Far Field").size(), 1u);
  EXPECT_EQ(faces_of_group(t, "block").size(), 3u);
  EXPECT_EQ(faces_of_group(t, "pin").size(), 6u);
  EXPECT_EQ(t.labels.group_name.size(), 5u);
  EXPECT_EQ(t.labels.face_name[faces_of_group(t, "wing")[0]], "wing");
  EXPECT_EQ(t.labels.face_name[faces_of_group(t, "block")[0]], "");
}

TEST(Import, finds_roles_in_names) {
  const ModelTables t = import_assembly().tables;
  for (std::size_t g = 0; g < t.labels.group_name.size(); ++g) {
    const std::string& name = t.labels.group_name[g];
    EXPECT_EQ(t.labels.group_role[g], name == "symmetry"    ? "symmetry"
                                      : name == "Far Field" ? "farfield"
                                                            : "wall")
        << name;
  }
}

TEST(Import, finds_roles_in_whole_words_only) {
  const TemporaryDirectory dir;
  test::write_named_loose_box(dir / "box.step");
  std::ifstream in(dir / "box.step");
  std::stringstream step;
  step << in.rdbuf();
  std::string text = step.str();
  const std::map<std::string, std::pair<std::string, std::string>> renamed = {
      {"x_min", {"symbol", "wall"}},   {"x_max", {"Sym-1", "symmetry"}},
      {"y_min", {"SYMM", "symmetry"}}, {"y_max", {"far_field", "farfield"}},
      {"z_min", {"gasym", "wall"}},    {"z_max", {"SymmetryPlane2", "symmetry"}}};
  for (const auto& [old_name, now] : renamed)
    for (std::size_t at; (at = text.find("'" + old_name + "'")) != std::string::npos;)
      text.replace(at + 1, old_name.size(), now.first);
  std::ofstream(dir / "box.step") << text;
  const ModelTables t = import_model(dir / "box.step", {}).tables;
  for (const auto& [old_name, now] : renamed) {
    const auto group = std::find(t.labels.group_name.begin(), t.labels.group_name.end(), now.first);
    ASSERT_NE(group, t.labels.group_name.end()) << now.first;
    EXPECT_EQ(t.labels.group_role[group - t.labels.group_name.begin()], now.second) << now.first;
  }
}

TEST(Import, leaves_far_field_and_symmetry_out_of_the_wall_box) {
  const ModelTables t = import_assembly().tables;
  Box3 walls;
  for (const char* group : {"wing", "block", "pin"})
    for (FaceId f : faces_of_group(t, group)) walls.add(t.face_box[f]);
  EXPECT_TRUE(t.wall_box().lo == walls.lo && t.wall_box().hi == walls.hi);
}

TEST(Import, keeps_colours_and_layers) {
  const ModelTables t = import_assembly().tables;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const bool is_wing = t.labels.face_name[f] == "wing";
    EXPECT_EQ(t.face_color[f], is_wing ? 0xff0000 : kNone) << f;
    EXPECT_EQ(t.face_layer[f], is_wing ? "skin" : "") << f;
  }
}

TEST(Import, makes_instances_faces_of_their_own_in_their_place) {
  const ModelTables t = import_assembly().tables;
  Box3 first, second;
  for (FaceId f : faces_of_group(t, "pin")) (t.face_box[f].center().x < 125 ? first : second).add(t.face_box[f]);
  EXPECT_LE(distance(first.center(), {100, 0, 7.5}), 1e-3);
  EXPECT_LE(distance(second.center(), {150, 0, 7.5}), 1e-3);
  EXPECT_EQ(t.n_solids, 3);
  EXPECT_EQ(t.n_shells, 3);
  const ImportResult r = import_assembly();
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, 48000 + 2 * kPi * 16 * 15, 1e-6 * r.volume);
}

// --- sewing, closed and open ---

TEST(Import, sews_loose_faces_to_a_solid_and_says_so) {
  const ImportResult r = test::import_shape("loose_box");
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_free, 0);
  EXPECT_EQ(r.tables.n_edges(), 12);
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
  EXPECT_GE(r.n_repairs(), 1);
  EXPECT_TRUE(std::any_of(r.findings.begin(), r.findings.end(),
                          [](const ImportFinding& f) { return f.is_repair && f.kind == FindingKind::kSewn; }));
}

TEST(Import, keeps_names_and_ids_of_sewn_faces) {
  const TemporaryDirectory dir;
  test::write_named_loose_box(dir / "box.step");
  const ImportResult r = import_model(dir / "box.step", {});
  EXPECT_TRUE(r.is_closed);
  ASSERT_EQ(r.tables.n_faces(), 6);
  const std::vector<std::string> names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  for (FaceId f = 0; f < 6; ++f) {
    const std::string& name = r.tables.labels.group_name[r.tables.labels.face_group[f]];
    EXPECT_EQ(name, names[f]);
    const Vec3 c = r.tables.face_box[f].center();
    const double at = name[0] == 'x' ? c.x / 60 : name[0] == 'y' ? c.y / 40 : c.z / 20;
    EXPECT_NEAR(at, name.find("max") != std::string::npos ? 1 : 0, 1e-5) << name;
  }
}

TEST(Import, does_not_touch_a_closed_model) {
  for (const char* shape :
       {"box", "sphere", "cylinder", "cone", "torus", "drilled_cylinder", "mirrored_cylinder", "two_boxes"}) {
    const ImportResult r = test::import_shape(shape);
    EXPECT_EQ(r.n_repairs(), 0) << shape;
    EXPECT_TRUE(r.is_closed) << shape;
    EXPECT_EQ(r.edge_uses.n_free, 0) << shape;
    EXPECT_GT(r.volume, 0) << shape;
  }
}

TEST(Import, reports_free_edges_with_their_places) {
  const ImportResult r = test::import_shape("square");
  EXPECT_FALSE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_free, 4);
  EXPECT_EQ(r.volume, 0);
  double length = 0;
  for (const ImportFinding& f : r.findings)
    if (f.kind == FindingKind::kFreeEdge) length += f.size;
  EXPECT_NEAR(length, 40, 1e-12);
}

TEST(Import, does_not_take_poles_and_seams_for_free_edges) {
  EXPECT_EQ(test::import_shape("sphere").edge_uses.n_free, 0);
  EXPECT_EQ(test::import_shape("torus").edge_uses.n_free, 0);
  EXPECT_EQ(test::import_shape("cone_side").edge_uses.n_free, 1);
  EXPECT_EQ(test::import_shape("periodic_tube").edge_uses.n_free, 2);
}

TEST(Import, reports_an_edge_of_three_faces) {
  const ImportResult r = test::import_shape("t_junction");
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 1);
  EXPECT_EQ(r.edge_uses.n_free, 9);
}

TEST(Import, refuses_an_open_model_where_a_closed_one_is_required) {
  const TemporaryDirectory dir;
  test::write_brep("square", dir / "open.brep");
  test::write_brep("box", dir / "closed.brep");
  ImportOptions options;
  options.require_closed = true;
  EXPECT_ERROR(import_model(dir / "open.brep", options), kGeometry, "4 free edges");
  EXPECT_TRUE(import_model(dir / "closed.brep", options).is_closed);
}

// --- topology and loops ---

struct Counts {
  const char* shape;
  int faces, edges, vertices, loops;
  double area, volume;
};

class ImportCounts : public testing::TestWithParam<Counts> {};

TEST_P(ImportCounts, are_those_of_the_shape) {
  const Counts c = GetParam();
  const ImportResult r = test::import_shape(c.shape);
  EXPECT_EQ(r.tables.n_faces(), c.faces);
  EXPECT_EQ(r.tables.n_edges(), c.edges);
  EXPECT_EQ(r.tables.n_vertices(), c.vertices);
  EXPECT_EQ(r.tables.n_loops(), c.loops);
  EXPECT_NEAR(r.area, c.area, 1e-6 * c.area);
  EXPECT_NEAR(r.volume, c.volume, 1e-6 * c.volume);
}

INSTANTIATE_TEST_SUITE_P(, ImportCounts,
                         testing::Values(Counts{"box", 6, 12, 8, 6, 8800, 48000},
                                         Counts{"sphere", 1, 3, 2, 1, 400 * kPi, 4000 * kPi / 3},
                                         Counts{"cylinder", 3, 3, 2, 3, 800 * kPi, 3000 * kPi},
                                         Counts{"cone", 2, 3, 2, 2, 100 * kPi*(1 + std::sqrt(5.0)), 2000 * kPi / 3},
                                         Counts{"torus", 1, 2, 1, 1, 480 * kPi* kPi, 1440 * kPi* kPi},
                                         Counts{"disc", 1, 1, 1, 1, 100 * kPi, 0},
                                         Counts{"annulus", 1, 2, 2, 2, 84 * kPi, 0},
                                         Counts{"plate_with_hole", 1, 5, 5, 2, 2400 - 64 * kPi, 0}),
                         [](const auto& info) { return std::string(info.param.shape); });

class Loops : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    ImportResult r = test::import_shape(GetParam());
    model_ = std::make_unique<Model>(std::move(r.tables), std::move(r.brep));
  }
  const ModelTables& t() const { return model_->tables(); }
  /// (u,v) along a coedge, s in [0,1] in its own direction.
  Vec2 at(FaceId f, CoedgeId c, double s) const {
    const EdgeId e = t().coedge_edge[c];
    const double a = t().edge_range[2 * e], b = t().edge_range[2 * e + 1];
    return model_->pcurve(f, c)->point(t().coedge_is_reversed[c] ? b + s * (a - b) : a + s * (b - a));
  }
  double loop_area(FaceId f, LoopId l) const {
    std::vector<Vec2> polygon;
    for (const CoedgeId c : t().loop_coedges(l))
      for (int k = 0; k < 64; ++k) polygon.push_back(at(f, c, k / 64.0));
    double area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      area += 0.5 * cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
    return area;
  }
  std::unique_ptr<Model> model_;
};

TEST_P(Loops, are_closed_polygons_in_the_parameter_plane) {
  for (FaceId f = 0; f < t().n_faces(); ++f) {
    const double* b = &t().face_uv_bounds[4 * f];
    for (const LoopId l : t().loops(f)) {
      const CoedgeId first = t().loop_coedge_offsets[l], last = t().loop_coedge_offsets[l + 1];
      ASSERT_GT(last, first);
      for (CoedgeId c = first; c < last; ++c) {
        const Vec2 gap = at(f, c, 1) - at(f, c + 1 < last ? c + 1 : first, 0);
        EXPECT_LE(std::abs(gap.x), 1e-6 * (b[1] - b[0])) << "face " << f << " coedge " << c - first;
        EXPECT_LE(std::abs(gap.y), 1e-6 * (b[3] - b[2])) << "face " << f << " coedge " << c - first;
      }
    }
  }
}

TEST_P(Loops, run_with_the_interior_on_the_left_outer_loop_first) {
  for (FaceId f = 0; f < t().n_faces(); ++f) {
    const LoopId first = t().face_loop_offsets[f], last = t().face_loop_offsets[f + 1];
    ASSERT_GT(last, first) << "a face without a loop";
    double area = 0;
    for (LoopId l = first; l < last; ++l) {
      const double a = loop_area(f, l);
      EXPECT_EQ(a > 0, l == first) << "face " << f << " loop " << l - first << ": " << a;
      area += a;
    }
    EXPECT_GT(area, 0);
    if (t().face_type[f] == SurfaceType::kPlane) {
      EXPECT_NEAR(area, t().face_area[f], 2e-3 * t().face_area[f]) << "face " << f;
    }
  }
}

TEST_P(Loops, lie_on_their_edges) {
  for (FaceId f = 0; f < t().n_faces(); ++f) {
    const auto surface = model_->surface(f);
    for (const LoopId l : t().loops(f))
      for (const CoedgeId c : t().loop_coedges(l)) {
        const EdgeId e = t().coedge_edge[c];
        const auto pcurve = model_->pcurve(f, c);
        const auto curve = t().edge_is_degenerate[e] ? nullptr : model_->curve(e);
        for (double s : {0.0, 0.13, 0.5, 0.77, 1.0}) {
          const double p = t().edge_range[2 * e] + s * (t().edge_range[2 * e + 1] - t().edge_range[2 * e]);
          const Vec3 x = curve ? curve->point(p) : t().vertex_xyz[t().edge_vertices[2 * e]];
          EXPECT_LE(distance(surface->point(pcurve->point(p)), x), t().edge_tolerance[e] + 1e-6)
              << "face " << f << " edge " << e;
        }
        for (int end = 0; end < 2 && curve; ++end)
          EXPECT_LE(distance(curve->point(t().edge_range[2 * e + end]), t().vertex_xyz[t().edge_vertices[2 * e + end]]),
                    t().vertex_tolerance[t().edge_vertices[2 * e + end]] + 1e-6);
      }
  }
}

TEST_P(Loops, stay_within_the_bounds_of_the_face) {
  for (FaceId f = 0; f < t().n_faces(); ++f) {
    const double* b = &t().face_uv_bounds[4 * f];
    const double mu = 0.01 * (b[1] - b[0]), mv = 0.01 * (b[3] - b[2]);
    Box3 box = t().face_box[f];
    for (const LoopId l : t().loops(f))
      for (const CoedgeId c : t().loop_coedges(l))
        for (double s : {0.0, 0.3, 0.6, 1.0}) {
          const Vec2 p = at(f, c, s);
          EXPECT_TRUE(p.x >= b[0] - mu && p.x <= b[1] + mu && p.y >= b[2] - mv && p.y <= b[3] + mv) << "face " << f;
          box.add(model_->surface(f)->point(p));
        }
    EXPECT_LE(box.diagonal(), t().face_box[f].diagonal() * (1 + 1e-6)) << "face " << f;
  }
}

INSTANTIATE_TEST_SUITE_P(, Loops,
                         testing::Values("box", "sphere", "cylinder", "cone", "torus", "drilled_cylinder",
                                         "mirrored_cylinder", "disc", "annulus", "plate_with_hole", "periodic_tube",
                                         "closed_tube", "rational_torus", "tube_window", "sphere_octant", "loose_box",
                                         "revolution", "offset"),
                         [](const auto& info) { return info.param; });

TEST(Import, uses_a_seam_twice_and_a_pole_once) {
  const ModelTables t = test::import_shape("sphere").tables;
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  int n_poles = 0;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    n_poles += t.edge_is_degenerate[e];
    EXPECT_EQ(offsets[e + 1] - offsets[e], t.edge_is_degenerate[e] ? 1 : 2);
    EXPECT_EQ(t.edge_length[e] == 0, t.edge_is_degenerate[e] == 1);
    if (t.edge_is_degenerate[e]) {
      EXPECT_EQ(t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]);
    }
  }
  EXPECT_EQ(n_poles, 2);
}

TEST(Import, orients_faces_out_of_convex_solids) {
  for (const char* shape : {"box", "sphere", "cylinder", "cone", "loose_box"}) {
    const Model model = test::make_model(shape);
    const ModelTables& t = model.tables();
    for (FaceId f = 0; f < t.n_faces(); ++f) {
      const auto s = model.surface(f);
      const Vec2 middle{0.5 * (s->u_min() + s->u_max()), 0.45 * s->v_min() + 0.55 * s->v_max()};
      const double side = dot(surface_normal(*s, middle), s->point(middle) - t.box().center());
      EXPECT_EQ(side < 0, t.face_is_reversed[f] == 1) << shape << " face " << f;
    }
  }
}

TEST(Import, mirrored_part_has_the_volume_of_its_original) {
  const ImportResult a = test::import_shape("drilled_cylinder"), b = test::import_shape("mirrored_cylinder");
  EXPECT_NEAR(a.volume, b.volume, 1e-6 * a.volume);
  EXPECT_NEAR(a.area, b.area, 1e-6 * a.area);
  EXPECT_LT(b.tables.box().lo.x, -9);
}

// --- files ---

TEST(Import, reads_binary_brep_like_the_text) {
  const TemporaryDirectory dir;
  test::write_brep("drilled_cylinder", dir / "text.brep");
  test::write_binary_brep("drilled_cylinder", dir / "binary.brep");
  const ImportResult a = import_model(dir / "text.brep", {}), b = import_model(dir / "binary.brep", {});
  EXPECT_EQ(b.format, "BREP");
  EXPECT_EQ(a.tables.n_edges(), b.tables.n_edges());
  EXPECT_EQ(a.tables.coedge_edge, b.tables.coedge_edge);
  EXPECT_NEAR(a.volume, b.volume, 1e-9 * a.volume);
}

TEST(Import, recognises_a_file_by_its_content) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "box.dat", "MM");
  EXPECT_EQ(import_model(dir / "box.dat", {}).format, "STEP");
}

TEST(Import, takes_an_iges_file_by_its_columns_whatever_its_title) {
  const TemporaryDirectory dir;
  test::write_iges("box", dir / "box.igs");
  std::ifstream in(dir / "box.igs", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(0, 17, "OFFSHORE PLATFORM");
  write_bytes(dir / "box.igs", text);
  EXPECT_EQ(import_model(dir / "box.igs", {}).format, "IGES");
  write_bytes(dir / "marked.igs", "\xef\xbb\xbf" + text);
  EXPECT_ERROR(import_model(dir / "marked.igs", {}), kInput, "a byte order mark or an empty line before");
  write_bytes(dir / "blank.igs", "\r\n" + text);
  EXPECT_ERROR(import_model(dir / "blank.igs", {}), kInput, "a byte order mark or an empty line before");
}

TEST(Import, refuses_what_is_no_model) {
  const TemporaryDirectory dir;
  EXPECT_ERROR(import_model(dir / "missing.step", {}), kInput, "no such file");
  EXPECT_ERROR(import_model(dir.path(), {}), kInput, "is a directory");
  write_bytes(dir / "empty.step", "");
  EXPECT_ERROR(import_model(dir / "empty.step", {}), kInput, "empty");
  write_bytes(dir / "note.step", "Dear all,\nplease find the model attached.\n");
  EXPECT_ERROR(import_model(dir / "note.step", {}), kInput, "not a STEP, IGES, BREP, STL, OBJ or PLY file");
  write_bytes(dir / "cube.off", "OFF\n8 12 0\n");
  EXPECT_ERROR(import_model(dir / "cube.off", {}), kInput, "an OFF mesh");
  write_bytes(dir / "box.obj", std::string("\xff\xfev\0 \0", 6));
  EXPECT_ERROR(import_model(dir / "box.obj", {}), kInput, "UTF-16");
  write_bytes(dir / "mesh.hdf", "\x89HDF\r\n\x1a\n and more");
  EXPECT_ERROR(import_model(dir / "mesh.hdf", {}), kInput, "HDF5");
}

TEST(Import, refuses_torn_files) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "box.step", "MM");
  test::write_brep("box", dir / "box.brep");
  test::write_binary_brep("box", dir / "box.bin.brep");
  for (const char* name : {"box.step", "box.brep", "box.bin.brep"})
    for (double part : {0.02, 0.3, 0.6, 0.9}) {
      const std::string bytes = read_bytes(dir / name);
      write_bytes(dir / "torn", bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
      try {
        const ImportResult r = import_model(dir / "torn", {});
        ADD_FAILURE() << name << " torn at " << part << " gave " << r.tables.n_faces() << " faces";
      } catch (const Error& e) {
        EXPECT_TRUE(e.code() == ExitCode::kInput || e.code() == ExitCode::kGeometry) << e.what();
      }
    }
}

TEST(Import, refuses_a_model_without_faces) {
  const TemporaryDirectory dir;
  test::write_brep("wire", dir / "wire.brep");
  EXPECT_ERROR(import_model(dir / "wire.brep", {}), kGeometry, "no face");
}

TEST(Import, gives_the_same_bytes_every_time) {
  for (const char* shape : {"drilled_cylinder", "loose_box", "rational_torus"}) {
    const ImportResult a = test::import_shape(shape), b = test::import_shape(shape);
    EXPECT_TRUE(a.brep == b.brep) << shape;
    EXPECT_EQ(a.tables.coedge_edge, b.tables.coedge_edge);
    EXPECT_EQ(a.tables.edge_length, b.tables.edge_length);
    EXPECT_EQ(a.tables.face_area, b.tables.face_area);
    EXPECT_EQ(a.tables.face_uv_bounds, b.tables.face_uv_bounds);
  }
  const ImportResult a = import_assembly(), b = import_assembly();
  EXPECT_TRUE(a.brep == b.brep);
  EXPECT_EQ(a.tables.labels.group_name, b.tables.labels.group_name);
}

}  // namespace
}  // namespace st
