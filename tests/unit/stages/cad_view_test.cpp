#include "stages/cad_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// Ids of the cells of one dimension.
std::set<std::int32_t> ids(const CellView& view, std::int32_t dim) {
  std::set<std::int32_t> found;
  for (std::size_t i = 0; i < view.types.size(); ++i)
    if (view.values[0].second[i] == dim) found.insert(view.values[1].second[i]);
  return found;
}

TEST(CadView, has_every_face_and_every_edge_but_poles) {
  const Model model = test::make_model("sphere");
  const CellView view = view_cad(model, {});
  EXPECT_EQ(ids(view, 2), (std::set<std::int32_t>{1}));
  std::set<std::int32_t> edges;
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e)
    if (!model.tables().edge_is_degenerate[e]) edges.insert(e + 1);
  EXPECT_EQ(ids(view, 1), edges);
  EXPECT_TRUE(ids(view, 0).empty());
  EXPECT_EQ(static_cast<std::size_t>(view.offsets.back()), view.nodes.size());
}

TEST(CadView, shows_findings_at_their_place_and_on_what_has_them) {
  const Model model = test::make_model("box");
  const std::vector<ImportFinding> findings = {{FindingKind::kSliverFace, "face 2 \"TOP\"", {1, 2, 3}, 0.1},
                                               {FindingKind::kShortEdge, "edge 12", {4, 5, 6}, 0.1}};
  const CellView view = view_cad(model, findings);
  EXPECT_EQ(ids(view, 0), (std::set<std::int32_t>{1, 2}));
  std::set<std::pair<std::int32_t, std::int32_t>> marked;  // dim, id
  for (std::size_t i = 0; i < view.types.size(); ++i)
    if (view.values[5].second[i] > 0) marked.insert({view.values[0].second[i], view.values[1].second[i]});
  EXPECT_EQ(marked, (std::set<std::pair<std::int32_t, std::int32_t>>{{0, 1}, {0, 2}, {1, 12}, {2, 2}}));
  EXPECT_TRUE(view.points[view.nodes.back()] == (Vec3{4, 5, 6}));
}

TEST(CadView, takes_no_facets_of_the_size_of_the_walls_for_a_far_field) {
  const TemporaryDirectory dir;
  test::write_brep("box", dir / "box.brep");
  ImportOptions options;
  options.air.farfield = "sphere:100";
  ImportResult air = import_model(dir / "box.brep", options);
  const Facets facets = facets_to_see(Model(std::move(air.tables), std::move(air.brep)));
  EXPECT_LT(facets.triangle.size(), 20000u);
  EXPECT_GT(facets.triangle.size(), 500u);
  EXPECT_TRUE(std::is_sorted(facets.face.begin(), facets.face.end()));
}

TEST(CadView, knows_trailing_edges) {
  const CellView view = view_cad(test::make_model("sharp_wing"), {});
  const std::vector<std::int32_t>& wing_edge = view.values[4].second;
  EXPECT_TRUE(std::count(wing_edge.begin(), wing_edge.end(), 1) > 0);
}

}  // namespace
}  // namespace st
