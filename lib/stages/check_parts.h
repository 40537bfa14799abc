// What st-check measures, of a whole mesh or of one share of it after the other. Internal to the check stage.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "base/progress.h"
#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"
#include "sizing/size_field.h"
#include "stages/check_cad.h"
#include "stages/check_report.h"
#include "stages/check_thresholds.h"

namespace st {

/// The geometry with what the checks need of it.
struct CadSide {
  double sewing = 0;  ///< what the user let st-import sew by, model unit; 0: its default, far below what is checked
  Model model;
  std::vector<std::uint8_t> may_be_open, may_be_nonmanifold;

  CadSide(GeometryArtifact&& g, const std::string& path);
  CadEdges edges() const { return {model.tables().edge_vertices, may_be_open, may_be_nonmanifold}; }
};

/// What all shares of a mesh are measured with.
struct CheckBasis {
  const CadSide* cad = nullptr;      ///< null: not given
  const SizeField* field = nullptr;  ///< null: not given
  const CheckStageOptions* options = nullptr;
  TriangleCounts counts;          ///< of the whole mesh
  Vec3 origin;                    ///< of cones for the volume
  std::vector<Vec3> face_place;   ///< face_places(), with a geometry
  std::vector<double> face_side;  ///< sides_of_faces(), likewise

  /// Of a mesh in memory.
  static CheckBasis of(const SurfaceMesh& mesh, const CadSide* cad, const SizeField* field,
                       const CheckStageOptions& options);
};

/// Everything that is measured of a share, and of several, one after the other.
struct CheckParts {
  TopologyReport topology;
  ShapeReport shape;
  std::vector<MeasurePart> measure;
  QualityParts quality;
  ConformityParts conformity;                 ///< with a sizing
  ChordParts chords;                          ///< with a geometry
  std::vector<DeviationSum::Part> deviation;  ///< likewise
  std::vector<FaceMoments> faces;             ///< likewise
  BadTriangles bad;
  ShapeCauses causes;               ///< with a geometry; of a whole mesh they are found later
  std::vector<TrianglePair> pairs;  ///< that cross, by their numbers in the whole mesh
  std::int64_t n_compared = 0;      ///< see find_crossing_triangles()
  bool was_ended = false;           ///< likewise

  /// Those of the next share. What only that share has the triangles for stays there.
  void add(const CheckParts& next, const TriangleCounts& counts);
  static auto fields(auto& p) {
    return std::tie(p.topology, p.shape, p.measure, p.quality, p.conformity, p.chords, p.deviation, p.faces, p.bad,
                    p.causes, p.pairs, p.n_compared, p.was_ended);
  }
};

/// What they mean: fills in all of `f` that follows from them alone, and takes what it holds out of them.
void report_parts(const CheckBasis& basis, CheckParts& parts, const FaceLabels& labels, Findings& f);

/// Measures a share; crossings are those between own triangles. What needs no table of the edges comes first, without
/// one: it takes the most memory. `more`: jobs that run beside.
CheckParts measure_share(const CheckBasis& basis, const SurfaceMesh& mesh, const TriangleCorners& corners,
                         const OwnTriangles& own, std::vector<std::function<void()>> more, Progress& progress,
                         double share);

}  // namespace st
