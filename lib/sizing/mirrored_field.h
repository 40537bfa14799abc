// Lengths of a symmetric mesh: those of a point and of its image count for both.
#pragma once

#include <algorithm>

#include "geometry/model/mirror.h"
#include "sizing/size_field.h"

namespace st {

/// The smaller of what `field` asks for at a point and at its image. Costs two queries.
class MirroredField : public SizeField {
 public:
  /// Both outlive the object.
  MirroredField(const SizeField& field, const Mirror& mirror) : field_(field), mirror_(mirror) {}

  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override {
    return std::min(field_.size(xyz, hint), field_.size(mirror_.image_of(xyz)));
  }
  LocalSize local(Vec3 xyz, int& hint) const override { return local_on(xyz, {}, hint); }
  LocalSize local_on(Vec3 xyz, Vec3 normal, int& hint) const override {
    int other_hint = 0;
    const LocalSize here = field_.local_on(xyz, normal, hint);
    LocalSize there = field_.local_on(mirror_.image_of(xyz), mirror_.image_of_direction(normal), other_hint);
    if (here.length < there.length || (here.length == there.length && here.along <= there.along)) return here;
    there.direction = mirror_.image_of_direction(there.direction);
    return there;
  }
  bool has_metrics() const override { return field_.has_metrics(); }
  bool is_stretched() const override { return field_.is_stretched(); }
  double min_size() const override { return field_.min_size(); }
  double slope() const override { return field_.slope(); }

 private:
  const SizeField& field_;
  const Mirror& mirror_;
};

}  // namespace st
