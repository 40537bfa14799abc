// The table of source types: all that the tools know of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sizing/source.h"

namespace st {

/// What a key of an option file's [[source]] sets.
enum class SourceKey : unsigned char {
  kFirstPoint,   ///< point[0] = [x, y, z]
  kSecondPoint,  ///< point[1]
  kPoints,       ///< as many points as there are spacings
  kDirection,    ///< half_axis[0] = [x, y, z]
  kExtent        ///< extent, the radius of a volume: a length
};

/// A type of source. A new one is a class (SizeSource: smallest spacing, spacing at a point) and an entry of
/// source_types(): then option files may have it, sizing.hdf stores it, and fields ask it.
struct SourceType {
  struct Key {
    const char* name;
    SourceKey sets;
  };
  SourceKind kind;        ///< as stored in sizing.hdf; no other type's
  const char* name;       ///< type = "..." in option files
  std::vector<Key> keys;  ///< that it needs besides its lengths
  std::unique_ptr<SizeSource> (*make)(const SourceSpec&, double slope);
  int n_spacings = 1;     ///< lengths, radii and doublings, up to 3: one for each of `kPoints`
  bool has_axis = false;  ///< a stretch runs from the first to the second point unless it is told
  /// Makes what the keys set complete; returns what is wrong with it, empty: nothing. Null: it is complete.
  std::string (*complete)(SourceSpec&) = nullptr;
};

/// The table, in the order in which messages name them. A test may add to it.
std::vector<SourceType>& source_types();

/// nullptr: there is none.
const SourceType* find_source_type(SourceKind kind);
const SourceType* find_source_type(const std::string& name);

/// "point, line, ... or disc"
std::string source_type_names();

}  // namespace st
