// Facets of those walls alone that profiles cross.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "features/face_roles.h"
#include "features/profile.h"
#include "features/wing_edges.h"
#include "geometry/model/edge_faces.h"
#include "geometry/model/facets.h"

namespace st {

/// A point of a plane of symmetry, and its unit normal, at the middle of its range. Precondition: the face is plane.
struct MirrorPlane {
  Vec3 x, normal;

  MirrorPlane(const Model& model, FaceId face);
  Vec3 image_of_direction(Vec3 v) const { return v - 2 * dot(v, normal) * normal; }
  Vec3 image_of(Vec3 p) const { return p - 2 * dot(p - x, normal) * normal; }
};

struct ProfileLimits {
  FacetLimits facets;
  double reach = 0;  ///< how far from a place the cut may begin, model unit
};

/// Grows where cuts end at the border of a face; a body that no profile crosses gets no facets. Member functions are
/// collective; facets and what is decided by them are rank 0's, empty elsewhere.
class ProfileFacets {
 public:
  /// Both must outlive the object.
  ProfileFacets(const Model& model, const FaceRoles& roles, const ProfileLimits& limits);

  /// Facets of the walls that cuts cross which begin on `edges` (of rank 0): at each of their places, square to the
  /// edge and to the model's axes. Bodies that hang together nowhere are a task each, with their own facets alone; of a
  /// single one the facets of the edges' own walls are tasks, and the cuts are rank 0's. Precondition: no
  /// facets yet where edges lie on several.
  void add_along(std::span<const WingEdge> edges, const Executor& executor);

  /// Those of the walls beyond the borders at which cuts end (of rank 0); false: there are none.
  bool add_beyond(std::span<const CutPlace> ends, const Executor& executor);

  /// Those of the walls at an edge, and of all that a cut through `x` meets which begins there.
  void add_cut(EdgeId e, Vec3 x, Vec3 normal, const Executor& executor);

  /// Whether the facets of a face are there.
  bool knows(FaceId f) const { return is_known_[f] != 0; }
  void clear();

  const Facets& facets() const { return facets_; }
  double reach() const { return limits_.reach; }

 private:
  /// A plane through a place on an edge.
  struct Cut {
    Vec3 x, normal;
  };

  void add_mirrors(std::span<const WingEdge> edges);
  std::vector<Cut> cuts_at(std::span<const WingEdge> edges) const;
  std::vector<std::uint8_t> walls_along(std::span<const WingEdge> edges);
  std::vector<std::uint8_t> walls_of_next(std::span<const Cut> cuts, std::size_t n_ahead, std::size_t& n_done);
  std::vector<std::vector<WingEdge>> by_body(std::span<const WingEdge> edges) const;
  void add_bodies(std::span<const std::vector<WingEdge>> bodies, const Executor& executor);
  void walk(std::span<const WingEdge> edges, std::size_t n_ahead);
  bool is_at(FaceId f, Vec3 x) const;
  std::vector<std::uint8_t> walls_beyond(std::span<const CutPlace> ends);
  void take_walls_at(EdgeId e, const Vec3* x, std::vector<std::uint8_t>& taken);
  bool add(std::vector<std::uint8_t> wanted, const Executor& executor);

  const Model& model_;
  const FaceRoles& roles_;
  const ProfileLimits limits_;
  EdgeFaces faces_at_;
  std::vector<std::uint8_t> is_known_;  // [n_faces] their facets are there, or will be next
  std::vector<MirrorPlane> mirrors_;    // on which edges lie: a cut goes on in the image
  Facets facets_;
};

/// Facets that follow the surfaces exactly, by how closely, in steps: no face gets the same ones twice. Serial.
class FacetStore {
 public:
  /// Both must outlive the object.
  FacetStore(const Model& model, const FaceRoles& roles) : model_(model), roles_(roles) {}

  /// Of the step nearest to `deflection`, model unit. What is there is dropped where it became much to search.
  ProfileFacets& near(double deflection, bool is_exact);
  /// Whether there are facets of a face, of any step.
  bool knows(FaceId f) const;
  void clear();

 private:
  const Model& model_;
  const FaceRoles& roles_;
  std::map<std::pair<int, bool>, ProfileFacets> all_;  // by step and exactness
};

}  // namespace st
