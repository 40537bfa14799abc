#include "stages/edit_trace.h"
#include "geometry/import/import.h"

#include <algorithm>
#include <optional>
#include <regex>

namespace st {
namespace {

void append_numbers(std::int32_t n, std::int32_t input, std::vector<Origin>& origins) {
  for (std::int32_t id = 0; id < n; ++id) origins.push_back({id, input});
}

void select_ids(std::span<const std::int32_t> ids, std::vector<Origin>& origins) {
  std::vector<Origin> selected;
  for (const std::int32_t id : ids) selected.push_back(origins[id]);
  origins = std::move(selected);
}

/// Finds where the entities of one input are now.
class Finder {
 public:
  Finder(const EditTrace& trace, const ModelTables& t, std::int32_t input)
      : faces_(of(trace.faces, input)), edges_(of(trace.edges, input)), vertices_(of(trace.vertices, input)) {
    vertex_face_.assign(t.n_vertices(), kNone);
    edge_face_.assign(t.n_edges(), kNone);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      for (const CoedgeId c : t.coedges(f)) {
        const EdgeId e = t.coedge_edge[c];
        edge_face_[e] = f;
        for (const int end : {0, 1}) vertex_face_[t.edge_vertices[2 * static_cast<std::size_t>(e) + end]] = f;
      }
  }

  /// "edge 12 "TE"", "edge 3 in face 4" ... with the new numbers, and a face of the result at it; nullopt: gone, or no
  /// entity of this kind.
  std::optional<std::pair<std::string, FaceId>> find(const std::string& entity) const {
    static const std::regex kNumbered("^(face|edge|vertex) ([0-9]+)(?: in face ([0-9]+))?((?: \".*\")?)$");
    std::smatch m;
    if (!std::regex_match(entity, m, kNumbered)) return std::nullopt;
    const std::string kind = m[1];
    const std::int32_t id = place(kind == "face" ? faces_ : kind == "edge" ? edges_ : vertices_, m[2]);
    const std::int32_t in_face = m[3].matched ? place(faces_, m[3]) : kNone;
    if (id == kNone || (m[3].matched && in_face == kNone)) return std::nullopt;
    const FaceId at = kind == "face" ? id : kind == "edge" ? edge_face_[id] : vertex_face_[id];
    return std::pair(kind + " " + std::to_string(id + 1) +
                         (m[3].matched ? " in face " + std::to_string(in_face + 1) : "") + m[4].str(),
                     at);
  }

 private:
  using Ids = std::vector<std::pair<std::int32_t, std::int32_t>>;  // in the input, in the result; ascending
  static Ids of(const std::vector<Origin>& origins, std::int32_t input) {
    Ids ids;
    for (std::size_t i = 0; i < origins.size(); ++i)
      if (origins[i].input == input) ids.emplace_back(origins[i].id, static_cast<std::int32_t>(i));
    std::sort(ids.begin(), ids.end());
    return ids;
  }
  static std::int32_t place(const Ids& ids, const std::string& number) {
    if (number.size() > 9) return kNone;
    const std::int32_t id = std::stoi(number) - 1;
    const auto it = std::lower_bound(ids.begin(), ids.end(), std::pair(id, std::int32_t{0}));
    return it != ids.end() && it->first == id ? it->second : kNone;
  }

  Ids faces_, edges_, vertices_;
  std::vector<FaceId> vertex_face_, edge_face_;
};

bool is_of_an_entity(const ImportFinding& f) {
  return f.entity.starts_with("face ") || f.entity.starts_with("edge ") || f.entity.starts_with("vertex ");
}

void move(const Similarity& motion, ImportFinding& f) {
  f.xyz = motion(f.xyz);
  f.size *= motion.scale;
}

}  // namespace

void EditTrace::append(const ModelTables& t, std::int32_t input) {
  append_numbers(t.n_faces(), input, faces);
  append_numbers(t.n_edges(), input, edges);
  append_numbers(t.n_vertices(), input, vertices);
}

void EditTrace::select(std::span<const FaceId> new_faces, std::span<const EdgeId> new_edges,
                       std::span<const VertexId> new_vertices) {
  select_ids(new_faces, faces);
  select_ids(new_edges, edges);
  select_ids(new_vertices, vertices);
}

std::vector<std::int32_t> previous_ids(const std::vector<Origin>& origins) {
  std::vector<std::int32_t> ids;
  for (const Origin& o : origins) ids.insert(ids.end(), {o.id, o.input});
  return ids;
}

std::vector<ImportFinding> carry_findings(const std::vector<std::vector<ImportFinding>>& of_input,
                                          const EditTrace& trace, const ModelTables& t,
                                          std::span<const Similarity> motion) {
  const bool moved_as_one =
      std::all_of(motion.begin(), motion.end(), [&](const Similarity& m) { return m == motion.front(); });
  std::vector<ImportFinding> carried;
  for (std::size_t i = 0; i < of_input.size(); ++i) {
    const Finder finder(trace, t, static_cast<std::int32_t>(i));
    for (ImportFinding f : of_input[i]) {
      if (f.kind == FindingKind::kFreeEdge || f.kind == FindingKind::kNonManifoldEdge ||
          (f.kind == FindingKind::kCrossingPart && !moved_as_one))
        continue;
      if (!is_of_an_entity(f)) {
        if (moved_as_one) move(motion.front(), f);
        carried.push_back(f);
      } else if (const auto found = finder.find(f.entity)) {
        f.entity = found->first;
        if (found->second != kNone) move(motion[found->second], f);
        carried.push_back(f);
      }
    }
  }
  return carried;
}

}  // namespace st
