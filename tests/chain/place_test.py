"""The same shape moved, turned, scaled, mirrored, reordered, or given as loose faces, gets the same mesh but for its
places: as many triangles, the same area and the same verdict. On files of the corpus (ST_CORPUS), at coarse sizes."""
import json
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import CORPUS, Run, ToolTest, main_on_corpus, make_chain  # noqa: E402

VARY = os.environ["ST_VARY"]
VARIANTS = ["moved", "turned", "tumbled", "scaled", "mirrored", "reordered", "loose", "reversed"]
MODELS = {  # and the largest length
    "aero_onera_m6_sharpte.brep": "10%",
    "aero_d150_wing.igs": "10%",
    "aero_tigl_simplewing.brep": "10%",
    "basic_refine_cone_cone.brep": "5%",
    "basic_refine_sphere_cube.brep": "5%",
    "mech_esp_piston.brep": "5%",
    "mech_geouned_tank.stp": "5%",
    "mech_netgen_screw.step": "5%",
    "mech_occt_bottle.brep": "5%",
}
TOUCHING = {"mech_geouned_tank.stp"}  # solids: walls between them are there once where faces are loose
MOST = 0.02  # difference in the number of triangles, relative
KNOWN = {  # larger differences that were measured; the limits shrink when their causes are mended
    ("mech_geouned_tank.stp", "reordered"): 0.03,
    ("basic_refine_cone_cone.brep", "tumbled"): 0.03,  # 2.6 %: other samples; both fields are exact within 0.5 %
}
AREA = 2e-3  # likewise: chords run elsewhere
SCALE = {"scaled": 1e-6}  # of areas


class Place(ToolTest):
    def report_of(self, model, variant, lmax):
        """What st-check says of a variant, and its exit code."""
        varied = self.folder / f"{variant}.brep"
        subprocess.run([VARY, model, varied, variant], check=True, capture_output=True)
        folder = make_chain(varied, self.folder / variant, raster_options=["--lmax", lmax])
        check = Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                    folder / "sizing.hdf", "--json")
        return check.code, json.loads(check.out.splitlines()[-1])

    def check(self, name, lmax):
        verdict, same = self.report_of(CORPUS / name, "same", lmax)
        for variant in VARIANTS[:-2] if name in TOUCHING else VARIANTS:
            with self.subTest(variant):
                code, report = self.report_of(CORPUS / name, variant, lmax)
                self.assertEqual(code, verdict, report)
                most = KNOWN.get((name, variant), MOST)
                self.assertLessEqual(abs(report["triangles"] - same["triangles"]), most * same["triangles"],
                                     f"{report['triangles']} triangles, {same['triangles']} of the shape as it is")
                self.assertLess(abs(report["area"] / (SCALE.get(variant, 1) * same["area"]) - 1), AREA)
                for key in ("closed", "components", "genus", "boundary_edges", "failed"):
                    if key != "boundary_edges" or same["closed"]:
                        self.assertEqual(report[key], same[key], key)

    def test_loose_faces_of_bodies_that_touch_have_common_walls(self):
        for variant in ("loose", "reversed"):
            with self.subTest(variant):
                code, report = self.report_of(CORPUS / "mech_geouned_tank.stp", variant, "5%")
                self.assertEqual((code, report["closed"], report["components"], len(report["failed"])), (0, True, 1, 0))


if __name__ == "__main__":
    main_on_corpus(Place, MODELS.items())
