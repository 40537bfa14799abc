#include <algorithm>
#include <cmath>
#include <utility>

#include "base/predicates.h"
#include "geometry/shape/surface_forms.h"
#include "meshing/face/flaw_mending.h"
#include "meshing/face/front.h"
#include "meshing/face/swap_quad.h"
#include "meshing/face/triangle_shape.h"

namespace st {
namespace {

/// i + 1, around a ring of n.
std::size_t following(std::size_t i, std::size_t n) { return i + 1 == n ? 0 : i + 1; }

constexpr int kNext[3] = {1, 2, 0};
constexpr int kPrev[3] = {2, 0, 1};
constexpr double kGoodQuality = 0.995;  // nodes whose triangles are all better stay where they are
constexpr double kShortEdge = 0.55;     // of the requested length: collapsed where that does no harm
constexpr double kLongEdge = 1.45;      // of the requested length: no collapse makes such an edge
constexpr float kNoTriangle = 2;        // quality of what is outside or gone
constexpr double kHalfSqrt3 = 0.8660254037844386;
constexpr double kWeightBase = 1.3;  // minus a triangle's quality: its weight in the smoothing
constexpr double kStill = 0.02;      // of the requested length: a shorter move wakes no neighbours
constexpr double kSwapGain = 1e-3;
constexpr double kSwapBelow = 0.9;    // pairs of triangles that are both better are left alone
constexpr double kRelaxLeast = 0.55;  // no triangle worse than this is made for the sake of the valence

template <bool kStretched>
class Enhancer {
 public:
  explicit Enhancer(FaceWork& work) : w_(work), m_(work.mesh) {}

  void run(int rounds) {
    start();
    swap_sweeps();
    for (int round = 0; round < rounds; ++round) {
      if (round < 2) collapse_sweep();
      if (round < 2) relax_sweep();
      smooth_sweep();
      swap_sweeps();
    }
  }

 private:
  using Shape = TriangleShape<kStretched>;

  void start() {
    changed_.assign(m_.triangles.size(), 0);
    tried_.assign(m_.triangles.size(), 0);
    degree_.assign(m_.nodes.size(), 0);
    is_active_.assign(m_.nodes.size(), 1);
    for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
      m_.triangles[i].quality = kNoTriangle;
      if (!is_inside(m_.triangles[i])) continue;
      if (m_.triangles[i].state != kLaid) update(static_cast<std::int32_t>(i));
      for (std::int32_t v : m_.triangles[i].v) ++degree_[v];
    }
  }

  void update(std::int32_t t) {
    const PlaneTriangle& r = m_.triangles[t];
    set_quality(t, static_cast<float>(quality(r.v[0], r.v[1], r.v[2])));
  }
  void set_quality(std::int32_t t, float quality) {
    m_.triangles[t].quality = quality;
    changed_[t] = clock_;
  }

  double edge_length(std::int32_t a, std::int32_t b) const {
    return std::sqrt(w_.template edge_length2<kStretched>(a, b));
  }
  bool is_inner(std::int32_t node) const { return node >= m_.n_boundary + 4; }

  double quality(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return Shape::quality(m_.nodes[a], m_.nodes[b], m_.nodes[c]);
  }

  bool is_inside(const PlaneTriangle& t) const { return t.state != kOutside && t.state != kDead; }

  void swap_sweeps() {
    for (int sweep = 0; sweep < 4; ++sweep) {
      std::size_t n_swaps = 0;
      for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
        if (m_.triangles[i].quality > kSwapBelow) continue;
        const std::uint32_t last = std::exchange(tried_[i], ++clock_);
        for (int k = 0; k < 3; ++k) {
          const std::int32_t other = m_.triangles[i].n[k];
          if (other == kNone || (changed_[i] < last && changed_[other] < last)) continue;  // as when it was tried last
          if (try_swap(static_cast<std::int32_t>(i), k)) ++n_swaps;
        }
      }
      if (n_swaps * 1000 < m_.triangles.size()) return;
    }
  }

  void swap(const SwapQuad& q, int k) {
    m_.swap(q.t, k);
    for (const std::int32_t n : {q.a, q.b, q.c, q.d}) is_active_[n] = 1;
    update(q.t);
    update(q.o);
    --degree_[q.a];
    --degree_[q.b];
    ++degree_[q.c];
    ++degree_[q.d];
  }

  bool try_swap(std::int32_t t, int k) {
    SwapQuad q;
    if (!quad_at(m_, t, k, q)) return false;
    const double before = std::min(m_.triangles[q.t].quality, m_.triangles[q.o].quality);
    const double after = std::min(quality(q.c, q.a, q.d), quality(q.c, q.d, q.b));
    if (after <= before + kSwapGain || !may_swap<kStretched>(w_, q, k)) return false;
    swap(q, k);
    return true;
  }

  /// Swaps towards six triangles about every inner node, where that costs little quality; smoothing earns it back (Frey
  /// and Field 1991).
  void relax_sweep() {
    for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
      if (!is_inside(m_.triangles[i])) continue;
      for (int k = 0; k < 3; ++k) try_relax(static_cast<std::int32_t>(i), k);
    }
  }

  void try_relax(std::int32_t t, int k) {
    const PlaneTriangle& r = m_.triangles[t];
    if (r.n[k] < t || degree_[r.v[k]] <= 5 || degree_[r.v[kNext[k]]] <= 5) return;  // each edge once
    SwapQuad q;
    if (!quad_at(m_, t, k, q)) return;
    if (!is_inner(q.a) || !is_inner(q.b) || !is_inner(q.c) || !is_inner(q.d)) return;
    if (degree_[q.a] + degree_[q.b] - degree_[q.c] - degree_[q.d] < 3) return;
    const double after = std::min(quality(q.c, q.a, q.d), quality(q.c, q.d, q.b));
    if (after < kRelaxLeast || !may_swap<kStretched>(w_, q, k)) return;
    swap(q, k);
  }

  void smooth_sweep() {
    const std::int32_t first = m_.n_boundary + 4, n = static_cast<std::int32_t>(m_.nodes.size());
    for (std::int32_t i = first; i < n; ++i) {
      if (!is_active_[i] || m_.triangle_at(i) == kNone || m_.nodes[i].is_laid) continue;
      is_active_[i] = 0;
      smooth(i);
    }
  }

  struct Ring {
    double worst = 2, mean = 0;  // quality
    /// Better than before at its worst, or on the mean where the worst stays fair.
    bool improves(const Ring& before) const {
      return worst > before.worst + 1e-4 || (worst > before.fair() && mean > before.mean + 1e-4);
    }
    double fair() const { return std::max(0.6, worst - 0.05); }
  };

  /// A node around one, and the triangle from it on counter-clockwise.
  struct RingNode {
    const MeshNode* node;
    std::int32_t id, triangle;
  };

  /// Sets ring_ to what is around a node, in place of ring_of(): false where the rim is in the way.
  bool find_ring(std::int32_t i, Ring& quality) {
    ring_.clear();
    const bool is_whole = m_.visit_ring(i, [&](std::int32_t id, std::int32_t t) {
      ring_.push_back({&m_.nodes[id], id, t});
      quality.worst = std::min<double>(quality.worst, m_.triangles[t].quality);
      quality.mean += m_.triangles[t].quality;
    });
    quality.mean /= static_cast<double>(ring_.size());
    return is_whole;
  }

  /// The ring about a moved node, its qualities in ring_quality_; left early where it cannot improve.
  Ring ring_about(const MeshNode& centre, const Ring& before) {
    Ring ring;
    ring_quality_.resize(ring_.size());
    const double least = std::min(before.worst + 1e-4, before.fair());
    const std::size_t n = ring_.size();
    const MeshNode* node = ring_[0].node;
    const typename Shape::Side first(centre, *node);
    typename Shape::Side spoke = first;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_last = i + 1 == n;
      const MeshNode& next = *ring_[is_last ? 0 : i + 1].node;
      const typename Shape::Side to_next = is_last ? first : typename Shape::Side(centre, next);
      const double q = Shape::quality(centre, *node, next, spoke, to_next);
      node = &next;
      spoke = to_next;
      ring.worst = std::min(ring.worst, q);
      if (q <= least) return ring;
      ring.mean += q;
      ring_quality_[i] = static_cast<float>(q);
    }
    ring.mean /= static_cast<double>(n);
    return ring;
  }

  /// Mean of the apexes that would make each triangle of the ring equilateral.
  Vec3 equilateral_place(const MeshNode& centre) const {
    Vec3 middle{}, edge{};
    double weights = 0;
    for (std::size_t j = 0; j < ring_.size(); ++j) {
      const Vec3 &b = ring_[j].node->x, &next = ring_[following(j, ring_.size())].node->x, e = next - b;
      const double weight = kWeightBase - m_.triangles[ring_[j].triangle].quality;
      middle += weight * (b + 0.5 * e);
      edge += weight * e;
      weights += weight;
    }
    return apex_of(centre, middle, edge) / weights;
  }

  void smooth(std::int32_t i) {
    Ring before;
    if (!find_ring(i, before) || before.worst > kGoodQuality) return;
    const MeshNode& old = m_.nodes[i];
    const Vec3 target = equilateral_place(old);
    const Metric metric = metric_of<kStretched>(old);
    const Eigen::Matrix2d form = symmetric(metric.e, metric.f, metric.g);
    for (double part : {1.0, 0.4}) {
      const auto step = solve(form, along_tangents(old.du, old.dv, part * (target - old.x)), 0);
      if (!step) return;
      MeshNode moved = old;
      moved.p = old.p + to_vec2(*step);
      if (!is_valid_at(moved.p)) continue;
      w_.evaluate(moved);
      if (ring_about(moved, before).improves(before)) {
        const bool is_far = norm2(moved.x - old.x) > kStill * kStill * old.h * old.h;
        m_.nodes[i] = moved;
        for (std::size_t j = 0; j < ring_.size(); ++j) set_quality(ring_[j].triangle, ring_quality_[j]);
        if (!is_far) return;
        is_active_[i] = 1;
        for (const RingNode& r : ring_) is_active_[r.id] = 1;
        return;
      }
    }
  }

  /// The third corner of an equilateral triangle over an edge, by the metric of the node. Linear.
  static Vec3 apex_of(const MeshNode& n, Vec3 middle, Vec3 edge) {
    if (!is_stretched(n)) return middle + kHalfSqrt3 * cross(n.normal, edge);
    return middle + unsqueezed(kHalfSqrt3 * cross(n.normal, squeezed(edge, n.squeeze)), n.squeeze);
  }

  bool is_valid_at(Vec2 p) const {
    const MeshNode* from = ring_.back().node;
    Vec2 way = from->p - p;
    for (const RingNode& r : ring_) {
      const Vec2 next = r.node->p - p;
      if (orient2d_between(way, next, from->p, r.node->p, p) <= 0) return false;
      from = r.node;
      way = next;
    }
    return true;
  }

  void collapse_sweep() {
    find_short_edges();
    const std::int32_t first = m_.n_boundary + 4, n = static_cast<std::int32_t>(m_.nodes.size());
    for (std::int32_t i = first; i < n; ++i)
      if ((at_short_edge_[i] || degree_[i] <= 4) && m_.triangle_at(i) != kNone && !m_.nodes[i].is_kept &&
          !m_.nodes[i].is_laid)
        try_collapse(i);
  }

  void find_short_edges() {
    at_short_edge_.assign(m_.nodes.size(), 0);
    for (std::size_t i = 0; i < m_.triangles.size(); ++i) {
      const PlaneTriangle& t = m_.triangles[i];
      if (!is_inside(t)) continue;
      for (int k = 0; k < 3; ++k) {
        if (is_pole_side(t.v[k], t.v[kNext[k]])) at_short_edge_[t.v[kPrev[k]]] = 1;
        if (t.n[k] > static_cast<std::int32_t>(i)) continue;  // each edge once
        const MeshNode &a = m_.nodes[t.v[k]], &b = m_.nodes[t.v[kNext[k]]];
        const double h = 0.5 * (a.h + b.h);
        if (mean_length2<kStretched>(a.x - b.x, a, b) <= kShortEdge * kShortEdge * h * h)
          at_short_edge_[t.v[k]] = at_short_edge_[t.v[kNext[k]]] = 1;
      }
    }
  }

  bool is_pole_side(std::int32_t a, std::int32_t b) const { return are_one_pole(m_.nodes[a], m_.nodes[b]); }

  void try_collapse(std::int32_t i) {
    if (!m_.ring_of(i, around_, tris_)) return;
    const MeshNode& node = m_.nodes[i];
    const int n = static_cast<int>(around_.size());
    int n_sides = 0;  // in space
    double before = 2;
    for (int k = 0; k < n; ++k) {
      if (is_pole_side(around_[k], around_[(k + 1) % n])) continue;
      ++n_sides;
      before = std::min<double>(before, m_.triangles[tris_[k]].quality);
    }
    double shortest = 1e300;
    for (std::int32_t j : around_)
      shortest = std::min(shortest, side_length(node, m_.nodes[j]) / (0.5 * (node.h + m_.nodes[j].h)));
    if (shortest > kShortEdge && n_sides > 4) return;
    int best = -1;
    double best_quality = n_sides <= 4 || shortest < 0.4 ? std::min(before, 0.35) : before;
    for (int c = 0; c < n; ++c) {
      const double q = collapsed_quality(c);
      if (q > best_quality) {
        best_quality = q;
        best = c;
      }
    }
    if (best < 0) return;
    --degree_[around_[(best + 1) % n]];
    --degree_[around_[(best + n - 1) % n]];
    degree_[around_[best]] += n - 4;
    for (const std::int32_t j : around_) is_active_[j] = 1;
    m_.collapse(i, best, around_, tris_);
    for (std::int32_t t : tris_)
      if (m_.triangles[t].state == kDead)
        set_quality(t, kNoTriangle);
      else
        update(t);
  }

  /// Worst quality after moving the node onto ring node c; -2 when invalid.
  double collapsed_quality(int c) const {
    const int n = static_cast<int>(around_.size());
    const MeshNode& target = m_.nodes[around_[c]];
    double worst = 2;
    for (int k = 0; k < n; ++k) {
      const int l = (k + 1) % n;
      if (k == c || l == c) continue;
      const MeshNode &a = m_.nodes[around_[k]], &b = m_.nodes[around_[l]];
      if (orient2d(target.p, a.p, b.p) <= 0) return -2;
      if (!is_pole_side(around_[k], around_[l])) worst = std::min(worst, Shape::quality(target, a, b));
    }
    // edges that appear: target to every ring node but its neighbours
    for (int k = 0; k < n; ++k) {
      if (k == c || k == (c + 1) % n || k == (c + n - 1) % n) continue;
      const MeshNode& a = m_.nodes[around_[k]];
      if (a.id != kNone && a.id == target.id) return -2;
      if (edge_length(around_[c], around_[k]) > kLongEdge * 0.5 * (a.h + target.h)) return -2;
    }
    return worst;
  }

  FaceWork& w_;
  Triangulation& m_;
  std::vector<float> ring_quality_;
  std::uint32_t clock_ = 0;                  // counts the triangles that swap_sweeps() has tried
  std::vector<std::uint32_t> changed_;       // when each triangle got its quality
  std::vector<std::uint32_t> tried_;         // when its sides were last tried
  std::vector<std::uint8_t> at_short_edge_;  // nodes that may be worth a collapse
  std::vector<std::uint8_t> is_active_;      // nodes to be smoothed: something about them changed
  std::vector<std::int32_t> degree_;         // triangles at each node
  std::vector<std::int32_t> around_, tris_;  // of a node that may collapse
  std::vector<RingNode> ring_;               // of a node that is smoothed
};

}  // namespace

void enhance(FaceWork& work, int rounds) {
  if (!work.field->is_stretched()) return Enhancer<false>(work).run(rounds);
  Enhancer<true>(work).run(rounds);
  mend_flaws(work);
}

}  // namespace st
