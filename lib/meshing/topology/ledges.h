// Ledges around holes and pins that are much narrower than the sizes.
#pragma once

#include <span>
#include <vector>

#include "features/strip.h"
#include "geometry/model/model.h"
#include "meshing/topology/small_features.h"
#include "sizing/size_field.h"

namespace st {

/// Faces between two loops of as many edges, beside each other and nowhere further apart than the face's limit, where
/// the surface turns up at one and down at the other: neither the end of a wall nor a groove. A strip for each pair of
/// edges, without stations, those of a face one after the other; by face. `face_limit`: [n_faces]. Local; linear.
std::vector<Strip> find_ledges(const Model& model, const SizeField& field, std::span<const MergeLimit> face_limit);

}  // namespace st
