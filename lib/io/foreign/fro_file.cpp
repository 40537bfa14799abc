// The FLITE family's .fro: counts, nodes, triangles, one a line.
#include "io/file/byte_cursor.h"
#include "io/foreign/triangulation_file.h"

namespace st {
namespace {

std::vector<std::int64_t> header_of(ByteCursor& in) {
  std::vector<std::int64_t> header;
  const std::string text(in.line());
  ByteCursor words(in.path(), text);
  while (!words.is_at_end()) header.push_back(words.integer());
  if (header.size() < 2) in.fail("a .fro file begins with the numbers of triangles and nodes");
  if (header.size() == 9) {  // quadrangles come first
    if (header[0] != 0) in.fail("has " + std::to_string(header[0]) + " quadrangles; write triangles only");
    header.erase(header.begin());
  }
  return header;
}

}  // namespace

TriangulationFile parse_fro(const std::string& path, const std::string& bytes) {
  ByteCursor in(path, bytes);
  in.is_at_end();
  const std::vector<std::int64_t> header = header_of(in);
  TriangulationFile result;
  const std::size_t n_triangles = in.count(header[0], 8, "triangles"), n_nodes = in.count(header[1], 8, "nodes");
  for (std::size_t i = 0; i < n_nodes; ++i) {
    if (in.integer() != static_cast<std::int64_t>(i) + 1) in.fail("the nodes are not numbered 1, 2, 3 ...");
    const double x = in.real(), y = in.real(), z = in.real();
    result.node_xyz.push_back({x, y, z});
    in.line();  // some writers add numbers
  }
  for (std::size_t i = 0; i < n_triangles; ++i) {
    if (in.integer() != static_cast<std::int64_t>(i) + 1) in.fail("the triangles are not numbered 1, 2, 3 ...");
    const std::int64_t a = in.integer(), b = in.integer(), c = in.integer();
    result.triangles.push_back({a - 1, b - 1, c - 1});
    result.surface.push_back(in.integer());
    in.line();
  }
  return result;
}

}  // namespace st
