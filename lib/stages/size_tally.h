// What a size field requires of groups of faces, and why. Internal to stages.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/hdf5/sizing_artifact.h"

namespace st {

/// What one cause makes of a group of faces.
struct CauseShare {
  std::int32_t cause = kNone;  ///< see pack_cause
  double triangles = 0;        ///< expected
  double least = 0;            ///< smallest length that it causes on these faces, model unit
};

/// What a group of faces gets.
struct GroupSizes {
  std::string name;                ///< UTF-8
  double triangles = 0;            ///< expected, > 0
  double least = 0, median = 0;    ///< requested lengths, by area, model unit
  std::vector<CauseShare> causes;  ///< most triangles first, then by cause; never empty
  double largest = 0;              ///< of the requested lengths

  double share(const CauseShare& cause) const { return cause.triangles / triangles; }
};

/// Sums what face_weights() visits by group and cause.
class SizeTally {
 public:
  /// `group_of_face` [n_faces]: index into `names`; kNone: left out.
  SizeTally(std::vector<std::string> names, std::vector<std::int32_t> group_of_face);

  void add(const SizedPart& part);

  /// Groups with any area, most triangles first, then in their own order, when all lengths of the field are multiplied
  /// by `scale`. `unit`: edge of the model over edge in the field's frame (Similarity::scale).
  std::vector<GroupSizes> groups(double scale, double unit) const;

 private:
  struct Share {
    FaceWeight weight;
    double least = 0;
  };
  struct LengthOnArea {
    float length = 0, area = 0;
  };
  struct Group {
    std::string name;
    std::map<std::int32_t, Share> causes;
    std::vector<LengthOnArea> lengths;
  };
  static double median(std::vector<LengthOnArea> lengths);
  static GroupSizes sizes_of(const Group& group, double scale, double unit);

  std::vector<std::int32_t> group_of_face_;
  std::vector<Group> groups_;
};

/// Groups that a table shows.
inline constexpr std::size_t kMostGroups = 12;

/// A tally by the main groups of faces; one of all faces, "model", where there is none.
SizeTally tally_by_group(const FaceLabels& labels, std::int32_t n_faces);

/// One line per group, aligned, below a heading; at most `most` of them, then how many more there are.
std::vector<std::string> group_lines(const std::vector<GroupSizes>& groups, const CauseNames& names, std::size_t most,
                                     const std::string& unit = "");

/// What the samples of the raster require of its main groups, in the cells that their faces pass through and that hold
/// a sample. Growth is not limited yet, so the triangles are none that a mesh would have.
std::vector<GroupSizes> sampled_groups(const RasterArtifact& raster);

/// ", lengths 0.87 to 6.59 on the faces", of all groups; empty without one.
std::string range_text(const std::vector<GroupSizes>& groups, const std::string& unit = "");

/// The same lines without triangles, for sampled_groups().
std::vector<std::string> sampled_lines(const std::vector<GroupSizes>& groups, const CauseNames& names, std::size_t most,
                                       const std::string& unit = "");

/// Every group with its numbers and the cause of most of its triangles.
nlohmann::ordered_json groups_json(const std::vector<GroupSizes>& groups, const CauseNames& names);

/// The same without triangles, for sampled_groups().
nlohmann::ordered_json sampled_json(const std::vector<GroupSizes>& groups, const CauseNames& names);

/// Every cause with its numbers.
nlohmann::ordered_json causes_json(const GroupSizes& group, const CauseNames& names);

/// One line per cause, aligned, below a heading; at most `most` of them, then one line of all others together.
std::vector<std::string> cause_lines(const GroupSizes& group, const CauseNames& names, std::size_t most);

}  // namespace st
