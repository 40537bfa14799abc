// That VTK and meshio read such arrays is tested in tests/foreign and tests/vtk.
#include "io/export/vtu_writer.h"

#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::string written(const auto& write) {
  TemporaryDirectory dir;
  Output out(dir / "x.vtu");
  write(out);
  out.commit();
  return read_bytes(dir / "x.vtu");
}

TEST(VtuWriter, writes_length_and_values_in_base64_with_padding) {
  const auto of = [](const std::vector<std::uint8_t>& values) {
    return written([&](Output& out) { write_vtu_array(out, "a<b", values); });
  };
  EXPECT_EQ(of({'M', 'a', 'n', 255}),
            "<DataArray type=\"UInt8\" Name=\"a&lt;b\" NumberOfTuples=\"4\" format=\"binary\">BAAAAAAAAABNYW7/"
            "</DataArray>\n");
  EXPECT_NE(of({1}).find(">AQAAAAAAAAAB</"), std::string::npos);
  EXPECT_NE(of({1, 2}).find(">AgAAAAAAAAABAg==</"), std::string::npos);
  EXPECT_NE(of({1, 2, 3}).find(">AwAAAAAAAAABAgM=</"), std::string::npos);
}

TEST(VtuWriter, makes_one_array_of_all_that_have_a_name) {
  const std::string text = written([](Output& out) { write_vtu_names(out, "face", {"a", "", "b\"", "a"}); });
  EXPECT_NE(text.find("Name=\"face:a\" NumberOfTuples=\"2\""), std::string::npos) << text;
  EXPECT_NE(text.find("Name=\"face:b'\" NumberOfTuples=\"1\""), std::string::npos) << text;
}

}  // namespace
}  // namespace st
