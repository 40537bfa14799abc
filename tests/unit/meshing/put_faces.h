// A meshed shape whose patches are put together again, as rounds have them.
#pragma once

#include <string>

#include "meshing/engine/meshed_faces.h"
#include "support/meshed.h"

namespace st::test {

/// A meshed shape, its patches put together again.
struct PutFaces {
  Meshed meshed;
  EdgeMesh edges;
  MeshedFaces faces{meshed.model, meshed.topology, one_rank, true, edges};

  PutFaces(const std::string& shape, double length) : meshed(shape, length) {
    faces.set_edges(meshed.result.edges);
    for (const FacePatch& p : meshed.result.patches) faces.put(p.face, FacePatch(p));
    faces.search_crossings();
  }
};

}  // namespace st::test
