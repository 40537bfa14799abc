// st-check: is this mesh fit for use?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

class Communicator;

/// What unattended runs ask of a mesh; nothing set: not asked.
struct CheckThresholds {
  int max_folds = 0;
  static constexpr NumberOption kMaxFolds{"--max-folds", "N", "[0, 1000000000]",
                                          "number of folded edges accepted (neighbouring triangles turned over)"};
  int max_crossings = 0;
  static constexpr NumberOption kMaxCrossings{"--max-crossings", "N", "[0, 1000000000]",
                                              "number of crossing or overlapping pairs of triangles accepted"};
  std::optional<double> min_quality;
  static constexpr NumberOption kMinQuality{
      "--min-quality", "F", "[0, 1]",
      "smallest quality accepted of any triangle (1: equilateral); default: not checked"};
  std::optional<double> min_mean_quality;
  static constexpr NumberOption kMinMeanQuality{
      "--min-mean-quality", "F", "[0, 1]", "smallest mean quality of all triangles accepted; default: not checked"};
  std::optional<double> min_p1_quality;
  static constexpr NumberOption kMinP1Quality{"--min-p1-quality", "F", "[0, 1]",
                                              "smallest first percentile of quality accepted; default: not checked"};
  std::optional<double> min_angle_deg;
  static constexpr NumberOption kMinAngle{"--min-angle", "DEG", "(0, 60]",
                                          "smallest angle accepted of any triangle, in degrees; default: not checked"};
  std::optional<int> max_free_sharp;
  static constexpr NumberOption kMaxFreeSharp{"--max-free-sharp", "N", "[0, 1000000000]",
                                              "number of triangles below --list-below accepted that the CAD does not "
                                              "force; needs --geometry; default: not checked"};
  std::optional<double> max_jump;
  static constexpr NumberOption kMaxJump{
      "--max-jump", "F", "[1, 1000000]",
      "largest size ratio of neighbouring triangles accepted, 99.9th percentile; default: not checked"};
  std::optional<double> min_size_share;
  static constexpr NumberOption kMinSizeShare{
      "--min-size-share", "F", "[0, 1]",
      "smallest share accepted of edges within 0.7 to 1.4 times the requested length, without those that the CAD "
      "forces; needs --sizing; default: not checked"};
  std::string max_deviation;  ///< length: of every triangle's midpoint from its surface; empty: not asked; needs the
                              ///< geometry
  std::optional<double> max_normal_deviation_deg;
  static constexpr NumberOption kMaxNormalDeviation{
      "--max-normal-deviation", "DEG", "(0, 180]",
      "largest angle accepted between a triangle and its surface, in degrees; needs --geometry; default: not checked"};
};

/// How much the summary says. kBrief: the verdict, what fails, and six figures; kWithWings: and a line for each of the
/// first lifting surfaces; kWhole: all checks, tables and causes.
enum class CheckText { kBrief, kWithWings, kWhole };

struct CheckStageOptions {
  std::string mesh;      ///< mesh artifact
  std::string geometry;  ///< optional: areas per face, open edges allowed only where the CAD has free edges, deviation
  std::string sizing;    ///< optional: conformity of edge lengths to the sizes
  double area_tolerance = 0.01;
  static constexpr NumberOption kAreaTolerance{
      "--area-tolerance", "F", "(0, 1]",
      "largest relative difference between mesh and CAD area of a face, after the chord error"};
  CheckThresholds thresholds;
  std::vector<std::string> reports;  ///< JSON files to write: everything, per model, group and face, with histograms
  std::string layers = {};  ///< layers of prisms that shall grow from the walls, see LayersRequest; empty: none
  double list_below_deg = 10;
  static constexpr NumberOption kListBelow{
      "--list-below", "DEG", "(0, 60]",
      "triangles with an angle below this, in degrees, are listed by cause; needs --geometry"};

  CheckText text = CheckText::kWhole;

  /// Throws Error(kUsage) for a threshold whose geometry or sizing is not given, and for layers that say nothing.
  void validate() const;
};

/// Local. Summary code kIncomplete when the mesh does not pass. `report`, where given, gets what options.reports do.
/// Throws Error.
StageSummary run_check(const CheckStageOptions& options, std::string* report = nullptr);
/// Collective: over ranks; the same result, on the first of them.
StageSummary run_check(const CheckStageOptions& options, const Communicator& ranks, std::string* report = nullptr);

}  // namespace st
