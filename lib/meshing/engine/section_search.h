// Triangles that cross among the sections of patches: what one rank finds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "base/executor.h"
#include "geometry/shape/wall_gap.h"
#include "mesh/patch_blocks.h"
#include "meshing/engine/chords.h"
#include "meshing/engine/patch_store.h"

namespace st {

/// Two triangles that cross.
struct FacetPair {
  static constexpr double kHalve = 0, kHopeless = -1, kUnknown = -2, kMeets = -3;

  Facet a, b;
  double factor = 0;  ///< of the length that parts them, or one of these
  auto key() const { return std::tuple(a.face, b.face, a.index, b.index, factor); }
};
using FacetPairs = std::vector<FacetPair>;

/// Sorted pairs, those of each two faces together.
std::vector<FacetPairs> by_faces(const FacetPairs& pairs);

/// A section with itself, or two, by their numbers of all.
struct SectionJob {
  std::int32_t a, b;
};

struct FoundCrossings {
  FacetPairs pairs;
  std::vector<Chord> chords;
  std::vector<std::array<FaceId, 2>> touching;  ///< faces of two bodies that meet
  std::vector<std::array<FaceId, 2>> ended;     ///< a face with itself, or two: not all pairs were compared

  void append(const FoundCrossings& more);
  static auto fields(auto& f) { return std::tie(f.pairs, f.chords, f.touching, f.ended); }
};

/// The corners of a triangle.
struct FacetCorners {
  WallTriangle places;
  bool is_spanning;  ///< all are on the boundary
};

/// All functions are local, and those that ask other ranks are for tasks.
class SectionSearch {
 public:
  /// `sections`: of all patches, by face, by number. All outlive the object.
  SectionSearch(const PatchStore& store, const Executor& executor, const BoundaryNumbering& numbering,
                const std::vector<PatchPlace>& sections)
      : store_(store), executor_(executor), numbering_(numbering), sections_(sections) {}

  FaceId face(std::int32_t s) const { return sections_[s].face; }
  /// The face is one section.
  bool is_whole(std::int32_t s) const;
  /// The rank that has the triangle.
  std::int32_t home(const Facet& facet) const { return sections_[section_of(facet)].rank; }
  /// The rank that has more to lose by sending.
  std::int32_t home(const SectionJob& job) const;
  /// About the time it takes.
  double weight(const SectionJob& job) const;

  /// For each job what of the other section is near that of this rank, whoever has it. All others are asked at once:
  /// where faces are small, most of the time would go into waiting for one answer after the other.
  std::vector<SectionPart> near_others(const std::vector<SectionJob>& jobs) const;
  /// `other`: of near_others(). Factors are not known yet, but of flat folds and where the search was ended.
  FoundCrossings find(const SectionJob& job, const SectionPart& other) const;
  /// The corners of a triangle of this rank.
  FacetCorners corners(const Facet& facet) const;
  /// The corners of triangles of one face, whoever has them.
  std::vector<FacetCorners> corners(const std::vector<Facet>& facets) const;
  /// What another rank asks for: corners of triangles, or what is near boxes.
  Bytes answer(const Bytes& request) const;

 private:
  std::int32_t section_of(const Facet& facet) const;
  Facet facet(std::int32_t s, std::int32_t triangle) const;
  std::array<std::int32_t, 2> here_and_there(const SectionJob& job) const;
  bool is_of_one_face(const SectionJob& job) const { return face(job.a) == face(job.b); }
  SectionPart near(std::int32_t s, const PatchBlocks& others, bool is_of_one_face) const;
  PatchBlocks blocks_of(const FacePatch& part) const;
  FoundCrossings within(std::int32_t s) const;
  FoundCrossings between(const SectionJob& job, const SectionPart& other) const;

  const PatchStore& store_;
  const Executor& executor_;
  const BoundaryNumbering& numbering_;
  const std::vector<PatchPlace>& sections_;
  const BoundarySegments segments_{numbering_};
};

}  // namespace st
