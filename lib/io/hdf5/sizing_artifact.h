// raster.hdf and sizing.hdf: the octree before and after prolongation.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/hdf5/artifact.h"
#include "sizing/blanking.h"
#include "sizing/face_cells.h"
#include "sizing/octree.h"
#include "sizing/octree_field.h"
#include "sizing/sample_seeds.h"
#include "sizing/source_set.h"
#include "sizing/wing_record.h"

namespace st {

/// Schema versions that this build writes and reads.
inline constexpr int kRasterVersion = 8, kSizingVersion = 10;

/// Resolved numbers of the sampling, model unit.
struct SizingNumbers {
  double min_length = 0;       ///< smallest sample length
  double max_length = 0;       ///< largest sample length on walls
  double far_length = 0;       ///< length where nothing asks for less: the largest of all groups, >= max_length
  double alpha_deg = 0;        ///< largest turning along one length, degrees
  double cell_per_length = 0;  ///< edge of a raster box over its sample length
  double diagonal = 0;         ///< what per cents refer to: of the box of all walls
  double max_aspect = 1;       ///< largest length along a direction over the length across
};

/// Names of what causes of lengths refer to; UTF-8, empty where there is none.
struct CauseNames {
  std::vector<std::string> edge;    ///< [n_edges]
  std::vector<std::string> face;    ///< [n_faces]
  std::vector<std::string> source;  ///< [n_sources] of sizing.hdf only
};

/// "edge 12 \"TE\"", "face 3", "source \"wake\"", "the background mesh", "the largest length". See pack_cause.
std::string cause_text(const CauseNames& names, std::int32_t cause);

/// Lengths of one cause below the least length that is given where they are (lmin).
struct Undercut {
  std::int32_t cause = kNone;  ///< see pack_cause
  std::int64_t n = 0;          ///< samples of the raster, or places of faces in cells, > 0
  double least = 0;            ///< model unit, before scale
  Vec3 place;                  ///< of the first, model unit

  bool operator==(const Undercut&) const = default;
};

/// What rasters and sizings know of the model besides lengths.
struct SizedModel {
  FaceCells faces;                     ///< where in the octree each face lies, with its area there
  std::vector<std::string> edge_name;  ///< [n_edges]; "": none
  FaceLabels labels;                   ///< names of faces, and groups for slopes of groups, or none
  std::vector<WingRecord> wings;       ///< lifting surfaces, in the octree's own frame and before scale
  std::vector<double> face_lmin;       ///< [n_faces] least length that is given for it, 0: none; empty: for none
  std::vector<Undercut> undercuts;     ///< lengths below that, by what causes them, most first: of a raster samples of
                                       ///< strips and bases, of a sizing the field on faces

  CauseNames cause_names(std::vector<std::string> sources = {}) const {
    return {edge_name, labels.face_name, std::move(sources)};
  }
};

/// raster.hdf
struct RasterArtifact {
  ArtifactHeader header;
  SizingNumbers numbers;
  RasterOctree octree;
  std::vector<LengthSample> samples;  ///< all samples; rounded from model.faces.origin
  BlankSurface surface;               ///< coarse triangles of a closed model; empty: not closed
  SizedModel model;
  std::int64_t n_not_sampled = 0;  ///< faces and batches of edges that could not be sampled; > 0: the raster is
                                   ///< incomplete
};

/// sizing.hdf
struct SizingArtifact {
  ArtifactHeader header;
  SizingNumbers numbers;
  double slope = 0;  ///< largest change of length per distance, before `scale`
  double scale = 1;  ///< multiplies every length of a query
  Similarity frame;  ///< the octree's point x lies at frame(x) of the model: it moved with its geometry. Lengths below
                     ///< are as before
  OctreeShape shape;
  ProlongedLengths lengths;
  ConeTable cones;    ///< tell the lengths; `lengths` are those at the leaves' centres. Empty: one length everywhere
  SourceSet sources;  ///< count besides, everywhere
  Blanking blanking;  ///< colours and splits; empty: no surface blanks anything. Links are not stored
  SizedModel model;
  std::vector<double> face_weight;  ///< [n_faces] integral of 1/h^2: number of triangles times sqrt(3)/4
  std::vector<std::string> source_name;

  CauseNames cause_names() const { return model.cause_names(source_name); }
  /// Views of the arrays above, in the octree's own frame. `tree`: of `sources`.
  OctreeFieldData field_data(const SourceTree* tree) const {
    OctreeFieldData data{shape.view(),
                         lengths.cells,
                         lengths.cause,
                         slope,
                         scale,
                         blanking.split_leaf,
                         blanking.split,
                         lengths.second_cells,
                         lengths.second_cause,
                         numbers.max_aspect};
    data.set_cones(cones, numbers.far_length);
    data.sources = tree;
    return data;
  }
  /// The field over these arrays, in the octree's own frame; in the model's with `frame`.
  std::unique_ptr<OctreeField> field(const Similarity& of = {}) const;
};

/// As all write_* and read_* of io/hdf5/artifact.h: atomic, checked, Error(kOutput) and Error(kInput).
std::string write_raster(const std::string& path, const RasterArtifact& raster);
RasterArtifact read_raster(const std::string& path);
std::string write_sizing(const std::string& path, const SizingArtifact& sizing);
SizingArtifact read_sizing(const std::string& path);

/// A sizing artifact as a field over the mapped file: costs no memory of its own, shared by all processes of a machine.
struct MappedSizing {
  ArtifactHeader header;
  SizingNumbers numbers;
  std::vector<double> face_weight;  ///< see SizingArtifact
  std::unique_ptr<OctreeField> field;
};
MappedSizing map_sizing(const std::string& path);

/// Names of a sizing artifact alone.
CauseNames read_cause_names(const std::string& path);

/// Lifting surfaces of a sizing artifact alone, where they lie in the model, with what its lengths ask for.
std::vector<WingRecord> read_asked_wings(const std::string& path);

/// The field alone; `header` may be null. Throws Error(kInput).
std::unique_ptr<SizeField> open_sizing(const std::string& path, ArtifactHeader* header);

}  // namespace st
