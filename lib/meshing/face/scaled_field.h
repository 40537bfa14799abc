// A size field with all lengths longer by one factor.
#pragma once

#include "sizing/size_field.h"

namespace st {

/// Longer lengths everywhere.
class ScaledField final : public SizeField {
 public:
  ScaledField(const SizeField& field, double scale) : field_(field), scale_(scale) {}
  double size(Vec3 x, int& hint) const override { return scale_ * field_.size(x, hint); }
  LocalSize local(Vec3 x, int& hint) const override { return local_on(x, {}, hint); }
  LocalSize local_on(Vec3 x, Vec3 normal, int& hint) const override {
    const LocalSize s = field_.local_on(x, normal, hint);
    return {scale_ * s.length, scale_ * s.along, s.direction};
  }
  bool has_metrics() const override { return field_.has_metrics(); }
  bool is_stretched() const override { return field_.is_stretched(); }
  double min_size() const override { return scale_ * field_.min_size(); }
  double slope() const override { return scale_ * field_.slope(); }

 private:
  const SizeField& field_;
  double scale_;
};

}  // namespace st
