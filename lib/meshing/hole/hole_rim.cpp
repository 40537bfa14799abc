#include "meshing/hole/hole_rim.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/lists_by_key.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

class RimFinder {
 public:
  RimFinder(const HoleMesh& cad, const HoleMarks& marks, FaceId face) : cad_(cad), mesh_(cad.mesh), face_(face) {
    for (TriangleId i = cad.face_begin[face]; i < cad.face_begin[face + 1]; ++i)
      if (marks.triangle[i]) triangles_.push_back(i);
  }

  std::vector<HoleRim> run() {
    if (triangles_.empty()) return {};
    if (static_cast<TriangleId>(triangles_.size()) == cad_.face_size(face_)) return whole_face();
    number_corners();
    find_parts();
    sort_sides();
    drop_inner_sides();
    return std::move(rims_);
  }

 private:
  using Side = HoleRim::Side;

  HoleRim& add_rim() {
    HoleRim& rim = rims_.emplace_back();
    rim.face = face_;
    rim.is_turned = cad_.face_is_turned[face_];
    return rim;
  }

  std::vector<HoleRim> whole_face() {
    add_rim().is_whole_face = true;
    rims_.back().triangles = std::move(triangles_);
    return std::move(rims_);
  }

  NodeId node_at(std::int32_t corner) const { return mesh_.triangles[corner / 3].n[corner % 3]; }

  /// Local numbers: a node inside the face has one (u,v); one on an edge has one for each side of a seam.
  void number_corners() {
    const NodeId first_inner = cad_.inner_begin[face_];
    std::vector<std::int32_t> of_inner(cad_.inner_begin[face_ + 1] - first_inner, kNone), on_edges;
    local_.resize(3 * triangles_.size());
    for (std::int32_t i = 0; i < std::ssize(local_); ++i) {
      const std::int32_t t = triangles_[i / 3], k = i % 3;
      const NodeId n = mesh_.triangles[t].n[k];
      if (n < first_inner) {
        on_edges.push_back(i);
        continue;
      }
      std::int32_t& number = of_inner[n - first_inner];
      if (number == kNone) number = add_node(3 * t + k);
      local_[i] = number;
    }
    number_on_edges(on_edges);
  }

  void number_on_edges(std::vector<std::int32_t>& places) {
    const auto corner = [&](std::int32_t i) { return 3 * triangles_[i / 3] + i % 3; };
    const auto key = [&](std::int32_t i) {
      const Vec2 uv = mesh_.corner_uv[corner(i)];
      return std::tuple(node_at(corner(i)), uv.x, uv.y);
    };
    std::sort(places.begin(), places.end(),
              [&](std::int32_t a, std::int32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
    for (std::size_t k = 0; k < places.size(); ++k)
      local_[places[k]] =
          k && key(places[k]) == key(places[k - 1]) ? local_[places[k - 1]] : add_node(corner(places[k]));
  }

  std::int32_t add_node(std::int32_t corner) {
    node_corner_.push_back(corner);
    return static_cast<std::int32_t>(node_corner_.size()) - 1;
  }

  /// Triangles with a common node belong to one hole.
  void find_parts() {
    connected_ = DisjointSets(static_cast<std::int64_t>(node_corner_.size()));
    for (std::size_t i = 0; i < local_.size(); i += 3)
      for (int k = 1; k < 3; ++k) connected_.join(local_[i], local_[i + k]);
    part_.assign(node_corner_.size(), kNone);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      std::int32_t& part = part_[connected_.find(local_[3 * i])];
      if (part == kNone) {
        part = static_cast<std::int32_t>(rims_.size());
        add_rim();
      }
      rims_[part].triangles.push_back(triangles_[i]);
    }
    in_rim_.assign(node_corner_.size(), kNone);
  }

  bool is_cad_side(NodeId a, NodeId b) const {
    if (std::max(a, b) >= cad_.inner_begin[0]) return false;
    for (const CadSegment& s : cad_.segments_between(a, b))
      if (std::binary_search(face_edges_.begin(), face_edges_.end(), s.edge)) return true;
    return false;
  }

  void collect_face_edges() {
    const ModelTables& t = cad_.tables;
    face_edges_.assign(t.edges_of(face_).begin(), t.edges_of(face_).end());
    std::sort(face_edges_.begin(), face_edges_.end());
  }

  /// Sides on CAD segments go to their rim; the others are counted into buckets by their lower node.
  void sort_sides() {
    collect_face_edges();
    std::vector<Side> open;
    open.reserve(local_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const Side s{local_[3 * t + k], local_[3 * t + next]};
        const NodeId* const n = mesh_.triangles[triangles_[t]].n;
        if (is_cad_side(n[k], n[next])) {
          HoleRim& rim = rims_[part_[connected_.find(s.first)]];
          rim.cad_sides.push_back(in_rim(rim, s));
          continue;
        }
        open.push_back(s);
      }
    sides_ = {node_corner_.size(), [&](const auto& visit) {
                for (const Side& s : open) visit(std::min(s.first, s.second), s);
              }};
  }

  /// Sides used an even number of times are inside the hole.
  void drop_inner_sides() {
    for (std::size_t n = 0; n < sides_.n_keys(); ++n) {
      const std::span<Side> sides = sides_[n];
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const std::int32_t upper = std::max(sides[i].first, sides[i].second);
        if (upper == kNone) continue;  // counted with an earlier one
        bool is_odd = true;
        for (Side& other : sides.subspan(i + 1))
          if (std::max(other.first, other.second) == upper) {
            is_odd = !is_odd;
            other = {kNone, kNone};
          }
        if (!is_odd) continue;
        HoleRim& rim = rims_[part_[connected_.find(sides[i].first)]];
        rim.free_sides.push_back(in_rim(rim, sides[i]));
      }
    }
  }

  /// The side with the rim's own numbers.
  Side in_rim(HoleRim& rim, Side s) {
    for (std::int32_t* n : {&s.first, &s.second}) {
      std::int32_t& number = in_rim_[*n];
      if (number == kNone) {
        const std::int32_t corner = node_corner_[*n];
        number = static_cast<std::int32_t>(rim.nodes.size());
        const NodeId node = node_at(corner);
        rim.nodes.push_back({mesh_.corner_uv[corner], mesh_.node_xyz[node], 0, node});
      }
      *n = number;
    }
    return s;
  }

  const HoleMesh& cad_;
  const SurfaceMesh& mesh_;
  FaceId face_;
  std::vector<TriangleId> triangles_;      // marked
  std::vector<std::int32_t> local_;        // [3*triangles_] local node
  std::vector<std::int32_t> node_corner_;  // [local nodes] a corner of the mesh with it
  DisjointSets connected_{0};              // of local nodes
  std::vector<std::int32_t> part_;         // [local nodes] hole, at roots
  std::vector<std::int32_t> in_rim_;       // [local nodes] number in its rim
  std::vector<EdgeId> face_edges_;         // sorted
  ListsByKey<Side> sides_;                 // not on the CAD, by lower node
  std::vector<HoleRim> rims_;
};

}  // namespace

std::vector<HoleRim> find_hole_rims(const HoleMesh& mesh, const HoleMarks& marks, FaceId face) {
  return RimFinder(mesh, marks, face).run();
}

}  // namespace st
