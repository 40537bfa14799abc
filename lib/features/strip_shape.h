// What makes a strip, for edges and for what goes on as one.
#pragma once

#include <vector>

#include "features/strip.h"
#include "geometry/shape/curve.h"

namespace st {

/// [n_edges] how often each edge is used by coedges of any face.
std::vector<int> count_uses(const ModelTables& t);
/// Whether two edges, or what goes on as one, are the sides of a strip: `ends` are all others of its loop together.
bool are_long_sides(double longer, double shorter, double ends);
/// Four times as long as the face is wide on average.
bool is_narrow(double area, double side);

/// Ways from one curve to another, which runs against it or not; closely enough to follow the turns of a helix. Local.
std::vector<Strip::Station> stations_between(const Curve& from, const Curve& to, bool is_opposed);

}  // namespace st
