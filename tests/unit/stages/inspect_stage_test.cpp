#include "stages/inspect_stage.h"

#include <nlohmann/json.hpp>

#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

using Json = nlohmann::json;

TEST(InfoStage, counts_what_is_in_each_kind) {
  TemporaryDirectory dir;
  write_geometry(dir / "g.hdf", sample_geometry());
  write_patches(dir / "p.hdf", sample_patches());
  write_mesh(dir / "m.hdf", sample_mesh());
  EXPECT_EQ(Json::parse(run_info(dir / "g.hdf").json)["counts"],
            Json::parse(R"({"faces":2,"edges":4,"vertices":3,"loops":2,"groups":2,"findings":2})"));
  EXPECT_EQ(Json::parse(run_info(dir / "p.hdf").json)["counts"],
            Json::parse(R"({"triangles":5,"faces":2,"patches":2,"failures":1,"groups":1})"));
  EXPECT_EQ(Json::parse(run_info(dir / "m.hdf").json)["counts"],
            Json::parse(R"({"triangles":4,"nodes":4,"faces":4,"groups":2})"));
}

TEST(InfoStage, says_where_an_artifact_comes_from) {
  TemporaryDirectory dir;
  const std::string hash = write_patches(dir / "p.hdf", sample_patches());
  const StageSummary summary = run_info(dir / "p.hdf");
  const Json json = Json::parse(summary.json);
  EXPECT_EQ(json["schema"], "patches");
  EXPECT_EQ(json["schema_version"], 2);
  EXPECT_EQ(json["written_by"], "st-test");
  EXPECT_EQ(json["unit"], "mm");
  EXPECT_EQ(json["unit_in_m"], 0.001);
  EXPECT_EQ(json["options"]["slope"], 0.2);
  EXPECT_EQ(json["inputs"], Json::parse(R"([{"role":"raster","name":"ra ster.hdf","hash":"4567"}])"));
  EXPECT_EQ(json["geometry_hash"], "0123");
  EXPECT_EQ(json["properties"]["is_complete"], false);
  EXPECT_EQ(json["hash"], hash);
  for (const std::string& text : {std::string("patches (schema version 2)"), std::string("ra ster.hdf 4567"), hash})
    EXPECT_NE(summary.line.find(text), std::string::npos) << summary.line;
  EXPECT_EQ(summary.json.find('\n'), std::string::npos);
}

TEST(InfoStage, survives_names_and_options_that_are_no_text) {
  TemporaryDirectory dir;
  MeshArtifact mesh = sample_mesh();
  mesh.header.tool = "\xff\xfe";
  mesh.header.options_json = "{broken";
  write_mesh(dir / "m.hdf", mesh);
  EXPECT_EQ(Json::parse(run_info(dir / "m.hdf").json)["options"], "{broken");
}

TEST(HashStage, prints_the_content_hash_alone_and_only_of_a_whole_file) {
  TemporaryDirectory dir;
  const std::string hash = write_mesh(dir / "m.hdf", sample_mesh());
  EXPECT_EQ(run_hash(dir / "m.hdf").line, hash);
  EXPECT_EQ(Json::parse(run_hash(dir / "m.hdf").json)["hash"], hash);
  std::string bytes = read_bytes(dir / "m.hdf");
  bytes[bytes.find("bottom")] = 'B';
  write_bytes(dir / "m.hdf", bytes);
  EXPECT_ERROR(run_hash(dir / "m.hdf"), kInput, "does not fit its checksum");
}

TEST(DiffStage, is_ok_for_equal_and_incomplete_for_different_artifacts) {
  TemporaryDirectory dir;
  MeshArtifact other = sample_mesh();
  other.mesh.node_size[2] *= 1 + 1e-9;
  write_mesh(dir / "a.hdf", sample_mesh());
  write_mesh(dir / "b.hdf", other);
  EXPECT_EQ(run_diff({dir / "a.hdf", dir / "a.hdf", 0}).code, ExitCode::kOk);
  EXPECT_EQ(run_diff({dir / "a.hdf", dir / "b.hdf", 1e-8}).code, ExitCode::kOk);
  const StageSummary different = run_diff({dir / "a.hdf", dir / "b.hdf", 0});
  EXPECT_EQ(different.code, ExitCode::kIncomplete);
  EXPECT_NE(different.line.find("/VTKHDF/PointData/size: 1 of 4 values differ, first in row 2"), std::string::npos)
      << different.line;
  EXPECT_EQ(Json::parse(different.json)["equal"], false);
  EXPECT_EQ(Json::parse(different.json)["differences"].size(), 1u);
}

}  // namespace
}  // namespace st
