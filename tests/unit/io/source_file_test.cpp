#include "io/toml/source_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "base/error.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class SourceFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name) << text;
    return dir_ / name;
  }
  SourceFile toml(const std::string& text, const ModelScale& scale = {10, 0.001}) const {
    return read_source_file(write("s.toml", text), scale);
  }
  void expect_error(const std::string& text, const std::string& part) const {
    try {
      toml(text);
      ADD_FAILURE() << "no error for " << text;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("s.toml:"), std::string::npos) << e.what();
    }
  }
  /// One edit of a good background file, and what its refusal says after the name of the file.
  struct Damage {
    std::string from, to, message;
  };
  void expect_refusals(const std::string& name, const std::string& good, const std::vector<Damage>& damages) const {
    for (const Damage& d : damages) {
      std::string text = good;
      const std::size_t at = text.find(d.from);
      ASSERT_NE(at, std::string::npos) << d.from;
      EXPECT_ERROR(read_background_file(write(name, text.replace(at, d.from.size(), d.to))), kInput, name + d.message);
    }
  }
  TemporaryDirectory dir_;
};

TEST_F(SourceFiles, toml_knows_every_kind) {
  const SourceFile f = toml(R"(
[[source]]
type = "point"
at = [1, 2, 3]
length = 0.5
[[source]]
name = "wake"
type = "line"
points = [[0, 0, 0], [9, 0, 0]]
length = ["5mm", 0.2]
radius = 0
doubling = "10%"
[[source]]
type = "triangle"
points = [[0, 0, 0], [9, 0, 0], [0, 1, 0]]
length = 1
[[source]]
type = "box"
lo = [0, 0, 0]
hi = [2, 4, 6]
length = 1
[[source]]
type = "cylinder"
from = [0, 0, 0]
to = [0, 0, 2]
extent = 0.5
length = 1
[[source]]
type = "sphere"
at = [0, 0, 0]
extent = 0.5
length = 1
[[source]]
type = "disc"
at = [0, 0, 0]
normal = [0, 0, 3]
extent = 0.5
length = 1
)");
  ASSERT_EQ(f.sources.size(), 7u);
  EXPECT_EQ(f.sources[0].point[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(f.sources[1].name, "wake");
  EXPECT_DOUBLE_EQ(f.sources[1].spacing[0].length, 5);  // mm in a model in mm
  EXPECT_EQ(f.sources[1].spacing[1].length, 0.2);
  EXPECT_EQ(f.sources[1].spacing[1].doubling, 1);
  EXPECT_EQ(f.sources[3].point[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(norm(f.sources[3].half_axis[2]), 3);
  EXPECT_EQ(f.sources[4].extent, 0.5);
}

TEST_F(SourceFiles, toml_refuses_lines_and_triangles_without_extent) {
  const std::string line = "[[source]]\ntype = \"line\"\nlength = 1\npoints = ",
                    triangle = "[[source]]\ntype = \"triangle\"\nlength = 1\npoints = ";
  expect_error(line + "[[1, 2, 3], [1, 2, 3]]", "line: its points are the same; move one, or write type = \"point\"");
  expect_error(triangle + "[[0, 0, 0], [1, 1, 1], [3, 3, 3]]", "triangle: its points lie on one line");
  expect_error(triangle + "[[1, 1, 1], [1, 1, 1], [1, 1, 1]]", "triangle: its points lie on one line");
  EXPECT_NO_THROW(toml(line + "[[1, 2, 3], [1, 2, 3.001]]"));
}

TEST_F(SourceFiles, toml_guesses_a_kind_that_is_misspelt) {
  expect_error("[[source]]\ntype = \"shpere\"\nlength = 1", "did you mean 'sphere'");
}

TEST_F(SourceFiles, toml_deletes_by_name) {
  EXPECT_EQ(toml("[[source]]\nname = \"wake\"\ndelete = true").deleted, std::vector<std::string>{"wake"});
  expect_error("[[source]]\nname = \"wake\"\ndelete = 1", "s.toml:3: delete: takes true or false");
  expect_error("[[source]]\ndelete = true", "s.toml:1: delete: needs the name of a source");
  expect_error("[[source]]\nnmae = \"wake\"\ndelete = true", "s.toml:2: unknown key 'nmae'");
}

TEST_F(SourceFiles, toml_may_be_an_option_file) {
  const SourceFile f = toml(R"(
slope = 0.1
[[size]]
lmax = 1
[[source]]
type = "point"
at = [1, 0, 0]
length = 1
[st-mesh]
max-turning = 20
[[st-prolong.source]]
type = "point"
at = [2, 0, 0]
length = 1
)");
  ASSERT_EQ(f.sources.size(), 2u);
  EXPECT_EQ(f.sources[0].point[0].x, 1);
  EXPECT_EQ(f.sources[1].point[0].x, 2);
  EXPECT_TRUE(toml("# all sources commented out").sources.empty());
}

TEST_F(SourceFiles, toml_errors_name_file_line_and_cause) {
  const std::string cylinder = "[[source]]\ntype = \"cylinder\"\nextent = 1\nlength = 1\nfrom = [0, 0, 0]\n";
  expect_error(cylinder + "to = [1e200, 0, 0]", "s.toml:6: to: 1e+200 is beyond 1e+12, the largest coordinate");
  expect_error(cylinder + "to = [1, 0, 0]\nradius = 1e300", "s.toml:7: radius: 1e+300 in the unit of the model");
  expect_error(cylinder + "to = [1, 0, 0]\nradius = true", "s.toml:7: radius: a length expected");
  expect_error("[[source]]\ntype = \"blob\"\nlength = 1", "blob");
  expect_error("[[source]]\ntype = \"point\"\nlength = 1", "at = [x, y, z]");
  expect_error("[[source]]\ntype = \"point\"\nat = [0, 0]\nlength = 1", "s.toml:3");
  expect_error("[[source]]\ntype = \"point\"\nat = [0, 0, 0]\nlength = -1", "must be positive");
  expect_error("[[source]]\ntype = \"point\"\nat = [0, 0, 0]\nlength = \"1 parsec\"", "parsec");
  expect_error("[[source]]\ntype = \"point\"\nat = [0, 0, 0]", "needs a length");
  expect_error("[[source]]\ntype = \"point\"\nat = [0, 0, 0]\nlength = 1\nlenght = 2",
               "unknown key 'lenght' of a source, did you mean 'length'; the keys are aspect, at, delete, direction");
  expect_error("[[source]]\ntype = \"point\"\nat = [0, 0, 0]\nlength = 1\nradius = 2\ndoubling = 1",
               "larger than radius");
  expect_error("[[source]]\ntype = \"line\"\npoints = [[0, 0, 0]]\nlength = 1", "2 points");
  expect_error("[[source]]\ntype = \"box\"\nlo = [0, 0, 0]\nhi = [1, 0, 1]\nlength = 1", "lo must be below hi");
  const std::string line = "[[source]]\ntype = \"line\"\npoints = [[0, 0, 0], [9, 0, 0]]\n";
  expect_error(line + "length = [1, 2, 3]", "s.toml:4: length: one value, or one for each of the 2 points");
  expect_error(line + "length = true", "s.toml:4: length: a length expected, such as 0.2");
  expect_error("[[source]]\ntype = \"sphere\"\nat = [0, 0, 0]\nlength = 1", "source needs extent");
  expect_error("[[source]]\ntype = \"cylinder\"\nfrom = [1, 0, 0]\nto = [1, 0, 0]\nextent = 1\nlength = 1",
               "from and to are the same point");
  expect_error("[[source]]\ntype = \"disc\"\nat = [1, 0, 0]\nnormal = [0, 0, 0]\nextent = 1\nlength = 1",
               "disc: normal is zero");
  expect_error("slope = 3", "no table [[source]]");
  expect_error("[source]\ntype = \"point\"", "s.toml:1: 'source' must be tables [[source]]");
  expect_error("[[sorce]]\ntype = \"point\"", "s.toml:1: unknown table 'sorce'");
  expect_error("[[source]\n", "s.toml:1");
}

const char* const kBac = R"(* background mesh
  4  1  1  1  1  0 0 0
  10  0 0 0
   1 0 0 0.5
   0 1 0 0.5
   0 0 1 0.5
  11  1.0D0 0 0
   1 0 0 0.5
   0 1 0 0.25
   0 0 1 0.5
  12  0 1 0
   1 0 0 1
   0 1 0 1
   0 0 1 1
  13  0 0 1
   1 0 0 1
   0 1 0 1
   0 0 1 1
  1 10 11 12 13
* points
global
  0.5 0.5 0.5  0.1  0  2
* lines
Leading edge 1
  0 0 0  0.1  0.2  0.4
  1 0 0  0.2  0.2  0.4
* triangles
7
  0 0 0  0.1  0.2  0.4
  1 0 0  0.2  0.2  0.4
  0 1 0  0.3  0.2  0.4
)";

std::vector<double> lengths_of(const BackgroundMesh& mesh) {
  std::vector<double> lengths;
  for (const LocalSize& s : mesh.node_size) lengths.push_back(s.length);
  return lengths;
}

TEST_F(SourceFiles, bac_has_background_and_sources) {
  const SourceFile f = read_source_file(write("m.bac", kBac), {});
  ASSERT_EQ(f.background.tets.size(), 1u);
  EXPECT_EQ(f.background.tets[0], (std::array<std::int32_t, 4>{0, 1, 2, 3}));
  EXPECT_EQ(f.background.node_xyz[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(lengths_of(f.background), (std::vector<double>{0.5, 0.25, 1, 1}));
  EXPECT_EQ(f.background.node_size[0].along, 0.5);
  EXPECT_EQ(f.background.node_size[1].along, 0.5);
  EXPECT_EQ(f.background.node_size[1].direction, (Vec3{1, 0, 0}));
  ASSERT_EQ(f.sources.size(), 3u);
  EXPECT_EQ(f.sources[0].name, "global");
  EXPECT_EQ(f.sources[1].name, "Leading edge 1");
  EXPECT_EQ(f.sources[1].spacing[1].length, 0.2);
  EXPECT_EQ(f.sources[2].kind, SourceKind::kTriangle);
  EXPECT_EQ(f.sources[2].point[2], (Vec3{0, 1, 0}));
}

TEST_F(SourceFiles, cut_bac_files_are_refused_at_every_line) {
  const std::string text = kBac;
  for (std::size_t end = text.find('\n'); end + 1 < text.size(); end = text.find('\n', end + 1))
    EXPECT_THROW(read_source_file(write("cut.bac", text.substr(0, end)), {}), Error) << end;
}

TEST_F(SourceFiles, damaged_bac_files_are_refused_with_the_line) {
  expect_refusals("bad.bac", kBac,
                  {{"4  1  1", "-4  1  1", ":2: nodes: not a count"},
                   {"4  1  1", "4.5  1  1", ":2: nodes: not a count"},
                   {"4  1  1", "4  1e10  1", ":2: tetrahedra: not a count"},
                   {"4  1  1", "4  1  0.5", ":2: sources: not a count"},
                   {"10  0 0 0", "10  0 0", ":3: a background node: 4 numbers expected"},
                   {"10  0 0 0", "10.5  0 0 0", ":3: not the number of a node"},
                   {"10  0 0 0", "1e300  0 0 0", ":3: not the number of a node"},
                   {"11  1.0D0", "10  1.0D0", ":7: has two nodes of the number 10"},
                   {"0 1 0 0.25", "0 1 0 0.2.5", ":9: a direction and its spacing: 4 numbers expected"},
                   {"0 1 0 0.25", "0 1 0 0", ":9: spacing must be positive; check the file"},
                   {"11 12 13", "11 12 12.5", ":19: not the number of a node"},
                   {"11 12 13", "11 12 14", ":19: tetrahedron names a node that does not exist"},
                   {"0.1  0  2", "0  0  2", ":22: spacing must be positive, and radii not negative"},
                   {"0.1  0  2", "0.1  -1  2", ":22: spacing must be positive, and radii not negative"}});
}

TEST_F(SourceFiles, bac_without_tetrahedra_has_sources_but_is_no_background) {
  const std::string path = write("s.bac", "title\n0 0 1 0 0\n* points\nglobal\n0.5 0.5 0.5  0.1  0  2\n");
  EXPECT_EQ(read_source_file(path, {}).sources.size(), 1u);
  EXPECT_ERROR(read_background_file(path), kInput, "s.bac: has no tetrahedra; give a background mesh");
}

TEST_F(SourceFiles, other_files_are_no_background) {
  EXPECT_ERROR(read_background_file(write("m.txt", "1 2 3")), kInput, "m.txt: no background mesh; give .bac");
}

TEST_F(SourceFiles, sources_may_be_stretched) {
  const auto spec = [&](const std::string& text) {
    return read_source_file(write("s.toml", "[[source]]\nlength = 1\n" + text), {}).sources.at(0);
  };
  const SourceSpec line = spec("type = \"line\"\npoints = [[0, 0, 0], [0, 2, 0]]\naspect = 4");
  EXPECT_EQ(line.aspect, 4);
  EXPECT_EQ(line.direction, (Vec3{0, 1, 0}));
  const SourceSpec cylinder =
      spec("type = \"cylinder\"\nfrom = [0, 0, 0]\nto = [3, 0, 0]\nextent = 1\naspect = 2\ndirection = [0, 0, 5]");
  EXPECT_EQ(cylinder.direction, (Vec3{0, 0, 1}));
  EXPECT_EQ(spec("type = \"point\"\nat = [0, 0, 0]").aspect, 1);
  const auto refused = [&](const std::string& text, const std::string& message) {
    EXPECT_ERROR(spec("type = \"point\"\nat = [0, 0, 0]\n" + text), kUsage, message);
  };
  refused("aspect = 4", "needs direction");
  refused("aspect = 4\ndirection = [0, 0, 0]", "needs direction");
  refused("aspect = 0.5\ndirection = [0, 0, 1]", "s.toml:5: aspect: a number from 1 to 100");
  refused("aspect = \"4\"\ndirection = [0, 0, 1]", "a number from 1 to 100");
}

TEST_F(SourceFiles, missing_empty_and_directory_are_refused) {
  EXPECT_ERROR(read_source_file(dir_ / "none.toml", {}), kInput, "none.toml: cannot be read");
  EXPECT_ERROR(read_source_file(dir_ / ".", {}), kInput, "is a directory");
  EXPECT_ERROR(read_source_file(write("empty.bac", ""), {}), kInput, "empty.bac: empty file");
  EXPECT_ERROR(read_source_file(write("empty.toml", ""), {}), kInput, "empty.toml: empty file");
}

}  // namespace
}  // namespace st
