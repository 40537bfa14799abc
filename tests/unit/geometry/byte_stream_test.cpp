// Numbers of B-Rep files are read as OpenCASCADE would read them.
#include "geometry/brep/byte_stream.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <BinTools.hxx>
#include <GeomTools.hxx>
#include <Standard_CString.hxx>
#include <Storage_StreamTypeMismatchError.hxx>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace st::occt {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

/// What GeomTools reads of a text that is one word.
double read(const std::string& word) {
  std::istringstream in(word);
  double value = 7;
  GeomTools::GetReal(in, value);
  return value;
}

TEST(ByteStream, every_number_of_a_text_is_that_of_OpenCASCADE_to_the_last_bit) {
  std::mt19937_64 random(1);
  char word[64];
  for (int i = 0; i < 20'000; ++i) {
    const double any = std::bit_cast<double>(random()),
                 usual = 1e-16 * static_cast<double>(static_cast<std::int64_t>(random()));
    if (!std::isfinite(any)) continue;
    for (const auto& [format, x] : {std::pair{"%.17g", any}, {"%.15g", any}, {"%.17g", usual}, {"%.6f", usual}}) {
      std::snprintf(word, sizeof word, format, x);
      ASSERT_EQ(bits(read(word)), bits(Strtod(word, nullptr))) << word;
    }
  }
}

TEST(ByteStream, odd_words_are_read_as_OpenCASCADE_does) {
  for (const char* word : {"0",
                           "-0",
                           "+5",
                           "1.",
                           ".5",
                           "-.5",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "4.9e-324",
                           "1d5",
                           "0x10",
                           "1.5abc",
                           "abc",
                           "-",
                           "1e",
                           "inf",
                           "nan",
                           "2.2250738585072011e-308",
                           "00012"})
    EXPECT_EQ(bits(read(word)), bits(Strtod(word, nullptr))) << word;
  for (const char* word : {"inf ", "nan ", "1e400 ", "1.5abc ", "+5 ", "0x10 ", "-.5\t"})
    EXPECT_EQ(bits(read(word)), bits(Strtod(word, nullptr))) << word;
  EXPECT_EQ(read("   \n\t 3.25  "), 3.25);
  EXPECT_EQ(read(""), 0);
}

TEST(ByteStream, a_text_ends_as_streams_do) {
  std::istringstream in("1 2\n3");
  double value = 0;
  for (const double expected : {1.0, 2.0}) {
    GeomTools::GetReal(in, value);
    EXPECT_EQ(value, expected);
    EXPECT_TRUE(in.good());
  }
  GeomTools::GetReal(in, value);
  EXPECT_EQ(value, 3);
  EXPECT_TRUE(in.eof() && !in.fail());
  GeomTools::GetReal(in, value);
  EXPECT_EQ(value, 0);
  EXPECT_FALSE(in.fail());  // nothing is tried at the end
  std::istringstream blank("  ");
  blank.exceptions(std::ios::failbit | std::ios::badbit);
  EXPECT_THROW(GeomTools::GetReal(blank, value), std::ios_base::failure);
}

TEST(ByteStream, bytes_of_a_number_are_the_number_and_too_few_are_an_error) {
  const double numbers[] = {1.5, -0.0, 1e-310};
  std::string text(reinterpret_cast<const char*>(numbers), sizeof numbers);
  text += "half";
  const std::vector<std::byte> bytes = bytes_of(text);
  const auto buffer = byte_stream(bytes);
  std::istream in(buffer.get());
  double value = 0;
  for (const double expected : numbers) {
    BinTools::GetReal(in, value);
    EXPECT_EQ(bits(value), bits(expected));
  }
  EXPECT_THROW(BinTools::GetReal(in, value), Storage_StreamTypeMismatchError);
  EXPECT_TRUE(in.eof() && in.fail());
  EXPECT_THROW(BinTools::GetReal(in, value), Storage_StreamTypeMismatchError);
}

TEST(ByteStream, goes_to_any_place_of_its_bytes_and_no_further) {
  const std::vector<std::byte> bytes = bytes_of("abcdef");
  const auto buffer = byte_stream(bytes);
  std::istream in(buffer.get());
  in.seekg(4);
  EXPECT_EQ(in.get(), 'e');
  EXPECT_EQ(in.tellg(), std::streampos(5));
  in.seekg(-2, std::ios::end);
  EXPECT_EQ(in.get(), 'e');
  in.seekg(-3, std::ios::cur);
  EXPECT_EQ(in.get(), 'c');
  in.seekg(7);
  EXPECT_TRUE(in.fail());
}

/// The readers inside of OpenCASCADE's libraries find these functions by their names.
TEST(ByteStream, OpenCASCADE_calls_these_functions) {
  Dl_info own{}, found{};
  for (const char* name : {"_ZN9GeomTools7GetRealERSiRd", "_ZN8BinTools7GetRealERSiRd"}) {
    ASSERT_NE(dladdr(reinterpret_cast<void*>(&read), &own), 0);
    ASSERT_NE(dladdr(dlsym(RTLD_DEFAULT, name), &found), 0) << name;
    EXPECT_STREQ(found.dli_fname, own.dli_fname) << name;
  }
}

}  // namespace
}  // namespace st::occt
