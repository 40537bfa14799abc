#include "geometry/import/text_encoding.h"

#include <gtest/gtest.h>

namespace st::occt {
namespace {

TEST(TextEncoding, takes_valid_utf8_for_utf8) {
  for (const char* text : {"", "PRODUCT('wing')", "Flügel", "主翼", "🚀 – ’"})
    EXPECT_EQ(detect_encoding(text), TextEncoding::kUtf8) << text;
}

TEST(TextEncoding, takes_japanese_bytes_for_shift_jis) {
  EXPECT_EQ(detect_encoding("a \x8e\xe5\x97\x83"), TextEncoding::kShiftJis) << "two kanji";
  EXPECT_EQ(detect_encoding("\x97\x83 1"), TextEncoding::kShiftJis) << "one, its second byte beyond ASCII, too";
  EXPECT_EQ(detect_encoding("\x95\x5c\x96\x59"), TextEncoding::kShiftJis) << "second bytes in ASCII";
  EXPECT_EQ(detect_encoding("\x83\x74\x83\x5e \xcc\xd7\xaf\xcc\xdf"), TextEncoding::kShiftJis)
      << "katakana, wide and narrow";
}

TEST(TextEncoding, takes_western_bytes_for_windows_1252) {
  for (const char* text :
       {"Fl\xfcgel", "M\xfcller\x92s wing", "aile \xe0 droite \x96 \xe9t\xe9", "\x80 5", "na\xefve", "\xe4\xf6\xfc\xdf",
        "\xc4\x96"
        "x\xff"})
    EXPECT_EQ(detect_encoding(text), TextEncoding::kWindows1252) << text;
}

TEST(TextEncoding, does_not_take_overlong_forms_and_surrogates_for_utf8) {
  for (const char* text :
       {"\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xf4\x90\x80\x80", "ab\xc3", "\xe4\xb8"})
    EXPECT_NE(detect_encoding(text), TextEncoding::kUtf8);
}

TEST(TextEncoding, gives_utf8_of_every_encoding) {
  EXPECT_EQ(to_utf8("Fl\xfcgel \x96 5 \x80", TextEncoding::kWindows1252), "Flügel – 5 €");
  EXPECT_EQ(to_utf8("\x8e\xe5\x97\x83\x95\x5c\x96\xca", TextEncoding::kShiftJis), "主翼表面");
  EXPECT_EQ(to_utf8("Flügel", TextEncoding::kUtf8), "Flügel");
  EXPECT_EQ(to_utf8("a\nb\tc", TextEncoding::kWindows1252), "a b c");
  EXPECT_EQ(to_utf8("a\xff"
                    "b",
                    TextEncoding::kUtf8),
            "a\xef\xbf\xbd"
            "b");
}

}  // namespace
}  // namespace st::occt
