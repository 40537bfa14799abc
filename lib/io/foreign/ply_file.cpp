// PLY of scanners and 3-D programs, ascii or binary: points and polygons.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/limits.h"
#include "io/file/byte_cursor.h"
#include "io/foreign/polygon_split.h"
#include "io/foreign/triangulation_file.h"

namespace st {
namespace {

enum class Encoding { kText, kLittle, kBig };
enum class Number { kNone, kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Number type = Number::kNone, count = Number::kNone;  ///< `count` of lists alone
};

struct Element {
  std::string name;
  std::int64_t n = 0;
  std::vector<Property> properties;
};

struct Name {
  std::string_view word;
  Number type;
};

constexpr Name kNumbers[] = {
    {"char", Number::kInt8},   {"int8", Number::kInt8},     {"uchar", Number::kUint8},   {"uint8", Number::kUint8},
    {"short", Number::kInt16}, {"int16", Number::kInt16},   {"ushort", Number::kUint16}, {"uint16", Number::kUint16},
    {"int", Number::kInt32},   {"int32", Number::kInt32},   {"uint", Number::kUint32},   {"uint32", Number::kUint32},
    {"float", Number::kFloat}, {"float32", Number::kFloat}, {"double", Number::kDouble}, {"float64", Number::kDouble}};

class PlyReader {
 public:
  PlyReader(const std::string& path, const std::string& bytes) : in_(path, bytes) {}

  TriangulationFile read() {
    read_header();
    in_.is_binary = encoding_ != Encoding::kText;
    in_.is_swapped = encoding_ == (std::endian::native == std::endian::little ? Encoding::kBig : Encoding::kLittle);
    for (const Element& e : elements_) {
      const std::size_t least = std::max<std::size_t>(e.properties.size(), 1);  // bytes
      in_.count(e.n, encoding_ == Encoding::kText ? 2 * least : least, e.name.c_str());
      for (std::int64_t i = 0; i < e.n; ++i) {
        if (e.name == "vertex")
          read_vertex(e);
        else
          read_polygon(e);
      }
    }
    if (!in_.is_at_end()) in_.fail("has more in it than its header says; export the mesh again");
    return std::move(file_);
  }

 private:
  void read_header() {
    in_.line();
    bool has_format = false;
    for (;;) {
      if (in_.position() >= in_.bytes().size())
        in_.fail("cut off: the header has no end_header; export the mesh again");
      const std::string_view line = in_.line();
      ByteCursor words(in_.path(), line);
      const std::string_view word = words.word();
      if (word == "end_header") break;
      if (word == "format") {
        encoding_ = encoding_of(words.word());
        has_format = true;
      } else if (word == "element") {
        elements_.push_back({std::string(words.word()), words.integer(), {}});
      } else if (word == "property") {
        if (elements_.empty()) in_.fail("a property stands before the first element");
        elements_.back().properties.push_back(property(words));
      }
    }
    if (!has_format) in_.fail("the header names no format");
  }

  Encoding encoding_of(std::string_view word) {
    if (word == "ascii") return Encoding::kText;
    if (word == "binary_little_endian") return Encoding::kLittle;
    if (word != "binary_big_endian") in_.fail("unknown format " + ByteCursor::quoted(word));
    return Encoding::kBig;
  }

  Property property(ByteCursor& words) {
    Property p;
    std::string_view word = words.word();
    if (word == "list") {
      p.count = number_type(words.word());
      word = words.word();
    }
    p.type = number_type(word);
    p.name = std::string(words.word());
    return p;
  }

  Number number_type(std::string_view word) {
    for (const Name& name : kNumbers)
      if (name.word == word) return name.type;
    in_.fail("unknown type of number " + ByteCursor::quoted(word));
  }

  double number(Number type) {
    if (encoding_ == Encoding::kText) return in_.real();
    switch (type) {
      case Number::kInt8:
        return in_.value<std::int8_t>();
      case Number::kUint8:
        return in_.value<std::uint8_t>();
      case Number::kInt16:
        return in_.value<std::int16_t>();
      case Number::kUint16:
        return in_.value<std::uint16_t>();
      case Number::kInt32:
        return in_.value<std::int32_t>();
      case Number::kUint32:
        return in_.value<std::uint32_t>();
      case Number::kFloat:
        return in_.value<float>();
      default:
        return in_.value<double>();
    }
  }

  /// The numbers of a list; of a property that is none, one.
  const std::vector<double>& values(const Property& p) {
    values_.clear();
    double n = 1;
    if (p.count != Number::kNone) n = number(p.count);
    if (!(n >= 0 && n <= static_cast<double>(in_.bytes().size())))
      in_.fail("a list has no valid length; export the mesh again");
    for (double i = 0; i < n; ++i) values_.push_back(number(p.type));
    return values_;
  }

  void read_vertex(const Element& e) {
    Vec3 x;
    int found = 0;
    for (const Property& p : e.properties) {
      const std::vector<double>& value = values(p);
      if (p.count != Number::kNone || p.name.size() != 1) continue;
      if (p.name == "x") x.x = value[0], ++found;
      if (p.name == "y") x.y = value[0], ++found;
      if (p.name == "z") x.z = value[0], ++found;
    }
    if (found != 3) in_.fail("the points have no x, y and z; export the mesh again");
    file_.node_xyz.push_back(x);
  }

  /// Of an element "face"; others are passed over, but for strips of triangles.
  void read_polygon(const Element& e) {
    for (const Property& p : e.properties) {
      const std::vector<double>& value = values(p);
      if (e.name == "tristrips") in_.fail("has strips of triangles; export it as triangles");
      if (e.name != "face" || p.count == Number::kNone || !p.name.starts_with("vertex_ind")) continue;
      polygon_.clear();
      for (const double v : value) {
        if (!(v >= 0 && v < static_cast<double>(file_.node_xyz.size())))
          in_.fail(fmt::format("a polygon names point {} of 0 to {}; export the mesh again", v,
                               static_cast<std::int64_t>(file_.node_xyz.size()) - 1));
        polygon_.push_back(static_cast<std::int64_t>(v));
      }
      split_polygon(file_.node_xyz, polygon_, file_.triangles);
      if (file_.triangles.size() > kMaxTriangles) in_.fail("has more triangles than can be handled");
    }
  }

  ByteCursor in_;
  Encoding encoding_ = Encoding::kText;
  std::vector<Element> elements_;
  TriangulationFile file_;
  std::vector<double> values_;
  std::vector<std::int64_t> polygon_;
};

}  // namespace

bool is_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

TriangulationFile parse_ply(const std::string& path, const std::string& bytes) { return PlyReader(path, bytes).read(); }

}  // namespace st
