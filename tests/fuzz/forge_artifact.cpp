// forge_artifact IN OUT SEED: the artifact with some values, rows or attributes changed, and checksums that fit.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_file.h"

namespace {

using st::DatasetInfo;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) { return n ? random() % n : 0; }

/// What breaks a reader that trusts: limits of the type, signs, numbers that are none.
template <class T>
T hostile_value(Random& random, T old) {
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_floating_point_v<T>) {
    const T values[] = {Limits::quiet_NaN(),
                        Limits::infinity(),
                        -Limits::infinity(),
                        Limits::max(),
                        Limits::lowest(),
                        Limits::denorm_min(),
                        T(0),
                        T(-1),
                        -old,
                        old * T(1e6),
                        old * T(1e-6),
                        old + T(1)};
    return values[below(random, std::size(values))];
  } else {
    const T values[] = {Limits::max(), Limits::min(), T(0),    T(1),       T(-1),      T(old + 1),
                        T(old - 1),    T(~old),       T(1000), T(1 << 24), T(random())};
    return values[below(random, std::size(values))];
  }
}

/// One way to spoil the values of a dataset of `columns` columns; the number of rows may change.
template <class T>
void spoil(Random& random, std::size_t columns, std::vector<T>& values) {
  const std::size_t n_rows = values.size() / columns;
  if (n_rows == 0) return values.assign(columns, hostile_value(random, T(0)));
  const std::size_t at = below(random, values.size()), row = below(random, n_rows);
  switch (below(random, 9)) {
    case 0:
      return std::fill(values.begin(), values.end(), hostile_value(random, values[at]));
    case 1:
      return std::shuffle(values.begin(), values.end(), random);
    case 2:
      return std::reverse(values.begin(), values.end());
    case 3:  // a row twice
      for (std::size_t c = 0; c < columns; ++c) values[below(random, n_rows) * columns + c] = values[row * columns + c];
      return;
    case 4:  // rows missing
      return values.resize(row * columns);
    case 5:  // more rows
      return values.insert(values.end(), columns, hostile_value(random, values[at])), void();
    case 6:
      return std::swap(values[at], values[below(random, values.size())]);
    default:
      values[at] = hostile_value(random, values[at]);
  }
}

/// Copies a dataset, spoilt or not.
template <class T>
void copy(const st::Hdf5Reader& in, const DatasetInfo& d, Random* random, st::Hdf5Writer& out) {
  const std::size_t columns = d.shape.size() > 1 ? d.shape[1] : 1;
  std::vector<T> values = in.read<T>(d.name, columns);
  if (random) spoil(*random, columns, values);
  out.write<T>(d.name, values, columns);
}

void copy_strings(const st::Hdf5Reader& in, const DatasetInfo& d, Random* random, st::Hdf5Writer& out) {
  if (d.is_foreign) return out.write_vtk_strings(d.name, std::vector<std::string>(d.shape[0], "name"));
  std::vector<std::string> values = in.read_strings(d.name);
  const std::string bad[] = {"",     std::string(100000, 'x'), "\x1b[2J\n\r\x07", "\xff\xfe\xc0", "{\"a\":[[[[", "%n%s",
                             "../.."};
  if (random && values.empty()) values.assign(1, "more");
  if (random) values[below(*random, values.size())] = bad[below(*random, std::size(bad))];
  if (random && below(*random, 4) == 0) values.pop_back();
  out.write_strings(d.name, values);
}

void copy_dataset(const st::Hdf5Reader& in, const DatasetInfo& d, Random* random, st::Hdf5Writer& out) {
  st::with_element(d.type, [&](const auto& element) {
    using T = std::decay_t<decltype(element)>;
    if constexpr (std::is_same_v<T, std::string>)
      copy_strings(in, d, random, out);
    else
      copy<T>(in, d, random, out);
  });
}

void copy_attribute(const st::AttributeSummary& a, Random* random, st::Hdf5Writer& out) {
  const std::size_t at = a.name.find('@');
  const std::string group = a.name.substr(0, at), name = a.name.substr(at + 1);
  if (name == "schema" || name == "schema_version" || name.rfind("unit", 0) == 0) return;  // of the header
  if (const auto* text = std::get_if<std::string>(&a.value))
    out.set_attribute(group, name, random ? *text + "\xff" : *text);
  if (const auto* number = std::get_if<double>(&a.value))
    out.set_attribute(group, name, random ? hostile_value(*random, *number) : *number);
  if (const auto* integer = std::get_if<std::int64_t>(&a.value))
    out.set_attribute(group, name, random ? hostile_value(*random, *integer) : *integer);
}

void forge(const std::string& from, const std::string& to, std::uint64_t seed) {
  const st::Hdf5Reader in(from);
  const std::vector<st::AttributeSummary> attributes = in.content_attributes();
  Random random(seed);
  std::vector<std::size_t> chosen(1 + below(random, 2));
  for (std::size_t& c : chosen) c = below(random, in.datasets().size() + attributes.size());
  const auto is_chosen = [&](std::size_t i) { return std::count(chosen.begin(), chosen.end(), i) ? &random : nullptr; };
  st::Hdf5Writer out(to, in.header());
  for (std::size_t i = 0; i < in.datasets().size(); ++i) copy_dataset(in, in.datasets()[i], is_chosen(i), out);
  for (std::size_t i = 0; i < attributes.size(); ++i)
    copy_attribute(attributes[i], is_chosen(in.datasets().size() + i), out);
  out.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    forge(argv[1], argv[2], std::stoull(argv[3]));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "forge_artifact: %s\n", e.what());
    return 1;
  }
  return 0;
}
