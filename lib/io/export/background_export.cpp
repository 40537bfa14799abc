#include "io/export/background_export.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include "base/error.h"
#include "io/file/temporary_file.h"
#include "sizing/metric_in_space.h"
#include "sizing/octree_tets.h"
#include "sizing/refine.h"

namespace st {
namespace {

/// Text written in pieces under a temporary name.
class TextFile {
 public:
  explicit TextFile(const std::string& path)
      : path_(path), temporary_(path), file_(temporary_.name(), std::ios::binary) {}

  TextFile& operator<<(const char* text) {
    buffer_ += text;
    return *this;
  }
  TextFile& operator<<(double value) { return number(value); }
  TextFile& operator<<(float value) { return number(value); }
  TextFile& operator<<(std::int64_t value) { return number(value); }
  void commit() {
    flush();
    file_.close();
    if (!file_) throw Error(ExitCode::kOutput, path_ + ": cannot be written; check free space and permissions");
    temporary_.commit();
  }

 private:
  template <class T>
  TextFile& number(T value) {
    char text[40];
    buffer_.append(text, std::to_chars(text, text + sizeof text, value).ptr);
    if (buffer_.size() > (1u << 20)) flush();
    return *this;
  }
  void flush() {
    file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::string path_, buffer_;
  TemporaryFile temporary_;
  std::ofstream file_;
};

/// The three directions of a metric.
std::array<Vec3, 3> directions_of(const LocalSize& size) {
  if (size.direction == Vec3{}) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const Vec3 t = size.direction;
  const Vec3 aside = normalized(cross(t, std::abs(t.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  return {t, aside, cross(t, aside)};
}

/// By rows.
void write_metric(const SymmetricTensor& metric, TextFile& file) {
  const auto [xx, yy, zz, xy, yz, xz] = metric;
  const char* before = "";
  for (const double value : {xx, xy, xz, xy, yy, yz, xz, yz, zz}) {
    file << before << static_cast<float>(value);
    before = ",";
  }
}

}  // namespace

void export_bac(const OctreeField& field, const std::string& output) {
  const OctreeShape shape = refine_octree(field);
  const OctreeTets mesh = octree_tets(shape.view());
  const Similarity frame = field.frame();
  TextFile file(output);
  file << "* background mesh\n" << static_cast<std::int64_t>(mesh.node_xyz.size()) << " ";
  file << static_cast<std::int64_t>(mesh.tets.size()) << " 0 0 0\n";
  int hint = 0;
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i) {
    const Vec3 x = frame(mesh.node_xyz[i]);
    const LocalSize size = field.local(x, hint);
    file << static_cast<std::int64_t>(i + 1) << " " << x.x << " " << x.y << " " << x.z << "\n";
    for (const Vec3& d : directions_of(size))
      file << d.x << " " << d.y << " " << d.z << " " << static_cast<float>(size.in(d)) << "\n";
  }
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    file << static_cast<std::int64_t>(i + 1);
    for (const std::int32_t node : mesh.tets[i]) file << " " << static_cast<std::int64_t>(node + 1);
    file << "\n";
  }
  file << "* points\n* lines\n* triangles\n";
  file.commit();
}

void export_pos(const OctreeField& field, const std::string& output) {
  const OctreeShape shape = refine_octree(field);
  const OctreeView octree = shape.view();
  const Similarity frame = field.frame();
  TextFile file(output);
  file << "View \"size\" {\n";
  int hint = 0;
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf) {
    const Vec3 c = octree.leaf_center(leaf);
    const double half = 0.5 * octree.cell_edge(octree.leaf_levels[leaf]);
    constexpr double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    file << (field.is_stretched() ? "TH(" : "SH(");
    for (int k = 0; k < 8; ++k) {
      const double* d = corner[k];
      const Vec3 x = frame(c + half * Vec3{d[0], d[1], d[2]});
      file << (k ? "," : "") << x.x << "," << x.y << "," << x.z;
    }
    file << "){";
    constexpr double kInside = 1 - 1e-9;  // just inside, so that this leaf answers
    for (int k = 0; k < 8; ++k) {
      const double* d = corner[k];
      const Vec3 x = frame(c + kInside * half * Vec3{d[0], d[1], d[2]});
      file << (k ? "," : "");
      if (field.is_stretched())
        write_metric(metric_in_space(field, x, hint), file);
      else
        file << static_cast<float>(field.local(x, hint).length);
    }
    file << "};\n";
  }
  file << "};\n";
  file.commit();
}

}  // namespace st
