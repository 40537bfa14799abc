// STEP files that need no document: what the plain reader makes of them is what the module makes of them.

#include <gtest/gtest.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "geometry/import/import.h"
#include "geometry/import/reader_module.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

using occt::CadFile;
using occt::CadPart;

/// The B-Rep as text: every curve, every surface, their order and their places.
std::string text_of(const TopoDS_Shape& shape) {
  std::ostringstream out;
  BRepTools::Write(shape, out);
  return out.str();
}

void expect_same_faces(const CadPart& a, const CadPart& b) {
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    EXPECT_EQ(text_of(a.faces[f].face), text_of(b.faces[f].face)) << f;
    EXPECT_EQ(a.faces[f].name, b.faces[f].name) << f;
    EXPECT_EQ(a.faces[f].layer, b.faces[f].layer) << f;
    EXPECT_EQ(a.faces[f].color, b.faces[f].color) << f;
    EXPECT_EQ(a.faces[f].body, b.faces[f].body) << f;
    EXPECT_EQ(a.faces[f].lies_as_said, b.faces[f].lies_as_said) << f;
    EXPECT_EQ(a.faces[f].has_seam, b.faces[f].has_seam) << f;
  }
}

void expect_same(const CadFile& a, const CadFile& b) {
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.unit_in_mm, b.unit_in_mm);
  EXPECT_EQ(a.has_mixed_units, b.has_mixed_units);
  EXPECT_EQ(a.missing_files, b.missing_files);
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t p = 0; p < a.parts.size(); ++p) {
    EXPECT_EQ(a.parts[p].name, b.parts[p].name);
    EXPECT_EQ(a.parts[p].path, b.parts[p].path);
    EXPECT_EQ(text_of(a.parts[p].shape), text_of(b.parts[p].shape));
    EXPECT_EQ(a.parts[p].edges.size(), b.parts[p].edges.size());
    expect_same_faces(a.parts[p], b.parts[p]);
  }
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// nullopt: it needs a document.
std::optional<CadFile> read_plain_step(const std::string& path) {
  CadFile file = occt::read_by_module("plain_step", path);
  return file.format.empty() ? std::nullopt : std::optional(std::move(file));
}

/// The box with `was` replaced in the file's text.
std::optional<CadFile> read_changed_box(const std::string& was, const std::string& now) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "box.step", "MM");
  std::string text = bytes_of(dir / "box.step");
  const std::size_t at = text.find(was);
  EXPECT_NE(at, std::string::npos) << was;
  std::ofstream(dir / "box.step") << text.replace(at, was.size(), now);
  return read_plain_step(dir / "box.step");
}

TEST(PlainStep, reads_what_the_reader_of_documents_reads) {
  for (const char* unit : {"MM", "INCH"})
    for (const char* shape :
         {"box", "sphere", "torus", "drilled_cylinder", "mirrored_cylinder", "sharp_wing", "square", "crumpled"}) {
      const TemporaryDirectory dir;
      test::write_step(shape, dir / "a.step", unit);
      const std::optional<CadFile> plain = read_plain_step(dir / "a.step");
      ASSERT_TRUE(plain) << shape;
      SCOPED_TRACE(shape);
      expect_same(*plain, occt::read_by_module("step_document", dir / "a.step"));
    }
}

TEST(PlainStep, numbers_the_bodies_of_a_part) {
  const TemporaryDirectory dir;
  test::write_brep("two_boxes", dir / "a.brep");
  BRep_Builder builder;
  TopoDS_Shape boxes;
  ASSERT_TRUE(BRepTools::Read(boxes, (dir / "a.brep").c_str(), builder));
  STEPControl_Writer writer;
  const int was = Interface_Static::IVal("write.step.assembly");
  Interface_Static::SetIVal("write.step.assembly", 0);  // one product of two solids
  writer.Transfer(boxes, STEPControl_AsIs);
  writer.Write((dir / "a.step").c_str());
  Interface_Static::SetIVal("write.step.assembly", was);
  const std::optional<CadFile> plain = read_plain_step(dir / "a.step");
  ASSERT_TRUE(plain);
  expect_same(*plain, occt::read_by_module("step_document", dir / "a.step"));
  ASSERT_EQ(plain->parts[0].faces.size(), 12u);
  EXPECT_EQ(plain->parts[0].faces[0].body, "body#1");
  EXPECT_EQ(plain->parts[0].faces[11].body, "body#2");
}

TEST(PlainStep, leaves_files_with_names_colours_and_assemblies_alone) {
  const TemporaryDirectory dir;
  test::write_named_assembly(dir / "assembly.step");
  test::write_named_loose_box(dir / "loose.step");
  EXPECT_FALSE(read_plain_step(dir / "assembly.step"));
  EXPECT_FALSE(read_plain_step(dir / "loose.step"));
  EXPECT_TRUE(read_changed_box("ADVANCED_FACE(''", "ADVANCED_FACE('NONE'"));
  EXPECT_FALSE(read_changed_box("ADVANCED_FACE(''", "ADVANCED_FACE('flap'"));
  EXPECT_FALSE(read_changed_box("EDGE_CURVE(''", "EDGE_CURVE('nose'"));
  EXPECT_FALSE(read_changed_box("ENDSEC;\nEND-ISO", "/* DOCUMENT_FILE */ ENDSEC;\nEND-ISO"));
}

TEST(PlainStep, begins_after_a_byte_order_mark_as_the_reader_of_documents_does) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "a.step", "MM");
  const std::optional<CadFile> plain = read_plain_step(dir / "a.step");
  const std::string bytes = bytes_of(dir / "a.step");
  std::ofstream(dir / "a.step", std::ios::binary) << "\xef\xbb\xbf" + bytes;
  const std::optional<CadFile> marked = read_plain_step(dir / "a.step");
  ASSERT_TRUE(plain && marked);
  expect_same(*plain, *marked);
  expect_same(*plain, occt::read_by_module("step_document", dir / "a.step"));
}

/// A box that stands in the file as a mapped item of this scale.
void write_mapped_box(const std::string& path, const std::string& scale) {
  test::write_step("box", path, "MM");
  std::string text = bytes_of(path);
  const std::string shape = "SHAPE_DEFINITION_REPRESENTATION(#4,#10);", axes = "(#11,#15),#";
  const std::size_t context = text.find(axes) + axes.size(), at = text.find(shape);
  ASSERT_NE(context, axes.size() - 1);
  ASSERT_NE(at, std::string::npos);
  const std::string id = text.substr(context, text.find(')', context) - context);
  std::ofstream(path) << text.replace(
      at, shape.size(),
      "SHAPE_DEFINITION_REPRESENTATION(#4,#9000);\n#9000=SHAPE_REPRESENTATION('',(#11,#9001),#" + id +
          ");\n#9001=MAPPED_ITEM('',#9002,#9003);\n#9002=REPRESENTATION_MAP(#11,#10);\n"
          "#9003=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,#9004,#9005,#9006," +
          scale +
          ",#9007);\n#9004=DIRECTION('',(1.,0.,0.));\n#9005=DIRECTION('',(0.,1.,0.));\n"
          "#9006=CARTESIAN_POINT('',(5.,0.,0.));\n#9007=DIRECTION('',(0.,0.,1.));\n");
}

TEST(PlainStep, refuses_parts_that_are_scaled_where_they_are_placed) {
  const TemporaryDirectory dir;
  write_mapped_box(dir / "same.step", "1.");
  write_mapped_box(dir / "default.step", "$");
  write_mapped_box(dir / "twice.step", "2.");
  for (const char* module : {"plain_step", "step_document"}) {
    EXPECT_NO_THROW(occt::read_by_module(module, dir / "same.step")) << module;
    EXPECT_NO_THROW(occt::read_by_module(module, dir / "default.step")) << module;
    EXPECT_ERROR(occt::read_by_module(module, dir / "twice.step"), kGeometry, "the scale 2, ");
  }
  const ImportResult box = import_model(dir / "same.step", {});
  EXPECT_NEAR(box.area, 8800, 1e-6);
  EXPECT_NEAR(box.tables.box().lo.x, 5, 1e-5);
}

TEST(PlainStep, reads_tabs_and_parameters_of_the_data_section) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "a.step", "MM");
  const std::optional<CadFile> plain = read_plain_step(dir / "a.step");
  std::string text = bytes_of(dir / "a.step");
  const std::size_t data = text.find("DATA;") + 4;
  text.insert(data, "('a',('AUTOMOTIVE_DESIGN'))");
  for (std::size_t at = data; (at = text.find("\n  ", at)) != std::string::npos;) text.replace(at, 3, "\n\t");
  std::ofstream(dir / "b.step", std::ios::binary) << text;
  const std::optional<CadFile> changed = read_plain_step(dir / "b.step");
  ASSERT_TRUE(plain && changed);
  expect_same(*plain, *changed);
}

TEST(PlainStep, leaves_out_faces_that_a_shell_has_twice) {
  const TemporaryDirectory dir;
  test::write_step("ball_with_stem", dir / "a.step", "MM");
  std::string text = bytes_of(dir / "a.step");
  const std::size_t face = text.find("#17 = ADVANCED_FACE("), list = text.find("CLOSED_SHELL('',(") + 17;
  ASSERT_NE(face, std::string::npos);
  const std::string twin = "#9000" + text.substr(face + 3, text.find(';', face) - face - 2) + "\n";
  text.insert(face, twin).insert(list, "#9000,");
  std::ofstream(dir / "b.step") << text;
  const ImportResult sound = import_model(dir / "a.step", {}), r = import_model(dir / "b.step", {});
  EXPECT_EQ(r.tables.n_faces(), sound.tables.n_faces());
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, sound.area, 1e-9 * sound.area);
  EXPECT_NEAR(r.volume, sound.volume, 1e-9 * sound.volume);
}

TEST(PlainStep, names_faces_and_bodies_that_no_shape_was_made_of) {
  using Names = std::vector<std::string>;
  const std::string end = "ENDSEC;\nEND-ISO", facets = "#9001=TESSELLATED_SOLID('seat',(#9002),";
  EXPECT_EQ(read_changed_box(end, end)->unread, Names());
  EXPECT_EQ(read_changed_box("PLANE('',#33)", "CLOTHOID('',#33)")->unread, Names{"ADVANCED_FACE #17"});
  EXPECT_EQ(read_changed_box(end, facets + "$);\n" + end)->unread, Names{"TESSELLATED_SOLID #9001 \"seat\""});
  EXPECT_EQ(read_changed_box(end, facets + "#15);\n" + end)->unread, Names());  // stands for the box
  const std::string items = "#10 = ADVANCED_BREP_SHAPE_REPRESENTATION('',(#11,#15", solid = "EXTRUDED_FACE_SOLID";
  EXPECT_EQ(read_changed_box(items, items + ",#9003")->unread, Names());  // which is not in the file
  const std::string line = "#9003 = " + solid + "('',#17,#13,1.);\n";
  EXPECT_EQ(read_changed_box(items, line + items + ",#9003")->unread, Names{solid + " #9003"});
}

TEST(PlainStep, says_what_it_cannot_parse) {
  const TemporaryDirectory dir;
  std::ofstream(dir / "a.step") << "ISO-10303-21;\nHEADER;\nnonsense\nEND-ISO-10303-21;\n";
  EXPECT_ERROR(read_plain_step(dir / "a.step"), kInput, "cannot be parsed");
}

TEST(ReaderModule, says_which_file_is_missing) {
  EXPECT_ERROR(occt::read_by_module("no_such_reader", "a.step"), kInternal, "lib/st/no_such_reader.so: cannot be");
}

}  // namespace
}  // namespace st
