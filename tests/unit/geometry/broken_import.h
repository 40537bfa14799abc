// Broken shapes through the import, and what it says of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "broken/broken_shapes.h"
#include "broken/damaged_shapes.h"
#include "broken/narrow_shapes.h"
#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st::test {

inline ImportResult import_broken(const std::string& shape, const ImportOptions& options = {}) {
  const TemporaryDirectory dir;
  write_broken(shape, dir / "model.brep");
  return import_model(dir / "model.brep", options);
}

inline ImportResult import_damaged(const std::string& shape, const ImportOptions& options = {}) {
  const TemporaryDirectory dir;
  write_damaged(shape, dir / "model.brep");
  return import_model(dir / "model.brep", options);
}

inline ImportResult import_narrow(const std::string& shape, const ImportOptions& options = {}) {
  const TemporaryDirectory dir;
  write_narrow(shape, dir / "model.brep");
  return import_model(dir / "model.brep", options);
}

inline std::vector<ImportFinding> findings_of(const ImportResult& r, const std::string& start) {
  std::vector<ImportFinding> found;
  std::copy_if(r.findings.begin(), r.findings.end(), std::back_inserter(found),
               [&](const ImportFinding& f) { return f.what().find(start) == 0; });
  return found;
}

/// The largest distance between a coedge's space curve and its trimming curve on the surface.
inline double largest_gap(const Model& model, FaceId f) {
  const ModelTables& t = model.tables();
  const auto surface = model.surface(f);
  double gap = 0;
  for (std::int32_t c = t.loop_coedge_offsets[t.face_loop_offsets[f]];
       c < t.loop_coedge_offsets[t.face_loop_offsets[f + 1]]; ++c) {
    const EdgeId e = t.coedge_edge[c];
    if (t.edge_is_degenerate[e]) continue;
    const auto curve = model.curve(e);
    const auto pcurve = model.pcurve(f, c);
    for (int k = 0; k <= 100; ++k) {
      const double at = t.edge_range[2 * e] + 0.01 * k * (t.edge_range[2 * e + 1] - t.edge_range[2 * e]);
      gap = std::max(gap, distance(curve->point(at), surface->point(pcurve->point(at))));
    }
  }
  return gap;
}

/// That a shape is closed and as large from a STEP file as from BREP; writes a.brep and a.step.
inline void expect_whole_in_step(const std::string& shape, const TemporaryDirectory& dir) {
  write_brep(shape, dir / "a.brep");
  write_step(shape, dir / "a.step", "MM");
  const ImportResult sound = import_model(dir / "a.brep", {}), r = import_model(dir / "a.step", {});
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area);
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume);
}

inline void expect_whole_in_iges(const std::string& shape, const TemporaryDirectory& dir) {
  write_brep(shape, dir / "a.brep");
  write_iges(shape, dir / "a.igs");
  const ImportResult sound = import_model(dir / "a.brep", {}), r = import_model(dir / "a.igs", {});
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area);
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume);
}

}  // namespace st::test
