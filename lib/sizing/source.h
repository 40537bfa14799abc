// Lengths asked for in space besides the raster: point, line and triangle sources, volumes, and the cells of a
// background mesh.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/similarity.h"
#include "sizing/size_field.h"

namespace st {

/// Bounds of a length over a cube.
struct SizeRange {
  double lo = 0, hi = 0;    ///< lo <= length <= hi wherever the source asks for something; lo = infinity: it asks for
                            ///< nothing there
  bool meets_core = false;  ///< part of the cube may lie where the length is constant and smallest
  bool has_detail = false;  ///< the length may do more in the cube than grow evenly: its values at a few points do not
                            ///< tell
};

/// Something that asks for lengths in space. A new kind of source is a new implementation.
class SizeSource : public SizeField {
 public:
  using SizeField::size;
  /// Bounds over the cube center +- half; they may be wide, but tighten as the cube shrinks.
  virtual SizeRange range(Vec3 center, double half) const = 0;
  /// Whether it asks for something everywhere, and if not, whether at `xyz`; elsewhere size() continues what holds at
  /// the border.
  virtual bool is_everywhere() const { return true; }
  virtual bool covers(Vec3) const { return true; }
  /// Largest ratio of the two lengths of local().
  virtual double max_aspect() const { return 1; }
};

enum class SourceKind { kPoint, kLine, kTriangle, kBox, kCylinder, kSphere, kDisc };

/// What a source asks for at one of its points (FLITE): `length` up to the distance `radius`, twice as much at
/// `doubling`, growing exponentially, but never faster than the slope.
struct SourceSpacing {
  double length = 0;    ///< model unit, > 0
  double radius = 0;    ///< model unit, >= 0
  double doubling = 0;  ///< model unit; <= radius: growth by the slope alone
};

/// A source as the user describes it.
struct SourceSpec {
  std::string name;
  SourceKind kind = SourceKind::kPoint;
  std::array<Vec3, 3> point;  ///< point; ends; corners; centre of box, sphere, disc; ends of the cylinder's axis
  std::array<SourceSpacing, 3> spacing;  ///< at each point of point, line and triangle; [0] for the others
  std::array<Vec3, 3> half_axis;         ///< box: its three half axes; disc: [0] the normal
  double extent = 0;                     ///< radius of cylinder, sphere, disc: the length is constant inside
  double aspect = 1;                     ///< >= 1: length along `direction` over that across
  Vec3 direction = {};                   ///< unit, where aspect > 1
};

/// Points of a line or triangle, 1 for the rest.
int n_spacings(SourceKind kind);

/// A line whose ends are one point becomes a point, a triangle whose corners lie on a line a line (or a point), with
/// the spacings of those ends; of several spacings at one place the one of the smallest length. False: it is neither.
bool simplify(SourceSpec& source);

/// A box around where the length is constant: points and volumes with their radii.
Box3 core_box(const SourceSpec& source);

/// Positions and directions are moved; lengths, radii and extents are scaled.
void transform(const Similarity& motion, SourceSpec& source);

/// The source as a field that grows by at most `slope`. Precondition: lengths > 0, radii >= 0, slope > 0.
std::unique_ptr<SizeSource> make_source(const SourceSpec& spec, double slope);

/// A background mesh: lengths at the nodes of tetrahedra, linear inside. In each tetrahedron one direction may have a
/// longer length: the one along which its nodes together are stretched most.
struct BackgroundMesh {
  std::vector<Vec3> node_xyz;
  std::vector<LocalSize> node_size;
  std::vector<std::array<std::int32_t, 4>> tets;  ///< nodes, any orientation
};

/// Takes the smallest length in all directions; the number of nodes that had a longer one.
std::int64_t remove_stretch(BackgroundMesh& mesh);

void transform(const Similarity& motion, BackgroundMesh& mesh);

/// One source per tetrahedron; flat ones are left out.
std::vector<std::unique_ptr<SizeSource>> make_sources(const BackgroundMesh& mesh);

}  // namespace st
