// Parts of a document of OpenCASCADE (XCAF), as readers of STEP and IGES fill it.
#pragma once

#include <TDocStd_Document.hxx>
#include <vector>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// A document that lives until close_document().
Handle(TDocStd_Document) new_document();
void close_document(const Handle(TDocStd_Document) & document);

/// The leaf parts, in the order of the tree, with colours, layers and names: face <- shell or solid <- part.
std::vector<CadPart> document_parts(const Handle(TDocStd_Document) & document);

}  // namespace st::occt
