#include "stages/pair_input.h"

#include <fmt/format.h>

#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "geometry/model/sameness.h"
#include "io/toml/pair_file.h"
#include "meshing/topology/pair_search.h"
#include "sizing/paired_field.h"

namespace st {
namespace {

std::vector<FaceId> faces_of(const PairSpec& pair, const std::string& name, const FaceLabels& labels) {
  const std::vector<std::uint8_t> is_in = find_faces(name, labels);
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < is_in.size(); ++f)
    if (is_in[f]) faces.push_back(static_cast<FaceId>(f));
  if (faces.empty())
    throw Error(ExitCode::kUsage, fmt::format("{}: pair: the model has no group of faces or part '{}'{}; st-info "
                                              "GEOMETRY --groups lists them",
                                              pair.where, name, say_other_kind(name, labels)));
  return faces;
}

std::vector<FacePair> pairs_of_file(const std::string& path, const ModelTables& t) {
  std::vector<FacePair> all;
  for (const PairSpec& spec : read_pair_file(path)) try {
      const std::vector<FacePair> some =
          pair_faces(t, faces_of(spec, spec.a, t.labels), faces_of(spec, spec.b, t.labels), spec.motion);
      all.insert(all.end(), some.begin(), some.end());
    } catch (const Error& e) {
      if (e.code() != ExitCode::kGeometry) throw;
      throw Error(e.code(), fmt::format("{}: pair: {}", spec.where, e.what()));
    }
  return all;
}

/// Pairs that were searched for may be others than the user thinks of: an inlet and an outlet, say.
void tell(const ModelTables& t, const std::vector<FacePair>& pairs, bool are_found) {
  const auto say = are_found ? log_report : log_info;
  for (const FacePair& p : pairs) {
    const bool is_translation = p.motion.rotation == Similarity().rotation;
    const Vec3 d = p.motion.translation;
    say(fmt::format(
        "  pair: {} has the mesh of {}, {}", t.face_label(p.b), t.face_label(p.a),
        is_translation ? fmt::format("moved by {:.10g} {:.10g} {:.10g}", d.x, d.y, d.z) : std::string("rotated")));
  }
}

}  // namespace

PeriodicPairs read_pairs(const std::string& option, const Model& model) {
  if (option.empty()) return {};
  PeriodicPairs pairs(model, option == "auto" ? find_pairs(model) : pairs_of_file(option, model.tables()));
  tell(model.tables(), pairs.pairs(), option == "auto");
  return pairs;
}

std::unique_ptr<SizeField> make_paired_field(const SizeField& field, const PeriodicPairs& pairs, const ModelTables& t) {
  if (pairs.empty()) return nullptr;
  std::vector<PairedRegion> regions;
  for (const FacePair& p : pairs.pairs()) regions.push_back({t.face_box[p.a], t.face_box[p.b], p.motion});
  return std::make_unique<PairedField>(field, std::move(regions), kSamePlace * t.box().diagonal());
}

}  // namespace st
