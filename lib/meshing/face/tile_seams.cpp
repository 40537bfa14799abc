#include "meshing/face/tile_seams.h"

#include <algorithm>
#include <array>

#include "meshing/face/face_check.h"
#include "meshing/face/front.h"

namespace st {
namespace {

constexpr int kLayers = 4;  // of triangles on each side of a cut

class SeamBand {
 public:
  SeamBand(const Surface& surface, const FaceBoundary& boundary, const SizeField& field, FaceMesh& mesh)
      : boundary_(boundary), mesh_(mesh), n_boundary_(static_cast<std::int32_t>(boundary.nodes.size())) {
    work_.set_surface(surface);
    work_.field = &field;
  }

  void run(std::int32_t n_cut, const FaceMeshOptions& options) {
    find_band(n_cut);
    number_nodes();
    take_over();
    work_.max_turning = radians(options.max_turning_deg);
    enhance(work_, options.enhance_rounds);
    check_folds(work_.mesh, mesh_);
    store();
  }

 private:
  using Corners = std::array<std::int32_t, 3>;

  void find_band(std::int32_t n_cut) {
    const std::size_t n_triangles = mesh_.corners.size() / 3;
    is_in_.assign(n_triangles, 0);
    std::vector<std::uint8_t> is_near(n_boundary_ + mesh_.inner.size(), 0);
    std::fill_n(is_near.begin() + n_boundary_, n_cut, 1);
    for (int layer = 0; layer < kLayers; ++layer) {
      for (std::size_t t = 0; t < n_triangles; ++t) {
        const std::int32_t* c = &mesh_.corners[3 * t];
        is_in_[t] |= is_near[c[0]] | is_near[c[1]] | is_near[c[2]];
      }
      for (std::size_t t = 0; t < n_triangles; ++t)
        for (int k = 0; is_in_[t] && k < 3; ++k) is_near[mesh_.corners[3 * t + k]] = 1;
    }
  }

  /// Nodes of the boundary, and those that triangles outside of the band have, are its rim.
  void number_nodes() {
    constexpr std::uint8_t kInside = 1, kOutside = 2;
    std::vector<std::uint8_t> uses(n_boundary_ + mesh_.inner.size(), 0);
    for (std::size_t i = 0; i < mesh_.corners.size(); ++i) uses[mesh_.corners[i]] |= is_in_[i / 3] ? kInside : kOutside;
    for (std::int32_t i = 0; i < n_boundary_; ++i) uses[i] |= kOutside;
    number_.assign(uses.size(), kNone);
    for (const std::uint8_t wanted : {kInside | kOutside, int{kInside}}) {
      for (std::size_t i = 0; i < uses.size(); ++i) {
        if (uses[i] != wanted) continue;
        number_[i] = static_cast<std::int32_t>(of_number_.size());
        of_number_.push_back(static_cast<std::int32_t>(i));
      }
      if (wanted != kInside) n_fixed_ = static_cast<std::int32_t>(of_number_.size());
    }
  }

  MeshNode node(std::int32_t corner) const {
    const FaceNode& own = corner < n_boundary_ ? boundary_.nodes[corner] : mesh_.inner[corner - n_boundary_];
    MeshNode n{own};
    n.p = {own.uv.x * work_.scale.x, own.uv.y * work_.scale.y};
    work_.evaluate(n);
    n.normal = work_.reliable_normal(n);
    n.x = own.x;
    n.request = own.h;
    return n;
  }

  void take_over() {
    std::vector<MeshNode> nodes;
    for (const std::int32_t corner : of_number_) nodes.push_back(node(corner));
    std::vector<Corners> triangles;
    for (std::size_t t = 0; t < is_in_.size(); ++t) {
      const std::int32_t* c = &mesh_.corners[3 * t];
      if (is_in_[t]) triangles.push_back({number_[c[0]], number_[c[1]], number_[c[2]]});
    }
    work_.mesh.adopt(n_fixed_, std::move(nodes), triangles);
    keep_loops();
  }

  /// Segments of the loops with triangles on both sides, too.
  void keep_loops() {
    std::vector<std::pair<std::int32_t, std::int32_t>> loops;  // ids
    for (const auto& [a, b] : boundary_.segments)
      loops.push_back(std::minmax({boundary_.nodes[a].id, boundary_.nodes[b].id}));
    std::sort(loops.begin(), loops.end());
    Triangulation& m = work_.mesh;
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = m.nodes[m.triangles[t].v[k]].id, b = m.nodes[m.triangles[t].v[(k + 1) % 3]].id;
        if (a == kNone || b == kNone) continue;
        const std::pair<std::int32_t, std::int32_t> side = std::minmax({a, b});
        if (std::binary_search(loops.begin(), loops.end(), side)) m.constrain(static_cast<std::int32_t>(t), k);
      }
  }

  /// The band in place of its old triangles; nodes that are gone go.
  void store() {
    std::vector<std::int32_t> corners;
    for (std::size_t t = 0; t < is_in_.size(); ++t)
      if (!is_in_[t]) corners.insert(corners.end(), &mesh_.corners[3 * t], &mesh_.corners[3 * t] + 3);
    std::vector<std::uint8_t> is_gone(mesh_.inner.size(), 0);
    const std::vector<MeshNode>& nodes = work_.mesh.nodes;
    for (std::size_t i = static_cast<std::size_t>(n_fixed_); i < of_number_.size(); ++i) {
      const std::int32_t inner = of_number_[i] - n_boundary_;
      mesh_.inner[inner] = nodes[i + 4];
      is_gone[inner] = 1;
    }
    for (const PlaneTriangle& t : work_.mesh.triangles) {
      if (t.state == kDead) continue;
      for (const std::int32_t v : t.v) {
        const std::int32_t corner = of_number_[v < n_fixed_ ? v : v - 4];
        if (corner >= n_boundary_) is_gone[corner - n_boundary_] = 0;
        corners.push_back(corner);
      }
    }
    std::vector<std::int32_t> place(mesh_.inner.size());
    std::int32_t n = 0;
    for (std::size_t i = 0; i < mesh_.inner.size(); ++i) {
      if (is_gone[i]) continue;
      place[i] = n_boundary_ + n;
      mesh_.inner[n++] = mesh_.inner[i];
    }
    mesh_.inner.resize(n);
    for (std::int32_t& c : corners)
      if (c >= n_boundary_) c = place[c - n_boundary_];
    mesh_.corners = std::move(corners);
  }

  const FaceBoundary& boundary_;
  FaceMesh& mesh_;
  const std::int32_t n_boundary_;
  FaceWork work_;
  std::vector<std::uint8_t> is_in_;      // [n_triangles]
  std::vector<std::int32_t> number_;     // in the band, of each corner
  std::vector<std::int32_t> of_number_;  // the corner of each node of the band
  std::int32_t n_fixed_ = 0;
};

}  // namespace

void improve_seams(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                   const FaceMeshOptions& options, std::int32_t n_cut, FaceMesh& mesh) {
  SeamBand(surface, boundary, field, mesh).run(n_cut, options);
}

}  // namespace st
