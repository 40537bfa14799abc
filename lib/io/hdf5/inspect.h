// Looking at any artifact without knowing its schema: what is in it, is it whole, how does it differ from another one.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "io/hdf5/artifact.h"

namespace st {

/// A dataset, without its values.
struct DatasetSummary {
  std::string name;                  ///< absolute path, "/st/face/area"
  std::string type;                  ///< "float64", "int32", "string" ...
  std::vector<std::uint64_t> shape;  ///< (n) or (n, columns)
};

/// An attribute of a group; provenance apart.
struct AttributeSummary {
  std::string name;  ///< "/st@is_closed"
  std::variant<std::string, std::int64_t, double> value;
};

struct ArtifactDescription {
  ArtifactHeader header;
  std::vector<DatasetSummary> datasets;      ///< by name
  std::vector<AttributeSummary> attributes;  ///< by name

  /// Rows of a dataset, 0 when there is none of this name.
  std::int64_t rows(const std::string& dataset) const;
  /// Value of an integer attribute, 0 when there is none of this name.
  std::int64_t integer(const std::string& attribute) const;
};

/// Describes an artifact of any schema and verifies the checksum of every dataset. Throws Error(kInput). Linear in the
/// size of the file.
ArtifactDescription describe_artifact(const std::string& path);

/// Where two artifacts differ: one line per dataset or attribute, empty when they say the same of the model (provenance
/// is not compared). Floating-point values may differ by `tolerance` relative to the larger of the two or, in rows of
/// several columns (points, vectors), to the largest value of the dataset; everything else must be equal. 0: bits.
/// Throws Error(kInput), and Error(kMismatch) for different schemas.
std::vector<std::string> compare_artifacts(const std::string& path_a, const std::string& path_b, double tolerance);

}  // namespace st
