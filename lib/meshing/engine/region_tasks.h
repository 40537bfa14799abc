// Faces, or holes of faces, as tasks: light ones as a whole, heavy ones tile by tile.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "base/progress.h"
#include "meshing/engine/mesh_result.h"
#include "meshing/engine/tiled_regions.h"

namespace st {

/// How regions of a kind are made, and what becomes of them. Results are what their maker packed.
struct RegionSteps {
  const char *cut, *whole, *tile, *seams;  ///< kinds of tasks, for TaskLabel
  const char *progress, *unit;             ///< what Progress says, and of what the weights are
  /// Local, on any rank: the region as a whole; and on rank 0, what that returned.
  std::function<Bytes(std::int32_t region)> make_whole;
  std::function<void(std::int32_t region, Bytes&& result)> take_whole;
  /// Makes it from its tiles. Where the latter returns false the region is made as a whole.
  std::function<Bytes(std::int32_t region, TiledRegions& tiled)> make_seams;
  std::function<bool(std::int32_t region, Bytes&& result)> take_seams;
  /// Collective, when all seams were taken: on rank 0, regions that are to be made as a whole all the same.
  std::function<std::vector<std::int32_t>(TiledRegions& tiled)> finish = {};
  /// As for NamedTasks, of both results: where these are not all that there is to keep.
  std::function<Bytes(const Bytes& result)> record = [](const Bytes& result) { return result; };
  std::function<Bytes(Bytes&& whole)> restore = [](Bytes&& whole) { return std::move(whole); };
};

/// The tasks of one round over regions. While heavy regions are cut, the others that are light are made; then the rest,
/// and the tiles; then the seams of those that were cut; last, as a whole, those whose tiles failed or do not fit.
class RegionTasks {
 public:
  /// All references outlive the object. `tiled`: nothing is chosen yet; `made_from`: as for NamedTasks; `weight`: by
  /// region.
  RegionTasks(RegionSteps steps, TiledRegions tiled, std::string made_from, const std::vector<double>& weight,
              const MeshOptions& options, const Executor& executor)
      : steps_(std::move(steps)),
        tiled_(std::move(tiled)),
        made_from_(std::move(made_from)),
        weight_(weight),
        options_(options),
        executor_(executor) {}

  /// Collective, once. `all`: ascending. Heavy ones, of more than one and a half tiles, are cut unless they are to be
  /// left out.
  void run(const std::vector<std::int32_t>& all);

 private:
  struct Task {
    TaskLabel label;
    double work;
    std::function<Bytes()> compute;
    std::function<void(Bytes&& result)> collect;  // on rank 0
    std::function<Bytes(const Bytes& result)> record = [](const Bytes& result) { return result; };
    std::function<Bytes(Bytes&& whole)> restore = [](Bytes&& whole) { return std::move(whole); };
  };
  void run(const std::vector<Task>& tasks);
  std::vector<Task> cuts();
  void add_whole(const std::vector<std::int32_t>& regions, std::vector<Task>& tasks, Progress& progress);
  void add_tiles(std::vector<Task>& tasks, Progress& progress);
  std::vector<std::int32_t> make_seams();

  const RegionSteps steps_;
  TiledRegions tiled_;
  const std::string made_from_;
  const std::vector<double>& weight_;
  const MeshOptions& options_;
  const Executor& executor_;
};

}  // namespace st
