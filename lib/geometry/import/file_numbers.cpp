#include "geometry/import/file_numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "base/threads.h"

namespace st::occt {
namespace {

constexpr int kLargestExponent = 200;  // squares of lengths overflow beyond 154; OpenCASCADE writes 2e100

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// By character: those that unsound numbers have and others rarely, and the quotes of names.
constexpr auto kIsLooked = [] {
  std::array<bool, 256> is_looked{};
  for (const char c : std::string_view("eEdDnNiI#'")) is_looked[static_cast<unsigned char>(c)] = true;
  return is_looked;
}();

/// Without its sign: "nan", "inf", "infinity", whatever the case.
bool is_word_of_no_number(std::string_view word) {
  if (word.empty() || (word[0] | 0x20) < 'i' || word.size() > 8) return false;
  std::string small(word);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small == "nan" || small == "inf" || small == "infinity";
}

bool is_sound(std::string_view word) {
  if (word[0] == '-' || word[0] == '+') word.remove_prefix(1);
  if (word.empty() || (!is_digit(word[0]) && word[0] != '.')) return !is_word_of_no_number(word);
  std::size_t at = word.find_first_not_of("0123456789.");
  if (at == std::string_view::npos) return true;
  if (word[at] == '#') return false;                                                   // 1.#INF of an old C library
  if (std::string_view("eEdD").find(word[at]) == std::string_view::npos) return true;  // the text 5HABCDE of IGES
  if (++at < word.size() && word[at] == '+') ++at;
  int exponent = 0;
  const auto [end, error] = std::from_chars(word.data() + at, word.data() + word.size(), exponent);
  return error == std::errc() ? exponent < kLargestExponent : end == word.data() + at || word[at] == '-';
}

/// "1.5e-05" or "2E3": OpenCASCADE takes it for 1.5, and loses the entity, or the digits behind the E. STEP has a point
/// and a capital E.
bool has_foreign_exponent(std::string_view word) {
  const std::size_t at = word.find_first_not_of("+-.0123456789");
  if (at == std::string_view::npos || at == 0 || at + 1 == word.size()) return false;
  if (word.find_first_not_of("+-0123456789", at + 1) != std::string_view::npos) return false;
  return word[at] == 'e' || (word[at] == 'E' && word.find('.') == std::string_view::npos);
}

class NumberScan {
 public:
  NumberScan(std::string_view text, const std::string& format, const std::string& path)
      : text_(text), path_(path), is_step_(format == "STEP"), is_iges_(format == "IGES") {}

  void run() const {
    if (is_step_) return scan(0, text_.size());  // a name may be anywhere, and over several lines
    if (!is_iges_) return scan_lines();
    constexpr std::size_t kSection = 72, kEndOfData = 64;  // columns
    for (std::size_t begin = 0, end = 0; begin < text_.size(); begin = end + 1) {
      end = std::min(text_.find('\n', begin), text_.size());
      if (end > begin + kSection && text_[begin + kSection] == 'P') scan(begin, begin + kEndOfData);
    }
  }

 private:
  /// All of them, on all threads.
  void scan_lines() const {
    constexpr std::size_t kBytes = 1 << 18;
    const auto line_end = [&](std::size_t at) { return at == 0 ? 0 : std::min(text_.find('\n', at), text_.size()); };
    parallel_for(text_.size(), kBytes,
                 [&](std::size_t begin, std::size_t end) { scan(line_end(begin), line_end(end)); });
  }

  bool ends_word(char c) const {
    return c == ',' || c == ';' || (!is_iges_ && (c == ' ' || (c >= '\t' && c <= '\r') || c == '(' || c == ')'));
  }

  /// Whether a number may be unsound from this character on: an exponent behind digits, or nan or inf as a word.
  bool is_suspect(std::size_t at, std::size_t begin) const {
    const char before = at > begin ? text_[at - 1] : ',';
    return is_digit(before) || before == '.' || before == '+' || before == '-' || ends_word(before);
  }

  /// A number in the parentheses behind the name of its type.
  bool is_typed(std::size_t at) const {
    return is_step_ && at > 1 && text_[at - 1] == '(' && (std::isalnum(static_cast<unsigned char>(text_[at - 2])) != 0);
  }

  void scan(const std::size_t begin, const std::size_t end) const {
    for (std::size_t at = begin; at < end; ++at) {
      const char c = text_[at];
      if (!kIsLooked[static_cast<unsigned char>(c)]) continue;
      if (c == '\'') {
        if (is_step_) at = std::min(text_.find(c, at + 1), end);  // a name
      } else if (is_suspect(at, begin)) {
        at = judge(at, begin, end);
      }
    }
  }

  /// The number around a character; returns its end.
  std::size_t judge(std::size_t at, std::size_t begin, std::size_t end) const {
    std::size_t first = at;
    while (first > begin && !ends_word(text_[first - 1])) --first;
    while (at < end && !ends_word(text_[at])) ++at;
    const std::string_view word = text_.substr(first, at - first);
    if (is_typed(first)) return at;
    if (!is_sound(word)) fail(first, word, "; the file is damaged: export it again from the CAD system");
    if (is_step_ && has_foreign_exponent(word))
      fail(first, word,
           ", which OpenCASCADE reads wrong: STEP has a point and a capital E, as in 1.5E-05; export it again");
    return at;
  }

  [[noreturn]] void fail(std::size_t at, std::string_view word, const char* why) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw Error(ExitCode::kGeometry,
                path_ + ": line " + std::to_string(line) + " has the number " + std::string(word) + why);
  }

  std::string_view text_;
  const std::string& path_;
  bool is_step_, is_iges_;
};

}  // namespace

void require_sound_numbers(const std::string& path, const std::string& format) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(0, in.tellg())), '\0');
  in.seekg(0);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const bool is_binary = text.substr(0, 64).find("Open CASCADE Topology V") != std::string::npos;
  if (!is_binary) NumberScan(text, format, path).run();
}

}  // namespace st::occt
