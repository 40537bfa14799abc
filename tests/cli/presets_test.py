"""Presets are plain options: the table of docs/presets.md, given by hand, makes the same sizing."""
import json
import os
import re
import subprocess
import unittest
from pathlib import Path

BIN, MODELS = Path(os.environ["ST_BIN"]), Path(os.environ["ST_MODELS"])
WORK = Path(os.environ["ST_WORK"]) / "presets"
PAGE = Path(__file__).resolve().parents[2] / "docs/presets.md"
ROW = re.compile(r"^\| `(\w+)` \|.*?\| `(.*?)` \| `(.*?)` \|", re.M)


def run(tool, *arguments):
    return subprocess.run([BIN / tool, *map(str, arguments), "--json"], capture_output=True, text=True)


def summary(tool, *arguments):
    done = run(tool, *arguments)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


class Presets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        cls.geometry = WORK / "geometry.hdf"
        summary("st-import", MODELS / "wing_with_flap.step", "-o", cls.geometry)

    def sizing_hash(self, raster_options, prolong_options):
        raster, sizing = WORK / "raster.hdf", WORK / "sizing.hdf"
        summary("st-raster", self.geometry, "-o", raster, *raster_options)
        return summary("st-prolong", raster, "-o", sizing, *prolong_options)["hash"]

    def test_the_page_lists_the_options_of_every_preset(self):
        rows = ROW.findall(PAGE.read_text(encoding="utf-8"))
        self.assertEqual([r[0] for r in rows], ["preview", "euler", "rans", "fine"])
        hashes = {}
        for name, raster, prolong in rows:
            by_name = self.sizing_hash(["--preset", name], ["--preset", name])
            by_hand = self.sizing_hash(raster.split(), prolong.split())
            self.assertEqual(by_name, by_hand, name)
            hashes[name] = by_name
        self.assertEqual(len(set(hashes.values())), len(rows), "presets differ from each other")

    def test_the_command_line_and_the_option_file_win(self):
        file = WORK / "options.toml"
        file.write_text('[st-raster]\npreset = "fine"\nlmax = "4%"\n')
        by_file = self.sizing_hash(["--options", file], [])
        by_line = self.sizing_hash(["--preset", "fine", "--lmax", "4%"], [])
        self.assertEqual(by_file, by_line)

    def test_a_family_has_the_lengths_times_and_by_the_ratio(self):
        raster, sizing = WORK / "raster.hdf", WORK / "member.hdf"
        summary("st-raster", self.geometry, "-o", raster)
        summary("st-prolong", raster, "-o", sizing, "--family", "1.5")
        for level, scale in (("coarse", "1.5"), ("fine", repr(1 / 1.5))):
            summary("st-prolong", raster, "-o", WORK / "alone.hdf", "--scale", scale)
            same = run("st-diff", WORK / f"member-{level}.hdf", WORK / "alone.hdf")
            self.assertEqual(same.returncode, 0, level + same.stdout)

    def test_the_family_of_the_workshops_has_six_levels_the_third_as_it_is(self):
        raster, sizing = WORK / "raster.hdf", WORK / "dpw.hdf"
        summary("st-raster", self.geometry, "-o", raster)
        summary("st-prolong", raster, "-o", sizing, "--family", "dpw")
        self.assertEqual(run("st-diff", WORK / "dpw-L3.hdf", sizing).returncode, 0)
        for level in range(1, 7):
            scale = 4 / (level + 1)
            summary("st-prolong", raster, "-o", WORK / "alone.hdf", "--scale", repr(scale))
            same = run("st-diff", WORK / f"dpw-L{level}.hdf", WORK / "alone.hdf")
            self.assertEqual(same.returncode, 0, f"L{level}: {same.stdout}")
        refused = run("st-prolong", raster, "-o", sizing, "--family", "dwp")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("takes a ratio in (1, 4] or dpw", refused.stderr)

    def test_an_unknown_preset_is_refused_with_the_names(self):
        done = run("st-raster", self.geometry, "--preset", "ranz")
        self.assertEqual(done.returncode, 2)
        self.assertIn("preview, euler, rans, fine", done.stderr)


if __name__ == "__main__":
    unittest.main()
