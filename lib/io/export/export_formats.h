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
#include "io/file/temporary_file.h"
#include "mesh/quad_pairs.h"
#include "mesh/surface_mesh.h"

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

Vec3 triangle_normal(const SurfaceMesh& mesh, const Triangle& triangle);

/// The name with control characters, and blanks when `is_word`, made '_', double quotes made single ones.
std::string clean_name(std::string name, bool is_word);

void export_stl(Output& out, const SurfaceMesh& mesh);
void export_ascii_stl(Output& out, const SurfaceMesh& mesh);
void export_obj(Output& out, const SurfaceMesh& mesh);
void export_ply(Output& out, const SurfaceMesh& mesh);
void export_fro(Output& out, const SurfaceMesh& mesh);
void export_mapbc(Output& out, const SurfaceMesh& mesh);
void export_nastran(Output& out, const SurfaceMesh& mesh);
void export_off(Output& out, const SurfaceMesh& mesh);
void export_smesh(Output& out, const SurfaceMesh& mesh);
void export_poly(Output& out, const SurfaceMesh& mesh);

// With quadrilaterals.
void export_vtu(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);
void export_msh(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);
void export_ugrid(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);
void export_lb8_ugrid(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);
void export_b8_ugrid(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);
void export_su2(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);
void export_medit(Output& out, const SurfaceMesh& mesh, const QuadPairs& elements);

}  // namespace st
