// Reading words, numbers and binary values from the bytes of a file.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace st {

/// Walks through the bytes of a file; the bytes outlive it. Errors are Error(kInput): "<path>: line 12: <what>".
class ByteCursor {
 public:
  ByteCursor(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(bytes_.begin(),
                                     bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, bytes_.size())), '\n');
    throw Error(ExitCode::kInput, path_ + (is_binary ? ": " : ": line " + std::to_string(line) + ": ") + what);
  }

  bool is_at_end() {
    while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
    return at_ == bytes_.size();
  }
  /// The next word; empty at the end.
  std::string_view word() {
    is_at_end();
    const std::size_t from = at_;
    while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
    return bytes_.substr(from, at_ - from);
  }
  /// The rest of the line, without its end; empty at the end of the file.
  std::string_view line() {
    const std::size_t from = at_, end = std::min(bytes_.find('\n', at_), bytes_.size());
    at_ = std::min(end + 1, bytes_.size());
    return bytes_.substr(from, end - from);
  }
  /// The next number in text; Fortran's 1.0D+00 counts as one.
  double real() {
    const std::string_view text = word();
    double value = 0;
    if (!parse(text, value)) fail_at_number(text);
    return value;
  }
  std::int64_t integer() {
    const std::string_view text = word();
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size() || text.empty())
      fail(text.empty() ? "cut off: an integer is missing; write the file again" : quoted(text) + " is no integer");
    return value;
  }
  /// The next value in binary.
  template <class T>
  T value() {
    std::array<char, sizeof(T)> bytes;
    if (bytes_.size() - at_ < sizeof(T)) fail("cut off: the file ends inside its data; write it again");
    std::memcpy(bytes.data(), bytes_.data() + at_, sizeof(T));
    if (is_swapped) std::reverse(bytes.begin(), bytes.end());
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }
  /// A number of things that take `least` bytes each; refused where the rest of the file has no room for so many.
  std::size_t count(std::int64_t n, std::size_t least, const char* what) {
    if (n < 0) fail("a negative number of " + std::string(what));
    if (static_cast<std::uint64_t>(n) > (bytes_.size() - at_) / least)
      fail("cut off: it should have " + std::to_string(n) + " " + what +
           ", more than there is room for; write the file again");
    return static_cast<std::size_t>(n);
  }
  std::size_t position() const { return at_; }
  void seek(std::size_t position) { at_ = position; }
  std::string_view bytes() const { return bytes_; }
  const std::string& path() const { return path_; }

  bool is_binary = false;   ///< errors name no line
  bool is_swapped = false;  ///< values are in the byte order of the other kind of machine

  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static bool parse(std::string_view text, double& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    std::string fortran;
    if (text.find_first_of("dD") != std::string_view::npos) {
      fortran = text;
      std::replace_if(
          fortran.begin(), fortran.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
      text = fortran;
    }
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && stop == text.data() + text.size() && !text.empty();
  }
  /// For messages.
  static std::string quoted(std::string_view text) {
    std::string result("'");
    result.append(text.substr(0, 40));
    return result += '\'';
  }

 private:
  [[noreturn]] void fail_at_number(std::string_view text) const {
    if (text.empty()) fail("cut off: a number is missing; write the file again");
    const bool has_comma = text.find(',') != std::string_view::npos;
    fail(quoted(text) + " is no number" + (has_comma ? "; write the file again with decimal points" : ""));
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace st
