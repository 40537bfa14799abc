// Code of the kernels, but for lengths along. For cone_along_code.h alone.
#pragma once

#include "sizing/cone_kernels.h"
#include "sizing/cone_vectors_code.h"

namespace st {
namespace {

constexpr float kProbe[3][kProbes] = {{-1, 1, -1, 1, -1, 1, -1, 1, -1, 1, 0, 0, 0, 0, 0, 0},
                                      {-1, -1, 1, 1, -1, -1, 1, 1, 0, 0, -1, 1, 0, 0, 0, 0},
                                      {-1, -1, -1, -1, 1, 1, 1, 1, 0, 0, 0, 0, -1, 1, 0, 0}};

/// The thirteen numbers of a cone by name.
struct ConeView {
  const float* x;  // [3]
  float length, slope;
  const float* side[2];  // [3] each
  const float* half;     // [2]

  explicit ConeView(const float* cone)
      : x(cone), length(cone[3]), slope(cone[4]), side{cone + 5, cone + 8}, half(cone + 11) {}

  /// Distances of places that lie so far from the middle of its rectangle.
  F8 distance(F8 dx, F8 dy, F8 dz) const {
    for (int e = 0; e < 2 && half[e] > 0; ++e) {
      const F8 ux = all(side[e][0]), uy = all(side[e][1]), uz = all(side[e][2]), end = all(half[e]),
               along = most(least(dx * ux + dy * uy + dz * uz, end), -end);
      dx = dx - along * ux;
      dy = dy - along * uy;
      dz = dz - along * uz;
    }
    return root(dx * dx + dy * dy + dz * dz);
  }
  F8 length_at(F8 distance) const { return length + slope * distance; }
};

inline float clamp(float v, float lo, float hi) { return v < lo ? lo : hi < v ? hi : v; }

/// Eight places, from the lower corner of the root.
struct EightPlaces {
  F8 x, y, z;

  F8 distance(const ConeView& cone) const { return cone.distance(x - cone.x[0], y - cone.x[1], z - cone.x[2]); }
  F8 length(const ConeView& cone) const { return cone.length_at(distance(cone)); }
};

struct CellView {
  const float* c;  // [3]
  float half;

  explicit CellView(const float* cell) : c(cell), half(cell[3]) {}

  /// `at_center`: the length of the cone there.
  bool is_near(const ConeView& cone, float at_center) const {
    constexpr float kNearby = 2.25F;  // half edges from the centre: up to half an edge from the closest point
    return at_center <= cone.length + cone.slope * kNearby * half;
  }

  void lengths(const ConeView& cone, F8 (&to)[2]) const {
    const F8 x = all(c[0] - cone.x[0]), y = all(c[1] - cone.x[1]), z = all(c[2] - cone.x[2]);
    for (int g = 0; g < 2; ++g)
      to[g] = cone.length_at(cone.distance(x + half * load(kProbe[0] + 8 * g), y + half * load(kProbe[1] + 8 * g),
                                           z + half * load(kProbe[2] + 8 * g)));
  }

  /// Where one looks along the way from the place closest to a cone's middle towards the centre.
  EightPlaces towards_center(const ConeView& cone) const {
    constexpr float kTowards[8] = {0, 0.25F, 0.5F, 0.75F, 0, 0.25F, 0.5F, 0.75F};
    const F8 share = load(kTowards);
    const auto along = [&](int k) {
      const float from = clamp(cone.x[k], c[k] - half, c[k] + half);
      return from + share * all(c[k] - from);
    };
    return {along(0), along(1), along(2)};
  }

  /// The places of the cell closest to eight of a cone's rectangle: around it, its middle, and the place closest to the
  /// centre of the cell.
  EightPlaces closest_to_rectangle(const ConeView& cone) const {
    constexpr float kInside = 0.8F;  // of the sides: further out its neighbours count
    float towards[2];
    for (int e = 0; e < 2; ++e) {
      float along = 0;
      for (int k = 0; k < 3; ++k) along += (c[k] - cone.x[k]) * cone.side[e][k];
      towards[e] = clamp(along, -kInside * cone.half[e], kInside * cone.half[e]);
    }
    constexpr float kU[8] = {0, 1, -1, 0, 1, 1, -1, -1}, kV[8] = {0, 0, 0, 0, 1, -1, 1, -1},
                    kTowards[8] = {0, 0, 0, 1, 0, 0, 0, 0};
    const F8 share = load(kTowards), along_u = kInside * cone.half[0] * load(kU) + towards[0] * share,
             along_v = kInside * cone.half[1] * load(kV) + towards[1] * share;
    const auto closest = [&](int k) {
      return most(all(c[k] - half),
                  least(all(c[k] + half), cone.x[k] + along_u * all(cone.side[0][k]) + along_v * all(cone.side[1][k])));
    };
    return {closest(0), closest(1), closest(2)};
  }
};

bool is_near_cell(const float* cell, const float* cone) {
  const CellView in(cell);
  const ConeView of(cone);
  float way[3];
  for (int k = 0; k < 3; ++k) way[k] = in.c[k] - of.x[k];
  for (int e = 0; e < 2 && of.half[e] > 0; ++e) {
    const float* unit = of.side[e];
    const float along = clamp(way[0] * unit[0] + way[1] * unit[1] + way[2] * unit[2], -of.half[e], of.half[e]);
    for (int k = 0; k < 3; ++k) way[k] -= along * unit[k];
  }
  const float distance = __builtin_sqrtf(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
  return in.is_near(of, of.length + of.slope * distance);
}

std::int32_t sides_ahead(const float* cell, const float* cone, bool& is_near) {
  constexpr float kOnSide = 1 + 1e-5F;  // of half the edge: a sample on the side may be rounded to the other
  const CellView in(cell);
  const ConeView of(cone);
  is_near = is_near_cell(cell, cone);
  const float half = kOnSide * in.half;
  constexpr std::int8_t kEverySecond[8] = {0, 1, 4, 5, 16, 17, 20, 21};
  // of four numbers the first three count
  const F4 reach = magnitudes(load_four(of.side[0])) * of.half[0] + magnitudes(load_four(of.side[1])) * of.half[1],
           from_center = load_four(of.x) - load_four(in.c);
  return kEverySecond[signs(from_center + reach >= -half) & 7] | kEverySecond[signs(from_center - reach <= half) & 7]
                                                                     << 1;
}

void cone_lengths(const float* cell, const float* cone, float* lengths) {
  F8 at[2];
  CellView(cell).lengths(ConeView(cone), at);
  store(lengths, at[0]);
  store(lengths + 8, at[1]);
}

bool offer_cone(const float* cell, const float* cone, const float* best, const ConeShares& shares, float* lengths,
                bool& is_near) {
  const CellView in(cell);
  const ConeView of(cone);
  F8 at[2];
  in.lengths(of, at);
  store(lengths, at[0]);
  store(lengths + 8, at[1]);
  is_near = in.is_near(of, lengths[kProbes - 1]);
  const F8 share = all(is_near ? shares.nearby : shares.far);
  return is_any((at[0] < share * load(best)) | (at[1] < share * load(best + 8)));
}

float take_lengths(const float* lengths, std::int32_t sample, float* best, std::int32_t* winner) {
  for (int g = 0; g < kProbes; g += 8) {
    const F8 own = load(lengths + g), other = load(best + g);
    store(winner + g, where(own < other, sample, load(winner + g)));
    store(best + g, least(own, other));
  }
  return least_of(least(load(lengths), load(lengths + 8)));
}

/// Whether a cone of such lengths at the places, over `share`, wins at any of them where `wins` is true.
bool wins_over(const EightPlaces& places, const F8& limit, I8 wins, const KnownCones& known) {
  if (!is_any(wins)) return false;
  const auto ask = [&](std::int32_t sample) {
    wins = wins & (places.length(ConeView(known.cone + kConeNumbers * static_cast<std::int64_t>(sample))) >= limit);
    return is_any(wins);
  };
  if (known.first >= 0 && !ask(known.first)) return false;
  const auto is_asked = [&](std::int32_t sample) { return sample != known.first && sample != known.without; };
  for (std::int32_t i = 0; i < known.n_own; ++i)
    if (is_asked(known.own[i]) && !ask(known.own[i])) return false;
  for (std::int32_t k = known.link; k >= 0; k = known.links[k].next)
    if (is_asked(known.links[k].sample) && !ask(known.links[k].sample)) return false;
  return true;
}

bool wins_nearby(const float* cell, const float* cone, float share, float largest, const KnownCones& known) {
  constexpr float kWide = 0.25F;  // of half the edge: wider rectangles are looked at in more places
  const CellView in(cell);
  const ConeView of(cone);
  const EightPlaces places = of.half[0] > kWide * in.half ? in.closest_to_rectangle(of) : in.towards_center(of);
  const F8 distance = places.distance(of), limit = (1 / share) * of.length_at(distance);
  return wins_over(places, limit, (distance < 2 * in.half) & (limit < largest), known);
}

/// The middles of the sides and half the ways to the corners; then a grid of four by four.
EightPlaces places_on(const ConeFace& face, std::int32_t set) {
  constexpr float kU[kFaceSets][kFacePlaces] = {{-1, 1, 0, 0, -0.5F, 0.5F, -0.5F, 0.5F},
                                                {-0.75F, -0.25F, 0.25F, 0.75F, -0.75F, -0.25F, 0.25F, 0.75F},
                                                {-0.75F, -0.25F, 0.25F, 0.75F, -0.75F, -0.25F, 0.25F, 0.75F}},
                  kV[kFaceSets][kFacePlaces] = {{0, 0, -1, 1, -0.5F, -0.5F, 0.5F, 0.5F},
                                                {-0.75F, -0.75F, -0.75F, -0.75F, -0.25F, -0.25F, -0.25F, -0.25F},
                                                {0.25F, 0.25F, 0.25F, 0.25F, 0.75F, 0.75F, 0.75F, 0.75F}};
  const F8 u = face.half * load(kU[set]), v = face.half * load(kV[set]), across = all(face.c[face.axis]);
  switch (face.axis) {
    case 0:
      return {across, face.c[1] + u, face.c[2] + v};
    case 1:
      return {face.c[0] + v, across, face.c[2] + u};
    default:
      return {face.c[0] + u, face.c[1] + v, across};
  }
}

bool wins_on_face(const ConeFace& face, std::int32_t set, const float* cone, float largest, const KnownCones& known) {
  const EightPlaces places = places_on(face, set);
  const F8 limit = (1 / kClearlyOnFace) * places.length(ConeView(cone));
  return wins_over(places, limit, limit < all(largest), known);
}

/// Of the cones of one cell alone the one that tells `length` at a place. Precondition: one does.
FaceCone& teller_of(std::int32_t cell, float length, const float* lengths, FaceCone* on_face) {
  while (on_face->of != cell || *lengths != length) {
    ++on_face;
    lengths += kFacePlaces;
  }
  return *on_face;
}

std::int32_t settle_face(const ConeFace& face, std::int32_t set, const float* cones, float largest, std::int32_t ways,
                         FaceCone* on_face, std::int32_t n, float* lengths) {
  const EightPlaces places = places_on(face, set);
  F8 best[2] = {all(largest), all(largest)};
  for (std::int32_t i = 0; i < n; ++i) {
    const F8 own = places.length(ConeView(cones + kConeNumbers * static_cast<std::int64_t>(on_face[i].sample)));
    store(lengths + kFacePlaces * i, own);
    if (on_face[i].of & 1) best[0] = least(best[0], own);
    if (on_face[i].of & 2) best[1] = least(best[1], own);
  }
  const F8 share = all(kClearlyOnFace);
  std::int32_t n_added = 0;
  for (int from = 0; from < 2; ++from) {
    F8 &here = best[from], &there = best[1 - from];
    while ((ways >> from & 1) != 0 && is_any(here < share * there)) {
      float own[kFacePlaces], other[kFacePlaces];
      store(own, here);
      store(other, there);
      int k = 0;
      while (!(own[k] < kClearlyOnFace * other[k])) ++k;
      FaceCone& added = teller_of(from + 1, own[k], lengths + k, on_face);
      added.of = 3;
      added.added = 2 - from;
      there = least(there, load(lengths + kFacePlaces * (&added - on_face)));
      ++n_added;
    }
  }
  return n_added;
}

/// Four numbers of each of eight from the n-th on, by number.
void turn_eight(const float* const (&from)[8], int n, F8& first, F8& second, F8& third, F8& fourth) {
  F8 of[4];
  for (int i = 0; i < 4; ++i) of[i] = load_fours(from[i] + n, from[i + 4] + n);
  const F8 ab_first = mix_first(of[0], of[1]), ab_last = mix_last(of[0], of[1]), cd_first = mix_first(of[2], of[3]),
           cd_last = mix_last(of[2], of[3]);
  first = join_first(ab_first, cd_first);
  second = join_last(ab_first, cd_first);
  third = join_first(ab_last, cd_last);
  fourth = join_last(ab_last, cd_last);
}

/// Eight cones side by side.
struct EightCones {
  F8 x[3], length, slope, side[2][3], half[2];

  explicit EightCones(const float* const (&cone)[8]) {
    turn_eight(cone, 0, x[0], x[1], x[2], length);
    turn_eight(cone, 4, slope, side[0][0], side[0][1], side[0][2]);
    turn_eight(cone, 8, side[1][0], side[1][1], side[1][2], half[0]);
    float last[8];
    for (int i = 0; i < 8; ++i) last[i] = cone[i][kConeNumbers - 1];
    half[1] = load(last);
  }

  /// By what each is longer at a place, see ConeKernels::least, than at its rectangle.
  F8 rise_at(const float* place) const {
    F8 way[3];
    for (int k = 0; k < 3; ++k) way[k] = (all(place[k]) - x[k]) + all(place[4 + k]);
    for (int e = 0; e < 2; ++e) {
      const F8 within = most(least(dot(way, side[e]), half[e]), -half[e]);
      for (int k = 0; k < 3; ++k) way[k] = way[k] - within * side[e][k];
    }
    return slope * root(dot(way, way));
  }

 private:
  static F8 dot(const F8 (&a)[3], const F8 (&b)[3]) { return (a[0] * b[0] + a[2] * b[2]) + a[1] * b[1]; }
};

/// The eight of a list from the k-th on, or the last one again. Inlined: they stay in registers.
[[gnu::always_inline]] inline EightCones eight_of(const float* cones, const std::int32_t* own, std::int32_t n,
                                                  std::int32_t k) {
  const float* cone[8];
  for (std::int32_t i = 0; i < 8; ++i)
    cone[i] = cones + kConeNumbers * static_cast<std::int64_t>(own[k + i < n ? k + i : n - 1]);
  return EightCones(cone);
}

/// See ConeKernels::least. Calls f(k, eight, rise) for each eight that it asks.
template <class F>
[[gnu::always_inline]] inline float least_of_cones(const float* cones, const std::int32_t* own, std::int32_t n,
                                                   const float* place, float largest, std::int32_t* winner,
                                                   const F& f) {
  F8 best = all(largest);
  I8 from = where(best >= best, -1, I8{});  // where in `own` the eight begin that tell it
  float result = largest;
  for (std::int32_t k = 0; k < n; k += 8) {
    if (!(cones[kConeNumbers * static_cast<std::int64_t>(own[k]) + 3] < result)) break;  // the shortest from here on
    const EightCones eight = eight_of(cones, own, n, k);
    const F8 rise = eight.rise_at(place), length = eight.length + rise;
    f(k, eight, rise);
    from = where(length < best, k, from);
    best = least(length, best);
    result = least_of(best);
  }
  if (!winner) return result;
  float lengths[8];
  std::int32_t begin[8];
  store(lengths, best);
  store(begin, from);
  std::int32_t first = n;
  for (std::int32_t i = 0; i < 8; ++i)
    if (lengths[i] == result && begin[i] >= 0 && begin[i] + i < first) first = begin[i] + i;
  *winner = first < n ? first : -1;
  return result;
}

float least_length(const float* cones, const std::int32_t* own, std::int32_t n, const float* place, float largest,
                   std::int32_t* winner) {
  return least_of_cones(cones, own, n, place, largest, winner, [](std::int32_t, const EightCones&, const F8&) {});
}

}  // namespace
}  // namespace st
