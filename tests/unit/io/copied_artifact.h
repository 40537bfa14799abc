// Artifacts written again, part by part, some of them changed: all hashes fit.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "io/hdf5/hdf5_file.h"

namespace st {

/// `change(name, values, columns)` may alter the values of any dataset, and of any attribute ("/st@slope"), which are
/// a vector of one; where it says false the part is left out. Strings for VTK are "name" each. Attributes of the header
/// stay as they are.
template <class Change>
void copy_artifact(const Hdf5Reader& in, const std::string& to, const Change& change) {
  Hdf5Writer out(to, in.header());
  for (const DatasetInfo& d : in.datasets()) {
    if (d.is_foreign) {
      std::vector<std::string> values(d.shape[0], "name");
      if (change(d.name, values, std::size_t{1})) out.write_vtk_strings(d.name, values);
      continue;
    }
    with_element(d.type, [&](const auto& element) {
      using T = std::decay_t<decltype(element)>;
      const std::size_t columns = d.shape.size() > 1 ? d.shape[1] : 1;
      if constexpr (std::is_same_v<T, std::string>) {
        std::vector<T> values = in.read_strings(d.name);
        if (change(d.name, values, columns)) out.write_strings(d.name, values);
      } else {
        std::vector<T> values = in.read<T>(d.name, columns);
        if (change(d.name, values, columns)) out.write<T>(d.name, values, columns);
      }
    });
  }
  for (const AttributeSummary& a : in.content_attributes()) {
    const std::size_t at = a.name.find('@');
    const std::string group = a.name.substr(0, at), name = a.name.substr(at + 1);
    if (name == "schema" || name == "schema_version" || name.rfind("unit", 0) == 0) continue;  // of the header
    std::visit(
        [&](const auto& value) {
          std::vector<std::decay_t<decltype(value)>> values{value};
          if (change(a.name, values, std::size_t{1})) out.set_attribute(group, name, values[0]);
        },
        a.value);
  }
  out.commit();
}

}  // namespace st
