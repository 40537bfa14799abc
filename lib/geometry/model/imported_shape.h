// The B-Rep on its way through the import, and what every step asks of it.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "geometry/brep/cad_file.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/model/model.h"

namespace st::occt {

/// A part of the file, or one instance of it.
struct PartLabel {
  std::string name, path;  ///< of CadPart
};

/// What the file says of a face.
struct FaceAttributes {
  std::string name, layer, part;    ///< UTF-8, empty when the file has none
  std::int32_t color = kNone;       ///< 0xRRGGBB
  std::int32_t part_index = kNone;  ///< of ImportedShape::parts; kNone: a face that the import made
  bool is_sewn_by_group = false;    ///< its group's tolerance was used
  std::int32_t file_face = kNone;   ///< number in the file, from 0; kNone: a face that the import made
  std::string role = {};            ///< recognised by shape: "farfield", "symmetry", "interface"; empty: by its name
};

/// "face 3 of the file".
std::string file_label(std::int32_t file_face);

/// One shape, its faces in the order of their ids, and what the file said of faces and edges.
// NOLINTNEXTLINE(bugprone-exception-escape): OpenCASCADE's map copies itself where it is to be moved, and may throw
struct ImportedShape {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces;        ///< TopExp order of `shape`
  std::vector<FaceAttributes> attributes;  ///< [n_faces]
  std::vector<std::pair<TopoDS_Shape, std::string>> edge_names;
  std::vector<PartLabel> parts;

  /// Of a face, from 1, as the file counts: "face 3 of the file".
  std::string file_label(int face) const { return occt::file_label(attributes[face - 1].file_face); }
  /// Takes over `changed`, in which `images(face)` stands for a face of old (any shape with faces in it, or null when
  /// it is gone): the attributes follow. Returns false and changes nothing when `changed` has no face.
  bool replace(const TopoDS_Shape& changed, const std::function<TopoDS_Shape(const TopoDS_Shape&)>& image);
  /// rough_box() of the shape. It is made once for each shape: what becomes of its edges does not count. By one thread.
  const Box3& box() const;

 private:
  mutable TopoDS_Shape boxed_;  // whose box it is
  mutable Box3 box_;
};

/// All parts of the file in one compound. Throws Error(kGeometry) when there is no face.
ImportedShape collect_parts(const CadFile& file, const std::string& path);

}  // namespace st::occt
