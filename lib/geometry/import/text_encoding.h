// Names in CAD files: which bytes they are, and as UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace st::occt {

enum class TextEncoding { kUtf8, kShiftJis, kWindows1252 };

/// Encoding of a whole file from its bytes beyond ASCII: UTF-8 where all of it is valid UTF-8 (ASCII is); else
/// Shift-JIS where all of it can be that and a character of two such bytes, or two characters in a row, begin with a
/// byte that Western European text has no letter for; else Windows-1252, of which Latin-1 is the part that has letters.
/// The cost is linear.
TextEncoding detect_encoding(std::string_view bytes);

/// detect_encoding() of a file; UTF-8 when it cannot be read.
TextEncoding file_encoding(const std::string& path);

/// Value of OpenCASCADE's parameter read.step.codepage.
const char* step_codepage(TextEncoding encoding);

/// Bytes of a name as UTF-8; those that the encoding has no character for become U+FFFD.
std::string to_utf8(const std::string& bytes, TextEncoding encoding);

/// The text on one line, control characters made blanks, and every byte that is no valid UTF-8 made U+FFFD.
std::string valid_utf8(const std::string& text);

}  // namespace st::occt
