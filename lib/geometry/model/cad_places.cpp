#include "geometry/model/cad_places.h"

#include <algorithm>
#include <array>

#include "geometry/model/id_checks.h"
#include "geometry/shape/composite_surface.h"

namespace st {

CadPlaces::CadPlaces(const Composites& composites, FaceId n_faces)
    : composites_(composites), composite_(static_cast<std::size_t>(n_faces), kNone) {
  for (std::int32_t i = 0; i < composites.size(); ++i)
    composite_[static_cast<std::size_t>(composites.members(i).front())] = i;
}

std::vector<CadPlace> CadPlaces::on(FaceId face, std::span<const Vec2> uv) const {
  const std::int32_t i = composite_[static_cast<std::size_t>(face)];
  std::vector<CadPlace> places;
  places.reserve(uv.size());
  if (i == kNone) {
    for (const Vec2 p : uv) places.push_back({face, p});
    return places;
  }
  const Chart chart = composites_.chart(i);
  const ChartSurface surface(chart);
  const auto first = static_cast<std::size_t>(composites_.triangle_offsets[i]);
  for (const Vec2 p : uv) {
    const auto t = static_cast<std::size_t>(surface.locate(p).triangle);
    const Corners& c = chart.corners[t];
    const MemberMap map({chart.uv[c[0]], chart.uv[c[1]], chart.uv[c[2]]}, composites_.triangle_uv[first + t],
                        composites_.triangle_pole[first + t]);
    places.push_back({composites_.triangle_face[first + t], map(p).uv});
  }
  return places;
}

std::vector<Vec2> middles(std::span<const Vec2> uv) {
  std::vector<Vec2> result;
  for (std::size_t c = 0; c + 2 < uv.size(); c += 3) result.push_back((1.0 / 3) * (uv[c] + uv[c + 1] + uv[c + 2]));
  return result;
}

bool has_sound_charts(const Composites& c, FaceId n_faces) {
  if (c.member_offsets.empty()) return false;
  const auto n = static_cast<std::size_t>(c.size());
  std::vector<FaceId> members = c.member;
  std::ranges::sort(members);
  if (!are_offsets(c.member_offsets, n, c.member.size()) || members.empty() || members.front() < 0 ||
      members.back() >= n_faces || std::ranges::adjacent_find(members) != members.end() ||
      !are_offsets(c.node_offsets, n, c.node_uv.size()) || c.node_xyz.size() != c.node_uv.size() ||
      !are_offsets(c.triangle_offsets, n, c.triangle_nodes.size()) ||
      c.triangle_face.size() != c.triangle_nodes.size() || c.triangle_uv.size() != c.triangle_nodes.size() ||
      c.triangle_pole.size() != c.triangle_nodes.size() || !are_pole_codes(c.triangle_pole))
    return false;
  for (std::int32_t i = 0; i < c.size(); ++i) {
    const std::span<const FaceId> own = c.members(i);
    if (own.size() < 2 || !std::ranges::is_sorted(own) || c.triangle_offsets[i] == c.triangle_offsets[i + 1])
      return false;
    for (std::int32_t t = c.triangle_offsets[i]; t < c.triangle_offsets[i + 1]; ++t)
      if (!are_below(c.triangle_nodes[static_cast<std::size_t>(t)], c.node_offsets[i + 1] - c.node_offsets[i]) ||
          !std::ranges::binary_search(own, c.triangle_face[static_cast<std::size_t>(t)]))
        return false;
  }
  return true;
}

}  // namespace st
