// Which refinements stay once the rounds have ended: those that help, and no smaller lengths than are needed.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "base/executor.h"
#include "geometry/model/model.h"
#include "meshing/engine/hopeless_faces.h"
#include "meshing/engine/meshed_faces.h"
#include "meshing/face/refinements.h"

namespace st {

/// Meshes with fewer refinements or longer lengths are tried; a worse mesh is given back for the one before.
/// Collective.
class RefinementTrials {
 public:
  /// Collective: edges and faces that these refinements reach are meshed again, for this reason. Returns the faces.
  /// Where more than `most_bad` are bad before holes are closed and crossings searched, neither is done.
  using MeshAgain = std::function<std::vector<FaceId>(const std::vector<Refinement>& changed, const char* why,
                                                      std::int64_t most_bad)>;
  static constexpr std::int64_t kAnyBad = std::numeric_limits<std::int64_t>::max();

  /// All references outlive the object. `hopeless`: on rank 0.
  RefinementTrials(const ModelTables& tables, const Executor& executor, const HopelessFaces& hopeless,
                   MeshedFaces& faces, Refinements& refinements, MeshAgain mesh_again)
      : tables_(tables),
        executor_(executor),
        hopeless_(hopeless),
        faces_(faces),
        refinements_(refinements),
        mesh_again_(std::move(mesh_again)) {}

  /// Smaller lengths about places that are bad all the same are no use, and go; first all those of faces that were
  /// given up. The mesh stays as it is where more were bad without them.
  void take_back();
  /// Rounds ask for half of a length at once, also beside places that need nothing any more. Where all is sound, longer
  /// lengths with which it stays so are taken.
  void loosen();

 private:
  enum class TakeBack { kAtBadPlaces, kOfHopelessFacesToo };
  bool take_back_once(TakeBack what);
  std::vector<Refinement> drop_useless(TakeBack what);
  std::int64_t n_more_of_hopeless() const;
  bool loosen_once();
  std::vector<char> must_stay() const;
  std::vector<Refinement> find_needed(const std::vector<Refinement>& all, std::vector<char>& is_needed) const;

  const ModelTables& tables_;
  const Executor& executor_;
  const HopelessFaces& hopeless_;
  MeshedFaces& faces_;
  Refinements& refinements_;
  MeshAgain mesh_again_;
};

}  // namespace st
