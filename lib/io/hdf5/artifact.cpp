#include "io/hdf5/artifact.h"

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"

namespace st {

ArtifactHeader read_header(const std::string& path) { return Hdf5Reader::header_of(path); }

void require_same_geometry(const std::string& path_a, const ArtifactHeader& a, const std::string& path_b,
                           const ArtifactHeader& b) {
  const auto geometry_of = [](const ArtifactHeader& h) {
    return h.schema == "geometry" ? h.content_hash : h.geometry_hash;
  };
  if (geometry_of(a) == geometry_of(b)) return;
  throw Error(ExitCode::kMismatch,
              path_a + " (" + a.schema + ") and " + path_b + " (" + b.schema +
                  ") do not go back to the same geometry; make both from the same geometry artifact");
}

}  // namespace st
