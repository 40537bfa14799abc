#include "geometry/flite/flite_writer.h"

#include <algorithm>
#include <map>

#include "geometry/flite/flite_divide.h"
#include "geometry/flite/flite_sampling.h"

namespace st {
namespace {

constexpr double kOfSize = 1e-3;  // of an edge's length or a face's width: what is smaller than the tolerance keeps its
                                  // form

class Exporter {
 public:
  Exporter(const Model& whole, const DividedModel& divided, double tolerance)
      : whole_(whole.tables()), divided_(divided), model_(divided.model), t_(model_.tables()) {
    result_.tolerance = tolerance;
  }

  FliteExport run() {
    for (EdgeId e = 0; e < t_.n_edges(); ++e) add_edge(e);
    for (FaceId f = 0; f < t_.n_faces(); ++f) add_face(f);
    count_divided();
    return std::move(result_);
  }

 private:
  void add_edge(EdgeId e) {
    segments_of_edge_.emplace_back();
    if (t_.edge_is_degenerate[e]) return;
    const VertexId start = t_.edge_vertices[2 * e], end = t_.edge_vertices[2 * e + 1];
    const double t0 = t_.edge_range[2 * e], t1 = t_.edge_range[2 * e + 1];
    const auto curve = model_.curve(e);
    const Vec3 a = t_.vertex_xyz[start], b = t_.vertex_xyz[end];
    const double tolerance = std::min(result_.tolerance, kOfSize * t_.edge_length[e]);
    if (start != end) {
      add_segment(e, sample_curve(*curve, t0, t1, a, b, tolerance));
      return;
    }
    const double middle = 0.5 * (t0 + t1);
    const Vec3 c = curve->point(middle);
    add_segment(e, sample_curve(*curve, t0, middle, a, c, tolerance));
    add_segment(e, sample_curve(*curve, middle, t1, c, b, tolerance));
  }

  void add_segment(EdgeId e, SampledCurve curve) {
    const int k = static_cast<int>(result_.file.curves.size());
    note(curve.deviation, t_.edge_label(e));
    result_.file.curves.push_back({k + 1, 0, std::move(curve.points)});
    result_.file.segments.push_back({k + 1, 0, k});
    segments_of_edge_[e].push_back(k);
  }

  void add_face(FaceId f) {
    const SampledSurface grid =
        sample_surface(*model_.surface(f), std::min(result_.tolerance, kOfSize * t_.face_width[f]));
    note(grid.deviation, divided_.origin[f] == kNone ? t_.face_label(f) : whole_.face_label(divided_.origin[f]));
    result_.file.surfaces.push_back({f + 1, 0, grid.n_u, grid.n_v, grid.points});
    FliteRegion region{f + 1, 0, f, {}};
    for (const LoopId l : t_.loops(f))
      for (const CoedgeId c : t_.loop_coedges(l)) {
        const std::vector<int>& segments = segments_of_edge_[t_.coedge_edge[c]];
        region.segments.insert(region.segments.end(), segments.begin(), segments.end());
      }
    result_.file.regions.push_back(std::move(region));
  }

  void note(double deviation, const std::string& where) {
    if (deviation > result_.deviation) result_.deviation = deviation, result_.worst = where;
  }

  void count_divided() {
    std::map<FaceId, int> parts;
    for (const FaceId f : divided_.origin) ++parts[f];
    result_.n_faces = whole_.n_faces();
    result_.n_divided =
        static_cast<int>(std::count_if(parts.begin(), parts.end(), [](const auto& p) { return p.second > 1; }));
  }

  const ModelTables& whole_;
  const DividedModel& divided_;
  const Model& model_;
  const ModelTables& t_;
  std::vector<std::vector<int>> segments_of_edge_;
  FliteExport result_;
};

}  // namespace

FliteExport make_flite(const Model& model, double tolerance) {
  const DividedModel divided = divide_for_flite(model);
  return Exporter(model, divided, tolerance).run();
}

}  // namespace st
