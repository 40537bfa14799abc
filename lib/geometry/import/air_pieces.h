// Parts of a model that hang together, and points of them: what the search for a flow domain looks at.
#pragma once

#include <TopoDS_Face.hxx>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/lists_by_key.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/model.h"

namespace st::occt {

/// A place on a face.
struct FaceSample {
  Vec3 xyz;     ///< model unit
  Vec3 normal;  ///< unit, du x dv: which way is open
};

/// Places inside the loops of a face, of a grid of (u,v); of a face that the grid misses, on its edges alone: none.
std::vector<FaceSample> sample_face(const TopoDS_Face& face);

/// Where a face begins at an edge, half way along it.
struct FaceRim {
  Vec3 into;  ///< from the edge into the face, square to it, unit
  Vec3 bend;  ///< curvature vector of the face along `into`, 1 / model unit; 0 where it cannot be told
};

/// A plane that holds whole faces, with all of the model on one side.
struct HullPlane {
  Vec3 point, normal;         ///< model unit; unit length, out of the model
  std::vector<FaceId> faces;  ///< ascending
  double area = 0;            ///< of these
};

/// Connected faces.
struct AirPiece {
  std::vector<FaceId> faces;  ///< ascending
  Box3 box;
};

/// About the largest distance of two points: the same however the model is turned.
double size_of(const std::vector<Vec3>& points);

/// Points and neighbours of a model's faces. Edges at one place count as one, faces with the same edges, too. Keeps
/// references to what it is made of.
class AirPieces {
 public:
  AirPieces(const ImportedShape& model, const ModelTables& tables);

  const ModelTables& tables() const { return t_; }
  const Box3& box() const { return box_; }
  double diagonal() const { return diagonal_; }
  TopoDS_Face face(FaceId f) const;
  /// sample_face() of it, made once.
  const std::vector<FaceSample>& samples_of(FaceId f) const;
  /// Of all edges at one place.
  EdgeId first_edge(EdgeId e) const { return first_edge_[e]; }
  /// Three faces or more meet there.
  bool is_crowded(EdgeId e) const { return ways_.count(first_edge_[e]) > 0; }
  /// Faces that use an edge, or another one at its place; one that uses it twice appears twice.
  std::span<const FaceId> faces_at(EdgeId e) const { return faces_at_[static_cast<std::size_t>(first_edge_[e])]; }

  /// Whether a piece ends at a crowded edge where two of the other's faces go on: a partition in a box, or the sides of
  /// a box that stands on another one.
  bool hangs_on(const AirPiece& piece, const AirPiece& other) const;

  /// Between the faces at an edge, or the two sides of a seam, radians in [0, pi]; pi where that cannot be told.
  double least_angle(EdgeId e) const;

  /// Of a face at one of its edges, once for each side of a seam; none where that cannot be told.
  std::vector<FaceRim> rims(FaceId f, EdgeId e) const;

  /// Large flat faces on the hull, in pieces or whole, and all faces in their planes, the largest area first.
  std::vector<HullPlane> hull_planes() const;

  /// Faces that are connected without those left out ([n_faces]), in the order of their first faces. An edge of three
  /// faces or more connects those two, of pieces that end there, that go on straight, within 20 degrees: a sheet hangs
  /// on what it divides.
  std::vector<AirPiece> pieces_without(const std::vector<char>& is_left_out) const;

  /// On an edge: both ends and three places between.
  std::vector<Vec3> points_of(EdgeId e) const;
  /// The same for all edges of faces.
  std::vector<Vec3> edge_points(std::span<const FaceId> faces) const;

 private:
  bool has_edges_in(FaceId f, const HullPlane& plane, double tolerance) const;
  bool is_in_plane(FaceId f, const HullPlane& plane) const;
  std::optional<HullPlane> hull_plane_of(FaceId f) const;
  std::optional<HullPlane> rough_plane_of(FaceId f) const;
  /// False: the model is on both sides.
  bool turn_outward(HullPlane& plane, double rounding) const;
  bool is_large(const HullPlane& plane) const;
  struct Way {
    FaceId face = kNone;
    Vec3 into;  // from the edge into the face, unit
  };
  void find_edge_points();
  void find_first_edges();
  bool are_at_one_place(EdgeId a, EdgeId b) const;
  void find_first_faces();
  void find_ways();
  /// The straightest of all pairs.
  static std::optional<std::pair<FaceId, FaceId>> straight_pair(std::span<const Way> at);

  const ImportedShape& model_;
  const ModelTables& t_;
  TopTools_IndexedMapOfShape edges_;
  std::vector<EdgeId> first_edge_;  // [n_edges] of all at its place: solids that touch may have edges each
  std::vector<FaceId> first_face_;  // [n_faces] of all with the same edges, and so of those that are there twice
  ListsByKey<FaceId> faces_at_;     // by first edge
  std::vector<Vec3> edge_points_;   // [5 * n_edges] of poles their vertex
  std::map<EdgeId, std::vector<Way>> ways_;                    // of edges of three faces or more
  mutable std::map<FaceId, std::vector<FaceSample>> samples_;  // of faces that were asked for
  Box3 box_;
  double diagonal_ = 0;
};

}  // namespace st::occt
