// st-export: artifacts in other programs' formats.
#include "common/tool_main.h"
#include "stages/export_stage.h"

int main(int argc, char** argv) {
  st::ExportStageOptions o;
  st::ToolMain tool("st-export",
                    "Converts a mesh, sizes or a geometry for other programs. Mesh: " + st::mesh_suffixes() +
                        ". Sizes: .vtu .pos .bac. Geometry: .vtu, .html, FLITE .dat. ParaView shows .vtu and .vtm.");
  tool.input("artifact", o.artifact, "mesh, raster, sizing, failures or geometry artifact");
  tool.output(o.output, "file to write; its suffix selects the format");
  tool.text("--format", o.format, "SUFFIX", "format of a mesh, whatever the suffix of the file: msh2, ascii.stl ...");
  tool.flag("--ascii", o.ascii, "the text form of a format that has both (.stl .ply .msh .msh2 .ugrid .mesh)");
  tool.flag("--binary", o.binary, "its binary form");
  tool.unit("--unit", o.unit, "unit of the coordinates of a mesh (default: the model's)");
  tool.flag("--quads", o.quads, "write rows of stretched triangles as quadrilaterals");
  tool.flag("--quadratic", o.quadratic, "elements of second order, their nodes on the CAD; needs --geometry");
  tool.flag("--parametric", o.parametric,
            "with t of nodes on edges, (u,v) on faces; with --geometry lines, too (.msh .mesh .meshb)");
  tool.flag("--split-groups", o.split_groups, "one file for each group: NAME_GROUP.stl");
  tool.optional_input("--geometry", o.geometry,
                      "the geometry of the mesh, for --quadratic, --parametric and deviations in .vtu");
  tool.optional_input("--sizing", o.sizing, "sizing artifact, for .sol: the requested size at each node of a mesh");
  tool.number(o.kFeatureAngle, o.feature_angle_deg);
  tool.length("--tolerance", o.tolerance, "0.001%", "largest distance of FLITE curves and surfaces from the CAD model");
  tool.main_options({"--format", "--unit", "--quads", "--quadratic", "--split-groups", "--geometry", "--sizing",
                     "--ascii", "--binary"});
  tool.examples({"st-export mesh.hdf -o mesh.stl", "st-export mesh.hdf -o mesh.cgns --unit m",
                 "st-export geometry.hdf -o cad.vtu"});
  return tool.run(argc, argv, [&] { return st::run_export(o); });
}
