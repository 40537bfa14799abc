#include "sizing/sample_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/eigen.h"
#include "base/limits.h"

namespace st {
namespace {

/// Calls f(leaf, centre) for every leaf that comes within `reach` of x along each axis.
template <class F>
void visit_leaves(const OctreeView& octree, std::int32_t node, Vec3 middle, double half, Vec3 x, double reach,
                  const F& f) {
  const Vec3 d = x - middle;
  if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > half + reach) return;
  if (node < 0) return f(~node, middle);
  const double quarter = 0.5 * half;
  for (std::size_t o = 0; o < 8; ++o)
    visit_leaves(octree, octree.node_children[8 * static_cast<std::size_t>(node) + o],
                 {middle.x + (o & 1 ? quarter : -quarter), middle.y + (o & 2 ? quarter : -quarter),
                  middle.z + (o & 4 ? quarter : -quarter)},
                 quarter, x, reach, f);
}

/// Stores a length where it is less; equal ones take the smaller cause.
void lower(RasterOctree& octree, std::int32_t site, double value, std::int32_t from) {
  const auto length = static_cast<float>(value);
  float& stored = octree.stored_length[static_cast<std::size_t>(site)];
  std::int32_t& cause = octree.stored_cause[static_cast<std::size_t>(site)];
  if (length > stored || (length == stored && from >= cause)) return;
  stored = length;
  cause = from;
}

/// Whether a sample lies on the surface of this part of a split leaf; of both where its normal does not tell.
bool concerns(const LengthSample& s, const Blanking& blanking, std::int32_t split, bool is_second) {
  constexpr double kClear = 0.3;  // cosine between the normals of sample and split
  const float* n = blanking.split[static_cast<std::size_t>(split)].normal;
  const double along = blanking.flow_along_normals * dot(Vec3(s.normal), Vec3{n[0], n[1], n[2]});
  return is_second ? along < kClear : along > -kClear;
}

/// A sample in a cell.
struct CellSample {
  Vec3 d;            // from the centre
  double length;     // its own
  double requested;  // what is requested at its place: no more than its own
};

double length_at(const CellLength& cell, Vec3 d) {
  return cell.length + cell.gradient[0] * d.x + cell.gradient[1] * d.y + cell.gradient[2] * d.z;
}

/// Least-squares plane through what is requested at the samples. They lie on a surface or a line: in the directions
/// that they do not tell, the gradient stays as it is.
void fit_to_samples(std::span<const CellSample> samples, double edge, double slope, CellLength& cell) {
  constexpr double kStiffness = 0.02;  // of the gradient, against samples spread over the edge of the cell
  const Vec3 before{cell.gradient[0], cell.gradient[1], cell.gradient[2]};
  const double share = 1.0 / static_cast<double>(samples.size());
  Vec3 middle;
  double mean = 0, smallest = std::numeric_limits<double>::infinity();
  for (const CellSample& s : samples) {
    middle += share * s.d;
    mean += share * s.requested;
    smallest = std::min(smallest, s.requested);
  }
  Eigen::Matrix3d matrix = kStiffness * edge * edge * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const CellSample& s : samples) {
    const Eigen::Vector3d d = to_eigen(s.d - middle);
    matrix += share * d * d.transpose();
    right += share * (s.requested - mean - dot(before, s.d - middle)) * d;
  }
  Vec3 gradient = before + to_vec3(solve(matrix, right, 0).value_or(Eigen::Vector3d::Zero()));
  if (norm(gradient) > slope) gradient = slope * normalized(gradient);
  cell.length = static_cast<float>(std::max(smallest, mean - dot(gradient, middle)));
  cell.gradient[0] = static_cast<float>(gradient.x);
  cell.gradient[1] = static_cast<float>(gradient.y);
  cell.gradient[2] = static_cast<float>(gradient.z);
}

/// Lowers a cell to its samples: as a whole, or by its upper bound, whichever lowers it less at the samples.
void hold(std::span<const CellSample> samples, CellLength& cell) {
  double excess = 0, smallest = std::numeric_limits<double>::infinity(), cap = smallest;
  for (const CellSample& s : samples) {
    smallest = std::min(smallest, s.length);
    const double own = length_at(cell, s.d);
    if (!(own > s.length)) continue;
    excess = std::max(excess, own - s.length);
    cap = std::min(cap, s.length);
  }
  if (!(excess > 0)) return;
  double lowered_by_cap = 0;
  for (const CellSample& s : samples) lowered_by_cap += std::max(0.0, length_at(cell, s.d) - cap);
  if (cell.length - excess >= smallest && excess * static_cast<double>(samples.size()) < lowered_by_cap)
    cell.length -= static_cast<float>(excess);
  else  // a negative bound says that the cell has a second part
    cell.upper = std::copysign(std::min(std::abs(cell.upper), static_cast<float>(cap)), cell.upper);
}

/// Samples by the leaf in which they lie.
class SamplesByLeaf {
 public:
  SamplesByLeaf(const OctreeView& octree, std::span<const LengthSample> samples) : octree_(octree), samples_(samples) {
    require_countable(samples.size(), "samples of the raster");
    std::vector<std::int32_t> leaf_of;
    first_.assign(octree.leaf_keys.size() + 1, 0);
    for (const LengthSample& s : samples) {
      leaf_of.push_back(octree.find_leaf(morton::encode(octree.grid_point(s.xyz))));
      ++first_[static_cast<std::size_t>(leaf_of.back()) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    by_leaf_.resize(samples.size());
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < leaf_of.size(); ++i) by_leaf_[next[leaf_of[i]]++] = static_cast<std::int32_t>(i);
  }

  /// Calls f(sample, place from the leaf's centre and lengths) for the samples in a leaf.
  template <class F>
  void visit(std::int32_t leaf, const F& f) const {
    const Vec3 center = octree_.leaf_center(leaf);
    for (std::int32_t k = first_[leaf]; k < first_[leaf + 1]; ++k) {
      const LengthSample& s = samples_[by_leaf_[k]];
      f(s, CellSample{s.xyz - center, s.length, s.length});
    }
  }

 private:
  const OctreeView& octree_;
  std::span<const LengthSample> samples_;
  std::vector<std::int32_t> first_;    // [n_leaves+1] into by_leaf_
  std::vector<std::int32_t> by_leaf_;  // [n_samples]
};

/// Finds the sites that a sample asks something of, on its side of a surface.
template <class F>
class SiteVisitor {
 public:
  SiteVisitor(const OctreeView& octree, const Neighbours& neighbours, const Blanking& blanking, const F& f)
      : octree_(octree), neighbours_(neighbours), blanking_(blanking), f_(f) {}

  /// Its own, without those around.
  void visit_own(const LengthSample& s) const {
    const std::int32_t leaf = octree_.find_leaf(morton::encode(octree_.grid_point(s.xyz)));
    for_parts(s, leaf, [&](std::int32_t site) { f_(site, leaf); });
    if (blanking_.colour[leaf] == CellColour::kBlanked) visit_beside(s, leaf);
  }

  void visit(const LengthSample& s) const {
    const std::int32_t leaf = octree_.find_leaf(morton::encode(octree_.grid_point(s.xyz)));
    for_parts(s, leaf, [&](std::int32_t site) {
      f_(site, leaf_of(site));
      for_each_link(&blanking_, neighbours_, site, [&](std::int32_t other, const CellStep&) { visit_near(other, s); });
    });
    if (blanking_.colour[leaf] == CellColour::kBlanked) visit_beside(s, leaf);
  }

 private:
  std::int32_t leaf_of(std::int32_t site) const {
    return site < octree_.n_leaves() ? site : blanking_.split_leaf[site - octree_.n_leaves()];
  }
  /// The surface may bulge a little into what is blanked: lengths do not pass from there.
  void visit_beside(const LengthSample& s, std::int32_t blanked) const {
    neighbours_.for_each(blanked, [&](std::int32_t other, const CellStep&) {
      for_parts(s, other, [&](std::int32_t site) { f_(site, leaf_of(site)); });
    });
  }
  /// Calls g(site) for the parts of the leaf on whose surface the sample lies.
  template <class G>
  void for_parts(const LengthSample& s, std::int32_t leaf, const G& g) const {
    const std::int32_t k = blanking_.find_split(leaf);
    if (k == kNone || concerns(s, blanking_, k, false)) g(leaf);
    if (k != kNone && concerns(s, blanking_, k, true)) g(octree_.n_leaves() + k);
  }
  /// Where the leaf comes within one length along each axis.
  void visit_near(std::int32_t site, const LengthSample& s) const {
    const std::int32_t leaf = leaf_of(site);
    const Vec3 d = s.xyz - octree_.leaf_center(leaf);
    const double reach = 0.5 * octree_.cell_edge(octree_.leaf_levels[leaf]) + s.length;
    if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= reach) f_(site, leaf);
  }

  const OctreeView& octree_;
  const Neighbours& neighbours_;
  const Blanking& blanking_;
  const F& f_;
};

/// Fits the cells to the samples in and around them.
class SampleFit {
 public:
  SampleFit(const Neighbours& neighbours, std::span<const LengthSample> samples, double slope, const Blanking* blanking,
            const ProlongedLengths& lengths)
      : neighbours_(neighbours),
        octree_(neighbours.octree()),
        by_leaf_(octree_, samples),
        slope_(slope),
        blanking_(blanking),
        lengths_(lengths) {
    for (const auto* cells : {&lengths.cells, &lengths.second_cells})
      for (const CellLength& cell : *cells) centre_length_.push_back(cell.length);
  }

  void fit(std::int32_t site, CellLength& cell) {
    own_.clear();
    add_samples(site, [&](CellSample s) { own_.push_back(s); });
    if (own_.empty()) return;
    const std::int32_t leaf = leaf_of(site);
    const Vec3 c = octree_.leaf_center(leaf);
    const double edge = octree_.cell_edge(octree_.leaf_levels[leaf]);
    find_links(site);
    all_ = own_;
    for (const Link& link : links_)
      add_samples(link.site, [&](CellSample s) {
        s.d += link.center - c;
        if (std::max({std::abs(s.d.x), std::abs(s.d.y), std::abs(s.d.z)}) <= kReach * edge) all_.push_back(s);
      });
    for (CellSample& s : all_) {
      for (const CellSample& other : all_)
        s.requested = std::min(s.requested, other.length + slope_ * distance(s.d, other.d));
      for (const Link& link : links_)
        s.requested = std::min(s.requested, link.length + slope_ * distance(c + s.d, link.center));
    }
    fit_to_samples(all_, edge, slope_, cell);
    hold(own_, cell);
  }

 private:
  static constexpr double kReach = 0.75;  // of the edge, from the centre: samples around count, too

  /// A site to which lengths pass; a large one may come several times.
  struct Link {
    std::int32_t site;
    Vec3 center;
    float length;  // before
  };

  std::int32_t leaf_of(std::int32_t site) const {
    return site < octree_.n_leaves() ? site : blanking_->split_leaf[site - octree_.n_leaves()];
  }

  void find_links(std::int32_t site) {
    links_.clear();
    for_each_link(blanking_, neighbours_, site, [&](std::int32_t to, const CellStep&) {
      links_.push_back({to, octree_.leaf_center(leaf_of(to)), centre_length_[to]});
    });
  }

  /// Calls add(sample) for the samples on the surface of this site.
  template <class Add>
  void add_samples(std::int32_t site, const Add& add) const {
    const std::int32_t leaf = leaf_of(site);
    const bool is_split = lengths_.cells[leaf].upper < 0, is_second = site >= octree_.n_leaves();
    const std::int32_t k = is_split ? blanking_->find_split(leaf) : kNone;
    by_leaf_.visit(leaf, [&](const LengthSample& s, const CellSample& in_cell) {
      if (!is_split || concerns(s, *blanking_, k, is_second)) add(in_cell);
    });
  }

  const Neighbours& neighbours_;
  const OctreeView& octree_;
  const SamplesByLeaf by_leaf_;
  const double slope_;
  const Blanking* const blanking_;
  const ProlongedLengths& lengths_;
  std::vector<float> centre_length_;  // [n_sites] before
  std::vector<CellSample> own_, all_;
  std::vector<Link> links_;
};

/// Of its rectangle, a little inside.
std::array<Vec3, 4> corners_of(const LengthSample& s) {
  constexpr double kInside = 0.9;
  const Vec3 u = kInside * Vec3{s.reach.u[0], s.reach.u[1], s.reach.u[2]},
             v = kInside * Vec3{s.reach.v[0], s.reach.v[1], s.reach.v[2]};
  return {s.xyz + u + v, s.xyz + u - v, s.xyz - u + v, s.xyz - u - v};
}

}  // namespace

Vec3 origin_of_places(const Box3& model) {
  constexpr double kFar = 16;  // largest sides of the box: there the steps are 1e-6 sides
  if (model.is_empty()) return {};
  const Vec3 side = model.hi - model.lo;
  double farthest = 0;
  for (const Vec3 x : {model.lo, model.hi})
    farthest = std::max({farthest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  return farthest > kFar * std::max({side.x, side.y, side.z}) ? model.center() : Vec3{};
}

std::vector<LengthSample> sorted_samples(std::span<const RasterBox> boxes, Vec3 origin) {
  std::vector<LengthSample> samples;
  samples.reserve(boxes.size());
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  for (const RasterBox& b : boxes) {
    const Vec3 x = b.center - origin;
    samples.push_back(
        {origin + Vec3{rounded(x.x), rounded(x.y), rounded(x.z)}, b.length, b.cause, b.normal, b.stretch, b.reach});
  }
  const auto key = [](const LengthSample& s) {
    return std::tuple(s.cause, s.xyz.x, s.xyz.y, s.xyz.z, s.length, s.stretch.along, s.reach.u[0], s.reach.u[1],
                      s.reach.u[2], s.reach.v[0], s.reach.v[1], s.reach.v[2]);
  };
  std::sort(samples.begin(), samples.end(),
            [&](const LengthSample& a, const LengthSample& b) { return key(a) < key(b); });
  return samples;
}

void forget_samples(RasterOctree& octree) {
  for (std::size_t leaf = 0; leaf < octree.stored_cause.size(); ++leaf) {
    std::int32_t& cause = octree.stored_cause[leaf];
    if (cause == kNone || (cause_kind(cause) != CauseKind::kEdge && cause_kind(cause) != CauseKind::kFace)) continue;
    octree.stored_length[leaf] = std::numeric_limits<float>::infinity();
    cause = kNone;
  }
}

void seed_lengths(std::span<const LengthSample> samples, double slope, RasterOctree& octree) {
  const OctreeView view = octree.shape.view();
  const double half = 0.5 * view.edge;
  for (const LengthSample& s : samples) {
    const Vec3 x = s.xyz;
    const auto seed = [&](std::int32_t leaf, Vec3 center) {
      lower(octree, leaf, s.length + slope * distance(x, center), s.cause);
    };
    visit_leaves(view, view.node_children.empty() ? ~0 : 0, view.lo + Vec3{half, half, half}, half, x, s.length, seed);
  }
}

void seed_lengths(std::span<const LengthSample> samples, double slope, const Blanking& blanking,
                  const Neighbours& neighbours, RasterOctree& octree) {
  const OctreeView view = octree.shape.view();
  for (const LengthSample& s : samples) {
    const auto seed = [&](std::int32_t site, std::int32_t leaf) {
      lower(octree, site, s.length + slope * distance(s.xyz, view.leaf_center(leaf)), s.cause);
    };
    SiteVisitor(view, neighbours, blanking, seed).visit(s);
  }
}

void for_each_seed(const Neighbours& neighbours, std::span<const LengthSample> samples, const Blanking* blanking,
                   const std::function<void(std::int32_t, std::int32_t)>& f) {
  const OctreeView& octree = neighbours.octree();
  const double half = 0.5 * octree.edge;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const LengthSample& s = samples[i];
    const auto own = [&](std::int32_t site, auto) { f(site, static_cast<std::int32_t>(i)); };
    if (blanking)
      SiteVisitor(octree, neighbours, *blanking, own).visit(s);
    else
      visit_leaves(octree, octree.node_children.empty() ? ~0 : 0, octree.lo + Vec3{half, half, half}, half, s.xyz,
                   s.length, own);
  }
}

void for_each_own_site(const Neighbours& neighbours, std::span<const LengthSample> samples, const Blanking* blanking,
                       const std::function<void(std::int32_t, std::int32_t)>& f) {
  const OctreeView& octree = neighbours.octree();
  const auto leaf_at = [&](Vec3 x) { return octree.find_leaf(morton::encode(octree.grid_point(x))); };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto own = [&](std::int32_t site, auto) { f(site, static_cast<std::int32_t>(i)); };
    const auto visit = [&](const LengthSample& s, std::int32_t leaf) {
      if (blanking)
        SiteVisitor(octree, neighbours, *blanking, own).visit_own(s);
      else
        own(leaf, 0);
    };
    const std::int32_t leaf = leaf_at(samples[i].xyz);
    visit(samples[i], leaf);
    if (samples[i].reach == SampleReach{}) continue;
    for (const Vec3 corner : corners_of(samples[i]))
      if (const std::int32_t other = leaf_at(corner); other != leaf) {
        LengthSample moved = samples[i];
        moved.xyz = corner;
        visit(moved, other);
      }
  }
}

void fit_samples(const Neighbours& neighbours, std::span<const LengthSample> samples, double slope,
                 const Blanking* blanking, ProlongedLengths& lengths) {
  if (samples.empty()) return;
  SampleFit fit(neighbours, samples, slope, blanking, lengths);
  const std::int32_t n = neighbours.octree().n_leaves();
  for (std::int32_t leaf = 0; leaf < n; ++leaf) fit.fit(leaf, lengths.cells[leaf]);
  for (std::size_t k = 0; k < lengths.second_cells.size(); ++k)
    fit.fit(n + static_cast<std::int32_t>(k), lengths.second_cells[k]);
}

}  // namespace st
