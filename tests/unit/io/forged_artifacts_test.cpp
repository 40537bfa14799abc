// Artifacts with one dataset or attribute forged, and checksums that fit: which are refused is written down, one line
// each, in forged_artifacts.txt. A check that goes missing shows there as a forgery that is read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "io/hdf5/hdf5_file.h"
#include "unit/io/copied_artifact.h"
#include "unit/io/sample_sizing.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

template <class T>
using Spoil = std::function<void(std::vector<T>& values, std::size_t columns)>;

/// By the letter that stands for it. To an empty dataset all add a row.
template <class T>
std::map<char, Spoil<T>> forgeries() {
  using Limits = std::numeric_limits<T>;
  const auto set_first = [](T x) { return [x](std::vector<T>& v, std::size_t) { v.front() = x; }; };
  const auto set_last = [](T x) { return [x](std::vector<T>& v, std::size_t) { v.back() = x; }; };
  std::map<char, Spoil<T>> all = {{'h', set_first(Limits::max())},
                                  {'z', [](std::vector<T>& v, std::size_t) { std::fill(v.begin(), v.end(), T(0)); }},
                                  {'r', [](std::vector<T>& v, std::size_t) { std::reverse(v.begin(), v.end()); }},
                                  {'s', [](std::vector<T>& v, std::size_t columns) { v.resize(v.size() - columns); }}};
  if constexpr (std::is_floating_point_v<T>) {
    all['n'] = set_last(Limits::quiet_NaN());
    all['I'] = set_last(Limits::infinity());
    all['m'] = set_first(-1);
  } else {
    all['l'] = set_last(Limits::lowest());
    all['i'] = [](std::vector<T>& v, std::size_t) { v.front() = static_cast<T>(v.front() + 1); };
    all['d'] = [](std::vector<T>& v, std::size_t) { v.back() = static_cast<T>(v.back() - 1); };
  }
  return all;
}

std::map<char, Spoil<std::string>> forgeries_of_texts() {
  return {{'u', [](auto& v, std::size_t) { v.front() = "\xff\xfe\xc0"; }},
          {'s', [](auto& v, std::size_t) { v.pop_back(); }}};
}

constexpr char kMissing = '-';

/// An artifact whose parts are copied one by one, one of them not as it is.
class Forger {
 public:
  explicit Forger(const std::string& path) : in_(path), attributes_(in_.content_attributes()) {}

  const std::vector<DatasetInfo>& datasets() const { return in_.datasets(); }
  const std::vector<AttributeSummary>& attributes() const { return attributes_; }

  /// The letters of what may be done to a dataset.
  std::string letters(const DatasetInfo& d) const {
    std::string all{kMissing};
    if (d.is_foreign) return all;
    with_element(d.type, [&](const auto& element) {
      using T = std::decay_t<decltype(element)>;
      if constexpr (std::is_same_v<T, std::string>)
        for (const auto& [letter, spoil] : forgeries_of_texts()) all += letter;
      else
        for (const auto& [letter, spoil] : forgeries<T>()) all += letter;
    });
    return d.shape[0] == 0 ? std::string{kMissing, 's'} : all;
  }

  void write(const std::string& to, const std::string& forged, char letter) const {
    copy_artifact(in_, to, [&](const std::string& name, auto& values, std::size_t columns) {
      if (name != forged) return true;
      if (letter != kMissing) forge(letter, values, columns);
      return letter != kMissing;
    });
  }

 private:
  static void forge(char letter, std::vector<std::string>& values, std::size_t columns) {
    values.empty() ? values.push_back("more") : forgeries_of_texts().at(letter)(values, columns);
  }
  template <class T>
  static void forge(char letter, std::vector<T>& values, std::size_t columns) {
    values.empty() ? values.resize(columns) : forgeries<T>().at(letter)(values, columns);
  }

  Hdf5Reader in_;
  std::vector<AttributeSummary> attributes_;
};

/// What is wrong with a refusal; "" when it is one, nullopt when the file is read.
std::optional<std::string> refusal(const std::string& path, const std::function<void(const std::string&)>& read) {
  try {
    read(path);
    return std::nullopt;
  } catch (const Error& e) {
    if (e.code() != ExitCode::kInput) return std::string("another code: ") + e.what();
    return std::string(e.what()).find(path) == std::string::npos ? std::string("names no file: ") + e.what() : "";
  } catch (const std::exception& e) {
    return std::string("no error of ours: ") + e.what();
  }
}

struct Sample {
  const char* name;
  std::function<void(const std::string&path)> write, read;
};

std::vector<Sample> samples() {
  return {
      {"geometry", [](const auto& p) { write_geometry(p, sample_geometry()); },
       [](const auto& p) { read_geometry(p); }},
      {"raster",
       [](const auto& p) {
         RasterArtifact raster = sample_raster();
         raster.surface = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 1}}}, BlankSide::kOutside};
         raster.samples[1].reach = reach_of({0.1, 0, 0}, {0, 0.1, 0});
         write_raster(p, raster);
       },
       [](const auto& p) { read_raster(p); }},
      {"sizing", [](const auto& p) { write_sizing(p, sizing_of_stretched_cones()); },
       [](const auto& p) { read_sizing(p); }},
      {"patches", [](const auto& p) { write_patches(p, sample_patches()); }, [](const auto& p) { read_patches(p); }},
      {"mesh", [](const auto& p) { write_mesh(p, sample_mesh()); }, [](const auto& p) { read_mesh(p); }}};
}

/// A line per dataset and attribute: which of its forgeries are refused, and which are read.
std::string table_of(const Sample& sample, const TemporaryDirectory& dir) {
  const std::string good = dir / "good.hdf", forged = dir / "forged.hdf";
  sample.write(good);
  const Forger forger(good);
  std::ostringstream table;
  const auto add = [&](const std::string& name, const std::string& letters) {
    std::string refused, read;
    for (const char letter : letters) {
      forger.write(forged, name, letter);
      const std::optional<std::string> wrong = refusal(forged, sample.read);
      (wrong ? refused : read) += letter;
      EXPECT_EQ(wrong.value_or(""), "") << sample.name << " " << name << " " << letter;
    }
    table << sample.name << ' ' << name << " refused:" << refused << " read:" << read << '\n';
  };
  for (const DatasetInfo& d : forger.datasets()) add(d.name, forger.letters(d));
  for (const AttributeSummary& a : forger.attributes())
    add(a.name, std::holds_alternative<std::string>(a.value) ? "-u"
                : std::holds_alternative<double>(a.value)    ? "-hzImn"
                                                             : "-hlz");
  return table.str();
}

TEST(ForgedArtifacts, are_refused_as_it_is_written) {
  const auto path = std::filesystem::path(ST_SOURCE_DIR) / "tests/unit/io/forged_artifacts.txt";
  std::map<std::string, std::string> expected, found;
  const auto add_lines = [](const std::string& text, std::map<std::string, std::string>& to) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (const std::size_t at = line.find(" refused:"); at != std::string::npos)
        to[line.substr(0, at)] = line.substr(at + 1);
  };
  add_lines(read_bytes(path.string()), expected);
  const TemporaryDirectory dir(std::filesystem::exists("/dev/shm") ? "/dev/shm"
                                                                   : std::filesystem::temp_directory_path());
  for (const Sample& sample : samples()) add_lines(table_of(sample, dir), found);
  for (const auto& [name, line] : found) EXPECT_EQ(line, expected[name]) << name;
  for (const auto& [name, line] : expected) EXPECT_TRUE(found.contains(name)) << name << " is no more";
}

}  // namespace
}  // namespace st
