// Values to bytes and back, for messages between ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace st {

using Bytes = std::vector<std::byte>;

/// A struct that names the fields to be sent: `static auto fields(auto& x) { return std::tie(x.a, x.b); }`.
template <class T>
concept HasFields = requires(T& x) {
  T::fields(x);
};

/// Values of a vector that go one by one: structs with fields, texts and vectors.
template <class T>
inline constexpr bool kOneByOne = HasFields<T> || !std::is_trivially_copyable_v<T>;

/// Appends values to a byte buffer: plain old data, texts, structs with fields, and vectors of all these.
class Packer {
 public:
  /// Room for so many bytes: nothing is moved while they come.
  void reserve(std::size_t n) { bytes_.reserve(n); }
  template <class T>
  void add(const T& value) {
    if constexpr (HasFields<T>) {
      std::apply([this](const auto&... field) { (add(field), ...); }, T::fields(value));
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      append(&value, sizeof value);
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    if constexpr (kOneByOne<T>) {
      for (const T& value : values) add(value);
    } else {
      append(values.data(), values.size() * sizeof(T));
    }
  }
  void add(const std::string& text) { add(std::vector<char>(text.begin(), text.end())); }
  Bytes take() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t n) {
    const std::size_t old = bytes_.size();
    bytes_.resize(old + n);
    if (n) std::memcpy(bytes_.data() + old, data, n);
  }
  Bytes bytes_;
};

/// Reads values in the order in which they were added. Throws std::runtime_error past the end.
class Unpacker {
 public:
  explicit Unpacker(const Bytes& bytes) : bytes_(bytes) {}
  template <class T>
  void get(T& value) {
    if constexpr (HasFields<T>) {
      std::apply([this](auto&... field) { (get(field), ...); }, T::fields(value));
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      read(&value, sizeof value);
    }
  }
  template <class T>
  void get(std::vector<T>& values) {
    std::uint64_t n = 0;
    get(n);
    if (n > (bytes_.size() - position_) / (kOneByOne<T> ? 1 : sizeof(T))) throw std::runtime_error("message too short");
    values.resize(n);
    if constexpr (kOneByOne<T>) {
      for (T& value : values) get(value);
    } else {
      read(values.data(), n * sizeof(T));
    }
  }
  bool is_empty() const { return position_ == bytes_.size(); }
  void get(std::string& text) {
    std::vector<char> chars;
    get(chars);
    text.assign(chars.begin(), chars.end());
  }

 private:
  void read(void* data, std::size_t n) {
    if (n > bytes_.size() - position_) throw std::runtime_error("message too short");
    if (n) std::memcpy(data, bytes_.data() + position_, n);
    position_ += n;
  }
  const Bytes& bytes_;
  std::size_t position_ = 0;
};

/// Bytes of values as Packer adds them.
struct PackedSize {
  template <class T>
  static std::size_t of(const T& value) {
    if constexpr (HasFields<T>)
      return std::apply([](const auto&... field) { return (std::size_t{0} + ... + of(field)); }, T::fields(value));
    else
      return sizeof value;
  }
  static std::size_t of(const std::string& text) { return sizeof(std::uint64_t) + text.size(); }
  template <class T>
  static std::size_t of(const std::vector<T>& values) {
    std::size_t n = sizeof(std::uint64_t);
    if constexpr (kOneByOne<T>) {
      for (const T& value : values) n += of(value);
    } else {
      n += values.size() * sizeof(T);
    }
    return n;
  }
};

template <class... Values>
Bytes packed(const Values&... values) {
  Packer packer;
  packer.reserve((std::size_t{0} + ... + PackedSize::of(values)));
  (packer.add(values), ...);
  return packer.take();
}

template <class... Values>
void unpack(const Bytes& bytes, Values&... values) {
  Unpacker unpacker(bytes);
  (unpacker.get(values), ...);
}

}  // namespace st
