#include "stages/edit_stage.h"
#include "geometry/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/hdf5/artifact.h"
#include "stages/edit_names.h"
#include "stages/edit_provenance.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class EditStage : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return dir_ / name; }

  /// A shape as a geometry artifact; `change` may give it names.
  template <class Change>
  std::string write(const std::string& shape, const std::string& name, Change change) {
    ImportResult r = test::import_shape(shape);
    change(r);
    GeometryArtifact g;
    g.tables = std::move(r.tables);
    g.brep = std::move(r.brep);
    g.findings = std::move(r.findings);
    g.is_closed = r.is_closed;
    write_geometry(path(name), g);
    return path(name);
  }
  std::string write(const std::string& shape, const std::string& name) {
    return write(shape, name, [](ImportResult&) {});
  }

  GeometryArtifact edit(EditStageOptions o) {
    o.output = path("out.hdf");
    summary_ = nlohmann::json::parse(run_edit(o).json);
    return read_geometry(o.output);
  }

  TemporaryDirectory dir_;
  nlohmann::json summary_;
};

EditStageOptions of_inputs(std::vector<std::string> geometries) {
  EditStageOptions o;
  o.geometries = std::move(geometries);
  return o;
}

/// previous_id of entity i: number and input.
std::pair<int, int> previous(const std::vector<std::int32_t>& ids, std::size_t i) {
  return {ids[2 * i], ids[2 * i + 1]};
}

TEST_F(EditStage, that_does_nothing_keeps_the_content_hash) {
  const std::string box = write("drilled_cylinder", "box.hdf");
  EditStageOptions o = of_inputs({box});
  o.transforms = {"rotate 1 2 3 0", "scale 1"};
  EXPECT_EQ(edit(o).header.content_hash, read_header(box).content_hash);
}

TEST_F(EditStage, puts_inputs_together_and_says_where_everything_is_from) {
  const std::string box = write("box", "box.hdf"), ball = write("sphere", "ball.hdf");
  EditStageOptions o = of_inputs({box, ball});
  o.transforms = {"translate 1000 0 0"};
  o.of = {"ball"};
  const GeometryArtifact g = edit(o);
  const GeometryArtifact a = read_geometry(box), b = read_geometry(ball);
  const ModelTables& t = g.tables;
  ASSERT_EQ(t.n_faces(), a.tables.n_faces() + b.tables.n_faces());
  EXPECT_TRUE(g.is_closed);
  EXPECT_NEAR(*t.volume, *a.tables.volume + *b.tables.volume, 1e-9 * *t.volume);
  EXPECT_EQ(t.labels.group_name, (std::vector<std::string>{"default", "ball/default"}));
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const bool is_second = f >= a.tables.n_faces();
    EXPECT_EQ(previous(g.previous_faces, f), std::pair(is_second ? f - a.tables.n_faces() : f, is_second ? 1 : 0));
    EXPECT_EQ(t.labels.group_name[t.labels.face_group[f]], is_second ? "ball/default" : "default");
    EXPECT_EQ(t.face_box[f].lo.x > 500, is_second);
    EXPECT_EQ(find_faces("ball", t.labels)[f], is_second);
    EXPECT_EQ(find_faces("input:box", t.labels)[f], !is_second);
  }
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    EXPECT_EQ(previous(g.previous_edges, e).second, e >= a.tables.n_edges() ? 1 : 0);
  EXPECT_EQ(previous(g.previous_vertices, t.n_vertices() - 1), std::pair(b.tables.n_vertices() - 1, 1));
  ASSERT_EQ(g.header.inputs.size(), 2u);
  EXPECT_EQ(g.header.inputs[1].name, "ball.hdf");
  EXPECT_EQ(g.header.inputs[1].hash, b.header.content_hash);
  EXPECT_EQ(summary_["crossings"].size(), 0u);
}

TEST_F(EditStage, joins_groups_where_told_and_refuses_to_join_roles) {
  const auto named = [](const char* name, const char* role) {
    return [=](ImportResult& r) {
      r.tables.labels.group_name = {name};
      r.tables.labels.group_role = {role};
    };
  };
  const std::string a = write("box", "a.hdf", named("tunnel", "farfield")),
                    b = write("sphere", "b.hdf", named("tunnel", "farfield")),
                    c = write("sphere", "c.hdf", named("tunnel", "wall"));
  EditStageOptions o = of_inputs({a, b});
  o.join = "sym*, tun*";
  EXPECT_EQ(edit(o).tables.labels.group_name, (std::vector<std::string>{"tunnel"}));
  o.join = "sym*";
  const GeometryArtifact apart = edit(o);
  EXPECT_EQ(apart.tables.labels.group_name, (std::vector<std::string>{"tunnel", "b/tunnel"}));
  EXPECT_EQ(apart.tables.labels.group_role, (std::vector<std::string>{"farfield", "farfield"}));
  o.geometries = {a, c};
  o.join = "*";
  EXPECT_ERROR(edit(o), kMismatch, "'tunnel' holds faces with the role farfield");
}

TEST_F(EditStage, keeps_groups_of_edges_and_vertices_apart_and_with_their_entities) {
  const std::string box = write("box", "box.hdf", [](ImportResult& r) {
    r.tables.labels.edge_groups = {{"rim", "", "{}", {0, 2}}};
    r.tables.labels.vertex_groups = {{"tip", "", "{}", {7}}};
  });
  EditStageOptions o = of_inputs({box, box});
  o.transforms = {"translate 0 0 100"};
  o.of = {"box#2"};
  const FaceLabels apart = edit(o).tables.labels;
  ASSERT_EQ(apart.edge_groups.size(), 2u);
  EXPECT_EQ(apart.edge_groups[1], (EntityGroup{"box#2/rim", "", "{}", {12, 14}}));
  EXPECT_EQ(apart.vertex_groups[1], (EntityGroup{"box#2/tip", "", "{}", {15}}));
  o.join = "r*";
  const FaceLabels joined = edit(o).tables.labels;
  ASSERT_EQ(joined.edge_groups.size(), 1u);
  EXPECT_EQ(joined.edge_groups[0].ids, (std::vector<std::int32_t>{0, 2, 12, 14}));
  o.extract = "rim";
  EXPECT_ERROR(edit(o), kUsage, "group of edges");
}

TEST_F(EditStage, scales_tolerances_of_groups_with_the_whole) {
  const std::string box = write(
      "box", "box.hdf", [](ImportResult& r) { r.tables.labels.group_attributes = {R"({"tolerance":0.25,"a":3})"}; });
  EditStageOptions o = of_inputs({box});
  o.transforms = {"scale 2"};
  EXPECT_EQ(edit(o).tables.labels.group_attributes[0], R"({"tolerance":0.5,"a":3})");
}

TEST_F(EditStage, tells_inputs_of_one_name_and_those_of_earlier_edits_apart) {
  const std::string box = write("box", "box.hdf");
  EditStageOptions o = of_inputs({box, box});
  o.transforms = {"mirror 1 0 0 at -5 0 0"};
  o.of = {"box#2"};
  const GeometryArtifact pair = edit(o);
  EXPECT_EQ(pair.tables.labels.tables.at(0).group_name, (std::vector<std::string>{"box", "box#2"}));
  EXPECT_NEAR(*pair.tables.volume, 2 * *read_geometry(box).tables.volume, 1e-9);
  write_geometry(path("pair.hdf"), pair);
  EditStageOptions again = of_inputs({path("pair.hdf"), box});
  again.as = "pair,box";
  EXPECT_EQ(edit(again).tables.labels.tables.at(0).group_name, (std::vector<std::string>{"box", "box#2", "box/box"}));
  again.as = "one";
  EXPECT_ERROR(edit(again), kUsage, "1 names for 2 geometries");
}

TEST_F(EditStage, refuses_inputs_of_different_units) {
  const std::string a = write("box", "a.hdf"), b = write("box", "b.hdf", [](ImportResult&r) {
                                                 r.tables.unit = "m";
                                                 r.tables.unit_in_m = 1;
                                               });
  EXPECT_ERROR(edit(of_inputs({a, b})), kMismatch, "b.hdf is in m");
}

TEST_F(EditStage, extracts_by_number_range_group_and_name_of_face) {
  const std::string box = write("box", "box.hdf", [](ImportResult& r) {
    r.tables.labels.face_name[5] = "lid";
    r.tables.labels.group_name = {"default", "floor"};
    r.tables.labels.group_role = {"wall", "wall"};
    r.tables.labels.group_attributes.clear();
    r.tables.labels.face_group[4] = 1;
  });
  EditStageOptions o = of_inputs({box});
  const auto faces = [&](const std::string& extract, const std::string& remove) {
    o.extract = extract;
    o.remove = remove;
    const GeometryArtifact g = edit(o);
    std::vector<int> ids;
    for (std::size_t i = 0; i < g.previous_faces.size(); i += 2) ids.push_back(g.previous_faces[i] + 1);
    return ids;
  };
  EXPECT_EQ(faces("2", ""), (std::vector<int>{2}));
  EXPECT_EQ(faces("4-5, 1", ""), (std::vector<int>{1, 4, 5}));
  EXPECT_EQ(faces("floor,l?d", ""), (std::vector<int>{5, 6}));
  EXPECT_EQ(faces("", "floor"), (std::vector<int>{1, 2, 3, 4, 6}));
  EXPECT_EQ(faces("1-3", "2"), (std::vector<int>{1, 3}));
  EXPECT_EQ(read_geometry(path("out.hdf")).tables.labels.group_name, (std::vector<std::string>{"default"}));  // the
                                                                                                              // floor
                                                                                                              // is gone
  EXPECT_ERROR(faces("flor", ""), kUsage, "did you mean 'floor'");
  EXPECT_ERROR(faces("7", ""), kUsage, "faces 1 to 6");
  EXPECT_ERROR(faces("0-2", ""), kUsage, "faces 1 to 6");
  EXPECT_ERROR(faces(" ,", ""), kUsage, "nothing named");
  EXPECT_ERROR(faces("1-3", "1-6"), kUsage, "nothing would be left");
}

TEST_F(EditStage, of_a_part_of_closed_bodies_is_closed_with_its_volume) {
  const std::string boxes = write("two_boxes", "boxes.hdf");
  const ModelTables before = read_geometry(boxes).tables;
  EditStageOptions o = of_inputs({boxes});
  o.extract = "1-6";
  o.require_valid = true;
  const GeometryArtifact g = edit(o);
  EXPECT_TRUE(g.is_closed);
  EXPECT_EQ(g.tables.n_solids, 1);
  EXPECT_EQ(g.tables.n_shells, 1);
  double volume = 0;
  const Box3 box = g.tables.box();
  volume = (box.hi.x - box.lo.x) * (box.hi.y - box.lo.y) * (box.hi.z - box.lo.z);
  EXPECT_NEAR(*g.tables.volume, volume, 1e-4 * volume);
  o.transforms = {"scale 2"};
  EXPECT_NEAR(*edit(o).tables.volume, 8 * *g.tables.volume, 1e-9 * volume);
}

TEST_F(EditStage, says_where_the_result_is_open) {
  const std::string box = write("box", "box.hdf");
  EditStageOptions o = of_inputs({box});
  o.remove = "3";
  const GeometryArtifact g = edit(o);
  EXPECT_FALSE(g.is_closed);
  EXPECT_FALSE(g.tables.volume);
  EXPECT_EQ(summary_["free_edges"], 4);
  EXPECT_EQ(std::count_if(g.findings.begin(), g.findings.end(),
                          [](const ImportFinding& f) { return f.kind == FindingKind::kFreeEdge; }),
            4);
  o.require_valid = true;
  std::filesystem::remove(path("out.hdf"));
  EXPECT_ERROR(edit(o), kGeometry, "open where it was closed: 4 free edges");
  EXPECT_FALSE(std::filesystem::exists(path("out.hdf")));
}

TEST_F(EditStage, says_where_parts_cross_and_only_then) {
  const std::string box = write("box", "box.hdf");
  const Vec3 size = read_geometry(box).tables.box().hi - read_geometry(box).tables.box().lo;
  EditStageOptions o = of_inputs({box, box});
  o.of = {"box#2"};
  o.require_valid = true;
  o.transforms = {"translate " + std::to_string(0.5 * size.x) + " " + std::to_string(0.4 * size.y) + " " +
                  std::to_string(0.3 * size.z)};
  EXPECT_ERROR(edit(o), kGeometry, "parts cross");
  o.require_valid = false;
  const GeometryArtifact g = edit(o);
  EXPECT_GT(summary_["crossings"].size(), 0u);
  EXPECT_TRUE(std::any_of(g.findings.begin(), g.findings.end(),
                          [](const ImportFinding& f) { return f.kind == FindingKind::kCrossingPart; }));
  o.require_valid = true;
  o.transforms = {"translate 0 0 " + std::to_string(3 * size.z)};
  EXPECT_NO_THROW(edit(o));
}

TEST_F(EditStage, refuses_to_tear_and_to_move_what_is_gone) {
  const std::string box = write("box", "box.hdf");
  EditStageOptions o = of_inputs({box});
  o.transforms = {"translate 1 0 0"};
  o.of = {"1,2"};
  EXPECT_ERROR(edit(o), kGeometry, "tear");
  o.extract = "3";
  EXPECT_ERROR(edit(o), kUsage, "nothing is left to move");
  o.of = {"1", "2"};
  EXPECT_ERROR(edit(o), kUsage, "--of is given 2 times");
}

TEST_F(EditStage, there_and_back_is_where_it_was) {
  for (const char* shape : {"drilled_cylinder", "cone", "two_boxes", "wave", "rational_torus"}) {
    const std::string whole = write(shape, "whole.hdf");
    EditStageOptions o = of_inputs({whole});
    o.transforms = {"hinge 1 2 3 4 5 7 31; mirror 1 1 0 at 3 0 0; scale 2"};
    write_geometry(path("there.hdf"), edit(o));
    o.geometries = {path("there.hdf")};
    o.transforms = {"scale 0.5; mirror 1 1 0 at 3 0 0; hinge 1 2 3 4 5 7 -31"};
    const GeometryArtifact back = edit(o), before = read_geometry(whole);
    ASSERT_EQ(back.tables.n_faces(), before.tables.n_faces());
    const double size = before.tables.box().diagonal();
    for (VertexId v = 0; v < before.tables.n_vertices(); ++v)
      EXPECT_LE(distance(back.tables.vertex_xyz[v], before.tables.vertex_xyz[v]), 1e-12 * size);
    EXPECT_EQ(back.tables.volume.has_value(), before.tables.volume.has_value());
    if (before.tables.volume) {
      EXPECT_NEAR(*back.tables.volume, *before.tables.volume, 1e-9 * *before.tables.volume);
    }
    EXPECT_EQ(back.is_closed, before.is_closed);
  }
}

TEST_F(EditStage, takes_findings_along_with_their_entities) {
  const std::string boxes = write("two_boxes", "boxes.hdf", [](ImportResult& r) {
    r.findings = {{FindingKind::kShortEdge, "edge 13 \"a \\\"b\"", {1, 0, 0}, 0.5, false},
                  {FindingKind::kSliverFace, "face 1", {0, 1, 0}, 0.25, false},
                  {FindingKind::kOther, "edge 14 in face 7", {0, 0, 1}, 1, true, "made up"},
                  {FindingKind::kSewn, "", {0, 0, 0}, 0, true}};
  });
  EditStageOptions o = of_inputs({boxes});
  o.remove = "1-6";
  o.transforms = {"scale 2; translate 0 0 1"};
  const GeometryArtifact g = edit(o);
  ASSERT_EQ(g.findings.size(), 3u);
  EXPECT_EQ(g.findings[0].entity, "edge 1 \"a \\\"b\"");
  EXPECT_EQ(g.findings[0].xyz, (Vec3{2, 0, 1}));
  EXPECT_EQ(g.findings[0].size, 1);
  EXPECT_EQ(g.findings[1].entity, "edge 2 in face 1");
  EXPECT_EQ(g.findings[2].kind, FindingKind::kSewn);
}

TEST_F(EditStage, leaves_word_of_a_motion_of_the_whole_and_of_nothing_else) {
  const std::string box = write("box", "box.hdf");
  const std::string hash = read_header(box).content_hash;
  EditStageOptions o = of_inputs({box});
  o.transforms = {"rotate 0 0 1 30", "translate 1 0 0"};
  const ArtifactHeader moved = edit(o).header;
  const Similarity motion = whole_motion("m.hdf", moved, hash);
  EXPECT_LE(distance(motion({1, 0, 0}), {1 + std::cos(radians(30)), 0.5, 0}), 1e-12);
  EXPECT_EQ(whole_motion("box.hdf", read_header(box), hash), Similarity());
  EXPECT_ERROR(whole_motion("m.hdf", moved, "0123"), kMismatch, "was made from box.hdf, which is not");
  o.extract = "1-4";
  EXPECT_ERROR(whole_motion("m.hdf", edit(o).header, hash), kMismatch, "not moved as a whole (--extract)");
  EXPECT_ERROR(whole_motion("m.hdf", edit(of_inputs({box, box})).header, hash), kMismatch, "2 geometries");
  EXPECT_ERROR(whole_motion("box.hdf", read_header(box), "0123"), kMismatch, "not the geometry of the raster");
}

}  // namespace
}  // namespace st
