// One description of the columns of a file for both ways: visit(io, tables) writes them with WrittenColumns, and reads
// and checks them with ReadColumns.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "io/hdf5/artifact_checks.h"

namespace st {

/// How many rows a column has.
struct Rows {
  static constexpr std::size_t kAny = ~std::size_t{0};
  std::size_t n = kAny;
  std::size_t n_numbers = 0;  ///< in each row; 0: those of the type
};

/// What is checked of a column that was read: (reader, name, column), throwing Error(kInput).
inline constexpr auto kUnchecked = [](const auto&...) {};
inline constexpr auto kFinite = [](const auto&... of) { require_finite(of...); };
inline constexpr auto kLengths = [](const auto&... of) { require_lengths(of...); };
inline constexpr auto kRanges = [](const auto&... of) { require_ranges(of...); };
/// Ids in [lowest, n).
inline auto ids_below(std::size_t n, std::int32_t lowest = 0) {
  return [n, lowest](const auto&... of) { require_ids(of..., n, lowest); };
}
inline auto offsets_into(std::size_t n_items) {
  return [n_items](const auto&... of) { require_offsets(of..., n_items); };
}

struct WrittenColumns {
  Hdf5Writer& file;

  template <class T, class Check = decltype(kUnchecked)>
  void operator()(const std::string& name, const std::vector<T>& column, Rows rows = {}, const Check& = {}) const {
    if constexpr (std::is_same_v<T, std::string>)
      file.write_strings(name, column);
    else
      file.write(name, column, rows.n_numbers > 0 ? rows.n_numbers : Element<T>::count);
  }
};

struct ReadColumns {
  const Hdf5Reader& file;

  template <class T, class Check = decltype(kUnchecked)>
  void operator()(const std::string& name, std::vector<T>& column, Rows rows = {}, const Check& check = {}) const {
    if constexpr (std::is_same_v<T, std::string>) {
      column = rows.n == Rows::kAny ? file.read_strings(name) : file.read_string_rows(name, rows.n);
    } else {
      const std::size_t n_numbers = rows.n_numbers > 0 ? rows.n_numbers : Element<T>::count;
      column = rows.n == Rows::kAny ? file.read<T>(name, n_numbers) : file.read_rows<T>(name, rows.n, n_numbers);
    }
    check(file, name, column);
  }
};

}  // namespace st
