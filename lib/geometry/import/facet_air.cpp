#include "geometry/import/facet_air.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/boxes.h"
#include "base/error.h"
#include "geometry/facet/facet_bodies.h"
#include "geometry/import/facet_plane_cut.h"
#include "geometry/import/plane_facets.h"

namespace st {
namespace {

using Side = std::pair<std::int32_t, std::int32_t>;

constexpr int kSphereParts = 32;  // sides of a far field along a quarter of a great circle: 3e-4 of the radius off it
constexpr double kFirstSquare = 0.6;  // of the diagonal: half a square around the model ...
constexpr double kLastSquare = 1.6;   // ... and its half diagonal, with room to the far field
constexpr std::size_t kPlacesShown = 5;

Vec3 axis_vector(int axis, double length) {
  Vec3 v{};
  component(v, axis) = length;
  return v;
}

void turn(FacetMesh& mesh, const std::vector<std::int32_t>& triangles) {
  std::vector<std::uint8_t> is_turned(mesh.normal.size(), 0);
  for (const std::int32_t t : triangles) {
    std::swap(mesh.corners[t][1], mesh.corners[t][2]);
    std::swap(mesh.corner_normal[t][1], mesh.corner_normal[t][2]);
    std::swap(mesh.is_line[t][0], mesh.is_line[t][2]);
    for (const std::int32_t n : mesh.corner_normal[t])
      if (!std::exchange(is_turned[n], 1)) mesh.normal[n] = -1.0 * mesh.normal[n];
  }
}

/// Regions by the order of their lowest triangles, without gaps.
void number_faces(FacetMesh& mesh) {
  std::map<std::int32_t, std::int32_t> number;
  for (std::int32_t& face : mesh.face)
    face = number.try_emplace(face, static_cast<std::int32_t>(number.size())).first->second;
}

class AirMaker {
 public:
  AirMaker(FacetMesh& mesh, std::vector<std::string>& part_name, const std::optional<occt::SymmetryPlane>& plane,
           const std::optional<occt::FarField>& far, std::vector<ImportFinding>& findings)
      : mesh_(mesh), part_name_(part_name), plane_(plane), far_(far), findings_(findings) {
    for (const Corners& c : mesh.corners)
      for (const std::int32_t n : c) box_.add(mesh.x[n]);
    diagonal_ = box_.diagonal();
  }

  void run() {
    if (far_) leave_out_inner_bodies();
    if (plane_) cut();
    find_rims();
    orient();
    if (far_) far_->kind == occt::FarField::Kind::kBox ? add_box() : add_sphere();
    if (plane_) close();
    if (far_) put_far_field_last();
  }

 private:
  double height(std::int32_t node) const { return height_above(*plane_, mesh_.x[node]); }

  Vec3 mirrored(Vec3 p) const {
    component(p, plane_->axis) = 2 * plane_->value - component(p, plane_->axis);
    return p;
  }

  /// Half a body that ends at the plane is one with its image.
  void leave_out_inner_bodies() {
    const std::vector<FacetBody> bodies = find_bodies(mesh_);
    std::vector<std::uint8_t> is_kept(mesh_.corners.size(), 1);
    for (const FacetBody& inner : bodies)
      for (const FacetBody& outer : bodies) {
        if (&inner == &outer || !contains(outer.box, inner.box)) continue;
        const Vec3 p = mesh_.x[mesh_.corners[inner.triangles[0]][0]];
        double turns = winding(mesh_, outer, p);
        if (outer.is_open && plane_) turns += winding(mesh_, outer, mirrored(p));
        if (std::abs(turns) < 0.5) continue;
        for (const std::int32_t t : inner.triangles) is_kept[t] = 0;
        findings_.push_back({FindingKind::kInnerBodyLeftOut, "", inner.box.center(), inner.box.diagonal(), false});
        break;
      }
    keep_triangles(mesh_, is_kept);
  }

  void cut() {
    if (occt::choose_side(*plane_, box_, diagonal_))
      findings_.push_back({FindingKind::kCutAtSymmetry, "", box_.center(), diagonal_, false});
    cut_at_plane(mesh_, *plane_);
    if (mesh_.corners.empty())
      throw Error(ExitCode::kGeometry, "all facets lie in the symmetry plane; check its axis and value");
  }

  /// Sides without a neighbour, all of which have to be in the plane.
  void find_rims() {
    const std::vector<Corners> neighbours = find_neighbours(mesh_.corners);
    std::vector<Side> open;
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        if (neighbours[t][k] != kNone) continue;
        const std::int32_t a = mesh_.corners[t][k], b = mesh_.corners[t][(k + 1) % 3];
        (plane_ && height(a) == 0 && height(b) == 0 ? rims_ : open).emplace_back(a, b);
      }
    if (!open.empty())
      throw Error(ExitCode::kGeometry,
                  fmt::format("the facets are open{}: {} sides are not those of two facets, at {}; mend them there",
                              plane_ ? " away from the symmetry plane" : "", open.size(), places(open)));
    if (plane_ && rims_.empty())
      throw Error(ExitCode::kGeometry,
                  "the model does not touch the symmetry plane; check the axis and the value of --symmetry");
  }

  std::string places(const std::vector<Side>& sides) const {
    std::string text;
    for (std::size_t i = 0; i < std::min(sides.size(), kPlacesShown); ++i) {
      const Vec3 x = 0.5 * (mesh_.x[sides[i].first] + mesh_.x[sides[i].second]);
      text += fmt::format("{}({:.6g}, {:.6g}, {:.6g})", i ? ", " : "", x.x, x.y, x.z);
    }
    return text + (sides.size() > kPlacesShown ? " ..." : "");
  }

  /// Bodies outward, as their volumes over a point of the plane tell; cavities inside another box stay as they are
  /// where there is no far field. The fluid lies on the other side.
  void orient() {
    const std::vector<FacetBody> bodies = find_bodies(mesh_);
    Vec3 origin = box_.center();
    if (plane_) component(origin, plane_->axis) = plane_->value;
    for (const FacetBody& body : bodies) {
      double volume = 0;
      for (const std::int32_t t : body.triangles)
        volume += dot(mesh_.x[mesh_.corners[t][0]] - origin, area_normal(mesh_, t));
      const bool is_inner = !far_ && std::any_of(bodies.begin(), bodies.end(), [&](const FacetBody& other) {
        return &other != &body && contains(other.box, body.box);
      });
      if ((volume < 0 && !is_inner) != far_.has_value()) turn(mesh_, body.triangles);
    }
  }

  // --- facets of the air ---

  std::int32_t add_node(Vec3 x) {
    mesh_.x.push_back(x);
    return static_cast<std::int32_t>(mesh_.x.size()) - 1;
  }

  std::int32_t add_part(const char* name) {
    part_name_.emplace_back(name);
    return static_cast<std::int32_t>(part_name_.size()) - 1;
  }

  std::int32_t n_faces() const { return 1 + *std::max_element(mesh_.face.begin(), mesh_.face.end()); }

  /// Facets of one face, each corner with its normal.
  void add_face(std::int32_t part, const std::vector<Corners>& triangles, const std::map<std::int32_t, Vec3>& normal) {
    const std::int32_t face = n_faces();
    std::map<std::int32_t, std::int32_t> row;
    for (const auto& [node, n] : normal) {
      row[node] = static_cast<std::int32_t>(mesh_.normal.size());
      mesh_.normal.push_back(n);
    }
    const std::vector<Corners> neighbours = find_neighbours(triangles);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      mesh_.corners.push_back(triangles[t]);
      mesh_.part.push_back(part);
      mesh_.face.push_back(face);
      mesh_.uv.emplace_back();
      auto& line = mesh_.is_line.emplace_back();
      auto& own = mesh_.corner_normal.emplace_back();
      for (int k = 0; k < 3; ++k) {
        line[k] = neighbours[t][k] == kNone;
        own[k] = row.at(triangles[t][k]);
      }
    }
  }

  void add_plane_face(std::int32_t part, const std::vector<Corners>& triangles, Vec3 normal) {
    std::map<std::int32_t, Vec3> normals;
    for (const Corners& c : triangles)
      for (const std::int32_t n : c) normals[n] = normal;
    add_face(part, triangles, normals);
  }

  Vec3 middle() const {
    Vec3 m = box_.center();
    if (plane_) component(m, plane_->axis) = plane_->value;
    return m;
  }

  /// Six squares, or five where one lies in the plane.
  void add_box() {
    const double r = far_->size * diagonal_;
    const Vec3 m = middle();
    std::array<std::int32_t, 8> node;
    for (int i = 0; i < 8; ++i) {
      Vec3 x = m + Vec3{i & 1 ? r : -r, i & 2 ? r : -r, i & 4 ? r : -r};
      if (plane_ && height_above(*plane_, x) < 0) component(x, plane_->axis) = plane_->value;
      node[i] = add_node(x);
    }
    const std::int32_t part = far_part_ = add_part("farfield");
    for (int axis = 0; axis < 3; ++axis)
      for (const int sign : {-1, 1}) {
        const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, first = sign > 0 ? 1 << axis : 0;
        std::array<int, 4> q{first, first + u, first + u + v, first + v};
        if (sign < 0) std::swap(q[1], q[3]);
        if (plane_ && axis == plane_->axis && sign != plane_->side) {
          for (int k = 0; k < 4; ++k) far_rim_.emplace_back(node[q[k]], node[q[(k + 1) % 4]]);
          continue;
        }
        add_plane_face(part, {{node[q[0]], node[q[1]], node[q[2]]}, {node[q[0]], node[q[2]], node[q[3]]}},
                       axis_vector(axis, sign));
      }
  }

  /// Eighths of a sphere, each a face.
  void add_sphere() {
    const double r = far_->size * diagonal_;
    const Vec3 m = middle();
    std::map<std::array<int, 3>, std::int32_t> known;
    const auto direction = [](const std::array<int, 3>& i) {
      std::array<double, 3> d;
      for (int k = 0; k < 3; ++k) d[k] = std::sin(0.5 * kPi * i[k] / kSphereParts);
      return normalized(Vec3{d[0], d[1], d[2]});
    };
    const std::int32_t part = far_part_ = add_part("farfield");
    for (int octant = 0; octant < 8; ++octant) {
      const std::array<int, 3> sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
      if (plane_ && sign[plane_->axis] != plane_->side) continue;
      std::map<std::int32_t, Vec3> normal;
      const auto node = [&](int i, int j) {
        const std::array<int, 3> at{sign[0] * i, sign[1] * j, sign[2] * (kSphereParts - i - j)};
        const auto [it, is_new] = known.try_emplace(at, 0);
        if (is_new) it->second = add_node(m + r * direction(at));
        normal[it->second] = direction(at);
        return it->second;
      };
      std::vector<Corners> triangles;
      for (int i = 0; i < kSphereParts; ++i)
        for (int j = 0; i + j < kSphereParts; ++j) {
          triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
          if (i + j + 1 < kSphereParts) triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        }
      if (sign[0] * sign[1] * sign[2] < 0)
        for (Corners& c : triangles) std::swap(c[1], c[2]);
      add_face(part, triangles, normal);
    }
    if (plane_) add_circle(known);
  }

  /// The far field's great circle in the plane.
  void add_circle(const std::map<std::array<int, 3>, std::int32_t>& known) {
    const int u = (plane_->axis + 1) % 3, v = (plane_->axis + 2) % 3;
    for (int quarter = 0; quarter < 4; ++quarter)
      for (int i = 0; i < kSphereParts; ++i) {
        std::array<int, 3> a{}, b{};
        const int su = quarter & 1 ? -1 : 1, sv = quarter & 2 ? -1 : 1;
        a[u] = su * i, a[v] = sv * (kSphereParts - i);
        b[u] = su * (i + 1), b[v] = sv * (kSphereParts - i - 1);
        far_rim_.emplace_back(known.at(a), known.at(b));
      }
  }

  /// Facets in the plane between all outlines, their normals away from what is kept. Squares, each twice as large as
  /// the one before, part it: OpenCASCADE tells points of 1e-7 of an outline's extent from each other, no nearer ones.
  void close() {
    std::vector<Side> outlines = rims_;
    std::vector<Corners> triangles;
    if (far_)
      for (double half = kFirstSquare * diagonal_; kLastSquare * half < far_->size * diagonal_; half *= 2) {
        const std::vector<Side> square = add_square(half);
        outlines.insert(outlines.end(), square.begin(), square.end());
        fill(outlines, triangles);
        outlines = square;
      }
    outlines.insert(outlines.end(), far_rim_.begin(), far_rim_.end());
    fill(outlines, triangles);
    add_plane_face(add_part("symmetry"), triangles, axis_vector(plane_->axis, -plane_->side));
  }

  std::vector<Side> add_square(double half) {
    const int u = (plane_->axis + 1) % 3, v = (plane_->axis + 2) % 3;
    std::array<std::int32_t, 4> node;
    for (int k = 0; k < 4; ++k) {
      Vec3 x = middle();
      component(x, u) += k == 0 || k == 3 ? -half : half;
      component(x, v) += k < 2 ? -half : half;
      node[k] = add_node(x);
    }
    return {{node[0], node[1]}, {node[1], node[2]}, {node[2], node[3]}, {node[3], node[0]}};
  }

  void fill(const std::vector<Side>& outlines, std::vector<Corners>& triangles) const {
    std::map<std::int32_t, std::int32_t> row;
    std::vector<std::int32_t> node;
    std::vector<Vec2> x;
    std::vector<Side> sides;
    const auto place = [&](std::int32_t n) {
      const auto [it, is_new] = row.try_emplace(n, static_cast<std::int32_t>(node.size()));
      if (is_new) {
        const Vec3 from = mesh_.x[n] - middle();
        node.push_back(n);
        x.push_back((1 / diagonal_) *
                    Vec2{component(from, (plane_->axis + 1) % 3), component(from, (plane_->axis + 2) % 3)});
      }
      return it->second;
    };
    for (const auto& [a, b] : outlines) sides.emplace_back(place(a), place(b));
    const std::optional<std::vector<Corners>> between = facets_between(x, sides);
    if (!between)
      throw Error(ExitCode::kGeometry,
                  fmt::format("the outlines in the symmetry plane cross or do not close, near {}; make the bodies one, "
                              "or mend the facets there",
                              places(rims_)));
    for (const Corners& c : *between) {
      triangles.push_back({node[c[0]], node[c[1]], node[c[2]]});
      if (plane_->side > 0) std::swap(triangles.back()[1], triangles.back()[2]);
    }
  }

  /// The body, the plane, the far field: the order of faces of CAD.
  void put_far_field_last() {
    std::vector<std::int32_t> order(mesh_.corners.size());
    for (std::size_t t = 0; t < order.size(); ++t) order[t] = static_cast<std::int32_t>(t);
    std::stable_partition(order.begin(), order.end(), [&](std::int32_t t) { return mesh_.part[t] != far_part_; });
    const auto arrange = [&](auto& rows) {
      auto sorted = rows;
      for (std::size_t t = 0; t < order.size(); ++t) sorted[t] = rows[order[t]];
      rows = std::move(sorted);
    };
    arrange(mesh_.corners), arrange(mesh_.corner_normal), arrange(mesh_.is_line), arrange(mesh_.part),
        arrange(mesh_.face), arrange(mesh_.uv);
  }

  FacetMesh& mesh_;
  std::vector<std::string>& part_name_;
  std::optional<occt::SymmetryPlane> plane_;
  std::optional<occt::FarField> far_;
  std::vector<ImportFinding>& findings_;
  Box3 box_;  // of the model
  double diagonal_ = 0;
  std::int32_t far_part_ = kNone;
  std::vector<Side> rims_, far_rim_;  // in the plane: of the bodies, of the far field
};

}  // namespace

void make_flow_domain(FacetMesh& mesh, std::vector<std::string>& part_name,
                      const std::optional<occt::SymmetryPlane>& plane, const std::optional<occt::FarField>& far,
                      std::vector<ImportFinding>& findings) {
  AirMaker(mesh, part_name, plane, far, findings).run();
  number_faces(mesh);
}

}  // namespace st
