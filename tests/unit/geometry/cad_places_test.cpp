#include "geometry/model/cad_places.h"
#include "geometry/shape/member_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/geometry/joined_models.h"

namespace st {
namespace {

TEST(CadPlaces, are_those_of_the_model_and_lie_where_the_joined_face_does) {
  const test::Joined joined("wing_of_200");
  const Model& cad = joined.model.cad();
  const ModelTables& t = joined.model.tables();
  const CadPlaces places(joined.composites, t.n_faces());
  int n_joined = 0;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (t.loops(f).empty()) continue;  // part of another
    const auto surface = joined.model.surface(f);
    std::vector<Vec2> uv;
    const FaceId member = joined.model.cad_faces(f, std::vector<Vec2>(1))[0];
    std::int32_t i = 0;
    while (i < joined.composites.size() &&
           std::ranges::find(joined.composites.members(i), member) == joined.composites.members(i).end())
      ++i;
    if (i == joined.composites.size()) {
      uv = {{0.5 * (surface->u_min() + surface->u_max()), 0.5 * (surface->v_min() + surface->v_max())}};
    } else {
      ++n_joined;
      const Chart chart = joined.composites.chart(i);
      for (const Corners& c : chart.corners)
        uv.push_back(0.5 * chart.uv[c[0]] + 0.3 * chart.uv[c[1]] + 0.2 * chart.uv[c[2]]);
    }
    const std::vector<CadPlace> found = places.on(f, uv);
    const std::vector<FaceId> faces = joined.model.cad_faces(f, uv);
    for (std::size_t k = 0; k < uv.size(); ++k) {
      EXPECT_EQ(found[k].face, faces[k]);
      EXPECT_LE(distance(cad.surface(found[k].face)->point(found[k].uv), surface->point(uv[k])), 1e-12);
    }
  }
  EXPECT_EQ(n_joined, joined.composites.size());
}

TEST(CadPlaces, need_charts_that_lead_nowhere_else) {
  const test::Joined joined("wing_of_8");
  const FaceId n = joined.model.tables().n_faces();
  EXPECT_TRUE(has_sound_charts(joined.composites, n));
  const auto is_sound = [&](const auto& change) {
    Composites c = joined.composites;
    change(c);
    return has_sound_charts(c, n);
  };
  EXPECT_FALSE(is_sound([](Composites& c) { c.member.back() = 100; }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.member[1] = c.member[0]; }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.member_offsets.back() += 1; }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.triangle_face[3] = -1; }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.triangle_nodes[3][1] = 1'000'000; }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.triangle_uv.pop_back(); }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.triangle_pole.pop_back(); }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.triangle_pole[0] = kNPoleCorners; }));
  EXPECT_FALSE(is_sound([](Composites& c) { c.node_uv.pop_back(); }));
}

}  // namespace
}  // namespace st
