// docs/artifacts.md says what the files have, and nothing else.
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include "io/hdf5/inspect.h"
#include "io/hdf5/sizing_artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

struct DocumentedDataset {
  std::string name, type;
  std::vector<std::string> shape;  ///< "n_faces+1", "3*n_triangles", "4"
};
struct Section {
  std::vector<DocumentedDataset> datasets;
  std::map<std::string, std::string> attributes;  ///< name, type
};

/// Cells of a row of a Markdown table, code marks and blanks removed.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) {
    cell = std::regex_replace(cell, std::regex("^[ `]+|[ `]+$"), "");
    cells.push_back(cell);
  }
  return cells;
}

std::vector<std::string> shape_of(const std::string& text) {
  std::vector<std::string> shape;
  std::istringstream stream(std::regex_replace(text, std::regex("[() ]"), ""));
  for (std::string extent; std::getline(stream, extent, ',');) shape.push_back(extent);
  return shape;
}

/// By the title of the section.
std::map<std::string, Section> read_document() {
  const auto path = std::filesystem::path(ST_SOURCE_DIR) / "docs/artifacts.md";
  std::istringstream text(read_bytes(path.string()));
  std::map<std::string, Section> sections;
  std::string title;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("## ", 0) == 0) title = line.substr(3);
    if (line.rfind("| `/", 0) != 0) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells[0].find('@') != std::string::npos)
      sections[title].attributes[cells[0]] = cells[1];
    else
      sections[title].datasets.push_back({cells[0], cells[1], shape_of(cells[2])});
  }
  return sections;
}

/// "k*symbol+c" with the symbol's value from `known`, which learns it at its first appearance; nullopt when it does not
/// fit `extent`.
bool fits(const std::string& expression, std::int64_t extent, std::map<std::string, std::int64_t>& known) {
  std::smatch m;
  if (std::regex_match(expression, std::regex("[0-9]+"))) return std::stoll(expression) == extent;
  if (!std::regex_match(expression, m, std::regex("(?:([0-9]+)\\*)?([a-z_]+)(?:\\+([0-9]+))?"))) return false;
  const std::int64_t factor = m[1].matched ? std::stoll(m[1]) : 1, summand = m[3].matched ? std::stoll(m[3]) : 0;
  if ((extent - summand) % factor != 0) return false;
  const std::int64_t value = (extent - summand) / factor;
  return known.emplace(m[2], value).first->second == value;
}

RasterArtifact sample_raster() {
  RasterArtifact r;
  r.header = sample_header();
  r.header.schema = "raster";
  r.numbers = {0.1, 1, 2, 10, 2, 40, 16};
  r.octree.shape.leaf_keys.resize(15);
  r.octree.shape.leaf_levels.resize(15);
  r.octree.shape.node_children.resize(16);
  r.octree.stored_length.resize(15, 1);
  r.octree.stored_cause.resize(15);
  r.samples.resize(11);
  r.samples[4].reach = reach_of({1, 0, 0});
  r.surface.points.resize(13);
  r.surface.triangles.resize(6, {{0, 1, 2}});
  r.model.faces.offsets = {0, 3, 6, 7};
  r.model.faces.leaf.resize(7);
  r.model.faces.area.resize(7, 1);
  r.model.faces.plane.resize(7);
  r.model.faces.origin = {1, 2, 3};
  r.model.edge_name.resize(5);
  r.model.labels = sample_labels(3);
  r.model.labels.face_name.resize(3);
  r.model.labels.group_name = {"body", "wing"};
  r.model.labels.face_group = {0, 1, 0};
  r.n_not_sampled = 1;
  r.model.wings.resize(2);
  r.model.wings[0].stations.resize(11);
  r.model.wings[0].edges.resize(3);
  r.model.wings[1].faces.resize(7);
  r.model.wings[1].bases.resize(4);
  r.model.face_lmin = {0.1, 0, 0.2};
  r.model.undercuts.resize(9);
  return r;
}

SizingArtifact sample_sizing() {
  SizingArtifact s;
  s.header = sample_header();
  s.header.schema = "sizing";
  s.numbers = sample_raster().numbers;
  s.slope = 0.2;
  s.frame.scale = 2;
  s.shape = sample_raster().octree.shape;
  s.lengths.cells.resize(15);
  s.lengths.cause.resize(15);
  s.blanking.colour.resize(15, CellColour::kCut);
  s.blanking.split_leaf = {3, 8};
  s.blanking.split.resize(2);
  s.lengths.second_cells.resize(2);
  s.lengths.second_cause.resize(2);
  s.cones = {std::vector<Cone>(9),
             std::vector<std::int32_t>(9),
             std::vector<std::int32_t>(18),
             std::vector<std::int32_t>(21),
             {},
             {},
             std::vector<ConeStretch>(9),
             std::vector<std::int32_t>(18),
             std::vector<std::int32_t>(14)};
  s.sources.slope = 0.2;
  s.sources.sources.resize(2);
  s.sources.background.node_xyz.resize(4);
  s.sources.background.node_size.resize(4);
  s.sources.background.node_metric.resize(4);
  s.sources.background.tets.resize(6);
  s.sources.background.triangles.resize(5);
  s.model = sample_raster().model;
  s.face_weight = {1, 2, 3};
  s.source_name = {"wake", ""};
  return s;
}

class ArtifactsDocument : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Sections, ArtifactsDocument,
                         testing::Values("Geometry", "Raster", "Sizing", "Patches", "Mesh", "Failures"),
                         [](const auto& info) { return info.param; });

void write_sample(const std::string& section, const std::string& path) {
  if (section == "Geometry") write_geometry(path, sample_geometry());
  if (section == "Raster") write_raster(path, sample_raster());
  if (section == "Sizing") write_sizing(path, sample_sizing());
  if (section == "Patches") write_patches(path, sample_patches());
  if (section == "Mesh") write_mesh(path, sample_mesh());
  if (section == "Failures") write_failures(path, sample_failures());
}

TEST_P(ArtifactsDocument, lists_exactly_the_datasets_of_the_file_with_type_and_shape) {
  TemporaryDirectory dir;
  write_sample(GetParam(), dir / "a.hdf");
  const ArtifactDescription artifact = describe_artifact(dir / "a.hdf");
  const Section section = read_document()[GetParam()];
  std::set<std::string> undocumented;
  for (const DatasetSummary& d : artifact.datasets) undocumented.insert(d.name);
  std::map<std::string, std::int64_t> known;
  for (const DocumentedDataset& documented : section.datasets) {
    EXPECT_EQ(undocumented.erase(documented.name), 1u) << documented.name << " is documented twice or not in the file";
    for (const DatasetSummary& d : artifact.datasets) {
      if (d.name != documented.name) continue;
      EXPECT_EQ(documented.type, d.type) << d.name;
      ASSERT_EQ(documented.shape.size(), d.shape.size()) << d.name;
      for (std::size_t i = 0; i < d.shape.size(); ++i)
        EXPECT_TRUE(fits(documented.shape[i], static_cast<std::int64_t>(d.shape[i]), known))
            << d.name << ": " << documented.shape[i] << " against " << d.shape[i];
    }
  }
  EXPECT_EQ(undocumented, std::set<std::string>());
}

TEST_P(ArtifactsDocument, lists_exactly_the_attributes_of_the_file_with_type) {
  TemporaryDirectory dir;
  write_sample(GetParam(), dir / "a.hdf");
  std::map<std::string, Section> document = read_document();
  std::map<std::string, std::string> documented = document[GetParam()].attributes, found;
  for (const auto& [name, type] : document["Every artifact"].attributes) documented[name] = type;
  const char* types[] = {"string", "int64", "float64"};
  for (const AttributeSummary& a : describe_artifact(dir / "a.hdf").attributes) found[a.name] = types[a.value.index()];
  for (const char* provenance : {"content_hash", "geometry_hash", "tool", "tool_version", "options", "inputs"})
    found["/st@" + std::string(provenance)] = "string";
  EXPECT_EQ(documented, found);
}

}  // namespace
}  // namespace st
