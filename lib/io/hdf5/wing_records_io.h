// Lifting surfaces in raster.hdf and sizing.hdf.
#pragma once

#include <vector>

#include "io/hdf5/hdf5_file.h"
#include "sizing/wing_record.h"

namespace st {

/// Nothing where there are none.
void write_wings(Hdf5Writer& file, const std::vector<WingRecord>& wings);

/// Empty where the file has none. Throws Error(kInput).
std::vector<WingRecord> read_wings(const Hdf5Reader& file);

}  // namespace st
