#include "io/toml/groups_file.h"

#include <gtest/gtest.h>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::vector<GroupRule> parse(const std::string& text) {
  TemporaryDirectory dir;
  write_bytes(dir / "g.toml", text);
  return read_groups(dir / "g.toml").rules;
}

TEST(GroupsFile, says_all_that_an_entry_may_say) {
  const std::vector<GroupRule> rules = parse(R"([[group]]
name = "Flügel"
table = "bc"
faces = [3, "5-7", "WING*"]
parts = "nut"
paths = ["a/*", "b"]
layers = "7"
groups = "default"
colors = ["#ff8000", "#0000FF"]
surfaces = ["plane", "other"]
inside = [0, -1.5, "-30mm", 1, 2, "1 in"]
role = "inlet"
tolerance = "0.1mm"
attributes = { b = [1, 2.5], a = "x", c = true }
optional = true
[[group]]
name = "rest"
table = "main"
)");
  ASSERT_EQ(rules.size(), 2u);
  const GroupRule& r = rules[0];
  EXPECT_EQ(r.where.substr(r.where.rfind('/') + 1), "g.toml:1");
  EXPECT_EQ(r.name, "Flügel");
  EXPECT_EQ(r.table, "bc");
  EXPECT_EQ(r.selection.faces, (std::vector<std::string>{"3", "5-7", "WING*"}));
  EXPECT_EQ(r.selection.parts, std::vector<std::string>{"nut"});
  EXPECT_EQ(r.selection.paths, (std::vector<std::string>{"a/*", "b"}));
  EXPECT_EQ(r.selection.layers, std::vector<std::string>{"7"});
  EXPECT_EQ(r.selection.groups, std::vector<std::string>{"default"});
  EXPECT_EQ(r.selection.colors, (std::vector<std::int32_t>{0xff8000, 0x0000ff}));
  EXPECT_EQ(r.selection.surfaces, (std::vector<SurfaceType>{SurfaceType::kPlane, SurfaceType::kOther}));
  ASSERT_TRUE(r.selection.inside);
  EXPECT_EQ((*r.selection.inside)[1].value, -1.5);
  EXPECT_TRUE((*r.selection.inside)[2].is_in_metres);
  EXPECT_NEAR((*r.selection.inside)[2].value, -0.03, 1e-15);
  EXPECT_NEAR((*r.selection.inside)[5].value, 0.0254, 1e-15);
  EXPECT_EQ(r.role, "inlet");
  EXPECT_NEAR(r.tolerance->value, 1e-4, 1e-15);
  EXPECT_EQ(r.attributes, R"({"a":"x","b":[1,2.5],"c":true})");
  EXPECT_TRUE(r.is_optional);
  EXPECT_EQ(rules[1].table, "") << "main is the table without a name";
}

TEST(GroupsFile, refuses_what_it_does_not_understand_with_line_and_key) {
  const std::pair<const char*, const char*> cases[] = {
      {"nmae = \"x\"", "unknown key 'nmae' of a [[group]], did you mean 'name'"},
      {"name = \"\"", "name: takes a string"},
      {"name = \"a\\nb\"", "name: contains a control character"},
      {"faces = 3", "name: is missing"},
      {"name = \"x\"\nfaces = []", "g.toml:3: faces: an empty list"},
      {"name = \"x\"\nfaces = [1.5]", "faces: takes a name"},
      {"name = \"x\"\nparts = 3", "parts: takes a name"},
      {"name = \"x\"\ntable = \"a b\"", "table: 'a b' is not a name"},
      {"name = \"x\"\ncolors = \"red\"", "colors: takes \"#rrggbb\""},
      {"name = \"x\"\ncolors = \"#-12345\"", "colors: takes"},
      {"name = \"x\"\ncolors = 3", "colors: takes"},
      {"name = \"x\"\nsurfaces = \"blob\"", "surfaces: 'blob' is unknown; write plane, cylinder"},
      {"name = \"x\"\ninside = [1, 2, 3]", "inside: takes six coordinates"},
      {"name = \"x\"\ninside = [1, 0, 0, 0, 1, 1]", "the lower corner comes first"},
      {"name = \"x\"\ntouching = [0, 0, 0, \"3parsec\", 1, 1]", "touching: takes coordinates"},
      {"name = \"x\"\ntouching = [0, 0, nan, 1, 1, 1]", "touching: takes coordinates"},
      {"name = \"x\"\ntouching = [0, 0, 0, \"inf\", 1, 1]", "touching: takes coordinates"},
      {"name = \"x\"\ntouching = [0, 0, 0, true, 1, 1]", "touching: takes coordinates"},
      {"name = \"x\"\nrole = \"wal\"", "role: 'wal' is unknown, did you mean 'wall'; write wall, symmetry"},
      {"name = \"x\"\ntolerance = -1", "tolerance: must be positive"},
      {"name = \"x\"\ntolerance = true", "g.toml:3: tolerance: takes a length such as 0.2"},
      {"name = \"x\"\noptional = 1", "optional: takes true or false"},
      {"name = \"x\"\nattributes = 1", "attributes: takes a table"},
      {"name = \"x\"\nattributes = {tolerance = 1}", "attributes: tolerance is a key of [[group]] itself"},
      {"name = \"x\"\nattributes = {d = 1979-05-27}", "attributes: d: takes"},
      {"name = \"x", "g.toml:2"},
  };
  for (const auto& [text, message] : cases) {
    TemporaryDirectory dir;
    write_bytes(dir / "g.toml", std::string("[[group]]\n") + text + "\n");
    EXPECT_ERROR(read_groups(dir / "g.toml"), kUsage, message);
  }
}

TEST(GroupsFile, without_groups_or_with_other_tables_is_refused) {
  TemporaryDirectory dir;
  write_bytes(dir / "empty.toml", "");
  EXPECT_ERROR(read_groups(dir / "empty.toml"), kUsage, "has no table [[group]]");
  write_bytes(dir / "other.toml", "[[group]]\nname = \"x\"\n[[gruop]]\n");
  EXPECT_ERROR(read_groups(dir / "other.toml"), kUsage, "other.toml:3: unknown table 'gruop'");
  write_bytes(dir / "single.toml", "[group]\nname = \"x\"\n");
  EXPECT_ERROR(read_groups(dir / "single.toml"), kUsage, "'group' must be tables [[group]]");
  EXPECT_ERROR(read_groups(dir / "none.toml"), kInput, "none.toml: cannot be read");
  EXPECT_ERROR(read_groups(dir / "."), kInput, "is a directory");
}

TEST(GroupsFile, may_be_an_option_file) {
  TemporaryDirectory dir;
  write_bytes(dir / "o.toml",
              "small = \"1%\"\n[[size]]\nlmax = 1\n[[group]]\nname = \"a\"\n"
              "[st-raster]\nalpha = 5\n[[st-import.group]]\nname = \"b\"\n");
  const GroupsFile file = read_groups(dir / "o.toml");
  ASSERT_EQ(file.rules.size(), 2u);
  EXPECT_EQ(file.rules[0].name + file.rules[1].name, "ab");
}

TEST(GroupsFile, has_the_hash_of_its_bytes) {
  TemporaryDirectory dir;
  write_bytes(dir / "a.toml", "[[group]]\nname = \"x\"\n");
  write_bytes(dir / "b.toml", "[[group]]\nname = \"x\"\n\n");
  EXPECT_EQ(read_groups(dir / "a.toml").hash, read_groups(dir / "a.toml").hash);
  EXPECT_NE(read_groups(dir / "a.toml").hash, read_groups(dir / "b.toml").hash);
}

TEST(GroupsFile, takes_groups_of_edges_and_vertices_with_keys_of_their_own) {
  const std::vector<GroupRule> rules = parse(R"([[group]]
name = "te"
edges = [3, "5-7", "TE_*"]
of = "edges"
between = ["WING", "BODY"]
rim = "WING"
on = ["WING", "BODY"]
[[group]]
of = "vertices"
name = "tips"
vertices = [1, "2-3"]
on = "te"
[[group]]
of = "faces"
name = "f"
)");
  ASSERT_EQ(rules.size(), 3u);
  EXPECT_EQ(rules[0].of, EntityDim::kEdge);
  EXPECT_EQ(rules[0].selection.edges, (std::vector<std::string>{"3", "5-7", "TE_*"}));
  EXPECT_EQ(rules[0].selection.between, (std::vector<std::string>{"WING", "BODY"}));
  EXPECT_EQ(rules[0].selection.rim, std::vector<std::string>{"WING"});
  EXPECT_EQ(rules[0].selection.on, (std::vector<std::string>{"WING", "BODY"}));
  EXPECT_EQ(rules[1].of, EntityDim::kVertex);
  EXPECT_EQ(rules[1].selection.vertices, (std::vector<std::string>{"1", "2-3"}));
  EXPECT_EQ(rules[1].selection.on, std::vector<std::string>{"te"});
  EXPECT_EQ(rules[2].of, EntityDim::kFace);
}

TEST(GroupsFile, refuses_keys_of_another_kind_of_group) {
  const std::string begin = "[[group]]\nname = \"te\"\n";
  EXPECT_ERROR(parse(begin + "edges = 1\n"), kUsage, "edges: is not a key of a group of faces but of edges");
  EXPECT_ERROR(parse(begin + "of = \"edges\"\nrole = \"wall\"\n"), kUsage,
               "role: is not a key of a group of edges but of faces");
  EXPECT_ERROR(parse(begin + "of = \"edges\"\ntolerance = 1\n"), kUsage, "tolerance: is not a key of a group of edges");
  EXPECT_ERROR(parse(begin + "of = \"vertices\"\nbetween = [\"a\", \"b\"]\n"), kUsage, "between");
  EXPECT_ERROR(parse(begin + "of = \"edges\"\nbetween = [\"a\"]\n"), kUsage, "between: takes two names");
  EXPECT_ERROR(parse(begin + "of = \"lines\"\n"), kUsage, "of: 'lines' is unknown; write vertices, edges, faces");
}

}  // namespace
}  // namespace st
