#include "base/hash.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace st {
namespace {

TEST(Hash, is_32_lower_case_hexadecimal_digits) {
  const std::string digest = hash_hex("abc", 3);
  EXPECT_EQ(digest.size(), 32u);
  EXPECT_EQ(digest.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Hash, known_value_never_changes) { EXPECT_EQ(hash_hex("", 0), "99aa06d3014798d86001c324468d497f"); }

TEST(Hash, does_not_depend_on_how_the_bytes_arrive) {
  std::vector<unsigned char> bytes(100000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * 131 + (i >> 8));
  Hasher pieces;
  for (std::size_t i = 0; i < bytes.size(); i += 777)
    pieces.add(bytes.data() + i, std::min<std::size_t>(777, bytes.size() - i));
  EXPECT_EQ(pieces.hex(), hash_hex(bytes.data(), bytes.size()));
}

TEST(Hash, every_byte_counts) {
  std::vector<unsigned char> bytes(1000, 7);
  const std::string digest = hash_hex(bytes.data(), bytes.size());
  for (std::size_t i = 0; i < bytes.size(); i += 37) {
    ++bytes[i];
    EXPECT_NE(hash_hex(bytes.data(), bytes.size()), digest) << "byte " << i;
    --bytes[i];
  }
}

TEST(Hash, texts_do_not_run_into_each_other) {
  Hasher a, b;
  a.add(std::string_view("ab"));
  a.add(std::string_view("c"));
  b.add(std::string_view("a"));
  b.add(std::string_view("bc"));
  EXPECT_NE(a.hex(), b.hex());
}

TEST(Hash, reading_the_digest_does_not_end_the_hash) {
  Hasher a, b;
  a.add("x", 1);
  EXPECT_EQ(a.hex(), hash_hex("x", 1));
  a.add("y", 1);
  EXPECT_EQ(a.hex(), hash_hex("xy", 2));
}

}  // namespace
}  // namespace st
