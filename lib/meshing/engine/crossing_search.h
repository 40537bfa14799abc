// Triangles of patches that cross each other, as places where the sizes must become smaller.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/executor.h"
#include "geometry/model/bodies.h"
#include "geometry/model/model.h"
#include "meshing/engine/section_search.h"

namespace st {

/// Half the longest of a triangle's sides, at its centre.
RefinementPoint halve_triangle(Vec3 a, Vec3 b, Vec3 c);

/// Remembers the pairs that it found: searched are only those with a patch made since the last search. Triangles of
/// two bodies count where the CAD keeps these apart; parts in contact cross as they like. Each section of a face, and
/// every two that meet, are a task of the rank that has the larger one.
class CrossingSearch {
 public:
  /// All references outlive the object. `across_bodies`: bodies are compared with each other, too.
  CrossingSearch(const Model& model, const PatchStore& store, const Executor& executor, bool across_bodies = true)
      : model_(model),
        store_(store),
        executor_(executor),
        is_across_(across_bodies),
        face_body_(bodies_of(model.tables())),
        face_is_given_up_(face_body_.size(), 0),
        found_{.touching = {},
               .face_is_fresh = std::vector<char>(face_body_.size(), 1),
               .chords = std::vector<std::vector<Chord>>(face_body_.size()),
               .pairs = {}} {}

  /// What was found of some patches, to come back to with these.
  struct State {
    std::set<std::pair<FaceId, FaceId>> touching;  // of two bodies in contact, as far as known
    std::vector<char> face_is_fresh;               // patch made since the last run
    std::vector<std::vector<Chord>> chords;        // by face
    FacetPairs pairs;                              // found so far and still there, sorted
  };

  /// Local. The face's patch is another one now.
  void renew(FaceId f) { found_.face_is_fresh[f] = 1; }
  const State& state() const { return found_; }
  /// Local. The patches are those of that time.
  void go_back(State to) { found_ = std::move(to); }
  /// Local, on rank 0. No triangles of the face are refined any more for crossing each other.
  void give_up(FaceId f) { face_is_given_up_[f] = 1; }
  /// Collective. `places` [n_faces], of rank 0.
  void run(const BoundaryNumbering& numbering, const std::vector<FacePlace>& places);
  /// Collective, after a run of the same places. On rank 0 two places for each pair that smaller triangles can part, up
  /// to some thousand, with a wider radius each time. What follows is of rank 0.
  std::vector<RefinementPoint> places_to_refine(const BoundaryNumbering& numbering,
                                                const std::vector<FacePlace>& places);
  /// How many the last run found.
  int n_pairs() const { return static_cast<int>(found_.pairs.size()); }
  /// But those where it is known what parts them.
  int n_unmeasured_pairs() const {
    return static_cast<int>(std::ranges::count_if(found_.pairs, [](const FacetPair& p) { return !(p.factor > 0); }));
  }
  /// [n_faces] those of two triangles of the face.
  std::vector<std::int64_t> n_pairs_within() const;
  /// Faces with triangles of the last run, ascending; those of which two triangles cross each other, or all.
  std::vector<FaceId> crossing_faces(bool others_too) const;
  /// Faces of two bodies in contact, as far as known, ascending: their triangles may cross.
  std::vector<FaceId> touching_faces() const;
  /// Triangles of the face, by their places in its patch, that cross others of it, or also of other faces; by the last
  /// run, ascending.
  std::vector<std::size_t> crossing_in(FaceId f, bool others_too) const;
  /// Local. Moves nodes inside faces where triangles of the last run touch as the CAD does, to part them: by less than
  /// surfaces that meet are apart (meeting_distance()). `patches`: at least of crossing_faces(). Returns the faces that
  /// have changed.
  std::vector<FaceId> move_touching_apart(const BoundaryNumbering& numbering,
                                          std::map<FaceId, FacePatch>& patches) const;

 private:
  bool may_be_apart(FaceId a, FaceId b) const;
  void say_ended(const std::set<std::array<FaceId, 2>>& faces) const;
  std::vector<SectionJob> jobs_of(const std::vector<PatchPlace>& sections) const;
  static RefinementPoint refinement_of(const FacetCorners& triangle, double factor, double covering);
  std::vector<PatchPlace> sections_of(const std::vector<FacePlace>& places) const;
  std::vector<FacetCorners> corners(std::vector<Facet> facets, const SectionSearch& search) const;
  void measure_whole_faces(const SectionJob& job, const SectionSearch& search, FoundCrossings& found) const;
  FacetPairs measured(const FacetPairs& pairs, const SectionSearch& search);
  FacetPairs measured_pair_of_faces(FacetPairs kept, const SectionSearch& search) const;

  const Model& model_;
  const PatchStore& store_;
  const Executor& executor_;
  bool is_across_;
  std::vector<std::int32_t> face_body_;
  int n_asked_ = 0;                     // times for places to refine
  std::vector<char> face_is_given_up_;  // on rank 0
  State found_;
};

}  // namespace st
