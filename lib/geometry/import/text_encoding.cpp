#include "geometry/import/text_encoding.h"

#include <Resource_Unicode.hxx>
#include <TCollection_ExtendedString.hxx>
#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

namespace st::occt {
namespace {

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// Bytes of the UTF-8 character at the beginning; 0: none. Overlong forms, surrogates and what is beyond U+10FFFF are
/// none.
std::size_t utf8_length(std::string_view s) {
  const auto byte = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
  const auto is_tail = [&](std::size_t i) { return (byte(i) & 0xc0) == 0x80; };
  const unsigned a = byte(0), b = byte(1);
  if (a < 0x80) return 1;
  if (a >= 0xc2 && a <= 0xdf && is_tail(1)) return 2;
  if (a >= 0xe0 && a <= 0xef && is_tail(1) && is_tail(2))
    return (a == 0xe0 && b < 0xa0) || (a == 0xed && b > 0x9f) ? 0 : 3;
  if (a >= 0xf0 && a <= 0xf4 && is_tail(1) && is_tail(2) && is_tail(3))
    return (a == 0xf0 && b < 0x90) || (a == 0xf4 && b > 0x8f) ? 0 : 4;
  return 0;
}

/// Bytes of the Shift-JIS character at the beginning, 0: none.
std::size_t shift_jis_length(std::string_view s) {
  const auto a = static_cast<unsigned char>(s[0]);
  if (a < 0x80 || (a >= 0xa1 && a <= 0xdf)) return 1;  // ASCII, half-width katakana
  const bool is_lead = (a >= 0x81 && a <= 0x9f) || (a >= 0xe0 && a <= 0xfc);
  if (!is_lead || s.size() < 2) return 0;
  const auto b = static_cast<unsigned char>(s[1]);
  return b >= 0x40 && b <= 0xfc && b != 0x7f ? 2 : 0;
}

bool is_utf8(std::string_view s) {
  for (std::size_t i = 0; i < s.size();) {
    const std::size_t n = is_ascii(s[i]) ? 1 : utf8_length(s.substr(i));
    if (n == 0) return false;
    i += n;
  }
  return true;
}

bool is_shift_jis(std::string_view s) {
  bool is_likely = false;
  std::size_t n_in_row = 0;  // characters of two bytes that begin like no letter of Western European text
  for (std::size_t i = 0; i < s.size();) {
    const std::size_t n = is_ascii(s[i]) ? 1 : shift_jis_length(s.substr(i));
    if (n == 0) return false;
    const bool is_kanji = n == 2 && static_cast<unsigned char>(s[i]) <= 0x9f;
    n_in_row = is_kanji ? n_in_row + 1 : 0;
    is_likely = is_likely || n_in_row > 1 || (is_kanji && !is_ascii(s[i + 1]));
    i += n;
  }
  return is_likely;
}

std::string utf8(const TCollection_ExtendedString& wide) {
  std::vector<char> text(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter out = text.data();
  wide.ToUTF8CString(out);
  return text.data();
}

}  // namespace

TextEncoding detect_encoding(std::string_view bytes) {
  if (is_utf8(bytes)) return TextEncoding::kUtf8;
  return is_shift_jis(bytes) ? TextEncoding::kShiftJis : TextEncoding::kWindows1252;
}

TextEncoding file_encoding(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  return detect_encoding(bytes.str());
}

const char* step_codepage(TextEncoding encoding) {
  return encoding == TextEncoding::kUtf8 ? "UTF8" : encoding == TextEncoding::kShiftJis ? "SJIS" : "CP1252";
}

std::string to_utf8(const std::string& bytes, TextEncoding encoding) {
  if (encoding == TextEncoding::kUtf8 || std::all_of(bytes.begin(), bytes.end(), is_ascii)) return valid_utf8(bytes);
  TCollection_ExtendedString wide;
  Resource_Unicode::ConvertFormatToUnicode(
      encoding == TextEncoding::kShiftJis ? Resource_FormatType_SJIS : Resource_FormatType_CP1252, bytes.c_str(), wide);
  return valid_utf8(utf8(wide));
}

std::string valid_utf8(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = utf8_length(std::string_view(text).substr(i));
    const bool is_control = n == 1 && (static_cast<unsigned char>(text[i]) < ' ' || text[i] == 0x7f);
    result += n == 0 ? "\xef\xbf\xbd" : is_control ? " " : text.substr(i, n);
    i += std::max<std::size_t>(n, 1);
  }
  return result;
}

}  // namespace st::occt
