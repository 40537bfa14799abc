// Sizes of parts of a model: rules that change the limits of groups, faces and edges.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/length.h"
#include "base/number_option.h"
#include "features/strip.h"
#include "features/wing_edges.h"
#include "geometry/model/model.h"
#include "sizing/size_limits.h"

namespace st {

/// What a rule speaks of; empty: of the whole model. It meets every kind of selection that is given, of each kind any
/// item, as with GroupRule. With edges, between or detected these are edges: faces and groups of faces then stand for
/// the edges of their faces.
struct SizeSelection {
  std::vector<std::string> groups;  ///< glob patterns on names of groups of faces, edges or vertices, and of parts
  std::vector<std::string> faces, edges;  ///< 1-based ids "17", ranges "17-20", or glob patterns on names; of edges
                                          ///< also of their groups
  std::vector<std::string> between;  ///< two glob patterns: the edges between a face of a group of the first and one of
                                     ///< the second
  std::vector<WingEdgeKind> detected;  ///< edges that detection gives these kinds

  bool empty() const { return groups.empty() && faces.empty() && !is_of_edges(); }
  bool is_of_edges() const { return !edges.empty() || !between.empty() || !detected.empty(); }
};

/// One rule.
struct SizeRule {
  std::string where;  ///< for messages: "sizes.toml:12"
  SizeSelection selection;
  std::optional<EdgeMeaning> meaning;  ///< of the edges selected, whatever their shape
  bool for_surfaces = true;            ///< the insides of the faces selected
  bool for_curves = true;              ///< the edges of the faces selected
  std::optional<bool> is_sampled;      ///< false: asks for nothing
  std::optional<LengthSpec> lmin, lmax, chord;
  // see SizeOptions
  std::optional<double> alpha_deg;
  std::optional<int> gap_cells, wall_cells, edge_cells;
  std::optional<double> max_aspect;  ///< edges that are named are stretched along themselves

  bool asks_sizes() const;
};

/// A key of a rule that takes a size: a length, a number, or a count, of which 0 means off.
struct SizeKey {
  const char* name;
  std::variant<std::optional<LengthSpec> SizeRule::*, std::optional<double> SizeRule::*, std::optional<int> SizeRule::*>
      value;
  const NumberOption* option = nullptr;  ///< accepted values; null: of a length
};

/// In the order in which messages name them.
std::span<const SizeKey> size_keys();

/// Adds the kinds of edges that "trailing" or "leading" mean; false: another word.
bool add_detected(const std::string& word, SizeSelection& selection);

/// What a rule selects; ids ascending.
struct RuleTargets {
  std::vector<FaceId> faces;
  std::vector<EdgeId> edges;  ///< selected as edges, not as edges of faces
  std::vector<VertexId> vertices;
};

/// `wing_edges`: what detection found, where any rule needs it. Throws Error(kUsage) naming the rule for a selection
/// that meets nothing or an id that does not exist.
RuleTargets find_targets(const SizeRule& rule, const ModelTables& tables, std::span<const WingEdge> wing_edges = {});

/// What rules say of edges, in their order. Of faces the long edges of narrow ones are meant; kNoTrailing is said of
/// all edges of faces. Throws Error(kUsage), likewise for a face that is not narrow.
std::vector<DeclaredEdge> declared_edges(std::span<const SizeRule> rules, const ModelTables& tables,
                                         std::span<const Strip> strips, std::span<const WingEdge> wing_edges);

/// `limits` with what the rule says. `reference`: what per cents refer to. Throws Error(kUsage) when lmin exceeds lmax.
SamplingLimits changed_limits(const SizeRule& rule, SamplingLimits limits, const LengthReference& reference);

}  // namespace st
