#include "meshing/face/seam_mesh.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/parallel_reserve.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "mesh/merge.h"
#include "meshing/face/face_check.h"

namespace st {
namespace {

std::int32_t size_of(const auto& rows) { return static_cast<std::int32_t>(rows.size()); }

constexpr std::uint8_t kInRest = 1, kInBand = 2;

/// For each cut node the first and the last tile that have it.
std::vector<std::array<std::int32_t, 2>> tiles_of_cuts(const TileCut& cut) {
  std::vector<std::array<std::int32_t, 2>> tiles(cut.nodes.size(), {kNone, kNone});
  for (std::int32_t i = 0; i < size_of(cut.tiles); ++i)
    for (const auto& segment : cut.tiles[i].segments)
      for (const std::int32_t n : segment) {
        if (n < cut.n_boundary) continue;
        auto& [first, last] = tiles[n - cut.n_boundary];
        last = i;
        if (first == kNone) first = i;
      }
  return tiles;
}

/// Separates what is near the cuts from the rest of a tile.
class TileSplitter {
 public:
  TileSplitter(const FaceBoundary& boundary, const TileCut& cut, std::int32_t tile, FaceMesh whole)
      : boundary_(boundary),
        cut_(cut),
        tile_(tile),
        n_face_(size_of(boundary.nodes)),
        places_(nodes_of(cut.tiles[tile])),
        n_boundary_(size_of(places_)),
        whole_(std::move(whole)) {}

  SplitPiece run() {
    Piece& band = split_.band;
    band.mesh.cause = whole_.cause;
    band.mesh.refinement = std::move(whole_.refinement);
    band.mesh.n_folds = whole_.n_folds;
    if (whole_.cause != FailureCause::kNone) return std::move(split_);
    find_layers();
    find_uses();
    number_nodes();
    number_boundary();
    share_triangles();
    return std::move(split_);
  }

 private:
  /// Steps from a cut node; boundary nodes that several tiles have are a step away at most.
  void find_layers() {
    layer_.assign(n_boundary_ + whole_.inner.size(), kSeamLayers + 1);
    for (std::int32_t i = 0; i < n_boundary_; ++i) {
      if (places_[i] >= n_face_)
        layer_[i] = 0;
      else if (std::binary_search(cut_.shared.begin(), cut_.shared.end(), places_[i]))
        layer_[i] = 1;
    }
    is_in_band_.assign(whole_.corners.size() / 3, 0);
    std::vector<std::size_t> found;
    for (int layer = 0; layer < kSeamLayers; ++layer) {
      found.clear();
      for (std::size_t t = 0; t < is_in_band_.size(); ++t)
        if (!is_in_band_[t] && nearest_layer(t) <= layer) found.push_back(t);
      for (const std::size_t t : found) {
        is_in_band_[t] = 1;
        for (int k = 0; k < 3; ++k) {
          std::uint8_t& own = layer_[whole_.corners[3 * t + k]];
          own = std::min(own, static_cast<std::uint8_t>(layer + 1));
        }
      }
    }
  }

  std::uint8_t nearest_layer(std::size_t t) const {
    const std::int32_t* c = &whole_.corners[3 * t];
    return std::min({layer_[c[0]], layer_[c[1]], layer_[c[2]]});
  }

  void find_uses() {
    uses_.assign(n_boundary_ + whole_.inner.size(), 0);
    for (std::size_t i = 0; i < whole_.corners.size(); ++i)
      uses_[whole_.corners[i]] |= is_in_band_[i / 3] ? kInBand : kInRest;
  }

  /// Nodes of the band are its own, then those of the rest.
  void number_nodes() {
    in_rest_.assign(whole_.inner.size(), kNone);
    in_band_.assign(whole_.inner.size(), kNone);
    const auto add = [&](std::int32_t i, std::vector<std::int32_t>& in_piece, Piece& piece) {
      in_piece[i] = size_of(piece.mesh.inner);
      piece.mesh.inner.push_back(whole_.inner[i]);
    };
    const auto for_all_with = [&](auto is_wanted, const auto& f) {
      for (std::int32_t i = 0; i < size_of(whole_.inner); ++i)
        if (is_wanted(uses_[n_boundary_ + i])) f(i);
    };
    Piece& band = split_.band;
    for_all_with([](int uses) { return uses & kInRest; }, [&](std::int32_t i) { add(i, in_rest_, split_.rest); });
    for_all_with([](int uses) { return uses == kInBand; }, [&](std::int32_t i) { add(i, in_band_, band); });
    for_all_with([](int uses) { return uses == (kInRest | kInBand); },
                 [&](std::int32_t i) {
                   add(i, in_band_, band);
                   band.owner.push_back({tile_, in_rest_[i]});
                 });
  }

  void number_boundary() {
    Piece& rest = split_.rest;
    boundary_in_rest_.assign(n_boundary_, kNone);
    for (std::int32_t i = 0; i < n_boundary_; ++i) {
      if (!(uses_[i] & kInRest)) continue;
      boundary_in_rest_[i] = size_of(rest.boundary);
      rest.boundary.push_back(boundary_.nodes[places_[i]]);
      rest.number.push_back(places_[i]);
      rest.boundary_number.push_back(cut_.number[places_[i]]);
    }
    sort_once(rest.boundary_number);
  }

  /// Triangles that stay have no cut node, for these have the band around them.
  void share_triangles() {
    const std::int32_t first_in_band = n_face_ + size_of(cut_.nodes), first_in_rest = size_of(split_.rest.boundary);
    for (std::size_t t = 0; t < is_in_band_.size(); ++t) {
      const std::int32_t* c = &whole_.corners[3 * t];
      for (int k = 0; k < 3; ++k) {
        const std::int32_t inner = c[k] - n_boundary_;
        if (is_in_band_[t]) {
          split_.band.mesh.corners.push_back(inner < 0 ? places_[c[k]] : first_in_band + in_band_[inner]);
          continue;
        }
        split_.rest.mesh.corners.push_back(inner < 0 ? boundary_in_rest_[c[k]] : first_in_rest + in_rest_[inner]);
        if (const std::int32_t d = c[(k + 1) % 3]; inner < 0 && d < n_boundary_)
          split_.band.sides.push_back({std::min(id(c[k]), id(d)), std::max(id(c[k]), id(d))});
      }
    }
    split_.rest.mesh.corners.shrink_to_fit();
    split_.rest.mesh.inner.shrink_to_fit();
  }

  std::int32_t id(std::int32_t corner) const { return boundary_.nodes[places_[corner]].id; }

  const FaceBoundary& boundary_;
  const TileCut& cut_;
  const std::int32_t tile_, n_face_;
  const std::vector<std::int32_t> places_;
  const std::int32_t n_boundary_;
  FaceMesh whole_;
  std::vector<std::uint8_t> layer_, uses_;       // of each corner
  std::vector<std::uint8_t> is_in_band_;         // [n_triangles]
  std::vector<std::int32_t> in_rest_, in_band_;  // [n_inner] the inner node there
  std::vector<std::int32_t> boundary_in_rest_;   // [n_boundary]
  SplitPiece split_;
};

/// Puts bands together. Nodes that stay, on the boundary of the face and in tiles, are the boundary of this mesh, in
/// this order.
class SeamMesher {
 public:
  SeamMesher(const SeamMaker& maker, std::vector<Piece> bands)
      : maker_(maker), bands_(std::move(bands)), n_face_(size_of(maker.boundary.nodes)), boundary_(maker.boundary) {}

  Piece run() {
    add_up();
    if (mesh_.cause == FailureCause::kNone) {
      add_nodes();
      add_triangles();
      const std::vector<std::array<std::int32_t, 2>> rim = find_rim();
      improve_seams(maker_.surface, maker_.make_surface, boundary_, maker_.field, maker_.options, pieces_, mesh_);
      for (const auto& [a, b] : rim) boundary_.segments.push_back({a, b});
      check_edges(boundary_, mesh_, seams_.sides);
      renumber();
    }
    seams_.mesh = std::move(mesh_);
    return std::move(seams_);
  }

 private:
  void add_up() {
    for (const Piece& band : bands_) {
      if (mesh_.cause == FailureCause::kNone) mesh_.cause = band.mesh.cause;
      mesh_.n_folds += band.mesh.n_folds;
      for (const RefinementPoint& p : band.mesh.refinement)
        if (mesh_.refinement.size() < kMostRefined) mesh_.refinement.push_back(p);
    }
  }

  void add_nodes() {
    const std::vector<FaceNode>& cut = maker_.cut.nodes;
    find_pieces(tiles_of_cuts(maker_.cut));
    std::int32_t last_id = 0;
    for (const FaceNode& n : boundary_.nodes) last_id = std::max(last_id, n.id);
    for (const FaceNode& n : cut) {
      last_id = std::max(last_id, n.id);
      add_inner(n);
    }
    for (const Piece& band : bands_) {
      const auto end = band.mesh.inner.begin() + band.n_own();
      first_own_.push_back(size_of(mesh_.inner));
      mesh_.inner.insert(mesh_.inner.end(), band.mesh.inner.begin(), end);
      first_rim_.push_back(size_of(boundary_.nodes));
      for (auto n = end; n != band.mesh.inner.end(); ++n) {
        boundary_.nodes.push_back(*n);
        boundary_.nodes.back().id = ++last_id;
      }
      seams_.owner.insert(seams_.owner.end(), band.owner.begin(), band.owner.end());
    }
  }

  void add_inner(const FaceNode& n) {
    mesh_.inner.push_back(n);
    mesh_.inner.back().id = kNone;
  }

  /// The nodes between each two tiles are a piece; so is each junction.
  void find_pieces(const std::vector<std::array<std::int32_t, 2>>& tiles) {
    std::vector<std::array<std::int32_t, 2>> all = tiles;
    sort_once(all);
    for (const auto& own : tiles)
      pieces_.push_back(static_cast<std::int32_t>(std::lower_bound(all.begin(), all.end(), own) - all.begin()));
  }

  void add_triangles() {
    const std::int32_t n_boundary = size_of(boundary_.nodes), n_fixed = n_face_ + size_of(maker_.cut.nodes);
    std::vector<std::int32_t> number(n_fixed);
    std::iota(number.begin(), number.begin() + n_face_, 0);
    std::iota(number.begin() + n_face_, number.end(), n_boundary);
    for (std::size_t i = 0; i < bands_.size(); ++i) {
      Piece& band = bands_[i];
      number.resize(n_fixed + band.mesh.inner.size());
      const auto rim = number.begin() + n_fixed + band.n_own();
      std::iota(number.begin() + n_fixed, rim, n_boundary + first_own_[i]);
      std::iota(rim, number.end(), first_rim_[i]);
      for (const std::int32_t c : band.mesh.corners) mesh_.corners.push_back(number[c]);
      seams_.sides.insert(seams_.sides.end(), band.sides.begin(), band.sides.end());
      band = {};
    }
  }

  /// Sides that rests have on their other side, too. Those between nodes of the face's boundary are among seams_.sides.
  std::vector<std::array<std::int32_t, 2>> find_rim() const {
    const std::int32_t n_boundary = size_of(boundary_.nodes);
    std::vector<std::array<std::int32_t, 2>> sides;
    for (std::size_t i = 0; i < mesh_.corners.size(); ++i) {
      const std::int32_t a = mesh_.corners[i], b = mesh_.corners[i % 3 == 2 ? i - 2 : i + 1];
      if (std::max(a, b) < n_boundary && std::max(a, b) >= n_face_) sides.push_back({a, b});
    }
    return without_opposite(std::move(sides));
  }

  static std::vector<std::array<std::int32_t, 2>> without_opposite(std::vector<std::array<std::int32_t, 2>> sides) {
    std::sort(sides.begin(), sides.end());
    std::vector<std::array<std::int32_t, 2>> once;
    std::copy_if(sides.begin(), sides.end(), std::back_inserter(once), [&](const auto& side) {
      return !std::binary_search(sides.begin(), sides.end(), std::array{side[1], side[0]});
    });
    return once;
  }

  /// As in a Piece, but on no cut: inner node k is n_face + k.
  void renumber() {
    const std::int32_t n_boundary = size_of(boundary_.nodes), n_own = size_of(mesh_.inner);
    for (std::int32_t& c : mesh_.corners)
      if (c >= n_boundary)
        c -= n_boundary - n_face_;
      else if (c >= n_face_)
        c += n_own;
    for (std::int32_t i = n_face_; i < n_boundary; ++i) add_inner(boundary_.nodes[i]);
  }

  const SeamMaker& maker_;
  std::vector<Piece> bands_;
  const std::int32_t n_face_;  // nodes on the boundary of the face
  FaceBoundary boundary_;
  std::vector<std::int32_t> pieces_;                 // [n_cut]
  std::vector<std::int32_t> first_own_, first_rim_;  // [n_bands] inner node, boundary node
  FaceMesh mesh_;
  Piece seams_;
};

}  // namespace

SplitPiece split_tile(const FaceBoundary& boundary, const TileCut& cut, std::int32_t tile, FaceMesh mesh) {
  return TileSplitter(boundary, cut, tile, std::move(mesh)).run();
}

Piece SeamMaker::run(std::vector<Piece> bands) const { return SeamMesher(*this, std::move(bands)).run(); }

FaceMesh join_sections(std::int32_t n_boundary, std::vector<Piece> sections, Piece seams) {
  if (seams.mesh.cause != FailureCause::kNone) return std::move(seams.mesh);
  FaceMesh joined;
  joined.n_folds = seams.mesh.n_folds;
  joined.refinement = seams.mesh.refinement;
  seams.number.resize(n_boundary);
  std::iota(seams.number.begin(), seams.number.end(), 0);
  sections.push_back(std::move(seams));
  std::vector<std::size_t> first_corner{0};
  std::vector<std::int32_t> n_own;
  for (const Piece& s : sections) {
    n_own.push_back(s.n_own());
    first_corner.push_back(first_corner.back() + s.mesh.corners.size());
  }
  const PatchNumbers numbers = PatchNumbers::of_sections(n_boundary, n_own);
  const auto n_inner = static_cast<std::size_t>(numbers.n_nodes() - n_boundary);
  parallel_reserve(joined.inner, n_inner);
  parallel_reserve(joined.corners, first_corner.back());
  joined.inner.resize(n_inner);
  joined.corners.resize(first_corner.back());
  parallel_for(sections.size(), 1, [&](std::size_t i, std::size_t) {
    const Piece& s = sections[i];
    const std::vector<NodeId> number = numbers.of_piece(i, s.number, n_own[i], s.owner);
    std::ranges::transform(s.mesh.corners, joined.corners.begin() + first_corner[i],
                           [&](std::int32_t c) { return number[c]; });
    std::copy_n(s.mesh.inner.begin(), n_own[i], joined.inner.begin() + numbers.inner_begin[i] - n_boundary);
  });
  return joined;
}

}  // namespace st
