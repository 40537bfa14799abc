#include "io/export/cell_view.h"

#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(CellView, is_written_with_values_and_names) {
  TemporaryDirectory dir;
  write_cell_view(dir / "v.vtu",
                  {{{0, 0, 0}, {1, 0, 0}}, {0, 1, 1}, {2, 3}, {3, 1}, {{"id", {7, 8}}}, {{"edge", {"TE"}}}});
  const std::string text = read_bytes(dir / "v.vtu");
  for (const char* part : {"NumberOfPoints=\"2\" NumberOfCells=\"2\"", "Name=\"id\"", "Name=\"edge:TE\"", "</VTKFile>"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace st
