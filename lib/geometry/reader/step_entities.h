// What entities of a STEP file say of units, names and sides, whatever reads its shapes.
#pragma once

#include <Interface_InterfaceModel.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_Reader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cstdint>
#include <string>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// Faces that were made of entities of a file, wherever they stand.
class FacesOfEntities {
 public:
  explicit FacesOfEntities(const Handle(XSControl_WorkSession) & session);

  /// Whether an entity became a face that is not yet among them; it is its last then.
  bool add(const Handle(Standard_Transient) & entity);
  /// How many were added before this face; kNone where it is not among them.
  std::int32_t find(const TopoDS_Shape& face) const;

 private:
  Handle(Transfer_TransientProcess) process_;
  TopTools_IndexedMapOfShape faces_;
};

/// From here on, shapes of STEP files get outer loops and seams right before OpenCASCADE heals them:
/// trim_meridians(), bound_whole_surfaces(), give_seams_curves(), move_curves_between_poles(), swap_seams(). Those of
/// IGES files: join_ring_ends(), make_seams(). Precondition: a controller of OpenCASCADE's readers is there.
void mend_loops_before_healing();

/// Reads the file's entities, also with what OpenCASCADE does not know (byte order mark, tabs); faces that a shell has
/// twice are left out. Throws Error(kInput) where it is no STEP file.
void read_step_file(const std::string& path, XSControl_Reader& reader);

/// The file's unit: unit_in_mm and has_mixed_units.
void read_step_units(const Handle(Interface_InterfaceModel) & model, CadFile& file);

/// XCAF takes a product's id where the name has no ASCII letter: the id becomes the name.
void keep_names_beyond_ascii(const Handle(Interface_InterfaceModel) & model);

/// Throws the Error(kGeometry) of a part that is placed with a scale.
[[noreturn]] void fail_at_scale(const std::string& path, double scale);

/// OpenCASCADE places a part that is mapped with a scale in its own size. Throws Error(kGeometry) where one has faces.
void refuse_scaled_parts(const Handle(XSControl_WorkSession) & session, const std::string& path);

/// What ADVANCED_FACEs say of the side that they face, and of their seams.
void read_senses(const Handle(XSControl_WorkSession) & session, CadFile& file);

/// Bodies and faces of a STEP file that no shape was made of, and tessellated bodies without an exact one: unread.
void find_unread(const Handle(XSControl_WorkSession) & session, CadFile& file);

}  // namespace st::occt
