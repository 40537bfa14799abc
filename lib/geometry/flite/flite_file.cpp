#include "geometry/flite/flite_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include "base/error.h"

namespace st {
namespace {

constexpr int kMaxGridSide = 1 << 20;    // nobody's grid: a damaged count
constexpr double kMaxCoordinate = 1e30;  // nobody's coordinate: a damaged number

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlanks = " \t\r,";
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::optional<int> integer_of(std::string_view word) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  int value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

/// As Fortran writes it: 1.5, 1.5E+00, 1.5D+00, and 1.5+100 where the exponent has three digits.
std::optional<double> real_of(std::string_view word) {
  std::string text(word.substr(!word.empty() && word[0] == '+' ? 1 : 0));
  for (char& c : text)
    if (c == 'D' || c == 'd') c = 'e';
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && text.find_first_of("eE") == std::string::npos) text.insert(sign, 1, 'e');
  const std::size_t exponent = text.find_first_of("eE");
  if (exponent != std::string::npos && exponent + 1 < text.size() && text[exponent + 1] == '+')
    text.erase(exponent + 1, 1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code == std::errc::result_out_of_range && end == text.data() + text.size())
    return text.find("e-") != std::string::npos ? std::optional(0.0) : std::nullopt;
  if (code != std::errc() || end != text.data() + text.size() || !(std::fabs(value) <= kMaxCoordinate)) return {};
  return value;
}

/// The lines of a file, read one after the other. Messages name the file, the line, and what is being read.
class LineReader {
 public:
  LineReader(const std::string& path, const std::string& text) : path_(path) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      lines_.push_back(std::string_view(text).substr(at, end - at));
      at = end + 1;
    }
    while (!lines_.empty() && words_of(lines_.back()).empty()) lines_.pop_back();
  }

  int line() const { return next_; }  ///< of the last one read, from 1
  std::size_t n_left() const { return lines_.size() - next_; }
  void set_context(std::string what) { context_ = std::move(what); }

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ExitCode::kInput, fmt::format("{}: line {}: {}{}; write the file again", path_, next_,
                                              context_.empty() ? "" : context_ + ": ", why));
  }

  std::string_view next() {
    if (n_left() == 0) fail("the file ends here: it is cut off");
    return lines_[next_++];
  }
  void label() { next(); }

  /// The first `n` numbers of the next line; more may follow.
  std::vector<int> integers(std::size_t n, const char* what) {
    const auto words = words_of(next());
    std::vector<int> values;
    for (std::size_t i = 0; i < n; ++i) {
      const auto value = i < words.size() ? integer_of(words[i]) : std::nullopt;
      if (!value) fail(fmt::format("'{}' where {} should be", shown(), what));
      values.push_back(*value);
    }
    return values;
  }

  Vec3 point() {
    const auto words = words_of(next());
    double x[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = i < words.size() ? real_of(words[i]) : std::nullopt;
      if (!value) fail(fmt::format("'{}' where the coordinates x y z should be", shown()));
      x[i] = *value;
    }
    return {x[0], x[1], x[2]};
  }

  /// `n` numbers, on as many lines as they take.
  std::vector<int> wrapped_integers(std::size_t n, const char* what) {
    std::vector<int> values;
    while (values.size() < n)
      for (const std::string_view word : words_of(next())) {
        const auto value = integer_of(word);
        if (!value || values.size() == n) fail(fmt::format("'{}' where {} {} should be", shown(), n, what));
        values.push_back(*value);
      }
    return values;
  }

  std::vector<Vec3> points(std::size_t n) {
    if (n > n_left()) fail(fmt::format("{} points announced, {} lines left: the file is cut off", n, n_left()));
    std::vector<Vec3> result(n);
    for (Vec3& p : result) p = point();
    return result;
  }

  void require(bool is_right, const std::string& why) const {
    if (!is_right) fail(why);
  }

 private:
  /// The last line, shortened and without bytes that a terminal would not show.
  std::string shown() const {
    std::string text(lines_[next_ - 1].substr(0, 60));
    for (char& c : text)
      if (c < ' ' || c > '~') c = c == '\t' || c == '\r' ? ' ' : '?';
    return text.substr(std::min(text.find_first_not_of(' '), text.size()));
  }

  std::string path_, context_;
  std::vector<std::string_view> lines_;
  std::size_t next_ = 0;
};

/// Index of each number in the file; refuses a number that comes twice.
class Numbers {
 public:
  void add(int id, const LineReader& in) {
    in.require(index_.emplace(id, static_cast<int>(index_.size())).second,
               fmt::format("the number {} comes twice", id));
  }
  int find(int id, const char* what, const LineReader& in) const {
    const auto it = index_.find(id);
    in.require(it != index_.end(), fmt::format("there is no {} {}", what, id));
    return it->second;
  }

 private:
  std::map<int, int> index_;
};

/// Two counts, each of them possible in what is left of the file.
std::vector<int> counts(LineReader& in, const char* what) {
  in.set_context("");
  const std::vector<int> n = in.integers(2, what);
  for (const int count : n) {
    in.require(count > 0, fmt::format("{} {} should be positive", count, what));
    in.require(static_cast<std::size_t>(count) <= in.n_left(),
               fmt::format("{} {}, but only {} lines left: the file is cut off or damaged", count, what, in.n_left()));
  }
  return n;
}

void read_curves(LineReader& in, int n, FliteFile& file, Numbers& numbers) {
  for (int k = 1; k <= n; ++k) {
    in.set_context(fmt::format("curve {} of {}", k, n));
    FliteCurve curve;
    curve.id = in.integers(2, "a curve's number and type")[0];
    curve.line = in.line();
    numbers.add(curve.id, in);
    const int n_points = in.integers(1, "a number of points")[0];
    in.require(n_points >= 2, fmt::format("{} points; a curve has at least 2", n_points));
    curve.points = in.points(n_points);
    file.curves.push_back(std::move(curve));
  }
}

void read_surfaces(LineReader& in, int n, FliteFile& file, Numbers& numbers) {
  for (int k = 1; k <= n; ++k) {
    in.set_context(fmt::format("surface {} of {}", k, n));
    FliteSurface surface;
    surface.id = in.integers(2, "a surface's number and type")[0];
    surface.line = in.line();
    numbers.add(surface.id, in);
    const std::vector<int> size = in.integers(2, "the two numbers of points of a grid");
    surface.n_first = size[0], surface.n_second = size[1];
    for (const int side : size)
      in.require(side >= 2 && side <= kMaxGridSide,
                 fmt::format("a grid of {} x {} points; it has at least 2 x 2", size[0], size[1]));
    surface.points = in.points(static_cast<std::size_t>(size[0]) * size[1]);
    file.surfaces.push_back(std::move(surface));
  }
}

void read_segments(LineReader& in, int n, const Numbers& curves, FliteFile& file, Numbers& numbers) {
  for (int k = 1; k <= n; ++k) {
    in.set_context(fmt::format("segment {} of {}", k, n));
    const std::vector<int> record = in.integers(2, "the numbers of a segment and its curve");
    numbers.add(record[0], in);
    file.segments.push_back({record[0], in.line(), curves.find(record[1], "curve", in)});
  }
}

void read_regions(LineReader& in, int n, const Numbers& surfaces, const Numbers& segments, FliteFile& file) {
  Numbers numbers;
  for (int k = 1; k <= n; ++k) {
    in.set_context(fmt::format("region {} of {}", k, n));
    const std::vector<int> record = in.integers(2, "the numbers of a region and its surface");
    numbers.add(record[0], in);
    FliteRegion region{record[0], in.line(), surfaces.find(record[1], "surface", in), {}};
    const int n_segments = in.integers(1, "a number of segments")[0];
    in.require(n_segments >= 1 && static_cast<std::size_t>(n_segments) <= 2 * file.segments.size(),
               fmt::format("{} boundary segments of {} in the file", n_segments, file.segments.size()));
    std::vector<int> uses(file.segments.size(), 0);
    for (const int id : in.wrapped_integers(n_segments, "boundary segments")) {
      region.segments.push_back(segments.find(std::abs(id), "segment", in));
      in.require(++uses[region.segments.back()] <= 2, fmt::format("segment {} bounds the region more than twice", id));
    }
    file.regions.push_back(std::move(region));
  }
}

std::string point_line(Vec3 p) { return fmt::format("{:24.15E}{:24.15E}{:24.15E}\n", p.x, p.y, p.z); }

}  // namespace

bool is_flite(const std::string& head) {
  if (head.find('\0') != std::string::npos) return false;
  std::vector<std::string_view> lines;
  for (std::size_t at = 0, end; (end = head.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(std::string_view(head).substr(at, end - at));
  const auto are_integers = [&](std::size_t line, std::size_t n) {
    const auto words = words_of(lines[line]);
    return words.size() >= n &&
           std::all_of(words.begin(), words.begin() + n, [](std::string_view w) { return integer_of(w).has_value(); });
  };
  const auto is_point = [&](std::size_t line) {
    const auto words = words_of(lines[line]);
    return words.size() >= 3 &&
           std::all_of(words.begin(), words.begin() + 3, [](std::string_view w) { return real_of(w).has_value(); });
  };
  if (lines.size() < 3 || !are_integers(1, 2)) return false;
  const auto label = words_of(lines[2]);
  if (label.empty() || real_of(label[0])) return false;
  return (lines.size() < 4 || are_integers(3, 2)) && (lines.size() < 5 || are_integers(4, 1)) &&
         (lines.size() < 6 || is_point(5));
}

FliteFile read_flite(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  LineReader in(path, text);
  FliteFile file;
  Numbers curves, surfaces, segments;
  in.label();
  const std::vector<int> n_support = counts(in, "curves and surfaces");
  in.label();
  read_curves(in, n_support[0], file, curves);
  in.set_context("label of the surfaces");
  in.label();
  read_surfaces(in, n_support[1], file, surfaces);
  in.set_context("label of the mesh generation part");
  in.label();
  const std::vector<int> n_parts = counts(in, "segments and regions");
  in.label();
  read_segments(in, n_parts[0], curves, file, segments);
  in.set_context("label of the regions");
  in.label();
  read_regions(in, n_parts[1], surfaces, segments, file);
  return file;
}

std::string flite_text(const FliteFile& file) {
  std::string text = fmt::format("Geometry\n{:8}{:8}\nCurves\n", file.curves.size(), file.surfaces.size());
  for (const FliteCurve& c : file.curves) {
    text += fmt::format("{:8}{:8}\n{:8}\n", c.id, 1, c.points.size());
    for (const Vec3 p : c.points) text += point_line(p);
  }
  text += "Surfaces\n";
  for (const FliteSurface& s : file.surfaces) {
    text += fmt::format("{:8}{:8}\n{:8}{:8}\n", s.id, 1, s.n_first, s.n_second);
    for (const Vec3 p : s.points) text += point_line(p);
  }
  text += fmt::format("Mesh Generation\n{:8}{:8}{:8}{:8}\nSegment Curves\n", file.segments.size(), file.regions.size(),
                      0, 0);
  for (const FliteSegment& s : file.segments) text += fmt::format("{:8}{:8}{:8}\n", s.id, file.curves[s.curve].id, 1);
  text += "Surfaces\n";
  for (const FliteRegion& r : file.regions) {
    text += fmt::format("{:8}{:8}{:8}{:8}\n{:8}\n", r.id, file.surfaces[r.surface].id, 1, 1, r.segments.size());
    for (std::size_t k = 0; k < r.segments.size(); ++k)
      text += fmt::format("{:8}{}", file.segments[r.segments[k]].id,
                          (k + 1) % 8 == 0 || k + 1 == r.segments.size() ? "\n" : "");
  }
  return text;
}

}  // namespace st
