// The loop of the mesher: what cannot be meshed, folds or crosses gets smaller sizes and is meshed again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/executor.h"
#include "meshing/engine/mesh_result.h"
#include "meshing/engine/refinement_policy.h"
#include "meshing/face/refinements.h"

namespace st {

/// The rounds; what they mesh (the faces of a model, or the holes of a mesh) is in the steps that derived classes have.
class MeshRounds {
 public:
  virtual ~MeshRounds() = default;
  MeshRounds(const MeshRounds&) = delete;
  MeshRounds& operator=(const MeshRounds&) = delete;

  /// Collective. Counts and times go into the result; the rest is what the steps put there.
  void run();

 protected:
  /// All references outlive the object.
  MeshRounds(const SizeField& field, const RefinementPolicy& policy, const Executor& executor, MeshResult& result)
      : field_(field), executor_(executor), result_(result), refinements_(field), policy_(policy) {}

  const SizeField& field_;
  const Executor& executor_;
  MeshResult& result_;
  Refinements refinements_;              // the same on every rank
  std::uint64_t n_meshed_ = 0;           // triangles on rank 0, those that were meshed again included
  std::int64_t n_unmeasured_pairs_ = 0;  // that cross, on rank 0, but those where it is known what parts them

 private:
  using Places = std::vector<RefinementPoint>;

  // the steps of a round; collective, their places count on rank 0
  virtual void mesh_edges() = 0;
  /// Places that need smaller sizes before regions can be meshed.
  virtual Places mesh_regions() = 0;
  /// Puts the regions together.
  virtual void join() = 0;
  /// Places where triangles cross; none ends the rounds.
  virtual Places find_crossings() = 0;
  /// Whether nothing crosses any more, by other means than smaller sizes, as little does in a heavy mesh.
  virtual bool mend_crossings() { return false; }
  /// What is meshed in the next round, since refinements from this one on were added.
  virtual void choose_again(std::size_t first_refinement) = 0;

  Places join_and_check();
  bool refine(const Places& places, double floor);
  Places affordable(const Places& places);
  bool is_measured(const Places& places) const;
  bool runs_away();
  bool is_stuck();

  RefinementPolicy policy_;
  std::uint64_t n_first_ = 0;        // triangles of the first round
  bool has_said_walls_ = false;      // too many triangles
  double n_for_walls_ = 0;           // triangles that were to part walls
  std::int64_t n_fewest_pairs_ = 0;  // of crossing triangles after a round; 0: none yet
  int n_stuck_ = 0;                  // rounds since then
};

}  // namespace st
