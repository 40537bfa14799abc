#include <gtest/gtest.h>

#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESBasic_SubfigureDef.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_HArray1OfIGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "unit/geometry/occt_shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// The faces of a box as a subfigure, placed 100 aside with a scale.
void write_placed_box(const std::string& path, double scale) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", 0);
  writer.AddShape(test::occt_shape("box"));
  std::vector<Handle(IGESData_IGESEntity)> faces;
  for (int i = 1; i <= writer.Model()->NbEntities(); ++i)
    if (writer.Model()->Entity(i)->IsKind(STANDARD_TYPE(IGESGeom_TrimmedSurface)))
      faces.push_back(writer.Model()->Entity(i));
  Handle(IGESData_HArray1OfIGESEntity) all = new IGESData_HArray1OfIGESEntity(1, static_cast<int>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f) all->SetValue(static_cast<int>(f) + 1, faces[f]);
  Handle(IGESBasic_SubfigureDef) box = new IGESBasic_SubfigureDef;
  box->Init(0, new TCollection_HAsciiString("box"), all);
  Handle(IGESBasic_SingularSubfigure) placed = new IGESBasic_SingularSubfigure;
  placed->Init(box, gp_XYZ(100, 0, 0), true, scale);
  ASSERT_TRUE(writer.AddEntity(placed));
  writer.ComputeModel();
  ASSERT_TRUE(writer.Write(path.c_str()));
}

TEST(IgesDocument, refuses_parts_that_are_scaled_where_they_are_placed) {
  const TemporaryDirectory dir;
  write_placed_box(dir / "same.igs", 1);
  write_placed_box(dir / "twice.igs", 2);
  EXPECT_GT(import_model(dir / "same.igs", {}).tables.box().hi.x, 100);
  EXPECT_ERROR(import_model(dir / "twice.igs", {}), kGeometry, "a part is placed with the scale 2, ");
}

}  // namespace
}  // namespace st
