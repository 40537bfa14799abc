#include "meshing/engine/paired_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/share.h"
#include "base/threads.h"
#include "meshing/face/face_attempt.h"
#include "meshing/face/face_patch.h"
#include "meshing/face/patch_image.h"
#include "meshing/face/patch_parameters.h"
#include "meshing/face/refinements.h"

namespace st {
namespace {

constexpr std::size_t kMostImages = 8;                                     // of one place: a corner of three pairs
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();  // version of a face without a patch

}  // namespace

PairImage image_on_pair(const Model& model, const PeriodicPairs& pairs, std::size_t pair, const FacePatch& patch,
                        const BoundaryNumbering& numbering, bool is_sound) try {
  const FacePair& p = pairs.pairs()[pair];
  const auto at = [&](const RimPlace& place) -> RimPlace {
    const auto [dim, entity, index] = place;
    if (dim == static_cast<std::uint8_t>(EntityDim::kVertex)) return {dim, pairs.vertex_image(pair, entity), 0};
    const PairFollower to = pairs.edge_image(pair, entity);
    const std::int32_t last = numbering.edges.n_nodes(entity) - 1;
    return {dim, to.leader, to.is_opposed ? last - index : +index};
  };
  PairImage result{image_of(patch, {p.b, p.motion, pairs.turns_over(pair), at}), ""};
  const auto surface = model.surface(p.b);
  const FaceBoundary boundary = make_face_boundary(model, *surface, p.b, numbering);
  const FurthestNode off = set_parameters(*surface, boundary, numbering, result.patch);
  if (const double most = pairs.tolerance(numbering.tables, p); is_sound && !(off.distance <= most))
    result.error = fmt::format("the image of {} is {:.3g} off its surface, beyond {:.3g}",
                               numbering.tables.face_label(p.a), off.distance, most);
  else if (!has_numbers_only(result.patch))
    result.error = "a place or (u,v) of its image is no number";
  return result;
} catch (const Error& e) {
  return {{}, e.what()};
}

std::vector<RefinementPoint> with_images(std::vector<RefinementPoint> places, const PeriodicPairs& pairs,
                                         const ModelTables& tables) {
  if (pairs.empty()) return places;
  std::vector<RefinementPoint> all;
  const double same = 1e-9 * tables.box().diagonal();
  for (const RefinementPoint& place : places) {
    const std::size_t first = all.size();
    all.push_back(place);
    for (std::size_t i = first; i < all.size() && all.size() < first + kMostImages; ++i)
      for (const FacePair& p : pairs.pairs())
        for (const bool forth : {true, false}) {
          RefinementPoint image = all[i];
          const double near = image.length + image.radius;
          if (box_distance(tables.face_box[forth ? p.a : p.b], image.x) > near) continue;
          image.x = (forth ? p.motion : p.motion.inverse())(image.x);
          const auto is_it = [&](const RefinementPoint& r) { return distance(r.x, image.x) <= same; };
          if (std::none_of(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(), is_it)) all.push_back(image);
        }
  }
  return all;
}

PairedFaces::PairedFaces(const Model& model, const MeshTopology& topology, const Executor& executor,
                         const PeriodicPairs* pairs, MeshedFaces& faces)
    : model_(model), tables_(topology.tables()), executor_(executor), pairs_(pairs ? *pairs : none_), faces_(faces) {}

std::vector<FaceId> PairedFaces::meshed_of(const std::vector<FaceId>& faces) const {
  std::vector<FaceId> meshed;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(meshed), [&](FaceId f) {
    return std::ranges::none_of(pairs_.pairs(), [&](const FacePair& p) { return p.b == f; });
  });
  return meshed;
}

void PairedFaces::spread(std::vector<char>& is_chosen) const {
  for (const FacePair& p : pairs_.pairs()) is_chosen[p.a] = is_chosen[p.b] |= is_chosen[p.a];
}

/// Of both faces of a pair: all sections of a patch have that of their round.
PairedFaces::Versions PairedFaces::versions(std::size_t pair) const {
  const auto version = [&](FaceId f) {
    const std::vector<PatchPlace>& sections = faces_.place(f);
    return sections.empty() ? kNever : sections.back().version;
  };
  return {version(pairs_.pairs()[pair].a), version(pairs_.pairs()[pair].b)};
}

/// Where the loops of both faces were closed, the second one has the image of what closes the first, if it can. A
/// closed face whose first one failed since, on other edges, has lost its patch like any other.
void PairedFaces::take(std::size_t pair, PairImage&& image) {
  const auto& [a, f, motion] = pairs_.pairs()[pair];
  if (faces_.outcome(f).is_closed && faces_.outcome(a).is_closed) {
    if (image.error.empty()) faces_.put(f, std::move(image.patch));
    return;
  }
  FaceOutcome o;
  if (image.error.empty()) {
    faces_.set(f, {}, std::move(o));
    return faces_.put(f, std::move(image.patch));
  }
  o.cause = FailureCause::kError;
  o.error = std::move(image.error);
  o.attempt = describe_attempt(faces_.numbering(), f, {}, {});
  faces_.set(f, {}, std::move(o));
}

std::vector<FaceId> PairedFaces::make_images(const std::vector<FaceId>& faces) {
  std::vector<FaceId> made;
  if (pairs_.empty()) return made;
  std::vector<std::size_t> chosen;
  std::vector<FaceId> first;
  for (std::size_t i = 0; i < pairs_.pairs().size(); ++i)
    if (executor_.is_root() && std::ranges::find(faces, pairs_.pairs()[i].b) != faces.end()) {
      chosen.push_back(i);
      first.push_back(pairs_.pairs()[i].a);
    }
  const MeshedFaces::Patches patches = faces_.bring(first);
  if (!executor_.is_root()) return made;
  std::vector<PairImage> images(chosen.size());
  parallel_for(chosen.size(), 1, [&](std::size_t i, std::size_t) {
    const auto it = patches.find(first[i]);
    images[i] = it != patches.end()
                    ? image_on_pair(model_, pairs_, chosen[i], it->second, faces_.numbering(),
                                    faces_.outcome(first[i]).cause == FailureCause::kNone)
                    : PairImage{{}, fmt::format("{}, whose image it has, has no mesh", tables_.face_label(first[i]))};
  });
  made_of_.resize(pairs_.pairs().size(), {kNever, kNever});
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (images[i].error.empty()) made.push_back(pairs_.pairs()[chosen[i]].b);
    take(chosen[i], std::move(images[i]));
    made_of_[chosen[i]] = versions(chosen[i]);
  }
  return made;
}

void PairedFaces::renew_images() {
  std::vector<FaceId> changed;
  for (std::size_t i = 0; i < made_of_.size(); ++i)  // none but on rank 0
    if (versions(i) != made_of_[i]) changed.push_back(pairs_.pairs()[i].b);
  share(executor_, changed);
  if (changed.empty()) return;
  make_images(changed);
  faces_.search_crossings();
}

}  // namespace st
