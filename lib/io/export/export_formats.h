// What the exports of meshes share, and one function per format.
#pragma once

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/export/export.h"
#include "io/file/temporary_file.h"

namespace st {

/// A buffered file that appears only when it is complete. All functions throw Error(kOutput).
class Output {
 public:
  explicit Output(const std::string& path) : temporary_(path), file_(std::fopen(temporary_.name().c_str(), "wb")) {
    if (!file_) fail();
  }
  ~Output() {
    if (file_) std::fclose(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void text(std::string_view text) { bytes(text.data(), text.size()); }
  void bytes(const void* data, std::size_t n) {
    if (n && std::fwrite(data, 1, n, file_) != n) fail();
  }
  template <class T>
  void value(const T& v) {
    bytes(&v, sizeof v);
  }
  template <class T>
  void values(const std::vector<T>& v) {
    bytes(v.data(), v.size() * sizeof(T));
  }
  void commit() {
    const int status = std::fclose(std::exchange(file_, nullptr));
    if (status != 0) fail();
    temporary_.commit();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ExitCode::kOutput, temporary_.path() + ": cannot be written (" + std::strerror(errno) +
                                       "); free some space or choose another directory");
  }
  TemporaryFile temporary_;
  std::FILE* file_ = nullptr;
};

/// Shortest text that reads back as the same number.
inline std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Text in pieces of some 60 kB.
class TextBuffer {
 public:
  explicit TextBuffer(Output& out) : out_(out) {}
  TextBuffer& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() > 60000) flush();
    return *this;
  }
  TextBuffer& operator<<(double value) { return *this << std::string_view(number(value)); }
  TextBuffer& operator<<(std::int64_t value) { return *this << std::string_view(std::to_string(value)); }
  /// To be called at the end.
  void flush() {
    out_.text(text_);
    text_.clear();
  }

 private:
  Output& out_;
  std::string text_;
};

/// The name with control characters, and blanks when `is_word`, made '_', double quotes made single ones.
std::string clean_name(std::string name, bool is_word);

/// Group of each triangle as a number from 1.
inline std::int64_t group_number(const SurfaceMesh& mesh, std::size_t triangle) {
  return std::int64_t{mesh.triangle_group[triangle]} + 1;
}

/// What a format's function gets: the mesh as elements, and the options.
struct ExportTask {
  const SurfaceMesh& mesh;
  const QuadPairs& elements;
  const MidNodes& mid_nodes;
  const ExportOptions& options;
  std::span<const TriangleValues> values;
  std::span<const NodeValues> node_values;  ///< of the nodes without those on sides
  std::string stem;                         ///< name of the file without folder and suffix

  std::int64_t n_nodes() const { return mesh.n_nodes() + mid_nodes.size(); }
  std::int64_t n_triangles() const { return static_cast<std::int64_t>(elements.triangles.size()); }
  std::int64_t n_quads() const { return static_cast<std::int64_t>(elements.quads.size()); }
  std::int64_t n_elements() const { return n_triangles() + n_quads(); }
  /// The triangle that element `i` is, or the lower of the two that it is made of.
  TriangleId triangle_of(std::int64_t i) const {
    return i < n_triangles() ? elements.triangles[i] : elements.quads[i - n_triangles()].triangle;
  }
  std::size_t group_of(std::int64_t i) const { return static_cast<std::size_t>(mesh.triangle_group[triangle_of(i)]); }
  Vec3 xyz(std::int64_t node) const {
    return node < mesh.n_nodes() ? mesh.node_xyz[node] : mid_nodes.xyz[node - mesh.n_nodes()];
  }
  /// Corners of element `i`, then the nodes on its sides from the first on, where there are such. From 0.
  std::vector<std::int64_t> nodes_of(std::int64_t i) const;
};

/// Elements of each group, in their order.
std::vector<std::vector<std::int64_t>> elements_by_group(const ExportTask& task);

void export_stl(Output& out, const ExportTask& task);
void export_ascii_stl(Output& out, const ExportTask& task);
void export_obj(Output& out, const ExportTask& task);
void export_ply(Output& out, const ExportTask& task);
void export_binary_ply(Output& out, const ExportTask& task);
void export_fro(Output& out, const ExportTask& task);
void export_mapbc(Output& out, const ExportTask& task);
void export_nastran(Output& out, const ExportTask& task);
void export_off(Output& out, const ExportTask& task);
void export_smesh(Output& out, const ExportTask& task);
void export_poly(Output& out, const ExportTask& task);
void export_vtu(Output& out, const ExportTask& task);
void export_msh(Output& out, const ExportTask& task);
void export_geo(Output& out, const ExportTask& task);
void export_binary_msh(Output& out, const ExportTask& task);
void export_msh2(Output& out, const ExportTask& task);
void export_binary_msh2(Output& out, const ExportTask& task);
void export_ugrid(Output& out, const ExportTask& task);
void export_lb8_ugrid(Output& out, const ExportTask& task);
void export_b8_ugrid(Output& out, const ExportTask& task);
void export_su2(Output& out, const ExportTask& task);
void export_medit(Output& out, const ExportTask& task);
void export_binary_medit(Output& out, const ExportTask& task);
void export_cgns(Output& out, const ExportTask& task);
void export_csv(Output& out, const ExportTask& task);
void export_emesh(Output& out, const ExportTask& task);

}  // namespace st
