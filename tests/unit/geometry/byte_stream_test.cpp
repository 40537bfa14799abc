#include "geometry/brep/byte_stream.h"

#include <gtest/gtest.h>

#include <cstring>
#include <istream>
#include <string>
#include <vector>

namespace st::occt {
namespace {

std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
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

}  // namespace
}  // namespace st::occt
