#include "meshing/topology/pair_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "base/error.h"
#include "geometry/model/sameness.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {
namespace {

constexpr double kSameAngle = 1e-6;  // radians, from the n-th part of a turn
constexpr double kNoLength = 1e-9;   // of the model's diagonal: below, a component of a translation is none

std::vector<Vec3> corners_of(const ModelTables& t, FaceId f) {
  std::set<VertexId> all;
  for (const EdgeId e : t.edges_of(f)) all.insert({t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]});
  std::vector<Vec3> corners;
  for (const VertexId v : all) corners.push_back(t.vertex_xyz[v]);
  return corners;
}

Vec3 middle_of(const std::vector<Vec3>& corners) {
  Vec3 sum;
  for (const Vec3& x : corners) sum += x;
  return sum / static_cast<double>(std::max<std::size_t>(corners.size(), 1));
}

/// Largest distance of the image of a corner from the nearest corner.
double mismatch(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Similarity& motion) {
  double most = a.size() == b.size() && !a.empty() ? 0 : 1e300;
  for (const Vec3& x : a) {
    double least = 1e300;
    for (const Vec3& y : b) least = std::min(least, distance(motion(x), y));
    most = std::max(most, least);
  }
  return most;
}

class ImageSearch {
 public:
  explicit ImageSearch(const Model& model) : model_(model), t_(model.tables()), size_(t_.box().diagonal()) {
    for (FaceId f = 0; f < t_.n_faces(); ++f) corners_.push_back(corners_of(t_, f));
    add_faces([](const std::string& role) { return role == "periodic"; });
    if (faces_.empty())
      add_faces([](const std::string& role) { return !is_outer_role(role) && role != "inlet" && role != "outlet"; });
  }

  std::vector<FacePair> run() {
    std::vector<FacePair> found = fits(true);
    std::vector<char> is_taken(t_.n_faces(), 0);
    for (const FacePair& p : found) is_taken[p.a] = is_taken[p.b] = 1;
    std::erase_if(faces_, [&](FaceId f) { return is_taken[f] != 0; });
    const std::vector<FacePair> turned = fits(false);
    found.insert(found.end(), turned.begin(), turned.end());
    if (found.empty())
      throw Error(
          ExitCode::kGeometry,
          "--pairs auto: no two faces are images of one another by one translation, or a rotation about x, y or "
          "z; write [[pair]] in a file");
    std::sort(found.begin(), found.end(), [](const FacePair& a, const FacePair& b) { return a.a < b.a; });
    return found;
  }

 private:
  template <class Is>
  void add_faces(const Is& is_wanted) {
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (is_wanted(role_of(t_.labels, static_cast<std::size_t>(t_.labels.face_group[f])))) faces_.push_back(f);
  }

  Similarity translation(FaceId a, FaceId b) const {
    Vec3 d = middle_of(corners_[b]) - middle_of(corners_[a]);
    for (double* x : {&d.x, &d.y, &d.z})
      if (std::abs(*x) < kNoLength * size_) *x = 0;
    return {.translation = d};
  }

  Similarity rotation(FaceId a, FaceId b, int axis) const {
    const Vec3 p = middle_of(corners_[a]), q = middle_of(corners_[b]);
    const auto angle_of = [&](Vec3 x) {
      return axis == 0 ? std::atan2(x.z, x.y) : axis == 1 ? std::atan2(x.x, x.z) : std::atan2(x.y, x.x);
    };
    double angle = std::remainder(angle_of(q) - angle_of(p), 2 * kPi);
    const double n = std::round(2 * kPi / std::abs(angle));
    if (std::isfinite(n) && std::abs(std::abs(angle) - 2 * kPi / n) < kSameAngle)
      angle = std::copysign(2 * kPi / n, angle);
    return rotation_about({axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0}, angle);
  }

  std::optional<FacePair> fit(FaceId a, FaceId b, bool by_translation) const {
    if (t_.face_type[a] != t_.face_type[b] || t_.edges_of(a).size() != t_.edges_of(b).size() ||
        std::abs(t_.face_area[a] - t_.face_area[b]) > kSameArea * t_.face_area[a])
      return std::nullopt;
    for (int axis = by_translation ? 2 : 0; axis < 3; ++axis) {
      const FacePair pair{a, b, by_translation ? translation(a, b) : rotation(a, b, axis)};
      if (mismatch(corners_[a], corners_[b], pair.motion) <= kSamePlace * size_ && turns_over(model_, pair))
        return pair;
    }
    return std::nullopt;
  }

  /// Each face has one partner at most.
  std::vector<FacePair> fits(bool by_translation) const {
    std::vector<FacePair> found;
    std::vector<FaceId> partner(t_.n_faces(), kNone);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t j = i + 1; j < faces_.size(); ++j) {
        const auto pair = fit(faces_[i], faces_[j], by_translation);
        if (!pair) continue;
        for (const FaceId f : {pair->a, pair->b})
          if (partner[f] != kNone)
            throw Error(ExitCode::kGeometry,
                        fmt::format("--pairs auto: {} is the image of {} and of {}; give the role periodic to the "
                                    "groups that are meant, or write [[pair]] in a file",
                                    t_.face_label(f), t_.face_label(partner[f]),
                                    t_.face_label(f == pair->a ? pair->b : pair->a)));
        partner[pair->a] = pair->b;
        partner[pair->b] = pair->a;
        found.push_back(*pair);
      }
    return found;
  }

  const Model& model_;
  const ModelTables& t_;
  const double size_;
  std::vector<FaceId> faces_;               // that may be in a pair
  std::vector<std::vector<Vec3>> corners_;  // by face
};

}  // namespace

std::vector<FacePair> pair_faces(const ModelTables& t, std::span<const FaceId> a, std::span<const FaceId> b,
                                 const Similarity& motion) {
  if (a.size() != b.size())
    throw Error(ExitCode::kGeometry,
                fmt::format("a has {} faces, and b has {}; both sides need as many", a.size(), b.size()));
  std::vector<FacePair> pairs;
  std::vector<std::vector<Vec3>> corners;  // of the faces of b
  for (const FaceId other : b) corners.push_back(corners_of(t, other));
  std::vector<char> is_taken(b.size(), 0);
  for (const FaceId f : a) {
    const std::vector<Vec3> own = corners_of(t, f);
    std::size_t best = 0;
    double least = 1e301;
    for (std::size_t i = 0; i < b.size(); ++i)
      if (const double off = is_taken[i] ? least : mismatch(own, corners[i], motion); off < least)
        least = off, best = i;
    is_taken[best] = 1;
    pairs.push_back({f, b[best], motion});
  }
  return pairs;
}

std::vector<FacePair> find_pairs(const Model& model) { return ImageSearch(model).run(); }

}  // namespace st
