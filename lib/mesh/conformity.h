// Lengths of edges against the requested sizes (docs/checks.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

#include "base/local_size.h"
#include "mesh/adjacency.h"
#include "mesh/kept_values.h"
#include "mesh/own_triangles.h"

namespace st {

/// Lengths of mesh edges over the requested lengths.
struct ConformityStats {
  static constexpr double kBinWidth = 0.1;
  std::int64_t n_edges = 0, n_within = 0;    ///< within [kConformityMin, kConformityMax]
  double min = 0, max = 0, sum = 0;          ///< of the ratio
  std::array<std::int64_t, 21> histogram{};  ///< edges by ratio in [0.1 k, 0.1 k + 0.1), the last without end
  double share() const { return n_edges ? static_cast<double>(n_within) / static_cast<double>(n_edges) : 1.0; }
  double mean() const { return n_edges ? sum / static_cast<double>(n_edges) : 1.0; }
  void add(double ratio);
  void add(const ConformityStats& other);
};

inline constexpr double kConformityMin = 0.7, kConformityMax = 1.4;

/// Mesh edges shorter than kConformityMin because the CAD leaves no choice.
struct ForcedPlace {
  enum class Kind : std::uint8_t {
    kShortEdge,  ///< along a CAD edge of at most three segments: it is shorter than its sizes, or a loop that needs its
                 ///< three sides
    kStrip       ///< across a face, from boundary to boundary: a strip or corner thinner than its sizes
  };
  Kind kind = Kind::kShortEdge;
  std::int32_t entity = kNone;  ///< CAD edge (kNone: between two vertices) or, for a strip, CAD face
  std::int64_t n_edges = 0;     ///< mesh edges there
  double min_ratio = 0;         ///< the shortest of them over its requested length
  Vec3 xyz;                     ///< the middle of that one, model unit
};

struct ConformityReport {
  struct OutsideEdge {
    NodeId a, b;
    TriangleId triangle, other;  ///< the first two at the edge; `other` kNone at a rim
    double ratio;
  };
  ConformityStats model;
  ConformityStats free;             ///< all edges but those of `forced`
  std::vector<ForcedPlace> forced;  ///< by kind and entity; between two vertices: one each
  ConformityStats inner;            ///< edges with a node inside a face: nothing of the CAD forces their length
  std::vector<ConformityStats> groups, faces;  ///< an edge counts for the face of its first triangle
  std::vector<OutsideEdge> outside;  ///< edges of `free` outside [kConformityMin, kConformityMax], by their nodes
  double p1 = 1, p99 = 1;            ///< percentiles of the ratio
};

/// What shares of a mesh add to a ConformityReport.
struct ConformityParts {
  struct Part {
    FaceId face;
    std::int32_t group;
    ConformityStats inner, rim, forced;  ///< edges with a node inside a face; others; those that the CAD forces
  };
  /// Kind, entity, or the two nodes of an edge between vertices.
  using ForcedKey = std::tuple<ForcedPlace::Kind, std::int32_t, NodeId, NodeId>;
  struct Forced {
    ForcedPlace::Kind kind;
    std::int32_t entity;
    NodeId a, b;
    std::int64_t order;  ///< of the edge at `place`
    ForcedPlace place;
    ForcedKey key() const { return {kind, entity, a, b}; }
  };
  std::vector<Part> parts;                             ///< by piece of the edges' first triangles, face and group
  std::vector<Forced> forced;                          ///< by key
  KeptValues lowest, highest;                          ///< of the ratio: as many as percentiles need
  std::vector<ConformityReport::OutsideEdge> outside;  ///< of this share, which has its nodes

  /// Those of the next share, but for its edges outside.
  void add(const ConformityParts& next, std::int64_t n_triangles);
  static auto fields(auto& p) { return std::tie(p.parts, p.forced, p.lowest, p.highest); }
};

/// As SizeField::local; may be called on several threads.
using RequestedSize = std::function<LocalSize(Vec3, int& hint)>;
/// As SizeField::length_along; likewise.
using RequestedLength = std::function<double(Vec3, Vec3 way, int& hint)>;

/// Ratio of an edge: its length times the mean of 1/requested over it (Simpson's rule on its ends and middle).
/// `requested_length(xyz) > 0` in model units. Forced is an edge below kConformityMin with both ends on the boundary of
/// faces that lies on a CAD edge of at most three segments, between two CAD vertices, or across a face. `along`: asked
/// for each edge instead, where planes matter. Local, linear.
ConformityReport measure_conformity(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                    const RequestedLength& along = {});
/// `n_triangles`: of the whole mesh.
ConformityParts measure_conformity(const SurfaceMesh& mesh, const EdgeTable& edges, const RequestedSize& requested,
                                   const RequestedLength& along, const OwnTriangles& own, std::int64_t n_triangles);
/// Of all parts; `n_groups`, `n_faces`: of the lists, at least.
ConformityReport report_conformity(ConformityParts&& parts, std::size_t n_groups, std::size_t n_faces);

}  // namespace st
