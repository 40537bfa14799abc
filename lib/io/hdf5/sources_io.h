// Sources of lengths in sizing.hdf, the background mesh among them.
#pragma once

#include "io/hdf5/hdf5_file.h"
#include "sizing/source_set.h"

namespace st {

inline constexpr const char* kSourceName = "/st/source/name";

/// All but the names: those of causes.
void write_sources(Hdf5Writer& file, const SourceSet& set);

/// Empty where the file has none. Throws Error(kInput).
SourceSet read_sources(const Hdf5Reader& file);

}  // namespace st
