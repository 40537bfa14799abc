#include "geometry/facet/facet_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/sort_once.h"
#include "geometry/model/edge_faces.h"
#include "geometry/model/rectangle_width.h"
#include "geometry/shape/known_neighbours.h"
#include "geometry/shape/polyline.h"

namespace st {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

/// Without the air's own facets, which are far away and exact.
double largest_coordinate(const FacetMesh& mesh, const std::vector<std::string>& part_name) {
  std::vector<std::uint8_t> is_air;
  for (const std::string& name : part_name)
    is_air.push_back(role_of_name(name) == "farfield" || role_of_name(name) == "symmetry");
  double largest = 0;
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t) {
    if (is_air[mesh.part[t]]) continue;
    for (const std::int32_t n : mesh.corners[t]) {
      const Vec3 x = mesh.x[n];
      largest = std::max({largest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    }
  }
  return largest;
}

class FacetModelMaker {
 public:
  FacetModelMaker(const FacetMesh& mesh, const std::vector<std::string>& part_name, double feature)
      : mesh_(mesh), cosine_(std::cos(feature)) {
    tolerance_ = kSinglePrecision * largest_coordinate(mesh, part_name);
  }

  FacetModel run(const std::vector<std::string>& part_name) {
    find_charts();
    find_lines();
    add_vertices();
    add_edges();
    add_faces();
    find_shells();
    label(part_name);
    return {std::move(tables_), std::move(shape_)};
  }

 private:
  void find_charts() {
    const std::int32_t n = 1 + *std::max_element(mesh_.face.begin(), mesh_.face.end());
    std::vector<std::vector<std::int32_t>> members(static_cast<std::size_t>(n));
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) members[mesh_.face[t]].push_back(t);
    PatchFinder finder(mesh_);
    for (auto& triangles : members) {
      charts_.push_back(std::move(finder.find(std::move(triangles)).front()));
      const FacetPatch& chart = charts_.back();
      topology_.push_back(find_topology(chart.x, chart.corners, chart.neighbours));
    }
  }

  /// Rims of charts as chains of nodes.
  void find_lines() {
    std::vector<NodePair> segments;
    for (std::size_t f = 0; f < charts_.size(); ++f)
      for (const auto& loop : topology_[f].loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          segments.push_back(std::minmax(charts_[f].node[loop[i]], charts_[f].node[loop[(i + 1) % loop.size()]]));
    sort_once(segments);
    for (const auto& [a, b] : segments) {
      beside_[a].push_back(b);
      beside_[b].push_back(a);
    }
    for (const auto& [node, others] : beside_)
      if (is_end(node)) ends_.push_back(node);
    for (const std::int32_t node : ends_)
      for (const std::int32_t other : beside_[node])
        if (place_.count(std::minmax(node, other)) == 0) follow(node, other);
    for (const auto& [a, b] : segments)
      if (place_.count({a, b}) == 0) {  // rings without an end begin at their lowest node
        ends_.push_back(a);
        follow(a, b);
      }
    std::sort(ends_.begin(), ends_.end());
  }

  bool is_end(std::int32_t node) {
    const auto& others = beside_[node];
    if (others.size() != 2) return true;
    return dot(normalized(mesh_.x[node] - mesh_.x[others[0]]), normalized(mesh_.x[others[1]] - mesh_.x[node])) <
           cosine_;
  }

  void follow(std::int32_t first, std::int32_t second) {
    std::vector<std::int32_t> line{first, second};
    while (line.back() != first && !std::binary_search(ends_.begin(), ends_.end(), line.back())) {
      const auto& others = beside_[line.back()];
      line.push_back(others[0] == line[line.size() - 2] ? others[1] : others[0]);
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      place_[std::minmax(line[i], line[i + 1])] = {static_cast<EdgeId>(lines_.size()), static_cast<std::int32_t>(i)};
    lines_.push_back(std::move(line));
  }

  void add_vertices() {
    for (const std::int32_t node : ends_) tables_.vertex_xyz.push_back(mesh_.x[node]);
    tables_.vertex_tolerance.assign(ends_.size(), tolerance_);
  }

  VertexId vertex(std::int32_t node) const {
    return static_cast<VertexId>(std::lower_bound(ends_.begin(), ends_.end(), node) - ends_.begin());
  }

  void add_edges() {
    shape_.edge_point_offsets = {0};
    for (const auto& line : lines_) {
      std::vector<Vec3> points;
      for (const std::int32_t node : line) points.push_back(mesh_.x[node]);
      const double length = polyline_parameters(points).back();
      for (const std::int32_t node : {line.front(), line.back()}) tables_.edge_vertices.push_back(vertex(node));
      for (const double t : {0.0, length}) tables_.edge_range.push_back(t);
      tables_.edge_length.push_back(length);
      shape_.edge_xyz.insert(shape_.edge_xyz.end(), points.begin(), points.end());
      shape_.edge_point_offsets.push_back(static_cast<std::int32_t>(shape_.edge_xyz.size()));
    }
    tables_.edge_tolerance.assign(lines_.size(), tolerance_);
    tables_.edge_is_degenerate.assign(lines_.size(), 0);
    tables_.edge_name.resize(lines_.size());
  }

  void add_faces() {
    tables_.face_loop_offsets = tables_.loop_coedge_offsets = {0};
    shape_.face_node_offsets = shape_.face_triangle_offsets = shape_.coedge_node_offsets = {0};
    for (std::size_t f = 0; f < charts_.size(); ++f) {
      add_chart(charts_[f]);
      add_loops(f);
      measure(static_cast<FaceId>(f));
    }
    tables_.face_is_reversed.assign(charts_.size(), 0);
    tables_.face_tolerance.assign(charts_.size(), tolerance_);
    tables_.face_color.assign(charts_.size(), kNone);
    tables_.face_layer.resize(charts_.size());
  }

  void add_chart(const FacetPatch& chart) {
    const std::size_t first = shape_.node_xyz.size();
    shape_.node_uv.resize(first + chart.x.size());
    for (std::size_t n = 0; n < chart.x.size(); ++n) {
      shape_.node_xyz.push_back(chart.x[n]);
      shape_.node_normal.push_back(mesh_.normal[chart.normal[n]]);
    }
    for (std::size_t i = 0; i < chart.corners.size(); ++i) {
      shape_.triangle_nodes.push_back(chart.corners[i]);
      for (int k = 0; k < 3; ++k)
        shape_.node_uv[first + static_cast<std::size_t>(chart.corners[i][k])] = mesh_.uv[chart.triangles[i]][k];
    }
    shape_.face_node_offsets.push_back(static_cast<std::int32_t>(shape_.node_xyz.size()));
    shape_.face_triangle_offsets.push_back(static_cast<std::int32_t>(shape_.triangle_nodes.size()));
  }

  /// The outer loop, which has the largest area in (u,v), first.
  void add_loops(std::size_t f) {
    const Vec2* uv = &shape_.node_uv[static_cast<std::size_t>(shape_.face_node_offsets[f])];
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t l = 0; l < topology_[f].loops.size(); ++l) {
      double area = 0;
      const auto& loop = topology_[f].loops[l];
      for (std::size_t i = 0; i < loop.size(); ++i) area += cross(uv[loop[i]], uv[loop[(i + 1) % loop.size()]]);
      order.emplace_back(-area, l);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [area, l] : order) add_loop(charts_[f], topology_[f].loops[l]);
    tables_.face_loop_offsets.push_back(tables_.n_loops());
  }

  void add_loop(const FacetPatch& chart, std::vector<std::int32_t> loop) {
    const auto begin = std::find_if(loop.begin(), loop.end(), [&](std::int32_t n) {
      return std::binary_search(ends_.begin(), ends_.end(), chart.node[n]);
    });
    std::rotate(loop.begin(), begin, loop.end());
    for (std::size_t i = 0; i < loop.size();) {
      const std::int32_t a = chart.node[loop[i]], b = chart.node[loop[(i + 1) % loop.size()]];
      const auto [edge, at] = place_.at(std::minmax(a, b));
      const bool is_reversed = lines_[edge][static_cast<std::size_t>(at)] != a;
      std::vector<std::int32_t> nodes;
      for (std::size_t k = 0; k < lines_[edge].size(); ++k) nodes.push_back(loop[(i + k) % loop.size()]);
      if (is_reversed) std::reverse(nodes.begin(), nodes.end());
      i += nodes.size() - 1;
      tables_.coedge_edge.push_back(edge);
      tables_.coedge_is_reversed.push_back(is_reversed);
      shape_.coedge_nodes.insert(shape_.coedge_nodes.end(), nodes.begin(), nodes.end());
      shape_.coedge_node_offsets.push_back(static_cast<std::int32_t>(shape_.coedge_nodes.size()));
    }
    tables_.loop_coedge_offsets.push_back(tables_.n_coedges());
  }

  /// Area, width, box, bounds, and whether it is a plane with (u,v) that are places in it.
  void measure(FaceId f) {
    const Chart chart = shape_.chart(f);
    Box3 box, plane;
    Vec3 sum{};
    double area = 0, perimeter = 0, aside = 0, stretch = 0;
    for (const Vec3 x : chart.x) box.add(x);
    for (const Vec2 p : chart.uv) plane.add(Vec3{p.x, p.y, 0});
    for (const Corners& c : chart.corners) {
      const Vec3 n = 0.5 * cross(chart.x[c[1]] - chart.x[c[0]], chart.x[c[2]] - chart.x[c[0]]);
      sum += n;
      area += norm(n);
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = c[k], b = c[(k + 1) % 3];
        stretch = std::max(stretch, std::abs(distance(chart.x[a], chart.x[b]) - norm(chart.uv[b] - chart.uv[a])));
      }
    }
    const Vec3 normal = normalized(sum);
    for (const Vec3 x : chart.x) aside = std::max(aside, std::abs(dot(x - chart.x[0], normal)));
    for (const EdgeId e : tables_.edges_of(f)) perimeter += tables_.edge_length[e];
    const bool faces_one_way = 2 * norm(sum) > area;  // the skin of a wing, rolled out, has no normal
    tables_.face_type.push_back(faces_one_way && std::max(aside, stretch) <= tolerance_ ? SurfaceType::kPlane
                                                                                        : SurfaceType::kOther);
    tables_.face_area.push_back(area);
    tables_.face_width.push_back(rectangle_width(area, perimeter));
    tables_.face_box.push_back(box);
    for (const double b : {plane.lo.x, plane.hi.x, plane.lo.y, plane.hi.y}) tables_.face_uv_bounds.push_back(b);
  }

  void find_shells() {
    const EdgeFaces faces_at(tables_);
    DisjointSets sets(tables_.n_faces());
    std::vector<std::uint8_t> is_open(charts_.size(), 0);
    for (EdgeId e = 0; e < tables_.n_edges(); ++e)
      for (const FaceId f : faces_at[e]) {
        sets.join(faces_at[e][0], f);
        if (faces_at[e].size() != 2) is_open[f] = 1;
      }
    tables_.face_shell.resize(charts_.size());
    tables_.face_solid.assign(charts_.size(), kNone);
    for (const auto& shell : sets.groups()) {
      const bool is_closed = std::none_of(shell.begin(), shell.end(), [&](FaceId f) { return is_open[f]; });
      for (const FaceId f : shell) {
        tables_.face_shell[f] = tables_.n_shells;
        if (is_closed) tables_.face_solid[f] = tables_.n_solids;
      }
      ++tables_.n_shells;
      tables_.n_solids += is_closed;
    }
    if (tables_.n_solids == tables_.n_shells) tables_.volume = volume();
  }

  double volume() const {
    const Vec3 origin = tables_.box().center();
    double sum = 0;
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      sum += dot(mesh_.x[mesh_.corners[t][0]] - origin, area_normal(mesh_, t)) / 6;
    return sum;
  }

  void label(const std::vector<std::string>& part_name) {
    FaceLabels& labels = tables_.labels;
    std::map<std::string, std::int32_t> groups;
    for (const FacetPatch& chart : charts_) {
      labels.face_name.push_back(part_name[mesh_.part[chart.triangles[0]]]);
      const std::string name = labels.face_name.back().empty() ? "default" : labels.face_name.back();
      const auto [it, is_new] = groups.emplace(name, static_cast<std::int32_t>(groups.size()));
      if (is_new) {
        labels.group_name.push_back(name);
        labels.group_role.push_back(role_of_name(name));
        labels.group_attributes.push_back("{}");
      }
      labels.face_group.push_back(it->second);
    }
  }

  const FacetMesh& mesh_;
  double cosine_, tolerance_ = 0;
  std::vector<FacetPatch> charts_;
  std::vector<PatchTopology> topology_;
  std::map<std::int32_t, std::vector<std::int32_t>> beside_;   // other ends of a node's segments
  std::vector<std::int32_t> ends_;                             // nodes that are vertices, ascending
  std::vector<std::vector<std::int32_t>> lines_;               // nodes along each edge
  std::map<NodePair, std::pair<EdgeId, std::int32_t>> place_;  // of segments on edges
  ModelTables tables_;
  FacetShape shape_;
};

}  // namespace

FacetModel make_facet_model(const FacetMesh& mesh, const std::vector<std::string>& part_name, double feature) {
  return FacetModelMaker(mesh, part_name, feature).run(part_name);
}

}  // namespace st
