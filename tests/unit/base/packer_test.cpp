#include "base/packer.h"

#include <gtest/gtest.h>

namespace st {
namespace {

struct Pair {
  double a;
  std::int64_t b;
};

TEST(Packer, gives_back_what_was_added_in_order) {
  Packer packer;
  packer.add(42);
  packer.add(std::vector<Pair>{{1.5, -1}, {2.5, -2}});
  packer.add(std::string("Flügel"));
  packer.add(std::vector<double>{});
  packer.add(std::string());
  const Bytes bytes = packer.take();
  Unpacker unpacker(bytes);
  int number = 0;
  std::vector<Pair> pairs;
  std::string text, empty_text = "x";
  std::vector<double> empty = {1};
  unpacker.get(number);
  unpacker.get(pairs);
  unpacker.get(text);
  unpacker.get(empty);
  unpacker.get(empty_text);
  EXPECT_EQ(number, 42);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].b, -2);
  EXPECT_EQ(text, "Flügel");
  EXPECT_TRUE(empty.empty());
  EXPECT_TRUE(empty_text.empty());
  EXPECT_THROW(unpacker.get(number), std::runtime_error);
}

struct Named {
  std::string name;
  std::vector<double> numbers;
  std::vector<Pair> pairs;

  static auto fields(auto& n) { return std::tie(n.name, n.numbers, n.pairs); }
};

TEST(Packer, makes_room_once) {
  const std::vector<Named> values = {{"one", {1, 2, 3}, {{1, 2}}}, {"", {}, {}}};
  const Bytes bytes = packed(values, 7, std::string("end"));
  EXPECT_EQ(bytes.size(), PackedSize::of(values) + sizeof(int) + PackedSize::of(std::string("end")));
  EXPECT_EQ(bytes.capacity(), bytes.size());
}

TEST(Packer, refuses_a_message_cut_anywhere) {
  Packer packer;
  packer.add(std::vector<double>(10, 1.0));
  const Bytes bytes = packer.take();
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
    Unpacker unpacker(cut);
    std::vector<double> values;
    EXPECT_THROW(unpacker.get(values), std::runtime_error) << n;
  }
}

TEST(Packer, refuses_a_length_that_no_message_can_have) {
  Packer packer;
  packer.add(~std::uint64_t{0} / 4);
  packer.add(1.0);
  const Bytes bytes = packer.take();
  Unpacker unpacker(bytes);
  std::vector<double> values;
  EXPECT_THROW(unpacker.get(values), std::runtime_error);
}

}  // namespace
}  // namespace st
