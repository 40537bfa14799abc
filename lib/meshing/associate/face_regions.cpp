#include "meshing/associate/face_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <set>

#include "base/disjoint_sets.h"
#include "base/error.h"
#include "geometry/shape/projection.h"
#include "meshing/associate/face_parameters.h"
#include "meshing/associate/places.h"

namespace st {
namespace {

constexpr int kSamples = 8;  // nodes by which a region is told from another that has the same edges

/// Triangles connected across mesh edges that belong to no chain.
class Regions {
 public:
  Regions(const SurfaceMesh& mesh, const MeshEdges& edges, const std::vector<EdgeId>& chain)
      : sets_(mesh.n_triangles()) {
    for (std::int32_t m = 0; m < edges.n_edges(); ++m) {
      const auto sides = edges.sides_of(m);
      for (std::size_t k = 1; chain[m] == kNone && k < sides.size(); ++k) sets_.join(sides[0] / 3, sides[k] / 3);
    }
    std::map<std::int32_t, std::int32_t> number;
    for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
      const auto [it, is_new] = number.try_emplace(sets_.find(t), static_cast<std::int32_t>(triangles.size()));
      if (is_new) triangles.emplace_back();
      triangles[it->second].push_back(t);
    }
  }
  std::vector<std::vector<TriangleId>> triangles;  ///< by region

 private:
  DisjointSets sets_;
};

Vec3 middle(const SurfaceMesh& m, const MeshEdges& edges, std::int32_t e) {
  return 0.5 * (m.node_xyz[edges.low[e]] + m.node_xyz[edges.high[e]]);
}

/// Away from the chains every mesh edge has two triangles; on them one for each use of the CAD edge.
void require_whole(const SurfaceMesh& mesh, const MeshEdges& edges, const EdgeChains& chains,
                   const std::vector<EdgeId>& chain) {
  std::vector<std::int32_t> uses(chains.tables.n_edges(), 0);
  for (const EdgeId e : chains.tables.coedge_edge) ++uses[e];
  Places open, crowded;
  for (std::int32_t m = 0; m < edges.n_edges(); ++m) {
    const auto n = static_cast<std::int32_t>(edges.sides_of(m).size()),
               expected = chain[m] == kNone ? 2 : uses[chain[m]];
    if (n != expected) (n < expected ? open : crowded).add(middle(mesh, edges, m));
  }
  if (open.count > 0)
    throw Error(ExitCode::kMismatch,
                "the mesh has holes where the geometry has none: " + std::to_string(open.count) +
                    " of its edges lack a triangle, at " + open.text() +
                    "; close them (or merge equal points) in the program that wrote the mesh, or mesh with st-mesh");
  if (crowded.count > 0)
    throw Error(ExitCode::kMismatch, "more triangles than the geometry has faces meet at " +
                                         std::to_string(crowded.count) + " edges of the mesh, at " + crowded.text() +
                                         "; remove the inner walls, or mesh with st-mesh");
}

class RegionFinder {
 public:
  RegionFinder(const SurfaceMesh& mesh, const MeshEdges& edges, const EdgeChains& chains, const ChainSegments& segments,
               const Model& model, const NodeTolerance& tolerance)
      : mesh_(mesh),
        edges_(edges),
        chains_(chains),
        t_(chains.tables),
        model_(model),
        tolerance_(tolerance),
        segments_(segments),
        chain_(segments.edge),
        regions_(mesh, edges, chain_) {}

  FaceRegions run() {
    list_faces();
    result_.face.assign(mesh_.n_triangles(), kNone);
    result_.corner_uv.resize(3 * mesh_.triangles.size());
    result_.triangles.resize(t_.n_faces());
    for (const auto& region : regions_.triangles) assign(region, choose_face(region));
    for (auto& triangles : result_.triangles) std::sort(triangles.begin(), triangles.end());
    require_all_faces();
    find_parameters();
    return std::move(result_);
  }

 private:
  void list_faces() {
    edge_faces_.resize(t_.n_edges());
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (t_.is_joined(f)) continue;
      bool has_edge = false;
      for (const CoedgeId c : t_.coedges(f)) {
        if (t_.edge_is_degenerate[t_.coedge_edge[c]]) continue;
        has_edge = true;
        edge_faces_[t_.coedge_edge[c]].insert(f);
      }
      if (!has_edge) bare_faces_.insert(f);
    }
  }

  void assign(const std::vector<TriangleId>& region, FaceId f) {
    for (const TriangleId t : region) result_.face[t] = f;
    result_.triangles[f].insert(result_.triangles[f].end(), region.begin(), region.end());
  }

  /// Faces that have all the edges around a region.
  std::set<FaceId> candidates(const std::vector<TriangleId>& region) const {
    std::set<EdgeId> around;
    for (const TriangleId t : region)
      for (int k = 0; k < 3; ++k)
        if (const std::int32_t m = edges_.edge_of_side[3 * t + k]; m != kNone && chain_[m] != kNone)
          around.insert(chain_[m]);
    if (around.empty()) return bare_faces_;
    std::set<FaceId> faces = edge_faces_[*around.begin()];
    for (const EdgeId e : around) std::erase_if(faces, [&](FaceId f) { return !edge_faces_[e].contains(f); });
    if (faces.empty()) fail_region(region, around);
    return faces;
  }

  FaceId choose_face(const std::vector<TriangleId>& region) const {
    const std::set<FaceId> faces = candidates(region);
    if (faces.size() == 1) return *faces.begin();
    std::pair<double, FaceId> best{1e300, kNone};
    for (const FaceId f : faces) best = std::min(best, std::pair(distance_from(f, region), f));
    if (best.second == kNone) fail_region(region, {});
    return best.second;
  }

  /// Largest distance of the middles of some triangles from a face's surface.
  double distance_from(FaceId f, const std::vector<TriangleId>& region) const {
    const auto surface = model_.surface(f);
    double largest = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto& n = mesh_.triangles[region[region.size() * i / kSamples]].n;
      largest = std::max(
          largest,
          closest_point(*surface, (mesh_.node_xyz[n[0]] + mesh_.node_xyz[n[1]] + mesh_.node_xyz[n[2]]) / 3).distance);
    }
    return largest;
  }

  [[noreturn]] void fail_region(const std::vector<TriangleId>& region, const std::set<EdgeId>& around) const {
    Places places;
    for (const TriangleId t : region) {
      const auto& n = mesh_.triangles[t].n;
      places.add((mesh_.node_xyz[n[0]] + mesh_.node_xyz[n[1]] + mesh_.node_xyz[n[2]]) / 3);
    }
    std::string text = std::to_string(region.size()) + " triangles lie on no face, at " + places.text();
    if (!around.empty())
      text += ": no face has all of the " + std::to_string(around.size()) + " edges around them, such as " +
              t_.edge_label(*around.begin()) + " and " + t_.edge_label(*around.rbegin());
    throw Error(ExitCode::kMismatch, text + "; the mesh is of another geometry");
  }

  void require_all_faces() const {
    std::string text;
    int n = 0;
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (!t_.is_joined(f) && result_.triangles[f].empty() && ++n <= 4)
        text += (n > 1 ? ", " : "") + t_.face_label(f) + " at " + place(t_.face_box[f].center());
    if (n > 0)
      throw Error(ExitCode::kMismatch,
                  std::to_string(n) + " faces of the geometry have no triangle of the mesh: " + text +
                      (n > 4 ? ", ..." : "") + "; the mesh is of another geometry, or mesh it with st-mesh");
  }

  void find_parameters() {
    Places off;
    double farthest = 0;
    std::vector<std::pair<NodeId, double>> distances;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      distances.clear();
      find_face_parameters({mesh_, edges_, chains_, segments_, model_, tolerance_}, f, result_.triangles[f],
                           result_.corner_uv, distances);
      for (const auto& [n, d] : distances) {
        if (d > result_.max_distance) result_.max_distance = d, result_.max_place = mesh_.node_xyz[n];
        if (d <= tolerance_.at(n, t_.face_tolerance[f])) continue;
        off.add(mesh_.node_xyz[n]);
        farthest = std::max(farthest, d);
      }
    }
    if (off.count == 0) return;
    char number[32];
    std::snprintf(number, sizeof number, "%.4g", farthest);
    throw Error(ExitCode::kMismatch, std::to_string(off.count) + " nodes of the mesh lie on no face, up to " + number +
                                         " away, at " + off.text() +
                                         "; the mesh is of another geometry, or --tolerance is too small");
  }

  const SurfaceMesh& mesh_;
  const MeshEdges& edges_;
  const EdgeChains& chains_;
  const ModelTables& t_;
  const Model& model_;
  const NodeTolerance& tolerance_;
  const ChainSegments& segments_;
  const std::vector<EdgeId>& chain_;
  Regions regions_;
  std::vector<std::set<FaceId>> edge_faces_;
  std::set<FaceId> bare_faces_;  // without an edge that is one
  FaceRegions result_;
};

}  // namespace

std::int64_t orient_regions(SurfaceMesh& mesh, const MeshEdges& edges, const EdgeChains& chains,
                            const ChainSegments& segments) {
  const std::vector<EdgeId>& chain = segments.edge;
  require_whole(mesh, edges, chains, chain);
  std::vector<signed char> turn(mesh.triangles.size(), -1);
  std::int64_t n_turned = 0;
  for (TriangleId first = 0; first < mesh.n_triangles(); ++first) {
    if (turn[first] >= 0) continue;
    std::vector<TriangleId> region{first};
    turn[first] = 0;
    for (std::size_t i = 0; i < region.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t m = edges.edge_of_side[3 * region[i] + k];
        if (m == kNone || chain[m] != kNone) continue;
        const auto sides = edges.sides_of(m);
        const SideId other = sides[0] / 3 == region[i] ? sides[1] : sides[0];
        const auto expected = static_cast<signed char>(turn[region[i]] ^ run_alike(mesh.triangles, sides[0], sides[1]));
        if (turn[other / 3] < 0) {
          turn[other / 3] = expected;
          region.push_back(other / 3);
        } else if (turn[other / 3] != expected) {
          throw Error(ExitCode::kMismatch, "the triangles around " + place(middle(mesh, edges, m)) +
                                               " cannot be oriented alike; mesh the geometry with st-mesh");
        }
      }
    const auto n = std::count_if(region.begin(), region.end(), [&](TriangleId t) { return turn[t] == 1; });
    const signed char minority = 2 * n > static_cast<std::ptrdiff_t>(region.size()) ? 0 : 1;
    for (const TriangleId t : region) {
      if (turn[t] != minority) continue;
      std::swap(mesh.triangles[t].n[1], mesh.triangles[t].n[2]);
      ++n_turned;
    }
  }
  return n_turned;
}

FaceRegions find_face_regions(const SurfaceMesh& mesh, const MeshEdges& edges, const EdgeChains& chains,
                              const ChainSegments& segments, const Model& model, const NodeTolerance& tolerance) {
  return RegionFinder(mesh, edges, chains, segments, model, tolerance).run();
}

}  // namespace st
