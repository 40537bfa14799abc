#include "meshing/face/tile_seams.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/parallel_reserve.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "mesh/adjacency.h"
#include "meshing/face/face_check.h"
#include "meshing/face/front.h"

namespace st {
namespace {

constexpr std::size_t kPerPart = 65'536;

/// Disjoint triangles of a mesh that are enhanced together, and what becomes of them.
class SeamPiece {
 public:
  using Sides = std::vector<std::pair<std::int32_t, std::int32_t>>;  // ids of the ends, the smaller first; sorted

  /// `loops`: of the whole face. `is_inner(corner)`: all triangles of this node are in the piece.
  template <class IsInner>
  SeamPiece(const Surface& surface, const FaceBoundary& boundary, const Sides& loops, const SizeField& field,
            FaceMesh& mesh, std::vector<std::int32_t> triangles, const IsInner& is_inner)
      : boundary_(boundary),
        loops_(loops),
        mesh_(mesh),
        n_boundary_(static_cast<std::int32_t>(boundary.nodes.size())),
        triangles_(std::move(triangles)) {
    work_.set_surface(surface);
    work_.field = &field;
    number_nodes(is_inner);
    take_over();
  }

  void enhance_it(const FaceMeshOptions& options) {
    work_.max_turning = radians(options.max_turning_deg);
    enhance(work_, options.enhance_rounds);
  }
  void count_folds(FaceMesh& counts) const { check_folds(work_.mesh, counts); }

  /// The triangles in the places of those before, and kNone for those that are gone. Touches no more than the triangles
  /// and the inner nodes of the piece.
  void store(std::vector<std::uint8_t>& is_gone) {
    const std::vector<MeshNode>& nodes = work_.mesh.nodes;
    for (std::size_t i = static_cast<std::size_t>(n_fixed_); i < of_number_.size(); ++i) {
      const std::int32_t inner = of_number_[i] - n_boundary_;
      mesh_.inner[inner] = nodes[i + 4];
      is_gone[inner] = 1;
    }
    auto place = triangles_.begin();
    for (const PlaneTriangle& t : work_.mesh.triangles) {
      if (t.state == kDead) continue;
      std::int32_t* corners = &mesh_.corners[3 * static_cast<std::size_t>(*place++)];
      for (const std::int32_t v : t.v) {
        *corners = of_number_[v < n_fixed_ ? v : v - 4];
        if (v >= n_fixed_ + 4) is_gone[*corners - n_boundary_] = 0;
        ++corners;
      }
    }
    for (; place != triangles_.end(); ++place)
      std::fill_n(&mesh_.corners[3 * static_cast<std::size_t>(*place)], 3, kNone);
  }

 private:
  using Corners = std::array<std::int32_t, 3>;

  /// Nodes that others have, too, are the rim, which comes first.
  template <class IsInner>
  void number_nodes(const IsInner& is_inner) {
    for (const std::int32_t t : triangles_)
      of_number_.insert(of_number_.end(), &mesh_.corners[3 * static_cast<std::size_t>(t)],
                        &mesh_.corners[3 * static_cast<std::size_t>(t)] + 3);
    sort_once(of_number_);
    const auto inner =
        std::stable_partition(of_number_.begin(), of_number_.end(), [&](std::int32_t c) { return !is_inner(c); });
    n_fixed_ = static_cast<std::int32_t>(inner - of_number_.begin());
  }

  /// Both parts of of_number_ are sorted.
  std::int32_t number(std::int32_t corner) const {
    const auto rim_end = of_number_.begin() + n_fixed_;
    auto it = std::lower_bound(of_number_.begin(), rim_end, corner);
    if (it == rim_end || *it != corner) it = std::lower_bound(rim_end, of_number_.end(), corner);
    return static_cast<std::int32_t>(it - of_number_.begin());
  }

  MeshNode node(std::int32_t corner) const {
    return work_.plane_node(corner < n_boundary_ ? boundary_.nodes[corner] : mesh_.inner[corner - n_boundary_]);
  }

  void take_over() {
    std::vector<MeshNode> nodes;
    for (const std::int32_t corner : of_number_) nodes.push_back(node(corner));
    std::vector<Corners> triangles;
    for (const std::int32_t t : triangles_) {
      const std::int32_t* c = &mesh_.corners[3 * static_cast<std::size_t>(t)];
      triangles.push_back({number(c[0]), number(c[1]), number(c[2])});
    }
    work_.mesh.adopt(n_fixed_, std::move(nodes), triangles);
    keep_loops();
  }

  /// Segments of the loops with triangles on both sides, too.
  void keep_loops() {
    Triangulation& m = work_.mesh;
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = m.nodes[m.triangles[t].v[k]].id, b = m.nodes[m.triangles[t].v[(k + 1) % 3]].id;
        if (a == kNone || b == kNone || a == b) continue;
        const std::pair<std::int32_t, std::int32_t> side = std::minmax({a, b});
        if (std::binary_search(loops_.begin(), loops_.end(), side)) m.constrain(static_cast<std::int32_t>(t), k);
      }
  }

  const FaceBoundary& boundary_;
  const Sides& loops_;
  FaceMesh& mesh_;
  const std::int32_t n_boundary_;
  const std::vector<std::int32_t> triangles_;
  FaceWork work_;
  std::vector<std::int32_t> of_number_;  // the corner of each node of the piece
  std::int32_t n_fixed_ = 0;
};

/// The triangles about all cuts of a face: piece by piece, then where pieces meet.
class SeamEnhancer {
 public:
  SeamEnhancer(const Surface& surface, const SurfaceMaker& make_surface, const FaceBoundary& boundary,
               const SizeField& field, const FaceMeshOptions& options, FaceMesh& mesh)
      : surface_(surface),
        make_surface_(make_surface),
        boundary_(boundary),
        field_(field),
        options_(options),
        mesh_(mesh),
        n_boundary_(static_cast<std::int32_t>(boundary.nodes.size())),
        is_gone_(mesh.inner.size(), 0) {
    for (const auto& [a, b] : boundary.segments)
      loops_.push_back(std::minmax({boundary.nodes[a].id, boundary.nodes[b].id}));
    std::sort(loops_.begin(), loops_.end());
  }

  void run(std::span<const std::int32_t> piece_of_cut) {
    find_band(piece_of_cut);
    std::vector<std::uint8_t> is_joint;
    const int n_in_pieces = improve_pieces(is_joint), n_at_joints = improve_joints(is_joint);
    if (n_in_pieces + n_at_joints > 0) count_folds();
    close_ranks();
  }

 private:
  std::int32_t* corners(std::int32_t t) const { return &mesh_.corners[3 * static_cast<std::size_t>(t)]; }

  /// Triangles in layers about the nodes of the cuts, and which piece each belongs to: the lowest of the nearest.
  void find_band(std::span<const std::int32_t> piece_of_cut) {
    const std::size_t n_triangles = mesh_.corners.size() / 3, n_nodes = n_boundary_ + mesh_.inner.size();
    parallel_reserve(layer_, n_nodes);
    layer_.assign(n_nodes, kSeamLayers + 1);
    parallel_reserve(number_, n_nodes);
    number_.assign(n_nodes, kNone);
    for (std::size_t i = 0; i < piece_of_cut.size(); ++i) {
      layer_[n_boundary_ + i] = 0;
      add_node(n_boundary_ + static_cast<std::int32_t>(i), piece_of_cut[i]);
    }
    std::vector<std::uint8_t> is_in(n_triangles, 0);
    std::vector<std::vector<std::int32_t>> found(n_triangles / kPerPart + 1);
    for (int layer = 0; layer < kSeamLayers; ++layer) {
      parallel_for(n_triangles, kPerPart, [&](std::size_t begin, std::size_t end) {
        std::vector<std::int32_t>& here = found[begin / kPerPart];
        here.clear();
        for (std::size_t t = begin; t < end; ++t) {
          const std::int32_t* c = &mesh_.corners[3 * t];
          if (is_in[t] || std::min({layer_[c[0]], layer_[c[1]], layer_[c[2]]}) > layer) continue;
          is_in[t] = 1;
          here.push_back(static_cast<std::int32_t>(t));
        }
      });
      for (const auto& here : found)
        for (const std::int32_t t : here) add_triangle(t, layer);
    }
  }

  void add_node(std::int32_t corner, std::int32_t piece) {
    number_[corner] = static_cast<std::int32_t>(node_.size());
    node_.push_back(corner);
    piece_.push_back(piece);
  }

  void add_triangle(std::int32_t t, int layer) {
    const std::int32_t* c = corners(t);
    std::int32_t piece = kNone;
    for (int k = 0; k < 3; ++k)
      if (layer_[c[k]] <= layer && (piece == kNone || piece_[number_[c[k]]] < piece)) piece = piece_[number_[c[k]]];
    band_.push_back(t);
    piece_of_.push_back(piece);
    for (int k = 0; k < 3; ++k) {
      if (layer_[c[k]] <= layer) continue;
      if (number_[c[k]] == kNone) add_node(c[k], piece);
      std::int32_t& own = piece_[number_[c[k]]];
      own = std::min(own, piece);
      layer_[c[k]] = static_cast<std::uint8_t>(layer + 1);
    }
  }

  /// All triangles of the node are in the band.
  bool is_inside(std::int32_t corner) const { return corner >= n_boundary_ && layer_[corner] < kSeamLayers; }

  /// Each with the nodes that no other has; `is_joint`: of each in node_, whether pieces share it. Returns the folds.
  int improve_pieces(std::vector<std::uint8_t>& is_joint) {
    constexpr std::int32_t kShared = -2;
    std::vector<std::int32_t> owner(node_.size(), kNone);
    std::map<std::int32_t, std::vector<std::int32_t>> pieces;
    for (std::size_t i = 0; i < band_.size(); ++i) {
      pieces[piece_of_[i]].push_back(band_[i]);
      for (int k = 0; k < 3; ++k) {
        std::int32_t& own = owner[number_[corners(band_[i])[k]]];
        own = own == kNone || own == piece_of_[i] ? piece_of_[i] : kShared;
      }
    }
    for (std::size_t i = 0; i < node_.size(); ++i) is_joint.push_back(owner[i] == kShared && is_inside(node_[i]));
    return improve(std::move(pieces), [&](std::int32_t c) { return is_inside(c) && owner[number_[c]] != kShared; });
  }

  /// Layers about the nodes that pieces share, as pieces of their own. Returns the folds.
  int improve_joints(const std::vector<std::uint8_t>& is_joint) {
    std::vector<std::uint8_t> layer(node_.size(), kSeamLayers + 1), is_in(band_.size(), 0);
    for (std::size_t i = 0; i < layer.size(); ++i)
      if (is_joint[i]) layer[i] = 0;
    DisjointSets sets(static_cast<std::int64_t>(layer.size()));
    const auto numbers = [&](std::int32_t t) {
      const std::int32_t* c = corners(t);
      return std::array{number_[c[0]], number_[c[1]], number_[c[2]]};
    };
    for (int l = 0; l < kSeamLayers; ++l)
      for (std::size_t i = 0; i < band_.size(); ++i) {
        if (is_in[i] || corners(band_[i])[0] == kNone) continue;
        const auto n = numbers(band_[i]);
        if (std::min({layer[n[0]], layer[n[1]], layer[n[2]]}) > l) continue;
        is_in[i] = 1;
        for (const std::int32_t own : n) {
          layer[own] = std::min(layer[own], static_cast<std::uint8_t>(l + 1));
          sets.join(n[0], own);
        }
      }
    std::map<std::int32_t, std::vector<std::int32_t>> joints;
    for (std::size_t i = 0; i < band_.size(); ++i)
      if (is_in[i]) joints[sets.find(numbers(band_[i])[0])].push_back(band_[i]);
    return improve(std::move(joints), [&](std::int32_t c) { return is_inside(c) && layer[number_[c]] < kSeamLayers; });
  }

  template <class IsInner>
  int improve(std::map<std::int32_t, std::vector<std::int32_t>>&& parts, const IsInner& is_inner) {
    std::vector<std::vector<std::int32_t>> triangles;
    for (auto& [own, some] : parts) triangles.push_back(std::move(some));
    std::vector<FaceMesh> counts(triangles.size());
    parallel_for(triangles.size(), 1, [&](std::size_t i, std::size_t) {
      const std::unique_ptr<Surface> own = make_surface_ ? make_surface_() : nullptr;
      SeamPiece piece(own ? *own : surface_, boundary_, loops_, field_, mesh_, std::move(triangles[i]), is_inner);
      piece.enhance_it(options_);
      piece.count_folds(counts[i]);
      piece.store(is_gone_);
    });
    int n_folds = 0;
    for (const FaceMesh& c : counts) n_folds += c.n_folds;
    return n_folds;
  }

  /// Measures the whole band, as it is now.
  void count_folds() {
    std::erase_if(band_, [&](std::int32_t t) { return corners(t)[0] == kNone; });
    const SeamPiece all(surface_, boundary_, loops_, field_, mesh_, band_,
                        [&](std::int32_t c) { return is_inside(c); });
    all.count_folds(mesh_);
  }

  /// Without triangles and nodes that are gone.
  void close_ranks() {
    std::vector<std::int32_t> nodes, triangles;
    for (const std::int32_t corner : node_)
      if (corner >= n_boundary_ && is_gone_[corner - n_boundary_]) nodes.push_back(corner - n_boundary_);
    std::copy_if(band_.begin(), band_.end(), std::back_inserter(triangles),
                 [&](std::int32_t t) { return corners(t)[0] == kNone; });
    std::sort(nodes.begin(), nodes.end());
    std::sort(triangles.begin(), triangles.end());
    erase_rows(mesh_.corners, 3, triangles);
    if (nodes.empty()) return;
    const std::size_t n_before = mesh_.inner.size();
    erase_rows(mesh_.inner, 1, nodes);
    std::vector<std::int32_t>& place = number_;  // of each inner node, from here on
    parallel_for(n_before, kPerPart, [&](std::size_t begin, std::size_t end) {
      auto gone = std::lower_bound(nodes.begin(), nodes.end(), static_cast<std::int32_t>(begin));
      for (std::size_t i = begin; i < end; ++i) {
        place[i] = n_boundary_ + static_cast<std::int32_t>(i) - static_cast<std::int32_t>(gone - nodes.begin());
        if (gone != nodes.end() && static_cast<std::size_t>(*gone) == i) ++gone;
      }
    });
    parallel_for(mesh_.corners.size(), kPerPart, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (mesh_.corners[i] >= n_boundary_) mesh_.corners[i] = place[mesh_.corners[i] - n_boundary_];
    });
  }

  /// `gone`: rows, ascending.
  template <class T>
  static void erase_rows(std::vector<T>& v, std::ptrdiff_t width, std::span<const std::int32_t> gone) {
    if (gone.empty()) return;
    auto end = v.begin() + width * gone[0];
    for (std::size_t i = 0; i < gone.size(); ++i) {
      const auto next = i + 1 < gone.size() ? v.begin() + width * gone[i + 1] : v.end();
      end = std::copy(v.begin() + width * (gone[i] + std::ptrdiff_t{1}), next, end);
    }
    v.erase(end, v.end());
  }

  const Surface& surface_;
  const SurfaceMaker& make_surface_;
  const FaceBoundary& boundary_;
  const SizeField& field_;
  const FaceMeshOptions& options_;
  FaceMesh& mesh_;
  const std::int32_t n_boundary_;
  SeamPiece::Sides loops_;
  std::vector<std::uint8_t> is_gone_;   // [n_inner]
  std::vector<std::uint8_t> layer_;     // of each corner: steps from a cut, kSeamLayers + 1: more
  std::vector<std::int32_t> number_;    // of each corner: place in node_, kNone: not in the band
  std::vector<std::int32_t> node_;      // corners in the band
  std::vector<std::int32_t> piece_;     // of each of these
  std::vector<std::int32_t> band_;      // triangles
  std::vector<std::int32_t> piece_of_;  // [n_band]
};

}  // namespace

void improve_seams(const Surface& surface, const SurfaceMaker& make_surface, const FaceBoundary& boundary,
                   const SizeField& field, const FaceMeshOptions& options, std::span<const std::int32_t> piece_of_cut,
                   FaceMesh& mesh) {
  SeamEnhancer(surface, make_surface, boundary, field, options, mesh).run(piece_of_cut);
}

}  // namespace st
