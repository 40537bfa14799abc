#include "meshing/engine/close_failed.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "base/threads.h"
#include "geometry/model/cad_tolerance.h"
#include "meshing/engine/tiled_regions.h"
#include "meshing/face/face_patch.h"
#include "meshing/face/loop_closing.h"

namespace st {
namespace {

constexpr double kNearEnough = 10;  // tolerances of the CAD: distance of a closed face's triangles from its surface

struct Closed {
  std::optional<FacePatch> patch;  // none: it stays a hole
  bool is_near = false;
  double deviation = 0;
  std::string error;
};

Closed close(FaceId f, const FaceClosing& by, const BoundaryNumbering& numbering) {
  const CurrentWork at_face("face", f + 1, by.limit(f));
  const ModelTables& tables = numbering.tables;
  const FaceField field(by.field, by.refinements, tables.face_box[f]);
  std::unique_ptr<Surface> surface;
  FaceBoundary boundary;
  try {
    surface = by.model.surface(f);
    boundary = make_face_boundary(by.model, *surface, f, numbering);
  } catch (const Error&) {
    surface.reset();
    boundary = make_boundary_in_space(f, numbering);
  }
  const ClosedFace closed = close_loops(surface.get(), boundary, field.get(), kNearEnough * cad_tolerance(tables, f));
  if (closed.mesh.cause != FailureCause::kNone) return {};
  FacePatch patch = make_patch(tables, f, boundary, closed.mesh, numbering);
  if (!has_numbers_only(patch)) return {};
  return {std::move(patch), closed.is_near, closed.deviation, {}};
}

}  // namespace

void close_failed(const FaceClosing& by, MeshedFaces& faces) {
  const BoundaryNumbering& numbering = faces.numbering();
  std::vector<FaceId> holes;
  for (FaceId f = 0; f < numbering.tables.n_faces(); ++f)
    if (faces.outcome(f).is_hole() && !by.left_out.contains(f)) holes.push_back(f);
  std::vector<Closed> closed(holes.size());
  parallel_for(holes.size(), 1, [&](std::size_t i, std::size_t) {
    try {
      closed[i] = close(holes[i], by, numbering);
    } catch (const Error& e) {
      closed[i].error = e.what();
    }
  });
  for (std::size_t i = 0; i < holes.size(); ++i) {
    Closed& c = closed[i];
    if (c.patch) faces.close(holes[i], std::move(*c.patch), c.is_near, c.deviation);
    if (c.error.empty()) continue;
    log_info(fmt::format("{} is not closed either: {}", numbering.tables.face_label(holes[i]), c.error));
  }
}

}  // namespace st
