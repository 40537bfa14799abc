// PLY in its three encodings, and its damages.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "io/foreign/triangulation_file.h"
#include "io/foreign/triangulation_reader.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::string ply_header(const std::string& format, int n_polygons) {
  return "ply\r\nformat " + format + " 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n" +
         "property double z\nproperty uchar red\nelement camera 1\nproperty list uchar short view\n" + "element face " +
         std::to_string(n_polygons) + "\nproperty list uchar int vertex_indices\n" +
         "property float quality\nend_header\n";
}

template <class T>
void put_number(std::string& bytes, T value, bool is_big) {
  std::string own(reinterpret_cast<const char*>(&value), sizeof value);
  if (is_big) std::reverse(own.begin(), own.end());
  bytes += own;
}

/// A square as a triangle and a quadrilateral.
std::string binary_ply(bool is_big) {
  std::string s = ply_header(is_big ? "binary_big_endian" : "binary_little_endian", 2);
  const float xy[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& p : xy) {
    put_number(s, p[0], is_big), put_number(s, p[1], is_big), put_number(s, 2.0, is_big);
    put_number(s, std::uint8_t{255}, is_big);
  }
  put_number(s, std::uint8_t{1}, is_big), put_number(s, std::int16_t{7}, is_big);
  const auto polygon = [&](const std::vector<std::int32_t>& corners) {
    put_number(s, static_cast<std::uint8_t>(corners.size()), is_big);
    for (const std::int32_t n : corners) put_number(s, n, is_big);
    put_number(s, 0.5f, is_big);
  };
  polygon({0, 1, 2}), polygon({0, 1, 2, 3});
  return s;
}

const std::string kPlyText = "0 0 2 255\n1 0 2 255\n1 1 2 255\n0 1 2 255\n1 7\n3 0 1 2 0.5\n4 0 1 2 3 0.5\n";

TEST(PlyFile, EncodingsGiveTheSame) {
  const TriangulationFile text = parse_ply("a.ply", ply_header("ascii", 2) + kPlyText);
  ASSERT_EQ(text.node_xyz.size(), 4u);
  EXPECT_EQ(text.node_xyz[2], (Vec3{1, 1, 2}));
  ASSERT_EQ(text.triangles.size(), 3u);
  for (const bool is_big : {false, true}) {
    const TriangulationFile binary = parse_ply("a.ply", binary_ply(is_big));
    EXPECT_EQ(binary.node_xyz, text.node_xyz);
    EXPECT_EQ(binary.triangles, text.triangles);
  }
}

TEST(PlyFile, IsKnownByContent) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.dat";
  write_bytes(path, binary_ply(false));
  EXPECT_EQ(triangulation_format(path), "a PLY mesh");
  EXPECT_EQ(read_triangulation(path).triangles.size(), 3u);
}

TEST(PlyFile, DamageHasAMessage) {
  const auto parse = [](const std::string& bytes) { parse_ply("a.ply", bytes); };
  EXPECT_ERROR(parse("ply\nformat ascii 1.0\n"), kInput, "the header has no end_header");
  EXPECT_ERROR(parse("ply\nelement vertex 0\nend_header\n"), kInput, "names no format");
  EXPECT_ERROR(parse("ply\nformat base64 1.0\nend_header\n"), kInput, "unknown format 'base64'");
  EXPECT_ERROR(parse("ply\nformat ascii 1.0\nproperty int x\n"), kInput, "before the first element");
  EXPECT_ERROR(parse("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"), kInput, "unknown type of number");
  EXPECT_ERROR(parse("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n1\n"), kInput,
               "no x, y and z");
  EXPECT_ERROR(
      parse(ply_header("ascii", 2) + "0 0 2 255\n1 0 2 255\n1 1 2 255\n0 1 2 255\n1 7\n3 0 1 9 0.5\n4 0 1 2 3 0\n"),
      kInput, "names point 9 of 0 to 3; export");
  EXPECT_ERROR(parse(ply_header("ascii", 1) + kPlyText), kInput, "more in it than its header says");
  EXPECT_ERROR(parse(binary_ply(false) + "more"), kInput, "more in it than its header says");
  const std::string whole = binary_ply(false);
  for (const std::size_t cut : {1u, 5u, 20u, 40u})
    EXPECT_ERROR(parse(whole.substr(0, whole.size() - cut)), kInput, "cut off");
  std::string long_list = whole;
  long_list[whole.find("uchar int") + 1] = 'u';  // no type any more
  EXPECT_ERROR(parse(long_list), kInput, "unknown type of number");
  EXPECT_ERROR(parse("ply\nformat ascii 1.0\nelement face 1000000\nend_header\n"), kInput, "than there is room for");
  EXPECT_ERROR(parse(ply_header("ascii", 1000000000) + kPlyText), kInput, "more than there is room for");
}

}  // namespace
}  // namespace st
