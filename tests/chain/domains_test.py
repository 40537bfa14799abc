"""Flow domains without names are recognised at import, machine parts are none, and no file gets its air twice."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import MODELS, OK, USAGE, Run, ToolTest, make_chain, must  # noqa: E402

BODY_IN_AIR = os.environ["ST_BODY_IN_AIR"]
CUT_MODEL = Path(os.environ["ST_BIN"]).parent / "tests/support/cut_model"
WING_MODELS = os.environ["ST_WING_MODELS"]
ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("ST_CORPUS") or ROOT / "../shared/corpus")
KINDS = ("box", "sphere", "cylinder", "c", "prism", "bullet")
SIDES = {"box": 6, "sphere": 1, "cylinder": 3, "c": 10, "prism": 8, "bullet": 3}
HALF_SIDES = {"box": 5, "sphere": 1, "cylinder": 3, "c": 7, "prism": 7, "bullet": 3}
WHOLE = ("aero_d150_fullspan.brep", "aero_evtol_bet.brep", "aero_bladex_propeller_shaft.iges", "aero_tigl_nacelle.stp",
         "ship_goteborg_hull.iges")
HALVES = ("aero_d150_wing_body_half.brep", "aero_evtol_bet.brep", "aero_tigl_simplewing.brep",
          "aero_lsdo_simple_wing.stp")


class Domains(ToolTest):
    def make(self, body, kind, size, variant, suffix="brep"):
        path = self.folder / f"{Path(body).stem}_{kind}_{size}_{variant}.{suffix}"
        subprocess.run([BODY_IN_AIR, body, kind, str(size), variant, path], check=True, capture_output=True,
                       timeout=300)
        return path

    def domain_of(self, path, *options):
        return must("st-import", path, "-o", self.folder / "g.hdf", "--json", *options).json()["flow_domain"]

    def expect(self, path, **counts):
        domain = self.domain_of(path)
        self.assertIsNotNone(domain, f"{path.name} is not recognised")
        self.assertEqual({key: domain[key] for key in counts}, counts, path.name)

    def corpus(self, names):
        found = [CORPUS / name for name in names if (CORPUS / name).exists()]
        if not found:
            self.skipTest(f"{CORPUS} has none of {', '.join(names)}; set ST_CORPUS")
        return found

    def test_of_six_kinds_are_recognised(self):
        for kind in KINDS:
            for size in (4, 100):
                with self.subTest(kind=kind, size=size):
                    self.expect(self.make(MODELS / "wing_with_flap.step", kind, size, "whole", "step"),
                                farfield=SIDES[kind], symmetry=0, interface=0, recognised_by="shape")

    def test_of_six_kinds_around_aircraft_are_recognised(self):
        for body in self.corpus(WHOLE):
            for kind in KINDS:
                with self.subTest(body=body.name, kind=kind):
                    self.expect(self.make(body, kind, 10, "whole"), farfield=SIDES[kind], symmetry=0, interface=0)

    def test_of_six_kinds_around_half_aircraft_have_a_symmetry_plane(self):
        for body in self.corpus(HALVES):
            for kind in KINDS:
                with self.subTest(body=body.name, kind=kind):
                    self.expect(self.make(body, kind, 10, "half", "step"), farfield=HALF_SIDES[kind], symmetry=1,
                                interface=0)

    def test_of_a_quarter_have_two_symmetry_planes(self):
        for body in self.corpus(("aero_d150_wing_body_half.brep",)):
            self.expect(self.make(body, "c", 10, "halfquarter", "step"), farfield=6, symmetry=2, interface=0)

    def test_turned_cut_or_with_boxes_sheets_and_several_bodies_inside_are_recognised(self):
        body = MODELS / "wing_with_flap.step"
        for variant, suffix, farfield, interface in (
                ("turned", "igs", 6, 0), ("two", "step", 6, 0), ("inner", "brep", 6, 6), ("inner", "step", 6, 12),
                ("wake", "brep", 6, 11), ("narrowwake", "brep", 6, 12),
                ("solid", "step", 6, 0), ("cut", "brep", 10, 1), ("cut", "step", 10, 2), ("disc", "igs", 6, 0),
                ("sheets", "igs", 6, 0)):
            with self.subTest(variant=variant, suffix=suffix):
                self.expect(self.make(body, "box", 10, variant, suffix), farfield=farfield, symmetry=0,
                            interface=interface)

    def cut(self, path, seed, n_planes):
        """All its faces, cut by random planes."""
        own = self.folder / f"{path.stem}_cut.brep"
        subprocess.run([CUT_MODEL, path, own, str(seed), str(n_planes)], check=True, capture_output=True, timeout=300)
        return own

    def test_whose_sides_are_cut_by_planes_are_recognised(self):
        for seed, kind in enumerate(KINDS):
            for variant in ("whole", "half"):
                with self.subTest(kind=kind, variant=variant):
                    path = self.cut(self.make(self.wing("elliptic_wing"), kind, 10, variant), seed, 8)
                    domain = self.domain_of(path)
                    self.assertIsNotNone(domain, f"{path.name} is not recognised")
                    self.assertGreater(domain["farfield"], 1)
                    self.assertEqual(domain["symmetry"] > 0, variant == "half")

    def test_machine_parts_cut_by_planes_are_none(self):
        parts = subprocess.run([BODY_IN_AIR, "parts"], check=True, capture_output=True, text=True).stdout.split()
        for seed, part in enumerate(parts):
            with self.subTest(part=part):
                path = self.folder / f"{part}.brep"
                subprocess.run([BODY_IN_AIR, "part", part, path], check=True, capture_output=True)
                self.assertIsNone(self.domain_of(self.cut(path, seed, 6)))

    def wing(self, name):
        path = self.folder / f"{name}.brep"
        subprocess.run([WING_MODELS, name, path], check=True, capture_output=True)
        return path

    def test_of_a_section_between_two_planes_have_two_symmetry_planes(self):
        for name in ("two_elements", "kinked_wing", "twisted_wing"):
            for kind in ("box", "c"):
                with self.subTest(name=name, kind=kind):
                    domain = self.domain_of(self.make(self.wing(name), kind, 10, "slice"))
                    self.assertIsNotNone(domain)
                    self.assertEqual(domain["symmetry"], 2)

    def test_of_a_section_with_plane_faces_are_said_in_one_line(self):
        path = self.make(self.wing("diamond_wing"), "box", 10, "slice")
        run = must("st-import", path, "-o", self.folder / "g.hdf")
        self.assertIn("section with plane faces between two planes, as a hole may be; --flow-domain yes",
                      run.err + run.out)
        self.assertEqual(self.domain_of(path, "--flow-domain", "yes")["symmetry"], 2)

    def test_that_are_doubtful_are_said_in_one_line(self):
        for size in (0.9, 0.6):
            path = self.make(self.wing("flying_wing"), "box", size, "whole")
            run = must("st-import", path, "-o", self.folder / "g.hdf")
            self.assertIn("larger than a quarter of what is around it; --flow-domain yes", run.err + run.out)

    def test_machine_parts_are_none(self):
        parts = subprocess.run([BODY_IN_AIR, "parts"], check=True, capture_output=True, text=True).stdout.split()
        self.assertGreater(len(parts), 10)
        for part in parts:
            for suffix in ("step", "igs"):
                with self.subTest(part=part, suffix=suffix):
                    path = self.folder / f"{part}.{suffix}"
                    subprocess.run([BODY_IN_AIR, "part", part, path], check=True, capture_output=True)
                    self.assertIsNone(self.domain_of(path))

    def test_are_not_doubled_and_can_be_replaced(self):
        path = self.make(MODELS / "wing_with_flap.step", "c", 10, "whole", "step")
        for options in (["--farfield", "box:20"], ["--symmetry", "y=0"], ["--symmetry", "y=0", "--farfield", "box:9"]):
            self.expect_error(USAGE, "st-import", path, "-o", self.folder / "d.hdf", *options,
                              says=["10 faces are farfield", "--replace-farfield"])
        self.assertEqual(self.domain_of(path, "--flow-domain", "no"), None)
        self.assertTrue(self.domain_of(path, "--replace-farfield", "sphere:50")["replaced"])

    def test_have_large_triangles_on_the_far_field_only(self):
        path = self.make(MODELS / "wing_with_flap.step", "box", 10, "whole", "step")
        folder = make_chain(path, self.folder / "chain")
        check = Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                    folder / "sizing.hdf", "--json")
        self.assertEqual(check.code, OK, str(check))
        alone = make_chain(MODELS / "wing_with_flap.step", self.folder / "alone")
        body = must("st-check", alone / "mesh.hdf", "--json").json()["triangles"]
        self.assertLess(abs(check.json()["triangles"] - body), 0.3 * body)

    def test_sizes_pass_a_box_in_the_air_that_asks_for_none(self):
        path = self.make(MODELS / "wing_with_flap.step", "box", 10, "inner")
        folder = make_chain(path, self.folder / "chain")
        check = Run("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing",
                    folder / "sizing.hdf", "--json")
        self.assertEqual(check.code, OK, str(check))
        interface = next(g for g in check.json()["groups"] if g["name"] == "interface")
        self.assertGreater(interface["sizes"]["share"], 0.99)
        self.assertGreater(interface["quality"]["min"], 0.7)


if __name__ == "__main__":
    unittest.main()
