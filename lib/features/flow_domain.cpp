#include "features/flow_domain.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace st {
namespace {

constexpr double kLargestBody = 0.25;  // diagonal of the body's box over the model's: a fifth, and room for one
constexpr double kClear = 0.5;         // distance to sides of the model's box, over the diagonal of the body's box
constexpr double kInSide = 1e-4;  // of a plane from a side of the model's box, over its diagonal: edges have tolerances
constexpr double kFlat = 1e-3;    // of a flat face, over the diagonal of its box
constexpr double kSpread = 1e-3;  // of outer faces from the sides of the model's box: spheres of patches

constexpr double Vec3::*kAxes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

/// A side of a box: 0 and 1 are low and high x, then y and z.
constexpr int kSides = 6;

double at_side(const Box3& box, int side) { return side % 2 ? box.hi.*kAxes[side / 2] : box.lo.*kAxes[side / 2]; }

/// Distance of the inner box from a side of the outer one, inward.
double gap(const Box3& inner, const Box3& outer, int side) {
  return (side % 2 ? 1 : -1) * (at_side(outer, side) - at_side(inner, side));
}

/// Connected faces, without some.
struct Piece {
  std::vector<FaceId> faces;
  Box3 box;
};

class DomainSearch {
 public:
  DomainSearch(const ModelTables& t, std::span<const Box3> face_box) : t_(t), box_(face_box) {
    for (const Box3& box : box_) all_.add(box);
    t.edge_faces(offsets_, edge_faces_);
  }

  std::vector<FaceId> find() const {
    std::vector<FaceId> outer = search({});
    for (int a = 0; a < kSides && outer.empty(); ++a) outer = search({a});
    for (int a = 0; a < kSides && outer.empty(); ++a)
      for (int b = a + 1; b < kSides && outer.empty(); ++b)
        if (a / 2 != b / 2) outer = search({a, b});
    return outer;
  }

 private:
  double rounding() const { return kInSide * all_.diagonal(); }

  bool is_in_side(FaceId f, int side) const {
    const auto axis = kAxes[side / 2];
    const Box3& box = box_[f];
    return box.hi.*axis - box.lo.*axis <= rounding() &&
           std::abs(at_side(box, side) - at_side(all_, side)) <= rounding();
  }

  /// Faces of the outer boundary when the body stands on these sides; empty when it does not.
  std::vector<FaceId> search(const std::vector<int>& sides) const {
    std::vector<char> is_plane(t_.n_faces(), 0);
    for (const int side : sides) {
      bool has_plane = false;
      for (FaceId f = 0; f < t_.n_faces(); ++f)
        if (is_in_side(f, side)) is_plane[f] = 1, has_plane = true;
      if (!has_plane) return {};
    }
    const std::vector<Piece> pieces = pieces_without(is_plane);
    const Piece* outer = nullptr;
    for (const Piece& piece : pieces)
      if (reaches(piece.box, sides)) {
        if (outer != nullptr) return {};
        outer = &piece;
      }
    if (outer == nullptr || pieces.size() < 2 || !is_body(pieces, *outer, sides)) return {};
    std::vector<FaceId> faces = outer->faces;
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (is_plane[f]) faces.push_back(f);
    std::sort(faces.begin(), faces.end());
    return faces;
  }

  std::vector<Piece> pieces_without(const std::vector<char>& is_left_out) const {
    std::vector<FaceId> parent(t_.n_faces());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](FaceId f) {
      while (parent[f] != f) f = parent[f] = parent[parent[f]];
      return f;
    };
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      FaceId first = kNone;
      for (std::int32_t k = offsets_[e]; k < offsets_[e + 1]; ++k) {
        if (is_left_out[edge_faces_[k]]) continue;
        if (first == kNone) first = edge_faces_[k];
        const FaceId a = root(first), b = root(edge_faces_[k]);
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
    std::map<FaceId, Piece> by_root;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (is_left_out[f]) continue;
      Piece& piece = by_root[root(f)];
      piece.faces.push_back(f);
      piece.box.add(box_[f]);
    }
    std::vector<Piece> pieces;
    for (auto& [first, piece] : by_root) pieces.push_back(std::move(piece));
    return pieces;
  }

  bool reaches(const Box3& box, const std::vector<int>& but) const {
    for (int side = 0; side < kSides; ++side)
      if (std::find(but.begin(), but.end(), side) == but.end() && gap(box, all_, side) > kSpread * all_.diagonal())
        return false;
    return true;
  }

  /// All pieces but the outer one together.
  bool is_body(const std::vector<Piece>& pieces, const Piece& outer, const std::vector<int>& sides) const {
    Box3 body;
    for (const Piece& piece : pieces)
      if (&piece != &outer) body.add(piece.box);
    const double size = body.diagonal();
    if (!(size > 0) || size > kLargestBody * all_.diagonal()) return false;
    for (int side = 0; side < kSides; ++side)
      if (std::find(sides.begin(), sides.end(), side) == sides.end() && gap(body, all_, side) < kClear * size)
        return false;
    if (sides.empty()) return true;
    return is_free_form(pieces, outer) || is_sphere(outer);
  }

  bool is_flat(FaceId f) const {
    const Vec3 extent = box_[f].hi - box_[f].lo;
    return t_.face_type[f] == SurfaceType::kPlane || std::min({extent.x, extent.y, extent.z}) <= kFlat * norm(extent);
  }

  bool is_free_form(const std::vector<Piece>& pieces, const Piece& outer) const {
    for (const Piece& piece : pieces)
      for (const FaceId f : piece.faces)
        if (&piece != &outer && t_.face_type[f] >= SurfaceType::kBezier && !is_flat(f)) return true;
    return false;
  }

  bool is_sphere(const Piece& outer) const {
    return std::all_of(outer.faces.begin(), outer.faces.end(),
                       [&](FaceId f) { return t_.face_type[f] == SurfaceType::kSphere; });
  }

  const ModelTables& t_;
  std::span<const Box3> box_;  // [n_faces]
  Box3 all_;
  std::vector<std::int32_t> offsets_;
  std::vector<FaceId> edge_faces_;
};

}  // namespace

std::vector<FaceId> find_flow_domain(const ModelTables& tables, std::span<const Box3> face_box) {
  if (tables.n_faces() < 2) return {};
  return DomainSearch(tables, face_box).find();
}

}  // namespace st
