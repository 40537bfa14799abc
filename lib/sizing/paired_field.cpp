#include "sizing/paired_field.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/boxes.h"

namespace st {
namespace {

constexpr std::size_t kMostImages = 8;  // of a point, with itself: a corner of three pairs

}  // namespace

PairedField::PairedField(const SizeField& base, const std::vector<PairedRegion>& regions, double tolerance)
    : base_(base), tolerance_(tolerance) {
  for (const PairedRegion& r : regions) {
    ways_.push_back({r.a, r.motion});
    ways_.push_back({r.b, r.motion.inverse()});
  }
}

LocalSize PairedField::local_on(Vec3 xyz, Vec3 normal, int& hint) const {
  struct Image {
    Vec3 x;
    Similarity motion;  // from xyz
  };
  LocalSize least = base_.local_on(xyz, normal, hint);
  std::array<Image, kMostImages> images;
  images[0].x = xyz;
  std::size_t n = 1;
  for (std::size_t i = 0; i < n; ++i)
    for (const Way& way : ways_) {
      if (n == kMostImages || !contains(way.box, images[i].x, tolerance_)) continue;
      const Image image{way.motion(images[i].x), images[i].motion.then(way.motion)};
      if (std::any_of(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(n),
                      [&](const Image& other) { return distance(other.x, image.x) <= tolerance_; }))
        continue;
      images[n++] = image;
      int away = 0;
      const LocalSize there = base_.local_on(image.x, image.motion.rotated(normal), away);
      if (there.length < least.length || (there.length == least.length && there.along < least.along))
        least = {there.length, there.along, image.motion.inverse().rotated(there.direction)};
    }
  return least;
}

}  // namespace st
