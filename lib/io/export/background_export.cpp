#include "io/export/background_export.h"

#include <charconv>
#include <fstream>

#include "base/error.h"
#include "io/file/temporary_file.h"
#include "sizing/octree_tets.h"

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

}  // namespace

void export_bac(const OctreeField& field, const std::string& output) {
  const OctreeTets mesh = octree_tets(field.data().octree);
  const Similarity frame = field.frame();
  TextFile file(output);
  file << "* background mesh\n" << static_cast<std::int64_t>(mesh.node_xyz.size()) << " ";
  file << static_cast<std::int64_t>(mesh.tets.size()) << " 0 0 0\n";
  int hint = 0;
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i) {
    const Vec3 x = frame(mesh.node_xyz[i]);
    const auto h = static_cast<float>(field.size(x, hint));
    file << static_cast<std::int64_t>(i + 1) << " " << x.x << " " << x.y << " " << x.z << "\n1 0 0 " << h << "\n0 1 0 "
         << h << "\n0 0 1 " << h << "\n";
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
  const OctreeView& octree = field.data().octree;
  const Similarity frame = field.frame();
  TextFile file(output);
  file << "View \"size\" {\n";
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf) {
    const Vec3 c = octree.leaf_center(leaf);
    const double half = 0.5 * octree.cell_edge(octree.leaf_levels[leaf]);
    constexpr double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    file << "SH(";
    for (int k = 0; k < 8; ++k) {
      const double* d = corner[k];
      const Vec3 x = frame(c + half * Vec3{d[0], d[1], d[2]});
      file << (k ? "," : "") << x.x << "," << x.y << "," << x.z;
    }
    file << "){";
    constexpr double kInside = 1 - 1e-9;  // just inside, so that this leaf answers
    for (int k = 0; k < 8; ++k) {
      const double* d = corner[k];
      int hint = leaf;
      file << (k ? "," : "")
           << static_cast<float>(field.size(frame(c + kInside * half * Vec3{d[0], d[1], d[2]}), hint));
    }
    file << "};\n";
  }
  file << "};\n";
  file.commit();
}

}  // namespace st
