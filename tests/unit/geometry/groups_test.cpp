#include "geometry/model/groups.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "geometry/model/model.h"

namespace st {
namespace {

/// Six faces in a row along x, one unit each: two of "wing", one without a name, three of parts.
ModelTables six_faces() {
  ModelTables t;
  t.unit = "mm";
  t.unit_in_m = 1e-3;
  t.face_is_reversed.assign(6, 0);
  t.labels.face_name = {"wing_up", "wing_down", "", "", "", "Flügel"};
  t.face_color = {0xff0000, 0xff0000, kNone, 0x00ff00, kNone, kNone};
  t.face_layer = {"1", "2", "", "", "", ""};
  t.face_type = {SurfaceType::kPlane, SurfaceType::kCylinder, SurfaceType::kPlane,
                 SurfaceType::kPlane, SurfaceType::kCylinder, SurfaceType::kSphere};
  t.face_tolerance.assign(6, 1e-7);
  for (double x = 0; x < 6; ++x) t.face_box.push_back({{x, 0, 0}, {x + 1, 1, 0}});
  t.labels.group_name = {"wing", "bolt", "symmetry"};
  t.labels.group_role = {"wall", "wall", "symmetry"};
  t.labels.face_group = {0, 0, 1, 1, 1, 2};
  t.labels.part_name = {"bolt", "bolt"};
  t.labels.part_path = {"as/bolt#1", "as/bolt#2"};
  t.labels.face_part = {kNone, kNone, 0, 0, 1, kNone};
  return t;
}

GroupRule rule(const std::string& name) {
  GroupRule r;
  r.where = "g.toml:" + std::to_string(name.size());
  r.name = name;
  return r;
}

BoxSpec box(double x0, double x1) {
  return {{{x0, false}, {0, false}, {0, false}, {x1, false}, {1, false}, {0, false}}};
}

/// Faces (from 1) of the group "x" that one rule makes.
std::vector<int> chosen(GroupRule r) {
  ModelTables t = six_faces();
  r.name = "x";
  apply_groups({r}, t);
  std::vector<int> faces;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (t.labels.group_name[t.labels.face_group[f]] == "x") faces.push_back(f + 1);
  return faces;
}

std::string message_of(const std::vector<GroupRule>& rules) {
  ModelTables t = six_faces();
  try {
    apply_groups(rules, t);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    return e.what();
  }
  return "";
}

TEST(Groups, select_faces_by_every_kind_of_selection) {
  using Ids = std::vector<int>;
  GroupRule r = rule("x");
  r.selection.faces = {"3", "5-6"};
  EXPECT_EQ(chosen(r), (Ids{3, 5, 6}));
  r = rule("x"), r.selection.faces = {"wing_*", "Fl*"};
  EXPECT_EQ(chosen(r), (Ids{1, 2, 6}));
  r = rule("x"), r.selection.parts = {"b?lt"};
  EXPECT_EQ(chosen(r), (Ids{3, 4, 5}));
  r = rule("x"), r.selection.paths = {"as/bolt#2"};
  EXPECT_EQ(chosen(r), (Ids{5}));
  r = rule("x"), r.selection.layers = {"[12]"};
  EXPECT_EQ(chosen(r), (Ids{1, 2}));
  r = rule("x"), r.selection.groups = {"wing"};
  EXPECT_EQ(chosen(r), (Ids{1, 2}));
  r = rule("x"), r.selection.colors = {0xff0000, 0x00ff00};
  EXPECT_EQ(chosen(r), (Ids{1, 2, 4}));
  r = rule("x"), r.selection.surfaces = {SurfaceType::kCylinder};
  EXPECT_EQ(chosen(r), (Ids{2, 5}));
  r = rule("x"), r.selection.inside = box(1, 3);
  EXPECT_EQ(chosen(r), (Ids{2, 3}));
  r = rule("x"), r.selection.touching = box(1.5, 2.5);
  EXPECT_EQ(chosen(r), (Ids{2, 3}));
}

TEST(Groups, need_every_kind_of_selection_that_is_given) {
  GroupRule r = rule("x");
  r.selection.parts = {"bolt"};
  r.selection.surfaces = {SurfaceType::kPlane};
  r.selection.touching = box(3.5, 6);
  EXPECT_EQ(chosen(r), (std::vector<int>{4}));
}

TEST(Groups, take_boxes_in_other_units_and_refuse_them_without_a_unit) {
  GroupRule r = rule("x");
  r.selection.inside = box(0, 0);
  (*r.selection.inside)[3] = {0.002, true};
  EXPECT_EQ(chosen(r), (std::vector<int>{1, 2}));
  ModelTables t = six_faces();
  t.unit_in_m.reset();
  EXPECT_THROW(apply_groups({r}, t), Error);
}

TEST(Groups, keep_the_groups_of_the_file_where_no_rule_speaks_and_count_by_first_face) {
  GroupRule r = rule("tips");
  r.selection.faces = {"2", "6"};
  ModelTables t = six_faces();
  EXPECT_TRUE(apply_groups({r}, t).empty());
  EXPECT_EQ(t.labels.group_name, (std::vector<std::string>{"wing", "tips", "bolt"}))
      << "the group symmetry has no face any more";
  EXPECT_EQ(t.labels.group_role, (std::vector<std::string>{"wall", "wall", "wall"}));
  EXPECT_EQ(t.labels.face_group, (std::vector<std::int32_t>{0, 1, 2, 2, 2, 1}));
}

TEST(Groups, give_roles_and_attributes_to_groups_of_the_file) {
  GroupRule wing = rule("wing"), symmetry = rule("symmetry");
  wing.role = "inlet";
  wing.attributes = R"({"p":1})";
  wing.tolerance = LengthSpec{LengthSpec::Kind::kAbsolute, 2e-4, "0.2mm"};
  symmetry.role = "wall";
  ModelTables t = six_faces();
  apply_groups({wing, symmetry}, t);
  EXPECT_EQ(t.labels.group_role, (std::vector<std::string>{"inlet", "wall", "wall"})) << "a role overrides the name's";
  EXPECT_EQ(t.labels.group_attributes, (std::vector<std::string>{R"({"tolerance":0.2,"p":1})", "{}", "{}"}));
}

TEST(Groups, have_the_role_of_their_name_when_no_rule_gives_one) {
  GroupRule far = rule("far field"), asymmetry = rule("asymmetry");
  far.selection.faces = {"1"};
  asymmetry.selection.faces = {"2"};
  ModelTables t = six_faces();
  apply_groups({far, asymmetry}, t);
  EXPECT_EQ(t.labels.group_role[0], "farfield");
  EXPECT_EQ(t.labels.group_role[1], "wall");
}

TEST(Groups, of_further_tables_leave_the_main_ones_alone) {
  GroupRule hot = rule("hot"), cold = rule("cold"), more = rule("hot");
  for (GroupRule* r : {&hot, &cold, &more}) r->table = "bc";
  hot.selection.faces = {"1"};
  cold.selection.faces = {"2-3"};
  more.selection.faces = {"6"};
  ModelTables t = six_faces();
  apply_groups({hot, cold, more}, t);
  EXPECT_EQ(t.labels.group_name, six_faces().labels.group_name);
  EXPECT_EQ(t.labels.face_group, six_faces().labels.face_group);
  ASSERT_EQ(t.labels.tables.size(), 1u);
  EXPECT_EQ(t.labels.tables[0].group_name, (std::vector<std::string>{"hot", "cold"}));
  EXPECT_EQ(t.labels.tables[0].face_group, (std::vector<std::int32_t>{0, 1, 1, kNone, kNone, 0}));
}

TEST(Groups, that_match_nothing_are_errors_unless_they_are_optional) {
  GroupRule r = rule("x");
  EXPECT_NE(message_of({r}).find("g.toml:1: group \"x\": the CAD file has no group of this name"), std::string::npos)
      << message_of({r});
  r.selection.parts = {"bolt", "nut*"};
  EXPECT_NE(message_of({r}).find("parts: 'nut*' matches nothing"), std::string::npos);
  r.selection.parts = {"bolt"};
  r.selection.faces = {"wing*"};
  EXPECT_NE(message_of({r}).find("no face matches its selection"), std::string::npos);
  r.is_optional = true;
  ModelTables t = six_faces();
  EXPECT_EQ(apply_groups({r}, t), (std::vector<EmptyGroup>{{"x", EntityDim::kFace}}));
  EXPECT_EQ(t.labels.group_name, six_faces().labels.group_name);
  r.selection.faces = {"7"};
  EXPECT_NE(message_of({r}).find("faces: 7 does not exist, there are faces 1 to 6"), std::string::npos)
      << "an id is never optional";
  r.selection.faces = {"5-3"};
  EXPECT_NE(message_of({r}), "");
}

TEST(Groups, that_share_a_face_of_one_table_are_both_named) {
  GroupRule a = rule("a"), bb = rule("bb");
  a.selection.faces = {"1-2"};
  bb.selection.faces = {"2"};
  const std::string message = message_of({a, bb});
  for (const char* part : {"g.toml:2", "g.toml:1", "\"a\"", "\"bb\"", "face 2 \"wing_down\""})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  bb.table = "other";
  EXPECT_EQ(message_of({a, bb}), "");
}

TEST(Groups, whose_entries_disagree_are_refused) {
  GroupRule a = rule("a"), again = rule("a");
  a.selection.faces = {"1"};
  again.selection.faces = {"2"};
  a.role = "inlet";
  again.role = "outlet";
  EXPECT_NE(message_of({a, again}).find("role"), std::string::npos);
  again.role.reset();
  a.attributes = R"({"p":1})";
  again.attributes = R"({"p":2})";
  EXPECT_NE(message_of({a, again}).find("attributes"), std::string::npos);
}

TEST(Groups, of_the_outside_are_left_out_of_the_reference_diagonal) {
  GroupRule r = rule("tunnel");
  r.selection.faces = {"3-6"};
  r.role = "farfield";
  ModelTables t = six_faces();
  apply_groups({r}, t);
  EXPECT_NEAR(t.wall_box().hi.x, 2, 1e-12);
}

// --- edges and vertices
// --------------------------------------------------------------------------------

/// Two unit squares side by side, faces 1 and 2 of groups "left" and "right": edges 1 to 3 around the left one, 4
/// between them, 5 to 7 around the right one, 8 a pole; vertex 1 to 3 at y = 0, 4 to 6 at y = 1.
ModelTables two_squares() {
  ModelTables t;
  t.unit_in_m = 1;
  t.vertex_xyz = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  t.vertex_tolerance.assign(6, 0);
  t.edge_vertices = {0, 1, 3, 0, 4, 3, 1, 4, 1, 2, 2, 5, 5, 4, 5, 5};
  t.edge_length = {1, 1, 1, 1, 1, 1, 1, 0};
  t.edge_tolerance.assign(8, 0);
  t.edge_is_degenerate = {0, 0, 0, 0, 0, 0, 0, 1};
  t.edge_name = {"", "", "TE_1", "root", "", "", "TE_2", ""};
  t.face_loop_offsets = {0, 1, 2};
  t.loop_coedge_offsets = {0, 4, 9};
  t.coedge_edge = {0, 3, 2, 1, 4, 5, 7, 6, 3};
  t.face_is_reversed = {0, 0};
  t.labels.face_name = {"", ""};
  t.face_box = {{{0, 0, 0}, {1, 1, 0}}, {{1, 0, 0}, {2, 1, 0}}};
  t.labels.group_name = {"left", "right"};
  t.labels.group_role = {"wall", "wall"};
  t.labels.face_group = {0, 1};
  return t;
}

std::vector<Box3> edge_boxes(const ModelTables& t) {
  std::vector<Box3> boxes(t.n_edges());
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (int k = 0; k < 2 && !t.edge_is_degenerate[e]; ++k) boxes[e].add(t.vertex_xyz[t.edge_vertices[2 * e + k]]);
  return boxes;
}

GroupRule entity_rule(const std::string& name, EntityDim of) {
  GroupRule r = rule(name);
  r.of = of;
  return r;
}

/// Numbers (from 1) of the edges or vertices that a rule selects.
std::vector<int> members(const GroupRule& r, const std::vector<GroupRule>& before = {}) {
  ModelTables t = two_squares();
  std::vector<GroupRule> rules = {r};
  rules.insert(rules.end(), before.begin(), before.end());
  apply_groups(rules, t, edge_boxes(t));
  std::vector<int> ids;
  for (const EntityGroup& g : r.of == EntityDim::kEdge ? t.labels.edge_groups : t.labels.vertex_groups)
    for (const std::int32_t id : g.ids)
      if (g.name == r.name) ids.push_back(id + 1);
  return ids;
}

std::string refusal(const std::vector<GroupRule>& rules) {
  ModelTables t = two_squares();
  try {
    apply_groups(rules, t, edge_boxes(t));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    return e.what();
  }
  return "";
}

TEST(EdgeGroups, select_by_number_name_faces_and_place) {
  using Ids = std::vector<int>;
  const GroupRule empty = entity_rule("x", EntityDim::kEdge);
  GroupRule r = empty;
  r.selection.edges = {"1-2", "TE_*"};
  EXPECT_EQ(members(r), (Ids{1, 2, 3, 7}));
  r = empty, r.selection.between = {"left", "r*"};
  EXPECT_EQ(members(r), Ids{4});
  r = empty, r.selection.on = {"right"};
  EXPECT_EQ(members(r), (Ids{4, 5, 6, 7})) << "without the pole";
  r = empty, r.selection.rim = {"right"};
  EXPECT_EQ(members(r), (Ids{4, 5, 6, 7}));
  r = empty, r.selection.rim = {"right", "left"};
  EXPECT_EQ(members(r), (Ids{1, 2, 3, 5, 6, 7})) << "the edge between them is inside";
  r = empty, r.selection.inside = BoxSpec{{{-1, false}, {1, false}, {0, false}, {3, false}, {1, false}, {0, false}}};
  EXPECT_EQ(members(r), (Ids{3, 7}));
  r = empty,
  r.selection.touching = BoxSpec{{{1.5, false}, {-1, false}, {0, false}, {1.6, false}, {0.5, false}, {0, false}}};
  EXPECT_EQ(members(r), Ids{5});
  r = empty, r.selection.on = {"left"}, r.selection.edges = {"3-5"};
  EXPECT_EQ(members(r), (Ids{3, 4})) << "every key must fit";
  r = entity_rule("root", EntityDim::kEdge);
  EXPECT_EQ(members(r), Ids{4}) << "without selection: the edges of its name";
}

TEST(EdgeGroups, say_why_two_groups_have_no_edge_between_them_and_closed_ones_no_rim) {
  GroupRule r = entity_rule("x", EntityDim::kEdge);
  r.selection.between = {"left", "left"};
  EXPECT_NE(refusal({r}).find("between: 'left' and 'left' have no common edge"), std::string::npos) << refusal({r});
  r.selection.between.clear();
  r.selection.rim = {"*"};
  ModelTables t = two_squares();
  t.coedge_edge = {0, 3, 2, 1, 0, 2, 7, 1, 3};  // the right square on the edges of the left one
  try {
    apply_groups({r}, t, edge_boxes(t));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("rim: these faces are closed and have no outline"), std::string::npos)
        << e.what();
  }
  r.is_optional = true;
  EXPECT_EQ(apply_groups({r}, t, edge_boxes(t)), (std::vector<EmptyGroup>{{"x", EntityDim::kEdge}}));
}

TEST(VertexGroups, select_by_number_faces_groups_of_edges_and_place) {
  using Ids = std::vector<int>;
  const GroupRule empty = entity_rule("x", EntityDim::kVertex);
  GroupRule r = empty, te = entity_rule("te", EntityDim::kEdge);
  r.selection.vertices = {"6", "1-2"};
  EXPECT_EQ(members(r), (Ids{1, 2, 6}));
  r = empty, r.selection.on = {"left"};
  EXPECT_EQ(members(r), (Ids{1, 2, 4, 5}));
  r = empty, r.selection.on = {"te"}, te.selection.edges = {"TE_2"};
  EXPECT_EQ(members(r, {te}), (Ids{5, 6})) << "wherever the group of edges stands in the file";
  r = empty, r.selection.inside = BoxSpec{{{0, false}, {1, false}, {0, false}, {1, false}, {1, false}, {0, false}}};
  EXPECT_EQ(members(r), (Ids{4, 5}));
  EXPECT_NE(refusal({empty}).find("vertices have no names"), std::string::npos);
  r = empty, r.selection.vertices = {"tip"};
  EXPECT_NE(refusal({r}).find("'tip' is not a number"), std::string::npos);
}

TEST(EdgeGroups, share_the_names_of_a_table_with_faces_and_vertices) {
  GroupRule left = entity_rule("left", EntityDim::kEdge), tip = entity_rule("tip", EntityDim::kEdge),
            point = entity_rule("tip", EntityDim::kVertex);
  left.selection.edges = tip.selection.edges = {"1"};
  point.selection.vertices = {"1"};
  EXPECT_NE(refusal({left}).find("has a group of faces of this name"), std::string::npos) << refusal({left});
  EXPECT_NE(refusal({point, tip}).find("has a group of edges of this name"), std::string::npos);
  left.table = point.table = "other";
  EXPECT_EQ(refusal({left, tip, point}), "");
}

TEST(EdgeGroups, hold_an_edge_once_in_a_table_and_say_who_has_it) {
  GroupRule a = entity_rule("a", EntityDim::kEdge), b = entity_rule("bb", EntityDim::kEdge), more = a;
  a.selection.edges = {"1-3"};
  more.selection.edges = {"3-4"};
  EXPECT_EQ(members(a, {more}), (std::vector<int>{1, 2, 3, 4})) << "entries of one name make one group";
  b.selection.edges = {"3"};
  const std::string message = refusal({a, b});
  for (const char* part : {"g.toml:2", "\"bb\"", "edge 3 \"TE_1\"", "\"a\" (g.toml:1)"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  b.table = "bc";
  EXPECT_EQ(refusal({a, b}), "");
  b.selection.edges = {"9"};
  EXPECT_NE(refusal({b}).find("edges: 9 does not exist, there are edges 1 to 8"), std::string::npos);
  b.selection.edges.clear();
  b.selection.on = {"nose"};
  EXPECT_NE(refusal({b}).find("on: no group or part matches 'nose'"), std::string::npos);
  b.is_optional = true;
  ModelTables t = two_squares();
  EXPECT_EQ(apply_groups({b}, t), (std::vector<EmptyGroup>{{"bb", EntityDim::kEdge}}));
  EXPECT_TRUE(t.labels.edge_groups.empty());
}

}  // namespace
}  // namespace st
