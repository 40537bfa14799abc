#include "features/suggested_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/eigen.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

// Shares and angles below: docs/design/heuristics.md, "Groups that are suggested".
constexpr double kRing = 0.4;      // of the largest spread of a trailing edge: the second one of a ring is more
constexpr double kAxial = 0.7;     // cosine between the flow and the axis of a ring or rotor
constexpr double kFin = 60;        // degrees above the lateral axis: fins, and less than
constexpr double kTailplane = 25;  // this: tailplanes and canards; between them a V
constexpr double kAway = 0.75;     // root chords between a wing and a tail, in the direction of the flow
constexpr double kOutward = 0.6;   // mean cosine between blades' trailing edges and the way from the middle of all
constexpr double kBeside = 0.3;    // root chords along the flow between both halves of a wing
constexpr double kOther = 0.4;     // of the wing's area: its other half, or a second wing
constexpr double kAlike = 0.1;     // of span and chord: blades of one propeller
constexpr double kFuselage = 0.3;  // of the reference diagonal

/// A lifting surface as a whole.
struct WingShape {
  Vec3 middle = {};  ///< between noses and trailing edge
  Vec3 flow = {};    ///< from nose to trailing edge, unit
  Vec3 along = {};   ///< in which the trailing edge spreads most, unit
  double area = 0, root = 0;
  bool is_ring = false, is_measured = false;
  bool is_rotor = false;  ///< blades that hang together: their trailing edges run outward from the axis
};

/// Directions in which places spread, the largest last; the values are variances.
PrincipalAxes spread_of(std::span<const Vec3> places) {
  const double share = 1.0 / static_cast<double>(places.size());
  Vec3 mean = {};
  for (const Vec3& p : places) mean += share * p;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : places) spread += share * to_eigen(p - mean) * to_eigen(p - mean).transpose();
  return principal_axes(spread);
}

/// Mean cosine between pieces of the trailing edges and the way there from the middle of `tails`.
double outward_share(const LiftingSurface& wing, std::span<const Vec3> tails) {
  Vec3 middle = {};
  for (const Vec3& p : tails) middle = middle + p * (1.0 / static_cast<double>(tails.size()));
  double sum = 0, length = 0;
  for (const ChordEdge& edge : wing.edges())
    for (std::size_t i = 1; i < edge.stations.size(); ++i) {
      const Vec3 a = edge.stations[i - 1].trailing, b = edge.stations[i].trailing, way = (a + b) * 0.5 - middle;
      if (norm(way) <= 0) continue;
      sum += std::abs(dot(b - a, normalized(way)));
      length += distance(a, b);
    }
  return length > 0 ? sum / length : 0;
}

WingShape shape_of(const LiftingSurface& wing) {
  WingShape shape;
  std::vector<Vec3> tails;
  int n = 0;
  for (const ChordEdge& edge : wing.edges())
    for (const ChordStation& s : edge.stations) {
      tails.push_back(s.trailing);
      if (!s.is_measured) continue;
      ++n;
      shape.middle = shape.middle + (s.trailing + s.nose) * 0.5;
      shape.flow = shape.flow + normalized(s.trailing - s.nose);
    }
  shape.is_measured = n > 0 && norm(shape.flow) > 0;
  if (!shape.is_measured) return shape;
  shape.middle = shape.middle * (1.0 / n);
  shape.flow = normalized(shape.flow);
  const PrincipalAxes spread = spread_of(tails);
  shape.along = spread.axis[2];
  const double axial = std::abs(dot(shape.flow, spread.axis[0]));
  if (spread.value[1] > kRing * kRing * spread.value[2] && axial > kAxial)
    (outward_share(wing, tails) > kOutward ? shape.is_rotor : shape.is_ring) = true;
  shape.area = wing.span * wing.median_chord;
  shape.root = wing.largest_chord;
  return shape;
}

class GroupSuggester {
 public:
  GroupSuggester(const ModelTables& tables, const FaceRoles& roles, std::span<const LiftingSurface> wings,
                 const Bodies& bodies)
      : t_(tables), roles_(roles), wings_(wings), bodies_(bodies), name_(roles.role.size()) {
    for (const LiftingSurface& wing : wings) shapes_.push_back(shape_of(wing));
    kinds_.resize(wings.size());
  }

  std::vector<SuggestedGroup> run() {
    name_air();
    name_wings();
    for (std::size_t w = 0; w < wings_.size(); ++w)
      for (const FaceId f : wings_[w].faces)
        if (!kinds_[w].empty() && name_[f].empty()) name_[f] = kinds_[w];
    find_neighbours();
    name_bodies();
    return groups();
  }

 private:
  void name_air() {
    for (std::size_t f = 0; f < name_.size(); ++f) {
      if (roles_.role[f] == FaceRole::kFarfield) name_[f] = "farfield";
      if (roles_.role[f] == FaceRole::kSymmetry) name_[f] = "symmetry";
      if (roles_.role[f] == FaceRole::kInterface) name_[f] = "interface";
    }
  }

  bool is_known(std::size_t w) const { return shapes_[w].is_measured; }
  bool is_alike(std::size_t a, std::size_t b) const {
    const auto near = [](double x, double y) { return std::abs(x - y) <= kAlike * std::max(x, y); };
    return near(wings_[a].span, wings_[b].span) && near(wings_[a].median_chord, wings_[b].median_chord);
  }

  /// Another one is alike, and the flow at it goes elsewhere by 25 degrees or more: they turn about an axis.
  bool is_blade(std::size_t w) const {
    for (std::size_t other = 0; other < wings_.size(); ++other) {
      if (other == w || !is_known(other) || shapes_[other].is_ring || !is_alike(w, other)) continue;
      if (dot(shapes_[w].flow, shapes_[other].flow) < std::cos(radians(kTailplane))) return true;
    }
    return false;
  }

  /// Square to the symmetry plane, else along the largest wing.
  Vec3 lateral_axis(const WingShape& main) const {
    Box3 plane;
    for (std::size_t f = 0; f < name_.size(); ++f)
      if (roles_.role[f] == FaceRole::kSymmetry) plane.add(t_.face_box[f]);
    if (plane.is_empty()) return main.along;
    const Vec3 d = plane.hi - plane.lo;
    if (d.x <= std::min(d.y, d.z)) return {1, 0, 0};
    return d.y <= d.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  }

  void set_kind(std::size_t w, const std::string& kind, const std::string& why) {
    kinds_[w] = kind;
    why_.emplace(kind, why);
  }

  void name_wings() {
    std::optional<std::size_t> main;
    for (std::size_t w = 0; w < wings_.size(); ++w) {
      if (!is_known(w)) continue;
      if (shapes_[w].is_rotor)
        set_kind(w, "blade", "blades around an axis");
      else if (shapes_[w].is_ring)
        set_kind(w, "nacelle", "a ring with a nose and a trailing edge");
      else if (is_blade(w))
        set_kind(w, "blade", "like others that point in other directions");
      else if (!main || shapes_[w].area > shapes_[*main].area)
        main = w;
    }
    if (!main) return;
    const Vec3 lateral = lateral_axis(shapes_[*main]);
    for (std::size_t w = 0; w < wings_.size(); ++w)
      if (is_known(w) && kinds_[w].empty()) name_wing(w, *main, lateral);
  }

  void name_wing(std::size_t w, std::size_t main, Vec3 lateral) {
    const WingShape &own = shapes_[w], &first = shapes_[main];
    if (w == main || is_alike(w, main)) return set_kind(w, "wing", "the lifting surface with the largest area");
    const double behind = dot(own.middle - first.middle, first.flow) / first.root;
    const Vec3 across = own.along - first.flow * dot(own.along, first.flow);
    const double angle = degrees(std::acos(std::min(1.0, std::abs(dot(normalized(across), lateral)))));
    if (angle > kFin) return set_kind(w, "fin", "a lifting surface that stands upright");
    if (behind > kAway && angle > kTailplane) return set_kind(w, "v_tail", "behind the wing, leaning");
    if (behind > kAway) return set_kind(w, "tailplane", "behind the wing");
    if (behind < -kAway) return set_kind(w, "canard", "ahead of the wing");
    if (own.area > kOther * first.area && std::abs(behind) < kBeside)
      return set_kind(w, "wing", "the lifting surface with the largest area");
    if (own.area < kOther * first.area) return set_kind(w, behind > 0 ? "flap" : "slat", "small, at the wing");
    set_kind(w, "wing_2", "a second lifting surface beside the largest");
  }

  void find_neighbours() {
    const EdgeFaces faces_at(t_);
    touched_.resize(bodies_.body.size());
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (const FaceId a : faces_at[e])
        for (const FaceId b : faces_at[e])
          if (const std::int32_t body = bodies_.of_face[a]; body != kNone && bodies_.of_face[b] != body)
            ++touched_[static_cast<std::size_t>(body)][b];
  }

  /// The group of most of the edges around a body, of those that `counts`.
  template <class Counts>
  std::string neighbour(std::size_t body, const Counts& counts) const {
    std::map<std::string, int> n;
    for (const auto& [f, edges] : touched_[body])
      if (!name_[f].empty() && counts(name_[f])) n[name_[f]] += edges;
    const auto most = std::ranges::max_element(n, {}, [](const auto& own) { return own.second; });
    return most == n.end() ? "" : most->first;
  }

  static bool is_air(const std::string& name) {
    return name == "farfield" || name == "symmetry" || name == "interface";
  }

  void name_body(std::size_t body, const std::string& name, const std::string& why) {
    why_.emplace(name, why);
    for (std::size_t f = 0; f < name_.size(); ++f)
      if (bodies_.of_face[f] == static_cast<std::int32_t>(body) && name_[f].empty()) name_[f] = name;
    is_named_.insert(body);
  }

  bool is_small(std::size_t body) const { return bodies_.body[body].diagonal <= kFuselage * roles_.reference_diagonal; }

  /// Small bodies that touch each other, and a nacelle and another lifting surface together.
  void name_pylons() {
    DisjointSets sets(static_cast<std::int32_t>(bodies_.body.size()));
    for (std::size_t b = 0; b < bodies_.body.size(); ++b)
      for (const auto& [f, edges] : touched_[b])
        if (const std::int32_t other = bodies_.of_face[f]; other != kNone && is_small(b) && is_small(other))
          sets.join(static_cast<std::int32_t>(b), other);
    std::vector<std::set<std::string>> beside(bodies_.body.size());
    for (std::size_t b = 0; b < bodies_.body.size(); ++b)
      for (const auto& [f, edges] : touched_[b])
        if (!name_[f].empty() && !is_air(name_[f])) beside[sets.find(static_cast<std::int32_t>(b))].insert(name_[f]);
    for (std::size_t b = 0; b < bodies_.body.size(); ++b)
      if (const auto& own = beside[sets.find(static_cast<std::int32_t>(b))]; own.contains("nacelle") && own.size() > 1)
        name_body(b, "pylon", "between a nacelle and something else");
  }

  void name_bodies() {
    name_pylons();
    const auto is_wing = [](const std::string& name) { return !is_air(name); };
    for (std::size_t b = 0; b < bodies_.body.size(); ++b)
      if (bodies_.body[b].is_wing_piece && !is_named_.contains(b))
        if (const std::string own = neighbour(b, is_wing); !own.empty()) name_body(b, own, why_[own]);
    std::optional<std::size_t> largest;
    for (std::size_t b = 0; b < bodies_.body.size(); ++b)
      if (!is_named_.contains(b) && (!largest || bodies_.body[b].diagonal > bodies_.body[*largest].diagonal))
        largest = b;
    if (largest && !is_small(*largest))
      name_body(*largest, std::ranges::find(kinds_, "wing") != kinds_.end() ? "fuselage" : "body",
                "the largest body that is no lifting surface");
    for (std::size_t b = 0; b < bodies_.body.size(); ++b) {
      if (is_named_.contains(b)) continue;
      std::set<std::string> beside;
      for (const auto& [f, edges] : touched_[b])
        if (!name_[f].empty() && !is_air(name_[f])) beside.insert(name_[f]);
      if (beside.contains("nacelle") && beside.size() > 1)
        name_body(b, "pylon", "between a nacelle and something else");
      else if (beside.contains("nacelle"))
        name_body(b, "nacelle", why_["nacelle"]);
      else if (!beside.empty())
        name_body(b, "fairing", "a small body on another one");
    }
  }

  std::vector<SuggestedGroup> groups() const {
    std::vector<SuggestedGroup> list;
    for (std::size_t f = 0; f < name_.size(); ++f) {
      if (name_[f].empty()) continue;
      auto own = std::ranges::find(list, name_[f], &SuggestedGroup::name);
      if (own == list.end()) {
        const auto why = why_.find(name_[f]);
        list.push_back(
            {name_[f], is_air(name_[f]) ? name_[f] : "wall", why == why_.end() ? "by its role" : why->second, {}});
        own = list.end() - 1;
      }
      own->faces.push_back(static_cast<FaceId>(f));
    }
    return list;
  }

  const ModelTables& t_;
  const FaceRoles& roles_;
  std::span<const LiftingSurface> wings_;
  const Bodies& bodies_;
  std::vector<std::string> name_;               // [n_faces]
  std::map<std::string, std::string> why_;      // by name
  std::vector<WingShape> shapes_;               // [n_wings]
  std::vector<std::string> kinds_;              // [n_wings]
  std::vector<std::map<FaceId, int>> touched_;  // [n_bodies] faces beside, and at how many edges
  std::set<std::size_t> is_named_;              // bodies
};

}  // namespace

std::vector<SuggestedGroup> suggest_groups(const ModelTables& tables, const FaceRoles& roles,
                                           std::span<const LiftingSurface> wings, const Bodies& bodies) {
  return GroupSuggester(tables, roles, wings, bodies).run();
}

}  // namespace st
