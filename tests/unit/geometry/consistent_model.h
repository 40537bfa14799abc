// Whether tables and evaluators of a model fit each other.
#pragma once

#include <gtest/gtest.h>

#include "geometry/model/model.h"

namespace st::test {

/// Every table as long as it must be, and evaluators that fit it: curves end at their vertices, trimming curves lie on
/// them, loops close.
/// `of_box`: how exact arc lengths are, in diagonals.
inline void expect_consistent(const Model& model, double of_box = 1e-6) {
  const ModelTables& t = model.tables();
  const auto n_faces = static_cast<std::size_t>(t.n_faces()), n_edges = static_cast<std::size_t>(t.n_edges());
  for (const std::size_t n :
       {t.face_type.size(), t.face_uv_bounds.size() / 4, t.face_tolerance.size(), t.face_area.size(),
        t.face_width.size(), t.face_box.size(), t.labels.face_name.size(), t.face_color.size(), t.face_layer.size(),
        t.labels.face_group.size(), t.face_shell.size(), t.face_solid.size(), t.face_loop_offsets.size() - 1})
    ASSERT_EQ(n, n_faces);
  for (const std::size_t n : {t.edge_vertices.size() / 2, t.edge_range.size() / 2, t.edge_tolerance.size(),
                              t.edge_is_degenerate.size(), t.edge_name.size()})
    ASSERT_EQ(n, n_edges);
  ASSERT_EQ(t.vertex_tolerance.size(), t.vertex_xyz.size());
  ASSERT_EQ(t.face_loop_offsets.back(), t.n_loops());
  ASSERT_EQ(t.loop_coedge_offsets.back(), t.n_coedges());
  const double slack = 1e-6 * t.box().diagonal();
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    const auto c = model.curve(e);
    for (int end = 0; end < 2; ++end)
      EXPECT_LE(distance(c->point(t.edge_range[2 * e + end]), t.vertex_xyz[t.edge_vertices[2 * e + end]]), slack)
          << "edge " << e;
    EXPECT_NEAR(arc_length(*c, c->t_min(), c->t_max(), 32), t.edge_length[e], of_box * t.box().diagonal());
  }
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto s = model.surface(f);
    EXPECT_LT(t.labels.face_group[f], static_cast<std::int32_t>(t.labels.group_name.size()));
    for (const LoopId l : t.loops(f)) {
      const CoedgeId first = t.loop_coedge_offsets[l], end = t.loop_coedge_offsets[l + 1];
      for (CoedgeId c = first; c < end; ++c) {
        const EdgeId e = t.coedge_edge[c];
        const CoedgeId next = c + 1 < end ? c + 1 : first;
        EXPECT_EQ(t.edge_vertices[2 * e + !t.coedge_is_reversed[c]],
                  t.edge_vertices[2 * t.coedge_edge[next] + t.coedge_is_reversed[next]]);
        if (t.edge_is_degenerate[e]) continue;
        const auto curve = model.curve(e);
        const auto uv = model.pcurve(f, c);
        for (double share : {0.0, 0.3, 1.0}) {
          const double at = t.edge_range[2 * e] + share * (t.edge_range[2 * e + 1] - t.edge_range[2 * e]);
          EXPECT_LE(distance(s->point(uv->point(at)), curve->point(at)), t.edge_tolerance[e] + slack)
              << "face " << f << " edge " << e;
        }
      }
    }
  }
}

}  // namespace st::test
