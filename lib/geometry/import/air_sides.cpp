#include "geometry/import/air_sides.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/disjoint_sets.h"
#include "geometry/model/model_tables.h"
#include "geometry/model/rectangle_width.h"

namespace st::occt {
namespace {

constexpr double kStraight = -0.9999;  // cosine between the directions into both faces: 0.8 degrees
constexpr double kSameBend = 0.01;     // of the larger curvature, and of one over the model's diagonal

struct Use {
  std::int32_t face;  // among those asked for
  EdgeId edge;
};

class SideFinder {
 public:
  SideFinder(const AirPieces& pieces, std::span<const FaceId> faces)
      : pieces_(pieces), t_(pieces.tables()), faces_(faces), sets_(static_cast<std::int64_t>(faces.size())) {}

  std::vector<AirSide> run() {
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (const EdgeId e : t_.edges_of(faces_[i]))
        if (!t_.edge_is_degenerate[e]) uses_[pieces_.first_edge(e)].push_back({static_cast<std::int32_t>(i), e});
    for (const auto& [e, uses] : uses_)
      if (uses.size() == 2 && uses[0].face != uses[1].face && goes_on(uses[0], uses[1]))
        sets_.join(uses[0].face, uses[1].face);
    std::vector<AirSide> sides;
    for (const std::vector<std::int32_t>& some : sets_.groups()) sides.push_back(side_of(some));
    return sides;
  }

 private:
  bool goes_on(const Use& a, const Use& b) const {
    const auto p = pieces_.rims(faces_[a.face], a.edge), q = pieces_.rims(faces_[b.face], b.edge);
    if (p.size() != 1 || q.size() != 1 || dot(p[0].into, q[0].into) > kStraight) return false;
    const double largest = std::max({norm(p[0].bend), norm(q[0].bend), 1 / pieces_.diagonal()});
    return norm(p[0].bend - q[0].bend) <= kSameBend * largest;
  }

  AirSide side_of(const std::vector<std::int32_t>& some) {
    AirSide side;
    double perimeter = 0;
    for (const std::int32_t i : some) {
      const FaceId f = faces_[static_cast<std::size_t>(i)];
      side.faces.push_back(f);
      side.area += t_.face_area[f];
      for (const EdgeId e : t_.edges_of(f)) {
        const std::vector<Use>& uses = uses_[pieces_.first_edge(e)];
        const bool is_inside = uses.size() == 2 && sets_.find(uses[0].face) == sets_.find(uses[1].face);
        if (!is_inside && !t_.edge_is_degenerate[e]) perimeter += t_.edge_length[e];
      }
    }
    std::sort(side.faces.begin(), side.faces.end());
    side.width = side.faces.size() == 1 ? t_.face_width[side.faces[0]] : rectangle_width(side.area, perimeter);
    return side;
  }

  const AirPieces& pieces_;
  const ModelTables& t_;
  std::span<const FaceId> faces_;
  DisjointSets sets_;
  std::map<EdgeId, std::vector<Use>> uses_;  // by first edge
};

}  // namespace

std::vector<AirSide> sides_of(const AirPieces& pieces, std::span<const FaceId> faces) {
  return SideFinder(pieces, faces).run();
}

}  // namespace st::occt
