// Shapes imported as mirrors of themselves.
#pragma once

#include <string>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st::test {

inline ImportResult import_mirrored(const std::string& shape, const std::string& plane) {
  const TemporaryDirectory dir;
  write_brep(shape, dir / "model.brep");
  ImportOptions options;
  options.air.mirror = plane;
  return import_model(dir / "model.brep", options);
}

/// The plane through the middle of the shape's box; tori are around the origin, and their boxes larger than they.
inline std::string middle_plane(const std::string& shape, char axis) {
  if (shape.find("torus") != std::string::npos) return std::string(1, axis) + "=0";
  const Vec3 c = import_shape(shape).tables.box().center();
  return std::string(1, axis) + "=" + std::to_string(axis == 'x' ? c.x : axis == 'y' ? c.y : c.z);
}

}  // namespace st::test
