#include "meshing/face/front_places.h"

#include "base/eigen.h"

namespace st {
namespace {

constexpr double kShortBase = 0.8;  // of the size at its ends: a shorter base does not hold back the growth any more
constexpr double kRowMiss = 0.003;  // of its length, by which a point of a row may miss its place

}  // namespace

template <bool kStretched>
bool FrontPlaces<kStretched>::of_side(const MeshNode& a, const MeshNode& b, double& r, MeshNode& p) {
  const Vec3 du = 0.5 * (a.du + b.du), dv = 0.5 * (a.dv + b.dv);
  const Metric m = metric_of<kStretched>(du, dv, a, b);
  const Vec2 e = b.p - a.p;
  const double base = edge_in_space(a, b), e2 = m.length2(e), det = m.e * m.g - m.f * m.f;
  if (!(e2 > 0) || !(det > 0)) return false;
  const double h = 0.5 * (a.h + b.h);
  r = std::max(std::min(h, kGrowth * std::max(base, kShortBase * h)), 0.62 * base);
  const double height = std::sqrt(std::max(r * r - 0.25 * base * base, 0.04 * r * r));
  const double f = height / std::sqrt(e2 * det);
  p.p = 0.5 * (a.p + b.p) + f * Vec2{-(m.f * e.x + m.g * e.y), m.e * e.x + m.f * e.y};
  for (int step = 0;; ++step) {
    w_.evaluate(p);
    if (step == 0) {  // the side's length is the mean of the sizes at its ends
      w_.ask_sizes(p);
      r = std::clamp(0.5 * (h + p.h), 0.62 * base, kGrowth * std::max(base, kShortBase * h));
      limit_turning(a, b, p, r);
    }
    const Vec3 ra = p.x - a.x, rb = p.x - b.x;
    const double la = std::sqrt(mean_length2<kStretched>(ra, a, p)), lb = std::sqrt(mean_length2<kStretched>(rb, b, p));
    if (std::abs(la - r) < 0.06 * r && std::abs(lb - r) < 0.06 * r) return true;
    if (step == 3) return la < 1.6 * r && lb < 1.6 * r && la > 0.4 * r && lb > 0.4 * r;
    Eigen::Matrix2d m;  // half the derivatives of la^2 and lb^2
    m << mean_product<kStretched>(ra, p.du, a, p), mean_product<kStretched>(ra, p.dv, a, p),
        mean_product<kStretched>(rb, p.du, b, p), mean_product<kStretched>(rb, p.dv, b, p);
    const double size = std::abs(m(0, 0) * m(1, 1)) + std::abs(m(0, 1) * m(1, 0));
    const double det_m = m.determinant();
    if (!(std::abs(det_m) > 1e-8 * size)) return la < 1.6 * r && lb < 1.6 * r && la > 0.4 * r && lb > 0.4 * r;
    const Eigen::Vector2d missing = 0.5 * Eigen::Vector2d(r * r - la * la, r * r - lb * lb);
    Vec2 move = to_vec2(adjugate(m) * missing / det_m);
    const double length = std::sqrt(mean_length2<kStretched>(move.x * p.du + move.y * p.dv, p));
    if (length > 0.5 * r) move = (0.5 * r / length) * move;
    p.p = p.p + move;
  }
}

template <bool kStretched>
bool FrontPlaces<kStretched>::of_row(const MeshNode& a, Vec3 d, Vec3 aside, double& length, MeshNode& p) {
  const auto first = tangent_step(a.du, a.dv, length * d);
  if (!first) return false;
  p.p = a.p + *first;
  for (int step = 0; step < 4; ++step) {
    w_.evaluate(p);
    w_.ask_sizes(p);
    double wanted = 0.5 * (a.h + std::min(p.h, kGrowth * a.h));
    limit_turning(a, a, p, wanted);
    length = step == 0 ? wanted : std::min(wanted, length);
    const Vec3 chord = p.x - a.x;
    const double reached = std::sqrt(length2(chord, a, p));
    if (!(reached > 0)) return false;
    const double aslant = dot(chord, aside);
    if (step == 3 || (std::abs(length - reached) < kRowMiss * length && std::abs(aslant) < kRowMiss * norm(chord)))
      break;
    const auto back = tangent_step(p.du, p.dv, -aslant * aside);
    if (!back) return false;
    p.p = a.p + std::clamp(length / reached, 0.4, 2.0) * (p.p - a.p + *back);
  }
  return dot(a.normal, p.normal) > cos_too_far_;
}

/// A side along which the normal turns too far becomes shorter, whatever the field says; to a quarter at the most.
template <bool kStretched>
void FrontPlaces<kStretched>::limit_turning(const MeshNode& a, const MeshNode& b, MeshNode& p, double& r) const {
  const double c = std::min(dot(a.normal, p.normal), dot(b.normal, p.normal));
  if (c > cos_turning_ || a.is_pole || b.is_pole) return;
  const double least = kTurningFloor * p.request;  // at a crease no length is short enough
  r = std::max(std::min(r, least), r * w_.max_turning / std::acos(std::clamp(c, -1.0, 1.0)));
  p.h = std::max(least, std::min(p.h, r));
}

template class FrontPlaces<true>;
template class FrontPlaces<false>;

}  // namespace st
