// What a CAD file holds: parts with the names, colours and layers of their faces.
#pragma once

#include <TopoDS_Shape.hxx>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace st::occt {

/// One leaf part of the file, already in place, with what the file says of its faces.
struct CadPart {
  TopoDS_Shape shape;
  std::string name;  ///< UTF-8
  std::string path;  ///< "assembly/sub#2/bolt#3", unique; empty when neither it nor its assemblies have a name
  struct FaceAttributes {
    TopoDS_Shape face;
    std::string name, layer;
    std::int32_t color = -1;
    std::string body = {};                  ///< the face's solid in a part of several; else empty
    std::optional<bool> lies_as_said = {};  ///< on that side of its loops as in the file; nullopt: unknown
    bool has_seam = false;                  ///< in the file an edge is in one of its loops in both directions
  };
  std::vector<FaceAttributes> faces;  ///< in TopExp order
  struct EdgeName {
    TopoDS_Shape edge;
    std::string name;
  };
  std::vector<EdgeName> edges;
};

struct CadFile {
  std::string format;  ///< "STEP", "IGES", "BREP", "FLITE"
  std::vector<CadPart> parts;
  std::optional<double> unit_in_mm;  ///< of the file; nullopt: none (BREP, FLITE)
  bool has_mixed_units = false;
  bool has_voids = false;                  ///< solids with cavities that the file names
  std::vector<std::string> missing_files;  ///< that hold parts of an assembly and are not there; ascending
  std::vector<std::string> unread;         ///< what no shape was made of, "ADVANCED_FACE #17"
  double resolution_mm = 0;                ///< tolerance the file states, 0 when none
};

}  // namespace st::occt
