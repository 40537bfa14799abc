// What --pairs asks for: pairs of faces.
#pragma once

#include <memory>
#include <string>

#include "meshing/topology/periodic_pairs.h"
#include "sizing/size_field.h"

namespace st {

/// `option` is "auto" or a file of tables [[pair]]; empty: no pairs. Throws Error as PeriodicPairs, read_pair_file()
/// and find_pairs() do. Local.
PeriodicPairs read_pairs(const std::string& option, const Model& model);

/// The smaller of the lengths on both sides of pairs; null without pairs: the field as it is. `field` outlives it.
std::unique_ptr<SizeField> make_paired_field(const SizeField& field, const PeriodicPairs& pairs, const ModelTables& t);

}  // namespace st
