#include "io/hdf5/inspect.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <type_traits>

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"

namespace st {
namespace {

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + ")";
}

std::size_t columns_of(const DatasetInfo& d) { return d.shape.size() == 2 ? d.shape[1] : 1; }

template <class T>
std::string value_text(const T& value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}
std::string value_text(const std::string& value) { return "'" + value + "'"; }

template <class T>
bool are_same(const T& a, const T& b) {
  if constexpr (std::is_same_v<T, double>)
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  else if constexpr (std::is_same_v<T, float>)
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  else
    return a == b;
}

/// Allowed difference between two floating-point values: relative to them, or to `scale` when it is positive.
template <class T>
double allowed(const T& a, const T& b, double tolerance, double scale) {
  if constexpr (!std::is_floating_point_v<T>)
    return 0;
  else
    return tolerance *
           (scale > 0 ? scale : std::max(std::abs(static_cast<double>(a)), std::abs(static_cast<double>(b))));
}

template <class T>
double scale_of(const std::vector<T>& a, const std::vector<T>& b, std::size_t columns) {
  double scale = 0;
  if constexpr (std::is_floating_point_v<T>) {
    if (columns == 1) return 0;
    for (const std::vector<T>* values : {&a, &b})
      for (const T v : *values)
        if (std::isfinite(v)) scale = std::max(scale, std::abs(static_cast<double>(v)));
  }
  return scale;
}

/// "" when equal, else what differs. Precondition: same length.
template <class T>
std::string compare_values(const std::vector<T>& a, const std::vector<T>& b, std::size_t columns, double tolerance) {
  const double scale = scale_of(a, b, columns);
  std::size_t n_different = 0, first = 0;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (are_same(a[i], b[i])) continue;
    if constexpr (std::is_floating_point_v<T>) {
      const double difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      if (difference <= allowed(a[i], b[i], tolerance, scale) && tolerance > 0) continue;
      largest = std::max(largest, difference);
    }
    if (n_different++ == 0) first = i;
  }
  if (n_different == 0) return "";
  std::string text = std::to_string(n_different) + " of " + std::to_string(a.size()) + " values differ, first in row " +
                     std::to_string(first / columns);
  if (columns > 1) text += " column " + std::to_string(first % columns);
  text += ": " + value_text(a[first]) + " against " + value_text(b[first]);
  if (largest > 0) text += "; largest difference " + value_text(largest);
  return text;
}

std::string compare_dataset(const Hdf5Reader& a, const Hdf5Reader& b, const DatasetInfo& in_a, double tolerance) {
  if (!b.has(in_a.name)) return "only in the first";
  const DatasetInfo& in_b = b.info(in_a.name);
  if (in_a.type != in_b.type)
    return std::string(element_type_name(in_a.type)) + " against " + element_type_name(in_b.type);
  if (in_a.shape != in_b.shape) return "shape " + shape_text(in_a.shape) + " against " + shape_text(in_b.shape);
  if (in_a.is_foreign) return "";  // a copy of another dataset
  return with_element(in_a.type, [&](const auto& element) {
    using T = std::decay_t<decltype(element)>;
    if constexpr (std::is_same_v<T, std::string>) {
      return compare_values(a.read_strings(in_a.name), b.read_strings(in_a.name), 1, 0);
    } else {
      const std::size_t columns = columns_of(in_a);
      return compare_values(a.read<T>(in_a.name, columns), b.read<T>(in_a.name, columns), columns, tolerance);
    }
  });
}

using AttributeMap = std::map<std::string, std::variant<std::string, std::int64_t, double>>;

AttributeMap attribute_map(const Hdf5Reader& reader) {
  AttributeMap map;
  for (const AttributeSummary& a : reader.content_attributes()) map[a.name] = a.value;
  return map;
}

std::string compare_attribute(const AttributeMap::mapped_type& a, const AttributeMap::mapped_type& b,
                              double tolerance) {
  if (a.index() != b.index()) return "of different types";
  return std::visit(
      [&](const auto& value) {
        using T = std::decay_t<decltype(value)>;
        const T& other = std::get<T>(b);
        return compare_values(std::vector<T>{value}, std::vector<T>{other}, 1, tolerance).empty()
                   ? std::string()
                   : value_text(value) + " against " + value_text(other);
      },
      a);
}

void compare_attributes(const Hdf5Reader& a, const Hdf5Reader& b, double tolerance,
                        std::vector<std::string>& differences) {
  const AttributeMap in_a = attribute_map(a), in_b = attribute_map(b);
  for (const auto& [name, value] : in_a) {
    const auto it = in_b.find(name);
    const std::string text = it == in_b.end() ? "only in the first" : compare_attribute(value, it->second, tolerance);
    if (!text.empty()) differences.push_back(name + ": " + text);
  }
  for (const auto& [name, value] : in_b)
    if (!in_a.count(name)) differences.push_back(name + ": only in the second");
}

}  // namespace

std::int64_t ArtifactDescription::rows(const std::string& dataset) const {
  for (const DatasetSummary& d : datasets)
    if (d.name == dataset) return static_cast<std::int64_t>(d.shape[0]);
  return 0;
}

std::int64_t ArtifactDescription::integer(const std::string& attribute) const {
  for (const AttributeSummary& a : attributes)
    if (a.name == attribute)
      if (const auto* value = std::get_if<std::int64_t>(&a.value)) return *value;
  return 0;
}

ArtifactDescription describe_artifact(const std::string& path) {
  const Hdf5Reader reader(path);
  ArtifactDescription description;
  description.header = reader.header();
  description.attributes = reader.content_attributes();
  for (const DatasetInfo& d : reader.datasets()) {
    reader.verify(d.name);
    description.datasets.push_back({d.name, element_type_name(d.type), d.shape});
  }
  return description;
}

std::vector<std::string> compare_artifacts(const std::string& path_a, const std::string& path_b, double tolerance) {
  const Hdf5Reader a(path_a), b(path_b);
  if (a.header().schema != b.header().schema)
    throw Error(ExitCode::kMismatch, path_a + " is a " + a.header().schema + " artifact, " + path_b + " a " +
                                         b.header().schema + " artifact; compare two of the same kind");
  std::vector<std::string> differences;
  compare_attributes(a, b, tolerance, differences);
  for (const DatasetInfo& d : a.datasets()) {
    if (is_provenance(d.name)) continue;
    const std::string text = compare_dataset(a, b, d, tolerance);
    if (!text.empty()) differences.push_back(d.name + ": " + text);
  }
  for (const DatasetInfo& d : b.datasets())
    if (!a.has(d.name) && !is_provenance(d.name)) differences.push_back(d.name + ": only in the second");
  return differences;
}

}  // namespace st
