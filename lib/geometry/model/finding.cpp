#include "geometry/model/finding.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace st {
namespace {

struct Wording {
  const char* name;
  const char* text;  // "{}": the detail
};

/// [FindingKind]
constexpr Wording kWordings[] = {
    {"free edge", "free edge"},
    {"non-manifold edge", "non-manifold edge"},
    {"faces disagree which side is outside", "faces disagree which side is outside"},
    {"short edge", "short edge"},
    {"tolerance larger than the edge is long", "tolerance larger than the edge is long"},
    {"edges end away from their vertex", "edges end away from their vertex"},
    {"sliver face", "sliver face"},
    {"tolerance larger than the face is wide", "tolerance larger than the face is wide"},
    {"loop crosses itself or another", "loop crosses itself or another"},
    {"invalid face", "invalid face ({})"},
    {"invalid shell", "invalid shell ({})"},
    {"invalid solid", "invalid solid ({})"},
    {"face passes through another part", "face passes through another part"},
    {"several units of length", "the file holds several units of length; everything was converted to {}"},
    {"optional group without members", "optional group without {}"},
    {"tolerance not used for sewing",
     "tolerance not used for sewing: the faces are named by numbers, which --symmetry and --farfield change"},
    {"cut at the symmetry plane", "cut at the symmetry plane"},
    {"cavity inside a solid left out of the fluid", "cavity inside a solid left out of the fluid"},
    {"body inside another left out of the fluid", "body inside another left out of the fluid"},
    {"duplicated face, removed", "duplicated face, removed: it lies on {}"},
    {"solid that is there twice, removed", "solid that is there twice, removed: it lies on solid {} of the file"},
    {"edges inside, on which other faces end, made slits", "edges inside, on which other faces end, made slits"},
    {"ring without bounds, given its surface's own", "ring without bounds, given its surface's own"},
    {"loops", "loops: {} loops or faces that could not be walked were rebuilt"},
    {"loops rebuilt from their edges", "loops rebuilt from their edges"},
    {"parameters of edges made equal to their trimming curves'",
     "parameters of {} edges made equal to their trimming curves'"},
    {"missing trimming curves of edges rebuilt", "trimming curves of {} edges were missing and rebuilt"},
    {"trimming curve off its edge, projected again",
     "trimming curve off its edge, projected again ({} of the distance is left)"},
    {"trimming curve off its edge, tolerance of the edge raised",
     "trimming curve off its edge, tolerance of the edge raised"},
    {"sewn", "sewn: {}"},
    {"sewn by the tolerance of their group", "sewn by the tolerance of their group: {}"},
    {"sewing left tolerances far above its own; trimming curves there are compared again",
     "sewing left tolerances far above its own; trimming curves there are compared again"},
    {"solid inside out, turned", "solid inside out, turned"},
    {"closed shell inside another one made its void", "closed shell inside another one made its void"},
    {"closed shell made a solid", "closed shell made a solid"},
    {"bodies that touch joined", "bodies that touch joined: {}"},
    {"bodies that touch not joined", "bodies that touch not joined, each has a mesh of its own there: {}"},
    {"bodies touch", "bodies touch, each has a mesh of its own there: {}"},
    {"bodies that overlap united", "bodies that overlap united: {}"},
    {"bodies that overlap not united", "bodies that overlap not united: {}"},
    {"parts cross", "parts cross: {}"},
    {"faces cross", "faces cross beside their common edge: {}"},
    {"face crosses itself", "face crosses itself"},
    {"face shrinks to a point", "face shrinks to a point and goes on turned over"},
    {"repair taken back", "repair taken back: {}"},
    {"edge away from its faces, made again from them", "edge away from its faces, made again from them"},
    {"surface divided at its kinks", "surface divided at its kinks: {}"},
    {"kink inside a face that could not be divided", "kink inside a face that could not be divided"},
    {"face without area, left out", "face without area, left out"},
    {"sewn where three faces or more meet", "sewn where three faces or more meet: {}"},
    {"sheet", "sheet: the same room, or none, is on both sides"},
    {"wall between two rooms", "wall between two rooms"},
    {"ends or lies on other faces, joined there", "ends or lies on other faces, joined there: {}"},
    {"ends or lies on other faces, not joined", "ends or lies on other faces, not joined: {}"},
    {"edge without a curve in space", "edge without a curve in space: {}"},
    {"loop in another period of its surface, moved", "loop in another period of its surface, moved by {}"},
    {"loop that ran the wrong way around its face, turned", "loop that ran the wrong way around its face, turned"},
    {"hole outside its face, left out", "hole outside its face, left out{}"},
    {"face left out", "face left out: {}"},
    {"face folds over itself", "face folds over itself"},
    {"trimming curve off its edge by more than a tolerance", "trimming curve off its edge by more than a tolerance"},
    {"face folded back onto its neighbour, merged into it", "face folded back onto its neighbour, merged into {}"},
    {"parts in another file, which is missing", "parts in another file, which is missing: {}"},
    {"other", "{}"},
};
constexpr std::size_t kKinds = std::size(kWordings) - 1;  // that are known, without kOther
static_assert(kKinds == static_cast<std::size_t>(FindingKind::kMissingFile) + 1);

constexpr std::string_view kDetail = "{}";

const Wording& wording_of(FindingKind kind) { return kWordings[std::min(static_cast<std::size_t>(kind), kKinds)]; }

}  // namespace

const char* name_of(FindingKind kind) { return wording_of(kind).name; }

std::string ImportFinding::what() const {
  std::string text = wording_of(kind).text;
  if (const std::size_t at = text.find(kDetail); at != std::string::npos) text.replace(at, kDetail.size(), detail);
  return text;
}

void restore_kind(ImportFinding& finding, std::uint8_t kind, const std::string& detail, const std::string& what) {
  const bool is_known = kind < kKinds;
  finding.kind = is_known ? static_cast<FindingKind>(kind) : FindingKind::kOther;
  finding.detail = is_known ? detail : what;
}

}  // namespace st
