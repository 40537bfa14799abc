// What st-check found, and its text. Internal to the check stage.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/model/model.h"
#include "judge/chord_error.h"
#include "judge/shape_causes.h"
#include "judge/surface_deviation.h"
#include "mesh/checks.h"
#include "mesh/conformity.h"
#include "mesh/quality.h"
#include "stages/check_stage.h"
#include "stages/wing_measure.h"

namespace st {

/// One line of the report: what was looked for, what was found.
struct Check {
  std::string name;  ///< "closed", "folds" ...
  std::string what;  ///< what is counted: "open edges"
  Defects defects;
  bool decides = true;       ///< the mesh fails when more than `allowed` were found
  std::string note;          ///< added to the line, found or not
  std::int64_t allowed = 0;  ///< as many are accepted

  bool fails() const { return decides && defects.count > allowed; }
};

/// What a geometry tells of its mesh.
struct CadFindings {
  bool is_of_facets = false;           ///< the model is a file of facets, no CAD
  std::int64_t n_model_crossings = 0;  ///< crossings and overlapping neighbours where the model crosses itself
  ChordError chords;
  SurfaceDeviation deviation;
  ShapeCauses causes;
  std::vector<double> face_area;                             ///< [n_faces] model unit squared
  std::vector<std::int32_t> face_group;                      ///< [n_faces]
  std::optional<double> area_difference, volume_difference;  ///< of the whole mesh from the CAD, relative; volume where
                                                             ///< both have one
};

/// Everything that was measured.
struct Findings {
  std::int64_t n_triangles = 0;
  TopologyReport topology;
  ShapeReport shape;
  CrossingReport crossings;
  MeshMeasure measure;
  QualityReport quality;
  bool is_stretched = false;  ///< quality, growth and smallest angles are those that stretched sizes see
  std::optional<ConformityReport> conformity;  ///< with a sizing
  std::vector<WingMeasure> wings;              ///< likewise
  std::optional<CadFindings> cad;              ///< with a geometry
  std::vector<Check> checks;
  std::string unit = {};  ///< of lengths; empty: unknown

  bool passes() const;
  /// The count of the check of this name; 0 where it was not made.
  std::int64_t count(const std::string& check) const;
  /// Handles of all parts together, where the number means something.
  std::optional<std::int64_t> genus() const;
  /// Of the faces of each group of triangles.
  std::vector<DeviationStats> deviation_by_group() const;
};

/// "face 17 "WING_UPPER"", 1-based.
std::string face_label(const SurfaceMesh& mesh, FaceId f);

/// Whose the crossings are; empty where nothing is known.
std::string crossing_note(const Findings& f);

/// "passes, 2 faces below the sizes" or "FAILS: 3 open edges, first at ...".
std::string verdict(const SurfaceMesh& mesh, const Findings& f);

/// "0.25 mm"; `unit` may be empty.
std::string length_text(double length, const std::string& unit);

/// One line per check, quality, sizes, deviation; the last line is the verdict. `path`: the mesh's, for the verdict.
std::string check_report_text(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds);

/// What fails, six figures, the verdict, and lifting surfaces where `detail` has them.
std::string check_brief_text(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds,
                             CheckText detail);

}  // namespace st
