// INRIA's Medit, as text (.mesh, .sol) and in the binary form of libMeshb (.meshb, .solb), versions 1 to 4.
#include <map>
#include <string_view>

#include "base/error.h"
#include "io/file/byte_cursor.h"
#include "io/foreign/cell_file.h"

namespace st {
namespace {

/// Keywords by their number in the binary form.
enum Keyword : std::int32_t {
  kDimension = 3,
  kVertices = 4,
  kTriangles = 6,
  kQuadrilaterals = 7,
  kTetrahedra = 8,
  kPrisms = 9,
  kHexahedra = 10,
  kPyramids = 49,
  kEnd = 54,
  kSolAtVertices = 62,
  kSolAtTriangles = 64,
  kSolAtQuadrilaterals = 65,
  kSolAtTetrahedra = 66,
  kSolAtPrisms = 67,
  kSolAtHexahedra = 68,
};
const std::map<std::string_view, Keyword>& keywords() {
  static const std::map<std::string_view, Keyword> all{{"Dimension", kDimension},
                                                       {"Vertices", kVertices},
                                                       {"Triangles", kTriangles},
                                                       {"Quadrilaterals", kQuadrilaterals},
                                                       {"Tetrahedra", kTetrahedra},
                                                       {"Prisms", kPrisms},
                                                       {"Hexahedra", kHexahedra},
                                                       {"Pyramids", kPyramids},
                                                       {"End", kEnd},
                                                       {"SolAtVertices", kSolAtVertices},
                                                       {"SolAtTriangles", kSolAtTriangles},
                                                       {"SolAtQuadrilaterals", kSolAtQuadrilaterals},
                                                       {"SolAtTetrahedra", kSolAtTetrahedra},
                                                       {"SolAtPrisms", kSolAtPrisms},
                                                       {"SolAtPentahedra", kSolAtPrisms},
                                                       {"SolAtHexahedra", kSolAtHexahedra}};
  return all;
}

bool has_values(Keyword keyword) { return keyword >= kSolAtVertices; }

/// VTK's type, of a keyword that lists cells or values at cells; 0: it lists none.
std::int64_t type_of(Keyword keyword) {
  switch (keyword) {
    case kTriangles:
    case kSolAtTriangles:
      return 5;
    case kQuadrilaterals:
    case kSolAtQuadrilaterals:
      return 9;
    case kTetrahedra:
    case kSolAtTetrahedra:
      return 10;
    case kHexahedra:
    case kSolAtHexahedra:
      return 12;
    case kPrisms:
    case kSolAtPrisms:
      return 13;
    case kPyramids:
      return 14;
    default:
      return 0;
  }
}

/// The numbers of a file, one after the other, whatever its form.
class MeditReader {
 public:
  MeditReader(const std::string& path, std::string_view bytes) : in_(path, bytes) {
    constexpr std::int32_t kNative = 1, kSwapped = 16777216;
    if (bytes.empty()) in_.fail("empty file; write it again");
    std::int32_t first = 0;
    if (bytes.size() >= sizeof first) std::memcpy(&first, bytes.data(), sizeof first);
    in_.is_binary = first == kNative || first == kSwapped;
    in_.is_swapped = first == kSwapped;
    if (in_.is_binary) {
      in_.value<std::int32_t>();
      version_ = in_.value<std::int32_t>();
      if (version_ < 1 || version_ > 4) in_.fail("version " + std::to_string(version_) + " is not read, 1 to 4 are");
    } else if (word() != "MeshVersionFormatted") {
      in_.fail("no file of Medit: it does not begin with MeshVersionFormatted");
    } else {
      word();
    }
  }

  [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }
  std::size_t count(std::int64_t n, std::size_t n_numbers, const char* what) {
    return in_.count(n, in_.is_binary ? 4 * n_numbers : 2 * n_numbers, what);  // bytes that they take at least
  }

  /// The next keyword that is known; kEnd at the end. Its numbers come next; those that are not read are passed over.
  Keyword next() { return in_.is_binary ? next_binary() : next_text(); }

  std::int64_t integer() {
    if (!in_.is_binary) {
      skip_comments();
      return in_.integer();
    }
    return version_ >= 4 ? in_.value<std::int64_t>() : in_.value<std::int32_t>();
  }
  /// Of the numbers that are small in every version.
  std::int64_t small_integer() { return in_.is_binary ? in_.value<std::int32_t>() : integer(); }
  double real() {
    if (!in_.is_binary) {
      skip_comments();
      return in_.real();
    }
    return version_ == 1 ? in_.value<float>() : in_.value<double>();
  }

 private:
  void skip_comments() {
    while (!in_.is_at_end() && in_.bytes()[in_.position()] == '#') in_.line();
  }
  std::string_view word() {
    skip_comments();
    return in_.word();
  }
  Keyword next_text() {
    for (;;) {
      const std::string_view text = word();
      if (text.empty()) return kEnd;
      if (const auto known = keywords().find(text); known != keywords().end()) return known->second;
    }
  }
  Keyword next_binary() {
    for (;;) {
      if (next_ > 0) in_.seek(next_);
      const std::size_t at = in_.position();
      const auto code = in_.value<std::int32_t>();
      const std::int64_t next = version_ >= 3 ? in_.value<std::int64_t>() : in_.value<std::int32_t>();
      if (code == kEnd) return kEnd;
      if (next != 0 && (next <= static_cast<std::int64_t>(at) || next > static_cast<std::int64_t>(in_.bytes().size())))
        in_.fail("damaged: a section ends at byte " + std::to_string(next) + "; write it again");
      next_ = static_cast<std::size_t>(next);
      for (const auto& [name, keyword] : keywords())
        if (keyword == code) return keyword;
      if (next == 0) return kEnd;
    }
  }

  ByteCursor in_;
  std::int32_t version_ = 2;
  std::size_t next_ = 0;  ///< where the next section of a binary file begins; 0: behind this one
};

void require_space(MeditReader& in) {
  if (const std::int64_t dimension = in.small_integer(); dimension != 3)
    in.fail("has " + std::to_string(dimension) + " dimensions; three are expected");
}

void read_vertices(MeditReader& in, CellFile& file) {
  const std::size_t n = in.count(in.integer(), 4, "vertices");
  file.node_xyz.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = in.real(), y = in.real(), z = in.real();
    in.integer();  // reference
    file.node_xyz.push_back({x, y, z});
  }
}

void read_cells(MeditReader& in, std::int64_t type, CellFile& file) {
  const int n_corners = n_corners_of(type);
  const std::size_t n = in.count(in.integer(), static_cast<std::size_t>(n_corners) + 1, "cells");
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < n_corners; ++k) file.node.push_back(in.integer() - 1);
    file.group.push_back(static_cast<std::int32_t>(in.integer()));
    file.type.push_back(type);
    file.offset.push_back(static_cast<std::int64_t>(file.node.size()));
  }
}

/// The values of a section that are wanted of each node or cell.
struct Wanted {
  std::size_t first = 0, n = 0, n_all = 0;
};

/// `number`: of the field, from 1; 0: the first that is no vector.
Wanted choose_values(MeditReader& in, std::int64_t number) {
  constexpr std::int64_t kScalar = 1, kVector = 2, kSymmetric = 3, kMatrix = 4;
  Wanted wanted;
  const std::int64_t n_types = in.small_integer();
  if (n_types < 1 || n_types > 1000) in.fail("a solution of " + std::to_string(n_types) + " fields");
  if (number > n_types)
    in.fail("has " + std::to_string(n_types) + " fields; there is no number " + std::to_string(number));
  for (std::int64_t k = 1; k <= n_types; ++k) {
    const std::int64_t type = in.small_integer();
    if (type < kScalar || type > kMatrix) in.fail("a field of type " + std::to_string(type) + ", 1 to 4 are known");
    const std::size_t n = type == kScalar ? 1 : type == kVector ? 3 : type == kSymmetric ? 6 : 9;
    if (k == number && type == kVector)
      in.fail("field " + std::to_string(number) + " is a vector; a number or a metric is expected");
    if (number == 0 ? wanted.n == 0 && type != kVector : k == number) wanted.first = wanted.n_all, wanted.n = n;
    wanted.n_all += n;
  }
  if (wanted.n == 0) in.fail("has vectors alone; a length or a metric for each node is expected");
  return wanted;
}

std::vector<double> read_values(MeditReader& in, std::int64_t number, std::size_t expected, const char* of) {
  const std::int64_t n = in.integer();
  if (n < 0 || static_cast<std::size_t>(n) != expected)
    in.fail("has values for " + std::to_string(n) + " " + of + ", the mesh " + std::to_string(expected));
  const Wanted wanted = choose_values(in, number);
  in.count(n, wanted.n_all, "values");
  std::vector<double> values(expected * wanted.n);
  for (std::size_t i = 0; i < expected; ++i) {
    double* const v = values.data() + i * wanted.n;
    for (std::size_t k = 0; k < wanted.n_all; ++k)
      if (const double x = in.real(); k >= wanted.first && k < wanted.first + wanted.n) v[k - wanted.first] = x;
    // Medit's triangle is xx, xy, yy, xz, yz, zz
    if (wanted.n == 6) {
      const double xx = v[0], xy = v[1], yy = v[2], xz = v[3], yz = v[4], zz = v[5];
      v[0] = xx, v[1] = yy, v[2] = zz, v[3] = xy, v[4] = yz, v[5] = xz;
    }
  }
  return values;
}

/// Keeps the cells that are meshed: of volumes, or of surfaces where there are none.
void drop_borders(CellFile& file) {
  if (std::none_of(file.type.begin(), file.type.end(), is_volume)) return;
  CellFile kept;
  kept.offset.push_back(0);
  for (std::size_t c = 0; c < file.type.size(); ++c) {
    if (!is_volume(file.type[c])) continue;
    kept.type.push_back(file.type[c]);
    kept.group.push_back(file.group[c]);
    kept.node.insert(kept.node.end(), file.node.begin() + file.offset[c], file.node.begin() + file.offset[c + 1]);
    kept.offset.push_back(static_cast<std::int64_t>(kept.node.size()));
  }
  file.type = std::move(kept.type), file.offset = std::move(kept.offset), file.node = std::move(kept.node);
  file.group = std::move(kept.group);
}

/// `of_type`: values of all cells of a type, in their order in the mesh.
void place_cell_values(MeditReader& in, const std::map<std::int64_t, std::vector<double>>& of_type, CellFile& file) {
  drop_borders(file);
  std::map<std::int64_t, std::size_t> n_cells, next;
  for (const std::int64_t type : file.type) ++n_cells[type];
  std::size_t n_components = 0;
  for (const auto& [type, n] : n_cells) {
    const auto values = of_type.find(type);
    if (values == of_type.end())
      in.fail("has values neither at vertices nor at the " + std::to_string(n) + " cells of VTK's type " +
              std::to_string(type));
    if (n_components > 0 && values->second.size() != n * n_components) in.fail("has other fields for other cells");
    n_components = values->second.size() / n;
  }
  for (const std::int64_t type : file.type) {
    const auto value = of_type.at(type).begin() + static_cast<std::ptrdiff_t>(n_components * next[type]++);
    file.cell_value.insert(file.cell_value.end(), value, value + static_cast<std::ptrdiff_t>(n_components));
  }
}

}  // namespace

CellFile parse_medit_mesh(const std::string& path, std::string_view bytes) {
  MeditReader in(path, bytes);
  CellFile file;
  file.offset.push_back(0);
  for (Keyword keyword = in.next(); keyword != kEnd; keyword = in.next()) {
    if (keyword == kDimension) require_space(in);
    if (keyword == kVertices) read_vertices(in, file);
    if (const std::int64_t type = type_of(keyword); type > 0 && !has_values(keyword)) read_cells(in, type, file);
  }
  return file;
}

void parse_medit_solution(const std::string& path, std::string_view bytes, std::int64_t number, CellFile& file) {
  MeditReader in(path, bytes);
  std::map<std::int64_t, std::vector<double>> of_type;
  for (Keyword keyword = in.next(); keyword != kEnd; keyword = in.next()) {
    if (keyword == kDimension) require_space(in);
    if (keyword == kSolAtVertices) {
      file.value = read_values(in, number, file.node_xyz.size(), "nodes");
      return;
    }
    if (const std::int64_t type = type_of(keyword); type > 0 && has_values(keyword))
      of_type[type] = read_values(
          in, number, static_cast<std::size_t>(std::count(file.type.begin(), file.type.end(), type)), "cells");
  }
  if (of_type.empty()) in.fail("has neither SolAtVertices nor values at cells, such as SolAtTetrahedra");
  place_cell_values(in, of_type, file);
}

}  // namespace st
