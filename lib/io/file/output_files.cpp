#include "io/file/output_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "base/error.h"

namespace st {
namespace {

namespace fs = std::filesystem;

OutputRules g_rules;  // without is_artifact: none

/// The place of a file that need not exist, its folder without links.
fs::path place_of(const std::string& path) {
  std::error_code none;
  const fs::path whole = fs::absolute(path, none).lexically_normal();
  return fs::weakly_canonical(whole.parent_path(), none) / whole.filename();
}

/// One file, by its name or by a link, symbolic or hard.
bool is_same(const std::string& a, const std::string& b) {
  std::error_code none;
  return fs::equivalent(a, b, none) || place_of(a) == place_of(b);
}

bool contains(const std::vector<std::string>& paths, const std::string& path) {
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& other) { return is_same(other, path); });
}

void refuse_input(const std::string& path) {
  if (contains(g_rules.inputs, path))
    throw Error(ExitCode::kUsage, path + ": is an input and would be overwritten; choose another output");
}

void refuse_second(const std::vector<std::string>& earlier, const std::string& path) {
  if (contains(earlier, path))
    throw Error(ExitCode::kUsage, path + ": given twice as an output; choose another name for one of them");
}

/// ".mesh.hdf.tmp.17.9a3c1b20"
bool is_temporary(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with(".") && name.find(".tmp.") != std::string::npos;
}

/// The checksum of cksum (POSIX): polynomial 0x04C11DB7, highest bit first, eight bytes at a time.
class Checksum {
 public:
  void add(const unsigned char* data, std::size_t n) {
    n_bytes_ += n;
    for (; n >= 8; n -= 8, data += 8) {
      const std::uint32_t first = sum_ ^ (std::uint32_t{data[0]} << 24 | std::uint32_t{data[1]} << 16 |
                                          std::uint32_t{data[2]} << 8 | std::uint32_t{data[3]});
      sum_ = table(7, first >> 24) ^ table(6, first >> 16 & 255) ^ table(5, first >> 8 & 255) ^ table(4, first & 255) ^
             table(3, data[4]) ^ table(2, data[5]) ^ table(1, data[6]) ^ table(0, data[7]);
    }
    for (; n > 0; --n) add_byte(*data++);
  }
  /// As cksum prints it: "3515105045 12". To be called once.
  std::string text() {
    const std::uint64_t size = n_bytes_;
    for (std::uint64_t rest = size; rest > 0; rest >>= 8) add_byte(static_cast<unsigned char>(rest & 255));
    return std::to_string(~sum_) + " " + std::to_string(size);
  }

 private:
  using Tables = std::array<std::array<std::uint32_t, 256>, 8>;
  static Tables make_tables() {
    Tables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t sum = byte << 24;
      for (int bit = 0; bit < 8; ++bit) sum = sum << 1 ^ (sum >> 31 ? 0x04C11DB7u : 0);
      tables[0][byte] = sum;
    }
    for (std::size_t k = 1; k < tables.size(); ++k)
      for (std::size_t byte = 0; byte < 256; ++byte)
        tables[k][byte] = tables[k - 1][byte] << 8 ^ tables[0][tables[k - 1][byte] >> 24];
    return tables;
  }
  static std::uint32_t table(std::size_t k, std::uint32_t byte) {
    static const Tables tables = make_tables();
    return tables[k][byte];
  }
  void add_byte(unsigned char byte) { sum_ = sum_ << 8 ^ table(0, sum_ >> 24 ^ byte); }

  std::uint32_t sum_ = 0;
  std::uint64_t n_bytes_ = 0;
};

/// "" where it cannot be read.
std::string checksum_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Checksum sum;
  std::vector<char> piece(1 << 16);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    sum.add(reinterpret_cast<const unsigned char*>(piece.data()), static_cast<std::size_t>(file.gcount()));
  return file.is_open() && !file.bad() ? sum.text() : "";
}

bool is_hdf5(const std::string& path) {
  constexpr std::array<char, 8> kSignature = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return start == kSignature;
}

bool is_artifact(const std::string& path) { return is_hdf5(path) && g_rules.is_artifact(path); }

/// The record of a folder, open and locked for as long as this lives.
class Record {
 public:
  Record(const fs::path& folder, int mode) {
    file_ = open((folder / kRecordName).c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    struct stat info {};
    if (file_ < 0 || fstat(file_, &info) != 0 || !S_ISREG(info.st_mode)) return;
    flock(file_, LOCK_EX);
    text_.resize(static_cast<std::size_t>(info.st_size));
    const ssize_t n = pread(file_, text_.data(), text_.size(), 0);
    text_.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    is_open_ = n >= 0;
  }
  ~Record() {
    if (file_ >= 0) close(file_);
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  bool has(const std::string& line) const { return ("\n" + text_).find("\n" + line + "\n") != std::string::npos; }

  /// One line for each name.
  void set(const std::string& name, const std::string& line) const {
    if (!is_open_) return;
    std::string text;
    std::istringstream lines(text_);
    for (std::string old; std::getline(lines, old);)
      if (name_in(old) != name) text += old + "\n";
    text += line + "\n";
    if (ftruncate(file_, 0) == 0 && pwrite(file_, text.data(), text.size(), 0) < 0) return;
  }

 private:
  /// "3515105045 12 mesh.stl"
  static std::string name_in(const std::string& line) {
    const std::size_t size = line.find(' '), name = line.find(' ', size + 1);
    return size == std::string::npos || name == std::string::npos ? "" : line.substr(name + 1);
  }

  int file_ = -1;
  bool is_open_ = false;
  std::string text_;
};

std::string line_of(const fs::path& place) { return checksum_of(place.string()) + " " + place.filename().string(); }

bool is_recorded(const fs::path& place) { return Record(place.parent_path(), O_RDONLY).has(line_of(place)); }

}  // namespace

void set_output_rules(OutputRules rules) {
  g_rules = std::move(rules);
  if (!g_rules.is_artifact) return;
  std::vector<std::string> earlier;
  for (const auto* outputs : {&g_rules.named, &g_rules.defaults}) {
    for (const std::string& path : *outputs) {
      refuse_second(earlier, path);
      refuse_input(path);
      earlier.push_back(path);
    }
  }
}

void require_derived_outputs(const std::vector<std::string>& paths) {
  if (!g_rules.is_artifact) return;
  for (const std::string& path : paths) {
    refuse_input(path);
    refuse_second(g_rules.named, path);
    refuse_second(g_rules.defaults, path);
    require_replaceable(path);
  }
}

void require_replaceable(const std::string& path) {
  if (!g_rules.is_artifact) return;
  refuse_input(path);
  struct stat info {};
  if (stat(path.c_str(), &info) != 0 || info.st_size == 0 || contains(g_rules.named, path)) return;
  if (is_artifact(path) || is_recorded(place_of(path))) return;
  throw Error(ExitCode::kOutput, path +
                                     ": would be replaced, but ST did not write it, or it was changed since; move it "
                                     "away, or choose another output");
}

void note_written(const std::string& path) {
  const bool is_replaced_beside_another = path.ends_with(".msh");  // by an export of .geo
  if (!g_rules.is_artifact || (contains(g_rules.named, path) && !is_replaced_beside_another) || is_temporary(path) ||
      is_artifact(path))
    return;
  const fs::path place = place_of(path);
  Record(place.parent_path(), O_RDWR | O_CREAT).set(place.filename().string(), line_of(place));
}

}  // namespace st
