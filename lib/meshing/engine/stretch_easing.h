// Lengths along become shorter where stretched triangles do not fit the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "mesh/merge.h"
#include "meshing/engine/eased_places.h"
#include "meshing/engine/meshed_faces.h"
#include "meshing/engine/refinement_trials.h"
#include "meshing/engine/stretch_flaws.h"
#include "meshing/face/refinements.h"

namespace st {

/// Rounds, once the others have ended, of fields without metrics: lengths along become shorter about obtuse triangles
/// and large steps of size, down to those across, and what they reach is meshed again. The best mesh stays: one that
/// folds or crosses no more than at the beginning. Collective.
class StretchEasing {
 public:
  /// See MeshOptions::find_unheld.
  using FindUnheld = std::function<std::vector<RefinementPoint>(const SurfaceMesh&)>;

  /// All references outlive the object. `mesh_again`: see RefinementTrials.
  StretchEasing(const ModelTables& tables, const SizeField& field, const Executor& executor, MeshedFaces& faces,
                Refinements& refinements, const FindUnheld& find_unheld, RefinementTrials::MeshAgain mesh_again)
      : tables_(tables),
        field_(field),
        executor_(executor),
        faces_(faces),
        refinements_(refinements),
        find_unheld_(find_unheld),
        mesh_again_(std::move(mesh_again)) {}

  void run();

 private:
  using Places = std::vector<RefinementPoint>;
  using Patches = MeshedFaces::Patches;
  /// Folds, crossings and failures; triangles above 150 degrees; unheld places; obtuse triangles; large ones.
  using Count = std::tuple<std::int64_t, std::size_t, std::size_t, std::size_t, std::size_t>;
  struct Best {
    Count n_flaws;
    bool has_obtuse;  // where lengths are alike
    MeshedFaces::State state;
    std::vector<Refinement> refinements;
  };

  std::vector<FaceId> all_faces() const;
  std::int64_t n_triangles(const std::vector<FaceId>& of) const;
  StretchFlaws find_flaws(int n_tries);
  bool is_on_root(bool is_here) const;
  Count count_flaws() const;
  std::size_t n_worst() const { return std::get<1>(best_.n_flaws) + std::get<2>(best_.n_flaws); }
  void run_rounds(const std::function<std::vector<Refinement>()>& shorten_more);
  bool keep_if_better();
  std::vector<Refinement> shorten_along();
  std::vector<Refinement> shorten(const Places& places, Shortens shortens);
  void take_back_spoiling(std::size_t first);
  void mix_rounds();
  void go_back();

  const ModelTables& tables_;
  const SizeField& field_;
  const Executor& executor_;
  MeshedFaces& faces_;
  Refinements& refinements_;
  const FindUnheld& find_unheld_;
  RefinementTrials::MeshAgain mesh_again_;
  std::int64_t n_bad_ = 0;            // at the beginning, or not clearly more
  std::int64_t n_first_ = 0;          // triangles, likewise
  std::int64_t n_again_ = 0;          // that were meshed since then
  std::vector<Refinement> spoiling_;  // lengths are not shortened within their reach
  StretchFlaws flaws_;                // of the present mesh, on rank 0
  std::vector<EasingRound> rounds_;   // of one run_rounds(), on rank 0
  Best best_;
  bool is_best_ = true;  // the present mesh
};

}  // namespace st
