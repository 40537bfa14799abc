// What st-mesh and st-remesh make: edges, patches, failures, counts and times.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/current_work.h"
#include "mesh/face_attempt.h"
#include "mesh/surface_mesh.h"
#include "meshing/engine/patch_store.h"
#include "meshing/face/face_mesher.h"
#include "sizing/size_field.h"

namespace st {

class PeriodicPairs;

/// Where the patches of a result are.
enum class PatchesGo {
  kToRoot,  ///< all on rank 0
  kNowhere  ///< each on the rank that made it
};

struct MeshOptions {
  int enhance_rounds = 5;          ///< of the enhancer in each face or hole
  double max_turning_deg = 30;     ///< of a CAD edge along one segment
  double merge_below = 0.05;       ///< of the requested length, see find_merged_features(); 0: nothing is merged
  double tile_triangles = 25'000;  ///< faces that expect one and a half times as many are cut; 0: none is
  std::map<FaceId, std::string> left_out = {};  ///< they fail, with this cause: meshing them ended an earlier run
  std::optional<double> time_limit = {};   ///< of a face, seconds, see CurrentWork; none: by its expected triangles
  WhenLate when_late = WhenLate::kSignal;  ///< what happens then; kThrow: the face fails
  PatchesGo patches = PatchesGo::kToRoot;
  bool parts_bodies = true;              ///< bodies that the CAD keeps apart are refined where their triangles cross
  bool mends_faces = true;               ///< what folds or crosses itself within a face is meshed again
  bool stores_requests = true;           ///< nodes get the lengths that the field requests: for a later st-remesh
  const PeriodicPairs* pairs = nullptr;  ///< outlive the run; null: there are none
  /// Places, with a radius, where lengths along shall become those across, from places, corners and faces of a mesh;
  /// rank 0 asks, once it is meshed. Null: none.
  std::function<std::vector<RefinementPoint>(const SurfaceMesh&)> find_unheld = {};

  FaceMeshOptions of_face() const { return {.enhance_rounds = enhance_rounds}; }
};

/// Where the time went, seconds on rank 0.
struct MeshTimes {
  double edges = 0, faces = 0, join = 0, crossing = 0;
};

/// The mesh of a model. Complete on rank 0 only, but for patches that stay where they were made; the edges are on every
/// rank.
struct MeshResult {
  EdgeMesh edges;
  std::vector<FacePatch> patches;      ///< by face; without triangles where the face failed. Or, where they stay where
                                       ///< they were made, the rows of the sections of this rank
  std::vector<PatchPlace> own_places;  ///< then: of each of these
  std::vector<FacePlace> places;       ///< then: of all, by face
  SurfaceMesh mesh;                    ///< the whole, where holes of one were filled and it was asked for
  std::vector<FaceFailure> failures;   ///< by face
  std::vector<FaceAttempt> attempts;   ///< likewise: how far each came
  std::vector<RefinementPoint> folds;  ///< places where a triangle is still turned against the surface
  std::vector<FaceId> bad_faces;       ///< that failed, or have a triangle that is folded or crosses another; ascending
  int n_rounds = 0, n_refinements = 0;
  int n_crossing_pairs = 0;  ///< that are left; where holes were filled: of which one triangle at least is new
  int n_grown = 0;           ///< holes that had to grow
  MeshTimes times;
};

/// Local. Gives every new node of this rank's patches and of edges the length that `field` requests there: what a later
/// st-remesh compares with, whatever was refined since. Nodes with a number in the mesh before stay as they are.
void store_requests(const SizeField& field, MeshResult& result);

}  // namespace st
