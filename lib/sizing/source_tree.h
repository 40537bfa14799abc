// All sources of a size specification together: the smallest of what they ask for, found by a search tree.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/box_tree.h"
#include "base/ids.h"
#include "sizing/source.h"

namespace st {

/// The few sources that count somewhere, as one number: a set of at most kMost, or that there are more.
class FewSources {
 public:
  static constexpr int kMost = 5;  ///< of small ids; of others kMostWide

  FewSources() = default;  ///< not known
  /// `n` of them. More than fit, or ids from 2^20 on: many.
  FewSources(const std::int32_t* source, std::size_t n);
  static FewSources from_bits(std::uint64_t bits) {
    FewSources few;
    few.bits_ = bits;
    return few;
  }
  std::uint64_t bits() const { return bits_; }

  bool is_known() const { return bits_ != 0; }
  bool are_none() const { return bits_ == 1; }
  bool are_many() const { return bits_ == kMost + 2; }
  /// Precondition: known, not many.
  int n() const { return static_cast<int>(bits_ & 7) - 1; }
  std::int32_t operator[](int i) const {
    const int bits = (bits_ & kWide) != 0 ? kWideBits : kBits;
    return static_cast<std::int32_t>(bits_ >> (4 + bits * i)) & ((1 << bits) - 1);
  }

 private:
  static constexpr int kBits = 12, kWideBits = 20, kMostWide = 3;  // of an id
  static constexpr std::uint64_t kWide = 8;
  std::uint64_t bits_ = 0;  // 1 + their number in the lowest three, whether ids are wide, then the ids
};

/// Sources and background meshes, each with the cause that its lengths get (pack_cause). Immutable.
class SourceTree {
 public:
  struct Entry {
    std::unique_ptr<SizeSource> source;
    std::int32_t cause = kNone;
  };
  explicit SourceTree(std::vector<Entry> entries);

  const Entry& entry(std::int32_t i) const { return entries_[i]; }

  /// The smallest of `upper` and of what the sources ask for at x. `winner` (may be null) becomes the one that asks for
  /// less, the first of equal ones; kNone: none.
  double size_below(Vec3 x, double upper, std::int32_t* winner = nullptr) const;
  /// Likewise, of those of `near` alone.
  double size_below(Vec3 x, double upper, FewSources near) const {
    if (near.are_many()) return size_below(x, upper);
    for (int i = 0; i < near.n(); ++i) upper = entries_[near[i]].source->size_below(x, upper);
    return upper;
  }
  double size_below(Vec3 x, double upper, FewSources near, std::int32_t& winner) const {
    if (near.are_many()) return size_below(x, upper, &winner);
    winner = kNone;
    for (int i = 0; i < near.n(); ++i)
      if (const double length = entries_[near[i]].source->size_below(x, upper); length < upper) {
        upper = length;
        winner = near[i];
      }
    return upper;
  }
  /// As size_below, of what is requested in each direction: the smallest length; along its direction, where it is
  /// stretched, no more than any source and `upper` allow.
  LocalSize local_below(Vec3 x, const LocalSize& upper) const;
  /// Likewise in the plane with this unit normal: the intersection of `upper` and of what any source asks for there.
  LocalSize local_on_below(Vec3 x, Vec3 normal, const LocalSize& upper) const;
  /// A bound: no source asks for less than it, or `upper`, within `radius` of x.
  double least_near(Vec3 x, double radius, double upper) const;
  /// Those that may ask for less than `upper`, and than all others, within `radius` of x.
  FewSources find_near(Vec3 x, double radius, double upper) const;
  /// Whether a source asks for no more than `length` at x.
  bool tells(Vec3 x, double length) const;
  /// The gradient of a source's lengths at x.
  Vec3 gradient(std::int32_t source, Vec3 x) const;
  /// The place from which a source's length at x grows: down its gradient to its smallest length.
  Vec3 origin(std::int32_t source, Vec3 x) const;
  double min_size() const { return min_size_; }
  double max_aspect() const { return max_aspect_; }
  bool has_metrics() const { return has_metrics_; }
  /// Of the steepest source.
  double slope() const { return slope_; }

 private:
  /// Whether a source below a node of the tree may ask for `best` or less at a squared distance from its box.
  bool reaches(std::int32_t node, double distance2, double best) const;

  std::vector<Entry> entries_;
  BoxTree tree_;
  std::vector<SourceSpacing> least_;  // [nodes of the tree] smallest length, largest radius, slowest growth below
  double slope_ = 0, min_size_ = 0, max_aspect_ = 1;
  bool has_metrics_ = false;
};

}  // namespace st
