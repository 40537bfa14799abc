// INRIA's Medit files, as text and in the binary form of libMeshb: lists of integers and reals.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "io/export/export_formats.h"

namespace st {

/// Keywords with their numbers in the binary form.
struct MeditKeyword {
  const char* name;
  std::int32_t code;
};
inline constexpr MeditKeyword kMeditVertices{"Vertices", 4}, kMeditTriangles{"Triangles", 6},
    kMeditTetrahedra{"Tetrahedra", 8}, kMeditSolution{"SolAtVertices", 62};

/// Integers, then reals: an entry of a list.
struct MeditEntry {
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
};

/// A list of entries that are made one by one. `n_integers`, `n_reals`: of each.
struct MeditList {
  MeditKeyword keyword;
  std::int64_t n = 0, n_integers = 0, n_reals = 0;
  std::int32_t solution_type = 0;  ///< of a solution of one field: 1 scalars, 3 symmetric tensors; 0: no solution
};

class MeditWriter {
 public:
  MeditWriter(Output& out, bool is_binary) : out_(out), text_(out), is_binary_(is_binary) {
    constexpr std::int32_t kByteOrder = 1, kVersion = 3, kDimension = 3, kSpace = 3;  // version 3: 64-bit positions
    if (is_binary_) {
      integers({kByteOrder, kVersion, kDimension});
      position(at_ + 12);
      integers({kSpace});
    } else {
      text_ << "MeshVersionFormatted 2\nDimension\n3\n";
    }
  }
  void comment(const std::string& text) {
    if (!is_binary_) text_ << "# " << text << "\n";
  }
  void begin(const MeditList& list) {
    const std::int64_t head = list.solution_type ? 24 : 16;  // keyword, position of the next one, count, types
    if (is_binary_) {
      integers({list.keyword.code});
      position(at_ - 4 + head + list.n * (4 * list.n_integers + 8 * list.n_reals));
      integers({static_cast<std::int32_t>(list.n)});
      if (list.solution_type) integers({1, list.solution_type});
    } else {
      text_ << list.keyword.name << "\n" << list.n << "\n";
      if (list.solution_type) text_ << "1 " << std::int64_t{list.solution_type} << "\n";
    }
  }
  /// Vertices have their reals first.
  void entry(const MeditEntry& e, bool has_reals_first = false) {
    if (has_reals_first) reals(e.reals, e.integers.empty());
    for (std::size_t i = 0; i < e.integers.size(); ++i) {
      if (is_binary_)
        integers({static_cast<std::int32_t>(e.integers[i])});
      else
        text_ << e.integers[i] << (i + 1 < e.integers.size() || (!has_reals_first && !e.reals.empty()) ? " " : "\n");
    }
    if (!has_reals_first) reals(e.reals, true);
  }
  void end() {
    constexpr std::int32_t kEnd = 54;
    if (is_binary_) {
      integers({kEnd});
      position(0);
    } else {
      text_ << "End\n";
      text_.flush();
    }
  }

 private:
  void integers(std::initializer_list<std::int32_t> values) {
    for (const std::int32_t v : values) out_.value(v);
    at_ += static_cast<std::int64_t>(4 * values.size());
  }
  void position(std::int64_t value) {
    out_.value(value);
    at_ += 8;
  }
  void reals(const std::vector<double>& values, bool is_last) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (is_binary_)
        out_.value(values[i]);
      else
        text_ << values[i] << (is_last && i + 1 == values.size() ? "\n" : " ");
    }
    if (is_binary_) at_ += static_cast<std::int64_t>(8 * values.size());
  }

  Output& out_;
  TextBuffer text_;
  bool is_binary_;
  std::int64_t at_ = 0;  ///< bytes written
};

}  // namespace st
