// Long lists of ascending numbers in few bytes.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace st {

/// Numbers from 0 on, none less than the one before, kept as their steps: a byte for each step below 128, two below
/// 16384, and so on.
class AscendingNumbers {
 public:
  AscendingNumbers() = default;
  explicit AscendingNumbers(std::span<const std::int32_t> numbers) {
    bytes_.reserve(numbers.size() + numbers.size() / 8);
    std::int32_t last = 0;
    for (const std::int32_t number : numbers) {
      auto step = static_cast<std::uint32_t>(number - last);
      for (; step >= kMore; step >>= 7) bytes_.push_back(static_cast<std::uint8_t>(step | kMore));
      bytes_.push_back(static_cast<std::uint8_t>(step));
      last = number;
    }
  }

  std::vector<std::int32_t> all() const {
    std::vector<std::int32_t> numbers;
    std::uint32_t last = 0, step = 0;
    int shift = 0;
    for (const std::uint8_t byte : bytes_) {
      step |= std::uint32_t{byte & (kMore - 1u)} << shift;
      shift += 7;
      if (byte & kMore) continue;
      numbers.push_back(static_cast<std::int32_t>(last += step));
      step = 0, shift = 0;
    }
    return numbers;
  }

  std::size_t n_bytes() const { return bytes_.size(); }
  static auto fields(auto& a) { return std::tie(a.bytes_); }

 private:
  static constexpr std::uint8_t kMore = 0x80;  ///< bit of a byte that is not the last one of its step
  std::vector<std::uint8_t> bytes_;
};

}  // namespace st
