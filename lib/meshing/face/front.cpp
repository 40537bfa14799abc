#include "meshing/face/front.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <queue>
#include <utility>

#include "base/predicates.h"
#include "meshing/face/front_places.h"
#include "meshing/face/row_blocks.h"
#include "meshing/face/stretch.h"

namespace st {
namespace {

constexpr int kNext[3] = {1, 2, 0};
constexpr int kPrev[3] = {2, 0, 1};

// Rules: docs/design/kernel.md; where each number comes from: docs/design/heuristics.md.
constexpr double kFinishedRadius = 0.68;       // circumradius over requested length; equilateral: 0.577
constexpr double kNearNode = 0.76;             // of the side: a new node nearer than this to another is not made
constexpr double kNearBoundary = 0.4;          // of the side: nor nearer than this to a boundary segment
constexpr double kObtuseAtRow = radians(130);  // no new node sees an edge of a laid row under a larger angle
constexpr double kVeryLong = 1.5;              // times the size: an edge so long is split even closer to other nodes
constexpr double kCloseSplit = 0.55;           // the distances kept then
constexpr double kTooLarge = 0.80;  // circumradius over requested length that is split when the front has ended

constexpr double kRowRadius = 0.9;  // circumradius over requested length where sizes are stretched; square: 0.707
constexpr double kRowAspect = 2.2;  // length along over across: less makes no rows

constexpr int kRingSamples = 8;      // chords that measure the way around a narrow part
constexpr double kNarrowRing = 2.6;  // of the size: with more room the front makes the ring itself

template <bool kStretched>
class Front {
 public:
  explicit Front(FaceWork& work) : w_(work), m_(work.mesh), places_(work) {}

  void run() {
    if constexpr (kStretched) ends_ = lay_row_blocks(w_);
    start();
    if constexpr (kStretched) lay_rows();
    ring_narrow_parts();
    advance();
    split_large();
  }

 private:
  struct Entry {
    std::int32_t t, a, b;
  };

  double edge_length2(std::int32_t a, std::int32_t b) const { return w_.template edge_length2<kStretched>(a, b); }
  template <typename... Squares>
  double circumradius2(const PlaneTriangle& t, Squares... of_edges) const {
    return w_.template circumradius2<kStretched>(t, of_edges...);
  }

  /// Square of the circumradius below which a triangle may be finished.
  double finished_radius2(const PlaneTriangle& t) const {
    const double h = (m_.nodes[t.v[0]].h + m_.nodes[t.v[1]].h + m_.nodes[t.v[2]].h) / 3;
    const double finished = finished_radius(t) * h;
    return finished * finished;
  }
  bool is_finished(const PlaneTriangle& t, double radius2) const {
    return radius2 < finished_radius2(t) && !turns_where_large(t, radius2);
  }
  bool turns_where_large(const PlaneTriangle& t, double radius2) const {
    const double request = (m_.nodes[t.v[0]].request + m_.nodes[t.v[1]].request + m_.nodes[t.v[2]].request) / 3;
    const double least = kTurningFloor * kFinishedRadius * request;
    return radius2 > least * least && places_.turns_too_far(m_.nodes[t.v[0]], m_.nodes[t.v[1]], m_.nodes[t.v[2]]);
  }

  /// Larger where sizes are stretched: rows make right-angled triangles.
  double finished_radius(const PlaneTriangle& t) const {
    if constexpr (!kStretched) return kFinishedRadius;
    double squeeze2 = 0;
    for (const std::int32_t v : t.v) squeeze2 += norm2(m_.nodes[v].squeeze) / 3;
    return kFinishedRadius + (kRowRadius - kFinishedRadius) * std::clamp(4 * squeeze2 - 2, 0.0, 1.0);
  }

  static bool is_done(const PlaneTriangle& t) {
    return t.state == kFinished || t.state == kRetired || t.state == kLaid;
  }

  void start() {
    for (std::size_t i = 0; i < m_.triangles.size(); ++i)
      if (PlaneTriangle& t = m_.triangles[i]; t.state == kUnfinished)
        t.state = is_finished(t, circumradius2(t)) ? kFinished : kUnfinished;
    for (std::size_t i = 0; i < m_.triangles.size(); ++i)
      if (m_.triangles[i].state == kUnfinished) push_front_edges(static_cast<std::int32_t>(i));
    std::stable_sort(queue_.begin(), queue_.end(), [](const Entry& e, const Entry& f) { return e.a < f.a; });
  }

  /// Where a face closes on itself at a seam with little room, as at the tip of a cone or along a needle: rings of
  /// three nodes, which no size asks for. With fewer the part would close to nothing at any size.
  void ring_narrow_parts() {
    for (const auto& [a, b] : seam_twins()) {
      const MeshNode na = m_.nodes[a], nb = m_.nodes[b];
      const auto at = [&](double share) {
        MeshNode p;
        p.p = na.p + share * (nb.p - na.p);
        w_.evaluate(p);
        return p;
      };
      double length = 0;
      Vec3 last = na.x;
      for (int i = 1; i <= kRingSamples; ++i) {
        const Vec3 x = at(static_cast<double>(i) / kRingSamples).x;
        length += distance(last, x);
        last = x;
      }
      if (length >= kNarrowRing * na.h) continue;
      for (const double share : {1.0 / 3, 2.0 / 3}) {
        MeshNode p = at(share);
        w_.ask_sizes(p);
        p.is_kept = true;
        insert(p, inside_triangle_at(a), length / 3, na.h) || insert(p, inside_triangle_at(b), length / 3, na.h);
      }
    }
  }

  /// A triangle of the face at a boundary node, where a search may start: it does not leave the loops.
  std::int32_t inside_triangle_at(std::int32_t node) const {
    const std::int32_t first = m_.triangle_at(node);
    std::int32_t t = first;
    do {
      const PlaneTriangle& r = m_.triangles[t];
      if (r.state != kOutside) return t;
      t = r.n[kPrev[r.v[0] == node ? 0 : r.v[1] == node ? 1 : 2]];
    } while (t != first && t != kNone);
    return first;
  }

  /// Pairs of plane nodes that are one node of a seam, by its id.
  std::vector<std::pair<std::int32_t, std::int32_t>> seam_twins() const {
    std::vector<std::pair<std::int32_t, std::int32_t>> by_id, twins;
    for (std::int32_t i = 0; i < m_.n_boundary; ++i)
      if (!m_.nodes[i].is_pole) by_id.push_back({m_.nodes[i].id, i});
    std::sort(by_id.begin(), by_id.end());
    const auto same = [&](std::size_t i, std::size_t j) {
      return j < by_id.size() && by_id[i].first == by_id[j].first;
    };
    for (std::size_t i = 0; i + 1 < by_id.size(); ++i)
      if (same(i, i + 1) && !same(i, i + 2) && !(i > 0 && same(i - 1, i)))
        twins.push_back({by_id[i].second, by_id[i + 1].second});
    return twins;
  }

  /// Edges of an unfinished triangle that border on something finished, or on the boundary.
  void push_front_edges(std::int32_t t) {
    const PlaneTriangle& r = m_.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const bool boundary = r.constrained >> k & 1;
      if (boundary || (r.n[k] != kNone && is_done(m_.triangles[r.n[k]]))) queue_.push_back({t, r.v[k], r.v[kNext[k]]});
    }
  }

  void advance() {
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      if (head > 4096 && head * 2 > queue_.size()) {
        queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(head));
        head = 0;
      }
      const Entry e = queue_[head];
      const PlaneTriangle& r = m_.triangles[e.t];
      if (r.state != kUnfinished) continue;
      int k = 0;
      while (k < 3 && !(r.v[k] == e.a && r.v[kNext[k]] == e.b)) ++k;
      if (k == 3) continue;
      if (are_one_pole(m_.nodes[e.a], m_.nodes[e.b])) continue;
      if (!place(e.t, e.a, e.b)) retire(e.t);
    }
    queue_.clear();
  }

  void retire(std::int32_t t) {
    m_.triangles[t].state = kRetired;
    const PlaneTriangle r = m_.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t o = r.n[k];
      if ((r.constrained >> k & 1) || o == kNone || m_.triangles[o].state != kUnfinished) continue;
      queue_.push_back({o, r.v[kNext[k]], r.v[k]});
    }
  }

  /// Where sizes are stretched, nodes in rows: from each node of a row one across, on both sides, and where none is
  /// left one along it, the finest first. Rows begin at the edges that lie along the direction, and meet nodes of the
  /// loops elsewhere; the triangles between them are right-angled in space. Rows end where sizes are about equal again.
  void lay_rows() {
    for (const auto& [a, b] : w_.segments) seed_rows(a, b);
    for (const auto& [a, b] : ends_) seed_rows(a, b);
    while (!across_.empty() || !along_.empty()) {
      const bool is_across = !across_.empty();
      const std::int32_t node = is_across ? across_.front() : -along_.top().second;
      if (is_across) {
        across_.pop_front();
      } else {
        along_.pop();
      }
      if (is_surrounded(node)) continue;
      for (const double sign : {1.0, -1.0}) step_from(node, is_across, sign);
    }
  }

  /// The ends of a boundary segment: first rows along it if it lies so.
  void seed_rows(std::int32_t a, std::int32_t b) {
    constexpr double kAligned = 0.7;  // cosine
    const Vec3 d = normalized(m_.nodes[b].x - m_.nodes[a].x);
    for (const std::int32_t n : {a, b}) {
      const MeshNode& node = m_.nodes[n];
      if (node.is_pole || aspect_of(node) < kRowAspect) continue;
      if (std::abs(dot(d, node.squeeze)) > kAligned * norm(node.squeeze)) across_.push_back(n);
      along_.push({-node.h, -n});
    }
  }

  /// By what is outside, and by laid rows: nothing can be placed from it.
  bool is_surrounded(std::int32_t node) const {
    bool is_free = false;
    return m_.visit_ring(node, [&](std::int32_t, std::int32_t t) {
      is_free |= m_.triangles[t].state != kOutside && m_.triangles[t].state != kLaid;
    }) && !is_free;
  }

  void step_from(std::int32_t from, bool is_across, double sign) {
    const MeshNode a = m_.nodes[from];
    const Vec3 t = normalized(a.squeeze), across = cross(a.normal, t);
    double length = a.h;
    MeshNode p;
    if (!places_.of_row(a, is_across ? sign * across : sign * aspect_of(a) * t, is_across ? t : across, length, p))
      return;
    const std::int32_t start = m_.triangle_towards(from, p.p);
    if (start == kNone || !insert(p, start, length, kGrowth * a.h)) return;
    if (aspect_of(p) < kRowAspect) return;
    const auto added = static_cast<std::int32_t>(m_.nodes.size()) - 1;
    across_.push_back(added);
    along_.push({-p.h, -added});
  }

  bool place(std::int32_t t, std::int32_t ia, std::int32_t ib) {
    const MeshNode &a = m_.nodes[ia], &b = m_.nodes[ib];
    const double base = places_.edge_in_space(a, b);
    MeshNode p;
    double r = 0;
    if (!(base > 0) || !places_.of_side(a, b, r, p)) return false;
    return insert(p, t, r, kGrowth * std::max(base, 0.5 * (a.h + b.h)));
  }

  /// Inserts p unless it is hidden, or too near to a node or a boundary segment.
  bool insert(MeshNode& p, std::int32_t start, double r, double largest) {
    if (w_.is_runaway() || !std::isfinite(norm2(p.x) + norm(p.p))) return false;
    const std::int32_t at = m_.locate(p.p, start);
    if (at == kNone || m_.triangles[at].state == kOutside || m_.triangles[at].state == kLaid) return false;
    const Metric metric = metric_of<kStretched>(p);
    for (const std::int32_t v : m_.triangles[at].v)  // most crowded places show here, before the cavity is looked for
      if (is_near(p, m_.nodes[v], metric, r)) return false;
    if (!m_.find_cavity(p.p, metric, at)) return false;
    if (is_crowded(p, metric, r)) return false;
    p.h = std::min(p.h, largest);
    m_.nodes.push_back(p);
    m_.added_node();
    m_.fill_cavity(static_cast<std::int32_t>(m_.nodes.size()) - 1);
    fan_ = m_.new_triangles();
    finish_fan();
    for (std::int32_t t : fan_) {
      const PlaneTriangle& f = m_.triangles[t];
      if (f.state == kUnfinished) {
        push_front_edges(t);
      } else if (!(f.constrained & 1) && f.n[0] != kNone && m_.triangles[f.n[0]].state == kUnfinished) {
        queue_.push_back({f.n[0], f.v[1], f.v[0]});
      }
    }
    return true;
  }

  /// Sets the states of the triangles about the last node. Each has it as its third corner, and begins on the rim where
  /// the one before ends: the edges to the node are measured once. A circle is at least as wide as each edge is long:
  /// most triangles that are not finished show by these edges.
  void finish_fan() {
    const std::int32_t node = static_cast<std::int32_t>(m_.nodes.size()) - 1;
    const double first2 = edge_length2(m_.triangles[fan_.front()].v[0], node);
    double from2 = first2;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      PlaneTriangle& t = m_.triangles[fan_[i]];
      const double to2 = i + 1 == fan_.size() ? first2 : edge_length2(t.v[1], node);
      const double largest2 = finished_radius2(t);
      t.state = kUnfinished;
      if (to2 < 4 * largest2 && from2 < 4 * largest2) {
        const double radius2 = circumradius2(t, edge_length2(t.v[0], t.v[1]), to2, from2);
        if (radius2 < largest2 && !turns_where_large(t, radius2)) t.state = kFinished;
      }
      from2 = to2;
    }
  }

  static bool is_near(const MeshNode& p, const MeshNode& node, const Metric& metric, double r) {
    const double near2 = kNearNode * kNearNode * r * r;
    return mean_length2<kStretched>(node.x - p.x, p, node) < near2 &&
           (node.is_pole || metric.length2(node.p - p.p) < 4 * near2);
  }

  bool is_crowded(const MeshNode& p, const Metric& metric, double r) const {
    for (const Triangulation::RingEdge& e : m_.ring()) {
      const MeshNode &a = m_.nodes[e.a], &b = m_.nodes[e.b];
      if (is_near(p, a, metric, r)) return true;
      if (!e.constrained || are_one_pole(a, b)) continue;
      if (distance_to(p, a, b) < kNearBoundary * r && plane_near(p, metric, a, b, 2 * kNearBoundary * r)) return true;
      const bool is_laid = e.outer != kNone && m_.triangles[e.outer].state == kLaid;
      if (is_laid && angle_between(a.x - p.x, b.x - p.x) > kObtuseAtRow) return true;
    }
    return false;
  }

  static double distance_to(const MeshNode& p, const MeshNode& a, const MeshNode& b) {
    if (!is_stretched(p)) return segment_distance(p.x, a.x, b.x);
    return segment_distance({}, squeezed(a.x - p.x, p.squeeze), squeezed(b.x - p.x, p.squeeze));
  }

  static bool plane_near(const MeshNode& p, const Metric& m, const MeshNode& a, const MeshNode& b, double reach) {
    const Vec2 d = b.p - a.p, q = p.p - a.p;
    const double l2 = m.length2(d);
    const double along = m.e * d.x * q.x + m.f * (d.x * q.y + d.y * q.x) + m.g * d.y * q.y;
    const double s = l2 > 0 ? std::clamp(along / l2, 0.0, 1.0) : 0.0;
    return m.length2(q - s * d) < reach * reach;
  }

  /// Triangles that the front left too large: a node at the middle of the longest edge, or the centre, until none is
  /// left.
  void split_large() {
    for (int round = 0; round < 12; ++round) {
      bool changed = false;
      const std::size_t n = m_.triangles.size();
      for (std::size_t i = 0; i < n; ++i) {
        const PlaneTriangle t = m_.triangles[i];
        if (t.state != kUnfinished && t.state != kRetired) continue;
        const double h = (m_.nodes[t.v[0]].h + m_.nodes[t.v[1]].h + m_.nodes[t.v[2]].h) / 3, too_large = kTooLarge * h;
        if (circumradius2(t) < too_large * too_large) continue;
        changed |= split(static_cast<std::int32_t>(i), t, h);
      }
      advance();
      if (!changed) return;
    }
  }

  bool split(std::int32_t i, const PlaneTriangle& t, double h) {
    int longest = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k)
      if (const double l = std::sqrt(edge_length2(t.v[k], t.v[kNext[k]])); l > length) {
        length = l;
        longest = k;
      }
    if (length < 1.3 * h) return false;
    const Vec2 a = m_.nodes[t.v[0]].p, b = m_.nodes[t.v[1]].p, c = m_.nodes[t.v[2]].p;
    const bool boundary = t.constrained >> longest & 1;
    const Vec2 middle = 0.5 * (m_.nodes[t.v[longest]].p + m_.nodes[t.v[kNext[longest]]].p);
    const Vec2 centre = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
    const double r = std::min(h, length / 2 / kNearNode * 0.99);
    for (double closeness : {1.0, kCloseSplit})
      for (int attempt = boundary ? 1 : 0; attempt < 2; ++attempt) {
        if (closeness < 1 && length < kVeryLong * h) continue;
        MeshNode p;
        p.p = attempt == 0 ? middle : centre;
        w_.evaluate(p);
        w_.ask_sizes(p);
        if (insert(p, i, closeness * r, kGrowth * h)) return true;
      }
    return false;
  }

  FaceWork& w_;
  Triangulation& m_;
  FrontPlaces<kStretched> places_;
  std::vector<Entry> queue_;
  std::deque<std::int32_t> across_;                             // nodes from which rows go on
  std::priority_queue<std::pair<double, std::int32_t>> along_;  // minus size, minus node: the finest first
  std::vector<std::int32_t> fan_;
  std::vector<std::pair<std::int32_t, std::int32_t>> ends_;  // of laid rows
};

}  // namespace

void advance_front(FaceWork& work) { work.field->is_stretched() ? Front<true>(work).run() : Front<false>(work).run(); }

}  // namespace st
