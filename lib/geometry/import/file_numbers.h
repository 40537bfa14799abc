// Numbers in the text of a CAD file that no reader of OpenCASCADE ends on.
#pragma once

#include <string>

namespace st::occt {

/// Throws Error(kGeometry) naming line and number when a file of `format` "STEP", "IGES" or "BREP" gives a coordinate,
/// radius or the like that is NaN, infinite or beyond 1e200; OpenCASCADE's own infinity is 2e100. Values whose type
/// STEP names, such as LENGTH_MEASURE(1.E308), say something about a model and pass. So do binary BREP files. In STEP
/// also numbers like 1.5e-05 or 2E3 are refused, which OpenCASCADE reads as others. The cost is linear.
void require_sound_numbers(const std::string& path, const std::string& format);

}  // namespace st::occt
