#include "stages/check_parts.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/length.h"
#include "base/threads.h"
#include "geometry/model/edge_faces.h"
#include "stages/field_on_mesh.h"
#include "stages/stored_model.h"

namespace st {

namespace {

double sewing_tolerance(const GeometryArtifact& g) {
  const auto options = nlohmann::json::parse(g.header.options_json, nullptr, false);
  if (!options.is_object() || !options.contains("sew") || !options["sew"].is_string()) return 0;
  return resolve_length(parse_length(options["sew"].get<std::string>(), "--sew"),
                        {g.tables.reference_diagonal(), g.tables.unit_in_m}, "--sew");
}

/// Jobs that do not depend on each other, the longest first; together they are a share of all checks.
void run_measures(std::vector<std::function<void()>> jobs, double share, Progress& progress) {
  for (auto& job : jobs)
    job = [&progress, work = std::move(job), part = share / static_cast<double>(jobs.size())] {
      work();
      progress.advance(part);
    };
  run_jobs(jobs);
}

void find_pairs_within(const SurfaceMesh& mesh, const OwnTriangles& own, CheckParts& parts) {
  parts.pairs = find_crossing_triangles(mesh.node_xyz, std::span(mesh.triangles).subspan(own.begin, own.size()),
                                        parts.was_ended, &parts.n_compared);
  for (TrianglePair& p : parts.pairs) p.a += own.first, p.b += own.first;
}

/// What SizeField::local() tells.
RequestedSize requested_by(const SizeField& field) {
  if (field.is_stretched()) return [&field](Vec3 p, int& hint) { return field.local(p, hint); };
  return [&field](Vec3 p, int& hint) {
    const double length = field.size(p, hint);
    return LocalSize{length, length, {}};
  };
}

}  // namespace

CadSide::CadSide(GeometryArtifact&& g, const std::string& path)
    : sewing(sewing_tolerance(g)), model(stored_model(g, path)) {
  const EdgeFaces faces_at(model.tables());
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e) {
    may_be_open.push_back(faces_at[e].size() == 1);
    may_be_nonmanifold.push_back(faces_at[e].size() > 2);
  }
}

CheckBasis CheckBasis::of(const SurfaceMesh& mesh, const CadSide* cad, const SizeField* field,
                          const CheckStageOptions& options) {
  CheckBasis basis{cad, field, &options, TriangleCounts::of(mesh), {}, {}, {}};
  Box3 box;
  for (const Vec3 p : mesh.node_xyz) box.add(p);
  basis.origin = box.center();
  if (!cad) return basis;
  const std::int32_t n_faces = cad->model.tables().n_faces();
  basis.face_place = face_places(mesh, n_faces);
  basis.face_side = sides_of_faces(side_parts(mesh.corner_uv, mesh.triangle_face), n_faces);
  return basis;
}

void CheckParts::add(const CheckParts& next, const TriangleCounts& counts) {
  const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  topology.add(next.topology);
  shape.add(next.shape);
  append(measure, next.measure);
  quality.add(next.quality, counts);
  conformity.add(next.conformity, counts.model);
  chords.add(next.chords);
  append(deviation, next.deviation);
  append(faces, next.faces);
  bad.add(next.bad);
  causes.angle_deg = next.causes.angle_deg;
  causes.add(next.causes);
  append(pairs, next.pairs);
  n_compared += next.n_compared;
  was_ended |= next.was_ended;
}

void report_parts(const CheckBasis& basis, CheckParts& parts, const FaceLabels& labels, Findings& f) {
  f.n_triangles = basis.counts.model;
  f.topology = std::move(parts.topology);
  f.shape = std::move(parts.shape);
  f.measure = measure_of(parts.measure, labels.face_name.size());
  f.quality = report_quality(std::move(parts.quality), basis.counts);
  if (basis.field)
    f.conformity = report_conformity(std::move(parts.conformity), labels.group_name.size(), labels.face_name.size());
  if (!basis.cad) return;
  f.cad->causes = std::move(parts.causes);
  f.cad->deviation = report_deviation(parts.deviation, basis.cad->model.tables().n_faces());
}

CheckParts measure_share(const CheckBasis& basis, const SurfaceMesh& mesh, const TriangleCorners& corners,
                         const OwnTriangles& own, std::vector<std::function<void()>> more, Progress& progress,
                         double share) {
  constexpr double kWithoutEdges = 0.6;  // of the time
  const CadSide* cad = basis.cad;
  const SizeField* field = basis.field;
  CheckParts parts;
  std::vector<std::function<void()>> jobs;
  jobs.emplace_back([&] { find_pairs_within(mesh, own, parts); });
  if (cad)
    jobs.emplace_back([&] {
      DeviationSum deviation(mesh, own, basis.face_side);
      parts.chords = estimate_chord_error(cad->model, mesh, own, &deviation);
      parts.deviation = deviation.parts();
    });
  for (auto& job : more) jobs.push_back(std::move(job));
  jobs.emplace_back([&] {
    parts.measure = measure_mesh(mesh, basis.origin, own);
    if (cad) parts.faces = measure_faces(mesh, own, basis.face_place, cad->model.tables());
    parts.bad = find_bad_triangles(mesh, corners, basis.options->thresholds, own);
  });
  run_measures(std::move(jobs), kWithoutEdges * share, progress);
  const EdgeTable edges = edges_of(mesh);
  jobs.clear();
  jobs.emplace_back([&] { parts.quality = measure_quality(mesh, edges, corners, own, basis.counts); });
  if (field)
    jobs.emplace_back([&] {
      parts.conformity =
          measure_conformity(mesh, edges, requested_by(*field), lengths_along(*field), own, basis.counts.model);
    });
  jobs.emplace_back([&] { parts.shape = check_shape(mesh, edges, own); });
  jobs.emplace_back([&] { parts.topology = check_topology(mesh, edges, cad ? cad->edges() : CadEdges{}, own); });
  run_measures(std::move(jobs), (1 - kWithoutEdges) * share, progress);
  return parts;
}

}  // namespace st
