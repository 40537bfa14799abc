// Faces between two long edges: trailing edges, thin walls' rims, chamfers. Their width asks for sizes that no
// curvature shows.
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "base/executor.h"
#include "geometry/model/model.h"

namespace st {

/// A face with one loop of two long edges, measured at equal shares of their lengths, closely enough to follow the
/// turns of a helix.
struct Strip {
  static constexpr double kInexact = 2;
  FaceId face = kNone;
  std::vector<FaceId> others = {};             ///< of a base of several strips beside each other: all but the first
  EdgeId edges[2] = {kNone, kNone};            ///< the long edges, the lower id first
  bool is_opposed = false;                     ///< they run against each other
  double length = 0;                           ///< of the first, model unit
  std::optional<int> cut_side = std::nullopt;  ///< 0 or 1: the side of a base in pieces on which the first edge lies
  double row = 0;    ///< of all strips that go on end to end in about one line, model unit; set for bases
  double exact = 0;  ///< model unit; above 0: its edges cross, so that where they are nearer they are one
  struct Station {
    Vec3 x;       ///< on the first edge
    Vec3 across;  ///< from there to the other edge
    double width() const { return norm(across); }
    Vec3 middle() const { return x + 0.5 * across; }
  };
  std::vector<Station> stations;  ///< from the start of the first edge to its end

  static auto fields(auto& s) {
    return std::tie(s.face, s.others, s.edges, s.is_opposed, s.length, s.cut_side, s.row, s.exact, s.stations);
  }

  /// Between two stations; `share` of the way, 0 to 1.
  Station at(double share) const;
  /// Whether a width asks for sizes: not where edges that cross are no further apart than twice `exact`.
  bool tells(double width) const { return width > kInexact * exact; }
  /// Whether it tells nowhere.
  bool is_one_edge() const;
};

/// Faces whose two long edges are open, belong to one other face each, are of about equal length and four times longer
/// than the face is wide on average, ascending. Collective: some faces are a task; the same on every rank.
std::vector<Strip> find_strips(const Model& model, const Executor& executor = SerialExecutor());

/// Likewise faces between two closed edges, and no others but a seam: the base of a ring. Local.
std::vector<Strip> find_rings(const Model& model);

/// A strip of which the face and the edges are known, the lower id first. Local.
Strip measured_strip(const Model& model, FaceId face, EdgeId a, EdgeId b);

/// Strip::exact of the strip between two edges, the lower id first. Local.
double strip_exactness(const Model& model, EdgeId first, EdgeId second, bool is_opposed);

/// The two sides of a face with one loop: one edge, and across from it one or several end to end.
struct StripSides {
  struct Side {
    EdgeId edge = kNone;
    bool is_opposed = false;  ///< it runs against `single`
  };
  FaceId face = kNone;
  EdgeId single = kNone;
  std::vector<Side> across;  ///< in the direction of `single`
  double width = 0;          ///< on the mean, model unit
};

/// Faces whose two sides are open, belong to one other face each, are of about equal length and four times longer than
/// the face is wide on average, ascending. Cheap. Local.
std::vector<StripSides> find_strip_sides(const ModelTables& tables);

}  // namespace st
