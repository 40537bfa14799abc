#include "stages/check_thresholds.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/length.h"
#include "stages/check_cad.h"

namespace st {
namespace {

/// One value of the whole mesh against its bound: one defect without a place, or none.
Check check_value(const std::string& name, const std::string& what, bool is_good, const std::string& note) {
  Check c{name, what, {}, true, note};
  if (!is_good) c.defects.add({});
  return c;
}

void check_quality(const BadTriangles& bad, const CheckThresholds& asked, Findings& f) {
  const QualityReport& q = f.quality;
  if (asked.min_quality)
    f.checks.push_back(
        {"min-quality", fmt::format("triangles of quality below {}", *asked.min_quality), bad.quality, true, ""});
  if (asked.min_angle_deg)
    f.checks.push_back(
        {"min-angle", fmt::format("triangles with an angle below {} deg", *asked.min_angle_deg), bad.angle, true, ""});
  if (asked.min_mean_quality)
    f.checks.push_back(check_value("min-mean-quality", fmt::format("mean quality below {}", *asked.min_mean_quality),
                                   q.model.mean >= *asked.min_mean_quality, fmt::format("{:.4f}", q.model.mean)));
  if (asked.min_p1_quality)
    f.checks.push_back(check_value("min-p1-quality",
                                   fmt::format("first percentile of quality below {}", *asked.min_p1_quality),
                                   q.model.p1 >= *asked.min_p1_quality, fmt::format("{:.4f}", q.model.p1)));
  if (asked.max_jump)
    f.checks.push_back(check_value("max-jump", fmt::format("growth (99.9 %) above {}", *asked.max_jump),
                                   q.jump_p999 <= *asked.max_jump, fmt::format("{:.3f}", q.jump_p999)));
}

void check_causes(const CheckThresholds& asked, Findings& f) {
  if (!asked.max_free_sharp || !f.cad) return;
  Check c{"max-free-sharp",
          fmt::format("triangles with an angle below {:g} deg that the CAD does not force", f.cad->causes.angle_deg),
          {},
          true,
          ""};
  for (const CausePlace& p : f.cad->causes.sharp.worst[static_cast<std::size_t>(ShapeCause::kFree)])
    c.defects.add({p.xyz, p.face, kNone});
  c.defects.count = f.cad->causes.sharp.free();
  c.allowed = *asked.max_free_sharp;
  f.checks.push_back(c);
}

void check_sizes(const CheckThresholds& asked, Findings& f) {
  if (!asked.min_size_share || !f.conformity) return;
  const double share = f.conformity->free.share();
  f.checks.push_back(check_value("min-size-share",
                                 fmt::format("share of edges of the requested length below {}", *asked.min_size_share),
                                 share >= *asked.min_size_share, fmt::format("{:.4f}", share)));
}

void check_deviation(const CheckThresholds& asked, const ModelTables& tables, Findings& f) {
  const std::vector<DeviationStats>& faces = f.cad->deviation.faces;
  if (!asked.max_deviation.empty()) {
    const double bound = resolve_length(parse_length(asked.max_deviation, "--max-deviation"),
                                        {tables.reference_diagonal(), tables.unit_in_m}, "--max-deviation");
    const std::vector<double> of_group = face_tolerances(tables.labels);
    const std::string own = of_group.empty() ? "" : ", or the tolerance of their group,";
    Check c{"max-deviation",
            fmt::format("faces with a triangle centroid off the surface by more than {:.6g}{}{}", bound,
                        in_unit(f.unit), own),
            {},
            true,
            ""};
    for (FaceId i = 0; i < static_cast<FaceId>(faces.size()); ++i) {
      const double tolerance = group_tolerance(of_group, i);
      if (faces[i].max_distance > (tolerance > 0 ? tolerance : bound))
        c.defects.add({faces[i].distance_place, i, kNone});
    }
    f.checks.push_back(c);
  }
  if (!asked.max_normal_deviation_deg) return;
  Check c{
      "max-normal-deviation",
      fmt::format("faces with a triangle turned from the surface by more than {} deg", *asked.max_normal_deviation_deg),
      {},
      true,
      ""};
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (faces[i].max_angle_deg > *asked.max_normal_deviation_deg)
      c.defects.add({faces[i].angle_place, static_cast<FaceId>(i), kNone});
  f.checks.push_back(c);
}

}  // namespace

BadTriangles find_bad_triangles(const SurfaceMesh& mesh, const TriangleCorners& corners, const CheckThresholds& asked,
                                const OwnTriangles& own) {
  BadTriangles bad;
  if (!asked.min_quality && !asked.min_angle_deg) return bad;
  for (TriangleId t = own.begin; t < own.end; ++t) {
    const auto& n = mesh.triangles[t].n;
    const auto [a, b, c] = corners(t);
    const DefectPlace place{(mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3,
                            mesh.triangle_face[t], kNone, own.number(t)};
    if (asked.min_quality && triangle_quality(a, b, c) < *asked.min_quality) bad.quality.add(place);
    if (asked.min_angle_deg && std::ranges::min(triangle_angles_deg(a, b, c)) < *asked.min_angle_deg)
      bad.angle.add(place);
  }
  return bad;
}

void check_thresholds(const BadTriangles& bad, const CheckThresholds& asked, const ModelTables* tables, Findings& f) {
  check_quality(bad, asked, f);
  check_causes(asked, f);
  check_sizes(asked, f);
  if (tables) check_deviation(asked, *tables, f);
}

}  // namespace st
