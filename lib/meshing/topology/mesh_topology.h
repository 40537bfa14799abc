// The CAD topology as the mesher sees it (virtual topology): short edges merged to a node, narrow strips closed. Only
// this file knows what was merged; the CAD model and its ids stay as they are.
#pragma once

#include <vector>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

class MeshTopology {
 public:
  /// A face between two long edges, closed where it is narrow: there both edges have the nodes of `kept`.
  struct Strip {
    FaceId face;
    EdgeId kept, closed;
    bool is_opposed;  ///< they run against each other
    /// The other one's place of node `index` of an edge with `n` nodes.
    std::int32_t mirrored(std::int32_t index, std::int32_t n) const { return is_opposed ? n - 1 - index : index; }
  };

  /// `merged`: ids of `tables`. Throws Error(kMismatch) when it names edges or faces that the tables do not have.
  explicit MeshTopology(const ModelTables& tables, MergedFeatures merged = {});

  /// The model's tables, where merged edges are degenerate and their vertices one, that of the lowest id.
  const ModelTables& tables() const { return tables_; }
  const MergedFeatures& merged() const { return merged_; }

  const std::vector<Strip>& strips() const& { return strips_; }
  const std::vector<Strip>& strips() const&& = delete;  ///< would end with the object
  /// Null when there is none.
  const Strip* strip_of(FaceId f) const { return find(strip_of_face_, f); }
  const Strip* strip_kept_at(EdgeId e) const { return find(strip_of_kept_, e); }
  const Strip* strip_closed_at(EdgeId e) const { return find(strip_of_closed_, e); }

 private:
  const Strip* find(const std::vector<std::int32_t>& of, std::int32_t id) const {
    return of.empty() || of[id] == kNone ? nullptr : &strips_[of[id]];
  }

  ModelTables tables_;
  MergedFeatures merged_;
  std::vector<Strip> strips_;
  std::vector<std::int32_t> strip_of_face_, strip_of_kept_, strip_of_closed_;  // into strips_, kNone: none; empty where
                                                                               // there is no strip
};

}  // namespace st
