// Which CAD faces are one, in artifacts: the group /st/composites (docs/dev/composites.md).
#pragma once

#include "geometry/model/composites.h"
#include "io/hdf5/hdf5_file.h"

namespace st {

/// Nothing where there are none.
void write_composites(Hdf5Writer& w, const Composites& composites);
bool has_composites(const Hdf5Reader& r);
/// Numbers are finite; what they lead to is not looked at. Throws Error(kInput) for a newer version.
Composites read_composites(const Hdf5Reader& r);

}  // namespace st
