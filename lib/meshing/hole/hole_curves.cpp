#include "meshing/hole/hole_curves.h"

#include <algorithm>

#include "base/limits.h"

namespace st {
namespace {

/// A part of a curve.
class CurvePart : public Curve {
 public:
  CurvePart(const Curve& curve, double t_min, double t_max) : curve_(curve) {
    t_min_ = t_min;
    t_max_ = t_max;
  }
  Vec3 point(double t) const override { return curve_.point(t); }
  CurvePoint evaluate(double t) const override { return curve_.evaluate(t); }

 private:
  const Curve& curve_;
};

}  // namespace

std::vector<SegmentRun> marked_runs(const HoleMesh& mesh, const HoleMarks& marks) {
  std::vector<SegmentRun> runs;
  const EdgeMesh& m = mesh.edges;
  for (EdgeId e = 0; e < m.n_edges(); ++e)
    for (std::int32_t i = m.first_node(e); i < m.first_node(e) + m.n_nodes(e); ++i) {
      if (!marks.segment[i]) continue;
      const std::int32_t first = i;
      while (marks.segment[i]) ++i;
      runs.push_back({e, first, i});
    }
  return runs;
}

EdgeMesh discretise_run(const HoleMesh& mesh, const SegmentRun& run, const Curve& curve, const SizeField& field,
                        const CurveMeshOptions& options) {
  const EdgeMesh& m = mesh.edges;
  const int n_kept = m.n_nodes(run.edge) - 1 - (run.last - run.first);
  CurveMeshOptions part = options;
  part.min_segments = std::max(1, options.min_segments - n_kept);
  EdgeMesh nodes = discretise_curve(CurvePart(curve, m.node_t[run.first], m.node_t[run.last]), field, part);
  nodes.node_t.front() = m.node_t[run.first];
  nodes.node_t.back() = m.node_t[run.last];
  nodes.node_xyz.front() = m.node_xyz[run.first];
  nodes.node_xyz.back() = m.node_xyz[run.last];
  return nodes;
}

EdgeUpdate update_edges(const HoleMesh& mesh, const std::vector<SegmentRun>& runs, const EdgeMesh& fresh) {
  const EdgeMesh& old = mesh.edges;
  EdgeUpdate u;
  u.old_to_new.assign(old.node_t.size(), kNone);
  u.edges.edge_offsets.push_back(0);
  const auto add = [&](double t, Vec3 x, double h, double request, NodeId previous) {
    u.edges.node_t.push_back(t);
    u.edges.node_xyz.push_back(x);
    u.edges.node_size.push_back(h);
    u.edges.node_request.push_back(request);
    u.edges.node_previous.push_back(previous);
  };
  EdgeId r = 0;
  for (EdgeId e = 0; e < old.n_edges(); ++e) {
    double end_size = 0;  // at the end of a run that was just replaced
    for (std::int32_t i = old.first_node(e); i < old.first_node(e) + old.n_nodes(e); ++i) {
      u.old_to_new[i] = static_cast<std::int32_t>(u.edges.node_t.size());
      add(old.node_t[i], old.node_xyz[i], end_size > 0 ? end_size : old.node_size[i], old.node_size[i],
          mesh.edge_node[i]);
      end_size = 0;
      if (r == fresh.n_edges() || runs[r].first != i || runs[r].edge != e) continue;
      const std::int32_t first = fresh.first_node(r), last = first + fresh.n_nodes(r) - 1;
      u.edges.node_size.back() = fresh.node_size[first];
      for (std::int32_t k = first + 1; k < last; ++k)
        add(fresh.node_t[k], fresh.node_xyz[k], fresh.node_size[k], fresh.node_size[k], kNone);
      end_size = fresh.node_size[last];
      i = runs[r++].last - 1;
    }
    u.edges.edge_offsets.push_back(checked_id(u.edges.node_t.size(), "nodes on CAD edges"));
  }
  return u;
}

}  // namespace st
