"""Groups, parts and names from the CAD file and a groups file to the mesh and the exports."""
import os
import re
import sys
import unittest
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, INPUT, MODELS, OK, USAGE, Run, ToolTest, content_hash, make_chain, must  # noqa: E402

CORPUS = Path(os.environ.get("ST_CORPUS") or Path(__file__).resolve().parents[2] / "../shared/corpus").resolve()
COARSE = {"raster_options": ["--lmin", "2%", "--lmax", "10%", "--alpha", "30"]}
EXPORTS = ["vtu", "msh", "ascii.stl", "stl", "obj", "ply", "fro"]

AS1 = """
[[group]]
name = "fasteners"
parts = ["nut", "bolt", "rod"]
tolerance = "0.1mm"
attributes = { solver = "viscous" }
[[group]]
name = "Träger"
paths = "as1/l-bracket-assembly#?/l-bracket"
[[group]]
name = "plate"
role = "symmetry"
[[group]]
table = "kind"
name = "flat"
surfaces = "plane"
[[group]]
table = "kind"
name = "none"
layers = "99"
optional = true
[[group]]
table = "paint"
name = "red"
colors = "#ff0000"
[[group]]
table = "layer"
name = "all"
layers = "25?"
"""

D150 = """
[[group]]
name = "wing right"
inside = [8, 1.5, -2.5, 25, 17, 2]
[[group]]
name = "wing left"
inside = [8, -17, -2.5, 25, -1.5, 2]
role = "other"
[[group]]
name = "some faces"
faces = [1, "3-5"]
[[group]]
table = "bc"
name = "tunnel"
touching = [-1, -1, -1, 1, 1, 1]
"""


def groups_of(artifact):
    """{table: {group: [faces]}}, and the whole object."""
    json = must("st-info", artifact, "--groups", "--json").json()
    return {t["table"]: {g["name"]: g["faces"] for g in t["groups"]} for t in json["tables"]}, json


def corpus_file(test, name):
    """The path of a real CAD file; the test is skipped, loudly, where it is missing."""
    path = CORPUS / name
    if not path.is_file():
        print(f"SKIPPED: {path} is missing; set ST_CORPUS", file=sys.stderr)
        test.skipTest(f"{path} is missing")
    return path


class Chain(ToolTest):
    def chain(self, model, groups):
        path = corpus_file(self, model)
        (self.folder / "groups.toml").write_text(groups)
        make_chain(path, self.folder, import_options=["--groups", self.folder / "groups.toml"], **COARSE)
        for suffix in EXPORTS:
            must("st-export", self.folder / "mesh.hdf", "-o", self.folder / f"mesh.{suffix}")

    def expect_exports_to_agree(self):
        """Every export says the same of the groups, and has as many triangles of each; returns these numbers."""
        _, json = groups_of(self.folder / "mesh.hdf")
        names = [g["name"] for g in json["tables"][0]["groups"]]
        solids, name = Counter(), None
        for line in (self.folder / "mesh.ascii.stl").read_text().split("\n"):
            name = line[6:] if line.startswith("solid ") else name
            solids[name] += line.startswith("facet ")
        self.assertEqual(list(solids), [n.replace(" ", "_") for n in names])
        of_group, group = Counter(), ""
        for line in (self.folder / "mesh.obj").read_text().split("\n"):
            if line.startswith("g "):
                group = line[2:]
            elif line.startswith("f "):
                of_group[group] += 1
        self.assertEqual(of_group, solids)
        msh = (self.folder / "mesh.msh").read_text()
        for i, n in enumerate(names):
            self.assertIn(f'\n2 {i + 1} "{n}"\n', msh)
        vtu = (self.folder / "mesh.vtu").read_text()
        for n in names:
            self.assertIn(f'Name="group:{n}"', vtu)
        ply = (self.folder / "mesh.ply").read_bytes().split(b"end_header")[0].decode()
        for i, n in enumerate(names):
            self.assertIn(f"comment group {i + 1} {n}\n", ply)
        self.assertEqual(sum(solids.values()), int((self.folder / "mesh.fro").read_text().split()[0]))
        return dict(zip(names, solids.values(), strict=True)), json

    def test_parts_of_an_assembly_are_groups_of_the_mesh_and_its_exports(self):
        self.chain("mech_as1_oc_214.stp", AS1)
        triangles, json = self.expect_exports_to_agree()
        self.assertEqual(list(triangles), ["fasteners", "Träger", "plate"])
        self.assertTrue(all(n > 100 for n in triangles.values()), triangles)
        for artifact in ("geometry.hdf", "patches.hdf", "mesh.hdf"):
            tables, json = groups_of(self.folder / artifact)
            self.assertEqual({n: len(f) for n, f in tables["main"].items()},
                             {"fasteners": 110, "Träger": 32, "plate": 18}, artifact)
            self.assertEqual(list(tables["kind"]), ["flat"])
            self.assertEqual(len(tables["paint"]["red"]), 64, "the nuts")
            self.assertEqual(len(tables["layer"]["all"]), 160)
            self.assertEqual([g["role"] for g in json["tables"][0]["groups"]], ["wall", "wall", "symmetry"])
            self.assertEqual(json["tables"][0]["groups"][0]["attributes"], {"tolerance": 0.1, "solver": "viscous"})
            paths = [p["path"] for p in json["parts"]]
            self.assertEqual(len(set(paths)), 18)
            self.assertIn("as1/l-bracket-assembly#2/nut-bolt-assembly#3/bolt", paths)
            self.assertEqual(Counter(p["name"] for p in json["parts"]),
                             {"nut": 8, "bolt": 6, "l-bracket": 2, "plate": 1, "rod": 1})
        self.assertIn('"part:as1/rod-assembly/nut#2"', (self.folder / "mesh.msh").read_text())
        self.assertIn('"group_kind:flat"', (self.folder / "mesh.msh").read_text())

    def test_faces_of_an_aircraft_without_names_are_groups_by_place(self):
        self.chain("aero_d150_fullspan.brep", D150)
        triangles, json = self.expect_exports_to_agree()
        self.assertEqual(set(triangles), {"wing right", "wing left", "some faces", "default"})
        tables, _ = groups_of(self.folder / "mesh.hdf")
        self.assertEqual(tables["main"]["some faces"], [1, 3, 4, 5])
        self.assertEqual(len(tables["main"]["wing left"]), len(tables["main"]["wing right"]))
        # lengths are larger than the wings are thick: where triangles fold or cross they are refined, not alike
        self.assertLess(abs(triangles["wing left"] / triangles["wing right"] - 1), 0.25)
        self.assertGreater(triangles["wing left"], 100)
        self.assertEqual(json["parts"], [])
        for table, groups in groups_of(self.folder / "geometry.hdf")[0].items():
            for name, faces in groups.items():  # closed strips have no triangle
                self.assertLessEqual(set(tables[table][name]), set(faces))
                self.assertGreater(len(tables[table][name]), 0.9 * len(faces))


class Import(ToolTest):
    def run_import(self, groups, *options, model="assembly.step"):
        (self.folder / "g.toml").write_text(groups)
        must("st-import", MODELS / model, "-o", self.folder / "g.hdf", "--groups", self.folder / "g.toml", *options)
        return groups_of(self.folder / "g.hdf")

    def expect_refusal(self, groups, says, code=USAGE, model=MODELS / "assembly.step"):
        (self.folder / "g.toml").write_text(groups)
        (self.folder / "out").mkdir(exist_ok=True)
        self.expect_error(code, "st-import", model, "-o", self.folder / "out/g.hdf", "--groups", self.folder / "g.toml",
                          says=says)
        self.expect_nothing_left(self.folder / "out")

    def test_instances_of_a_part_differ_by_their_paths(self):
        tables, json = self.run_import('[[group]]\nname = "second pin"\npaths = "assembly/pin#2"\n')
        self.assertEqual(sorted(p["path"] for p in json["parts"]),
                         ["assembly/block", "assembly/pin#1", "assembly/pin#2"])
        second = next(p["faces"] for p in json["parts"] if p["path"] == "assembly/pin#2")
        self.assertEqual(tables["main"]["second pin"], second)
        self.assertNotIn("pin", " ".join(n for n, f in tables["main"].items() if set(f) & set(second)
                                         and n != "second pin"))

    def test_the_groups_file_is_an_input_and_an_option_of_the_artifact(self):
        self.run_import('[[group]]\nname = "a"\nfaces = 1\n')
        info = must("st-info", self.folder / "g.hdf", "--json").json()
        self.assertEqual(info["inputs"][1]["role"], "groups")
        self.assertEqual(info["inputs"][1]["name"], "g.toml")
        self.assertEqual(info["options"]["groups"], "g.toml")

    def test_groups_may_stand_in_the_option_file(self):
        text = 'small = "0.02%"\n[[group]]\nname = "a"\nfaces = 1\n[[st-import.group]]\nname = "b"\nfaces = 2\n'
        (self.folder / "o.toml").write_text(text)
        arguments = ["-o", self.folder / "g.hdf", "--options", self.folder / "o.toml"]
        must("st-import", MODELS / "box.step", *arguments)
        groups = must("st-info", self.folder / "g.hdf", "--groups").out
        self.assertRegex(groups, r"\ba\b")
        self.assertRegex(groups, r"\bb\b")
        (self.folder / "o.toml").write_text(text + "[[gruop]]\n")
        self.expect_error(USAGE, "st-import", MODELS / "box.step", *arguments, says=["o.toml:8", "gruop"])

    def test_groups_that_the_shape_suggests_can_be_edited_and_imported(self):
        model, groups = MODELS / "wing_with_flap.step", self.folder / "suggested.toml"
        said = must("st-import", model, "--check", "--suggest-groups", groups).err
        self.assertRegex(said, r"suggested.toml: .*wing \d+.* faces are in none")
        self.expect_nothing_left(self.folder, "suggested.toml")  # --check writes no artifact
        text = groups.read_text()
        self.assertIn("[[group]]  # ", text)
        self.assertIn('name = "wing"', text)
        groups.write_text(text.replace('name = "wing"', 'name = "main element"'))
        must("st-import", model, "-o", self.folder / "g.hdf", "--groups", groups)
        tables, _ = groups_of(self.folder / "g.hdf")
        self.assertIn("main element", tables["main"])
        new = self.folder / "new.hdf"
        self.expect_error(USAGE, "st-import", model, "-o", new, "--groups", groups, "--suggest-groups",
                          self.folder / "more.toml", says="give one of them")
        self.expect_error(USAGE, "st-import", model, "-o", new, "--suggest-groups", model, says="input")

    def test_st_info_says_what_a_group_is(self):
        must("st-import", MODELS / "assembly.step", "-o", self.folder / "g.hdf")
        said = must("st-info", self.folder / "g.hdf", "--groups").out
        self.assertRegex(said, r'"\S+", wall: \d+ faces.*, area \S+ mm\^2, from \(.*\) to \(.*\) mm: ')
        (self.folder / "g.toml").write_text('[[group]]\nname = "first"\nfaces = 1\n')
        must("st-import", MODELS / "assembly.step", "-o", self.folder / "g.hdf", "--groups", self.folder / "g.toml")
        said = must("st-info", self.folder / "g.hdf", "--groups").out
        self.assertRegex(said, r'"first", wall: 1 face of "\S+".*, area .*: 1\n')

    def test_errors_name_file_line_and_groups_and_leave_nothing(self):
        self.expect_refusal('[[group]]\nname = "a"\nfaces = "1-2"\n[[group]]\nname = "b"\nfaces = 2\n',
                            ["g.toml:4", '"a"', '"b"', "face 2"])
        self.expect_refusal('[[group]]\nname = "a"\nfaces = "zz*"\n', ["g.toml:1", "zz*", "optional"])
        self.expect_refusal('[[group]]\nname = "a"\nfaces = 999\n', ["999"])
        self.expect_refusal('[[group]]\nname = "a"\nfaecs = 1\n', ["g.toml:3", "faecs"],
                            model=self.folder / "none.step")  # before the CAD file
        self.expect_refusal('[[group]]\nname = "a"\ninside = [0, 0, 0, "1mm", 1, 1]\n', ["no unit"],
                            model=MODELS / "box.brep")
        self.expect_error(INPUT, "st-import", MODELS / "box.step", "-o", self.folder / "out/g.hdf", "--groups",
                          self.folder / "none.toml", says="none.toml")

    def test_check_judges_the_groups_too(self):
        (self.folder / "g.toml").write_text('[[group]]\nname = "a"\nfaces = 1\n[[group]]\nname = "o"\nfaces = "x*"\n'
                                            'optional = true\n')
        json = must("st-import", MODELS / "assembly.step", "--check", "--json", "--groups",
                    self.folder / "g.toml").json()
        self.assertEqual(json["tables"][0]["groups"][0], {"name": "a", "role": "wall", "faces": 1})
        self.assertTrue(any(f["what"] == "optional group without a face" and f["entity"] == 'group "o"'
                            for f in json["findings"]))

    def test_a_role_decides_whether_a_face_counts_for_the_diagonal(self):
        for role, longer in (("farfield", False), ("outlet", True)):
            self.run_import(f'[[group]]\nname = "block"\nrole = "{role}"\n')
            raster = must("st-raster", self.folder / "g.hdf", "-o", self.folder / "r.hdf", "--json").json()
            diagonal = must("st-info", self.folder / "r.hdf", "--json").json()["properties"]["diagonal"]
            whole = must("st-import", MODELS / "assembly.step", "--check", "--json").json()["box"]
            self.assertEqual(diagonal > 0.9 * sum((b - a) ** 2 for a,
                                                  b in zip(whole[:3], whole[3:], strict=True)) ** 0.5, longer, raster)

    def test_flow_domain_faces_can_be_grouped(self):
        tables, json = self.run_import('[[group]]\nname = "tunnel"\ngroups = "farfield"\nrole = "farfield"\n',
                                       "--farfield", "box:5", model="box.step")
        self.assertEqual(len(tables["main"]["tunnel"]), 6)
        self.assertNotIn("farfield", tables["main"])


    def test_solids_of_one_part_differ_by_their_paths(self):
        tables, json = self.run_import('[[group]]\nname = "second"\npaths = "*/Sólido2"\n',
                                       model=corpus_file(self, "mech_geouned_tank.stp"))
        self.assertEqual([p["path"] for p in json["parts"]], [f"TANK2/TEST/_m0_/Sólido{i + 1}" for i in range(12)])
        self.assertEqual(tables["main"]["second"], json["parts"][1]["faces"])


class Options(ToolTest):
    """Options of later stages take names of groups of every table, of parts and of their paths."""

    def setUp(self):
        super().setUp()
        (self.folder / "g.toml").write_text('[[group]]\ntable = "bc"\nname = "hot"\npaths = "assembly/pin#1"\n')
        make_chain(MODELS / "assembly.step", self.folder, import_options=["--groups", self.folder / "g.toml"], **COARSE)
        self.inputs = [self.folder / "geometry.hdf", self.folder / "sizing.hdf"]

    def test_st_mesh_and_st_remesh_take_them(self):
        for name, n_faces in (("pin", 4), ("assembly/pin#*", 6), ("assembly/pin#2", 3), ("hot", 3), ("bc:h*", 3),
                              ("block", 6)):
            must("st-mesh", *self.inputs, "-o", self.folder / "part.hdf", "--group", name)
            self.assertEqual(must("st-info", self.folder / "part.hdf", "--json").json()["counts"]["patches"], n_faces,
                             name)
        self.expect_error(USAGE, "st-mesh", *self.inputs, "-o", self.folder / "part.hdf", "--group", "cold",
                          says=["cold", "--groups"])
        must("st-remesh", self.folder / "mesh.hdf", *self.inputs, "-o", self.folder / "re.hdf", "--dry-run", "--keep",
             "assembly/pin#2")

    def test_st_prolong_and_st_raster_take_them(self):
        (self.folder / "p.csv").write_text("".join(f"{x},{y},{z}\n" for x in range(0, 160, 8) for y in range(0, 45, 8)
                                                   for z in range(0, 21, 8)))
        total = {}
        for slope in ("", "hot=0.02", "assembly/pin#*=0.02"):
            must("st-prolong", self.folder / "raster.hdf", "-o", self.folder / "s.hdf", "--slope-of", slope, "--sample",
                 self.folder / "p.csv",
                 "--sample-output", self.folder / "o.csv")
            total[slope] = sum(float(line.split(",")[3])
                               for line in (self.folder / "o.csv").read_text().split("\n")[1:] if line)
        self.assertLess(total["assembly/pin#*=0.02"], total["hot=0.02"])
        self.assertLess(total["hot=0.02"], total[""])
        self.expect_error(USAGE, "st-prolong", self.folder / "raster.hdf", "-o", self.folder / "s.hdf", "--slope-of",
                          "cold=0.1", says="cold")
        samples = []
        for name in ("hot", "assembly/pin#*"):
            (self.folder / "sizes.toml").write_text(f'[[size]]\ngroups = "{name}"\nlmax = "1%"\n')
            run = must("st-raster", self.folder / "geometry.hdf", "-o", self.folder / "r.hdf", "--lmax", "10%",
                       "--sizes", self.folder / "sizes.toml", "--json")
            samples.append(run.json()["samples"])
        self.assertLess(samples[0], samples[1])

    def test_the_side_to_blank_follows_from_roles(self):
        (self.folder / "g.toml").write_text('[[group]]\nname = "tunnel"\ngroups = "farfield"\nrole = "farfield"\n')
        make_chain(MODELS / "box.step", self.folder,
                   import_options=["--farfield", "box:1", "--groups", self.folder / "g.toml"], **COARSE)
        said = {}
        for side in ("auto", "outside", "inside"):
            said[side] = must("st-prolong", self.folder / "raster.hdf", "-o", self.folder / "s.hdf", "--blank",
                              self.folder / "mesh.hdf", "--blank-side", side,
                              "--json").json()["blanked_cells"]
        self.assertEqual(said["auto"], said["outside"])
        self.assertNotEqual(said["auto"], said["inside"])


BOX = """
[[group]]
name = "top"
inside = [0, 0, 20, 60, 40, 20]
[[group]]
of = "edges"
name = "outline"
rim = "top"
attributes = { note = "sharp" }
[[group]]
of = "edges"
name = "uprights"
table = "bc"
inside = [0, 0, 0, 0, 40, 20]
[[group]]
of = "vertices"
name = "corner"
inside = [60, 40, 20, 60, 40, 20]
"""
BOX_NAMES = ["top", "outline", "corner"]


class MshFile:
    """Nodes, elements by type and physical names of a Gmsh 4.1 text file."""

    def __init__(self, path):
        sections = {}
        name = None
        for line in Path(path).read_text().split("\n"):
            if line.startswith("$"):
                name = None if line.startswith("$End") else line[1:]
            elif name:
                sections.setdefault(name, []).append(line)
        self.names = [(int(d), int(n), text.strip('"')) for d, n,
                      text in (line.split(" ", 2) for line in sections["PhysicalNames"][1:])]
        self.nodes, self.elements = {}, {1: [], 2: [], 15: []}
        rows = iter(sections["Nodes"][1:])
        for row in rows:
            numbers = [int(next(rows)) for _ in range(int(row.split()[3]))]
            for n in numbers:
                self.nodes[n] = tuple(map(float, next(rows).split()))
        rows = iter(sections["Elements"][1:])
        for row in rows:
            _, entity, kind, n = map(int, row.split())
            for _ in range(n):
                self.elements[kind].append((entity, [self.nodes[int(x)] for x in next(rows).split()[1:]]))
        counts = list(map(int, sections["Entities"][0].split()))
        curves = [line.split() for line in sections["Entities"][1 + counts[0]:1 + counts[0] + counts[1]]]
        self.curve_tags = {int(c[0]): list(map(int, c[8:8 + int(c[7])])) for c in curves}


def length(points):
    return sum((a - b) ** 2 for a, b in zip(*points, strict=True)) ** 0.5


class EntityGroups(ToolTest):
    """Groups of edges and vertices through the whole chain."""

    def chain(self, n_ranks=1, **options):
        (self.folder / "groups.toml").write_text(BOX)
        return make_chain(MODELS / "box.step", self.folder / f"np{n_ranks}", n_ranks,
                          import_options=["--groups", self.folder / "groups.toml"], **options)

    def test_every_artifact_holds_them_whatever_the_number_of_ranks(self):
        sizes = self.folder / "sizes.toml"
        sizes.write_text('[[size]]\ngroups = ["outline", "bc:uprights"]\nlmax = 2\n[[size]]\ngroups = "corner"\nlmax = '
                         '1\n')
        options = {"raster_options": [*COARSE["raster_options"], "--sizes", sizes]}
        one, three = self.chain(**options), self.chain(3, **options)
        self.assertEqual(content_hash(one / "raster.hdf"), content_hash(three / "raster.hdf"))
        for artifact in ("geometry.hdf", "patches.hdf", "mesh.hdf"):
            self.assertEqual(content_hash(one / artifact), content_hash(three / artifact))
            json = must("st-info", one / artifact, "--groups", "--json").json()
            groups = {(t["table"], g["name"]): g for t in json["tables"] for g in t["groups"]}
            self.assertEqual(len(groups["main", "outline"]["edges"]), 4, artifact)
            self.assertEqual(groups["main", "outline"]["attributes"], {"note": "sharp"})
            self.assertEqual(len(groups["bc", "uprights"]["edges"]), 4)
            self.assertEqual(len(groups["main", "corner"]["vertices"]), 1)
        text = must("st-info", one / "mesh.hdf", "--groups").out
        self.assertIn('"outline", {"note":"sharp"}: 4 edges: ', text)
        self.assertIn('"corner": 1 vertex: ', text)

    def test_exports_have_their_lines_and_points_or_say_what_is_lost(self):
        folder = self.chain(**COARSE)
        for suffix in ("msh", "vtu", "obj", "ply"):
            self.assertEqual(must("st-export", folder / "mesh.hdf", "-o", folder / f"m.{suffix}").err, "")
        for suffix in ("stl", "ascii.stl", "fro"):
            self.assertIn("groups of edges and vertices (3)",
                          must("st-export", folder / "mesh.hdf", "-o", folder / f"m.{suffix}").err)
        self.assertIn("groups of edges and vertices (3)",
                      must("st-merge", folder / "patches.hdf", "-o", folder / "again.hdf", "--export",
                           folder / "m.stl").err)
        msh = MshFile(folder / "m.msh")
        number = {name: (dim, n) for dim, n, name in msh.names}
        self.assertEqual((number["outline"][0], number["group_bc:uprights"][0], number["corner"][0]), (1, 1, 0))
        self.assertEqual(len({n for _, n in number.values()}), len(number), "a number stands for one thing")
        on = lambda name: [points for entity, points in msh.elements[1]
                           if number[name][1] in msh.curve_tags[entity]]  # noqa: E731
        self.assertAlmostEqual(sum(map(length, on("outline"))), 200, places=9)
        self.assertAlmostEqual(sum(map(length, on("group_bc:uprights"))), 120, places=9)
        self.assertTrue(all(z == 20 for points in on("outline") for _, _, z in points))
        self.assertEqual([points for _, points in msh.elements[15]], [[(60, 40, 20)]])
        info = must("st-check", folder / "m.msh", "--geometry", folder / "geometry.hdf", "--json").json()
        self.assertEqual(info["triangles"], len(msh.elements[2]), "lines and points do not disturb who reads triangles")

    def test_sizes_are_asked_for_on_edges_and_at_vertices(self):
        folder = self.chain(**COARSE)
        shortest = {}
        for key, name in (("edges", "outline"), ("groups", "outline"), ("groups", "bc:up*"), ("groups", "corner"),
                          ("", "")):
            (self.folder / "sizes.toml").write_text('[[size]]\nlmax = "10%"\n' +
                                                    (f'[[size]]\n{key} = "{name}"\nlmax = 1\n' if key else ""))
            must("st-raster", folder / "geometry.hdf", "-o", self.folder / "r.hdf", *COARSE["raster_options"],
                 "--sizes", self.folder / "sizes.toml")
            must("st-prolong", self.folder / "r.hdf", "-o", self.folder / "s.hdf")
            must("st-mesh", folder / "geometry.hdf", self.folder / "s.hdf", "-o", self.folder / "p.hdf")
            must("st-merge", self.folder / "p.hdf", "-o", self.folder / "m.hdf", "--export", self.folder / "m.msh")
            msh = MshFile(self.folder / "m.msh")
            at = lambda p: min(length((p, q)) for q in msh.nodes.values() if q != p)  # noqa: E731
            shortest[key, name] = [round(at(p), 1) for p in ((60, 40, 20), (0, 0, 20), (60, 0, 0), (0, 0, 0))]
        plain = shortest["", ""]
        fine = {k: [a < 0.5 * b for a, b in zip(v, plain, strict=True)] for k, v in shortest.items()}
        self.assertEqual(fine["edges", "outline"], [True, True, False, False], shortest)
        self.assertEqual(fine["groups", "outline"], [True, True, False, False])
        self.assertEqual(fine["groups", "bc:up*"], [False, True, False, True])
        self.assertEqual(fine["groups", "corner"], [True, False, False, False])

    def test_remeshing_keeps_the_segments_of_a_group_of_edges(self):
        folder = self.chain(**COARSE)
        must("st-prolong", folder / "raster.hdf", "-o", folder / "fine.hdf", "--scale", "0.5")
        segments = {}
        for name, options in (("before", None), ("kept", ["--keep", "outline"]), ("free", [])):
            mesh = folder / "mesh.hdf" if options is None else folder / f"{name}.hdf"
            if options is not None:
                for n_ranks in (1, 3):
                    must("st-remesh", folder / "mesh.hdf", folder / "geometry.hdf", folder / "fine.hdf", "--merged",
                         folder / f"{name}{n_ranks}.hdf",
                         *options, "--np", n_ranks)
                self.assertEqual(content_hash(folder / f"{name}1.hdf"), content_hash(folder / f"{name}3.hdf"))
                mesh = folder / f"{name}1.hdf"
            must("st-check", mesh, "--geometry", folder / "geometry.hdf")
            must("st-export", mesh, "-o", folder / f"{name}.msh")
            msh = MshFile(folder / f"{name}.msh")
            number = {n: k for _, k, n in msh.names}
            segments[name] = {g: sorted(p for e, p in msh.elements[1] if number[g] in msh.curve_tags[e])
                              for g in ("outline", "group_bc:uprights")}
        self.assertEqual(segments["kept"]["outline"], segments["before"]["outline"])
        self.assertGreater(len(segments["free"]["outline"]), 1.5 * len(segments["before"]["outline"]))
        self.assertGreater(len(segments["kept"]["group_bc:uprights"]), len(segments["before"]["group_bc:uprights"]),
                           "other edges are redone")
        self.expect_error(USAGE, "st-remesh", folder / "mesh.hdf", folder / "geometry.hdf", folder / "fine.hdf",
                          "--keep", "corner",
                          says=["corner", "group of vertices"])
        self.expect_error(USAGE, "st-mesh", folder / "geometry.hdf", folder / "fine.hdf", "--group", "outline", "-o",
                          folder / "p.hdf",
                          says=["outline", "group of edges"])

    def test_names_of_a_table_are_one_groups(self):
        (self.folder / "groups.toml").write_text(BOX + '[[group]]\nof = "edges"\nname = "top"\nedges = 1\n')
        self.expect_error(USAGE, "st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--groups",
                          self.folder / "groups.toml",
                          says=["groups.toml:19", "group of faces of this name"])


def far_field(tolerance):
    """The cube of 100: its faces meet at one of two corners. Numbers of faces change when the inner cube becomes a
    void."""
    corners = ("[-51, -51, -51, -49, -49, -49]", "[49, 49, 49, 51, 51, 51]")
    return "".join(f'[[group]]\nname = "far field"\ntouching = {box}\n' +
                   (f"tolerance = {tolerance}\n" if tolerance else "") for box in corners)


class Tolerances(ToolTest):
    """A cube in a far field of loose faces, with gaps of 0.05 and 0.5: the far field has a tolerance of its own."""

    def imported(self, tolerance, *options):
        (self.folder / "groups.toml").write_text(far_field(tolerance))
        run = must("st-import", MODELS / "gappy_boxes.brep", "-o", self.folder / "geometry.hdf", "--groups",
                   self.folder / "groups.toml", "--json", *options)
        return run.json()

    def meshed(self, *check_options, lengths=("--lmin", "2", "--lmax", "10")):
        must("st-raster", self.folder / "geometry.hdf", "-o", self.folder / "raster.hdf", *lengths)
        must("st-prolong", self.folder / "raster.hdf", "-o", self.folder / "sizing.hdf")
        must("st-mesh", self.folder / "geometry.hdf", self.folder / "sizing.hdf", "-o", self.folder / "patches.hdf")
        must("st-merge", self.folder / "patches.hdf", "-o", self.folder / "mesh.hdf")
        return Run("st-check", self.folder / "mesh.hdf", "--geometry", self.folder / "geometry.hdf", "--json",
                   *check_options)

    def test_sews_the_far_field_and_leaves_the_body_as_it_is(self):
        self.assertEqual(self.imported(0)["free_edges"], 16)
        self.assertEqual(self.imported(0.1)["free_edges"], 16)
        self.assertEqual(self.imported(1)["free_edges"], 8)
        self.assertEqual(self.imported(1, "--sew", "1")["free_edges"], 0)
        run = self.meshed()
        self.assertEqual(run.code, OK, run)

    def test_a_mesh_off_its_surfaces_by_more_than_the_tolerance_of_their_group_fails(self):
        self.imported(0.1, "--sew", "1")
        run = self.meshed()
        self.assertEqual(run.code, INCOMPLETE, run)
        self.assertEqual(run.json()["failed"], ["group-tolerance"])
        self.imported(0, "--sew", "1")
        self.assertEqual(self.meshed().code, OK)

    def test_explains_the_volume_that_sewn_gaps_change(self):
        (self.folder / "groups.toml").write_text('[[group]]\nname = "all"\ntouching = [-1, -1, -1, 2, 2, 2]\n'
                                                 'tolerance = 0.05\n')
        for options in (["--groups", self.folder / "groups.toml"], ["--sew", "0.05"]):
            run = must("st-import", MODELS / "gappy_cube.brep", "-o", self.folder / "geometry.hdf", "--json", *options)
            self.assertEqual(run.json()["free_edges"], 0)
            check = self.meshed(lengths=("--lmax", "0.1"))
            self.assertEqual(check.code, OK, check)
            self.assertGreater(check.json()["volume_difference"], 0.008, "the top is 0.02 above the sides")
            text = must("st-check", self.folder / "mesh.hdf", "--geometry", self.folder / "geometry.hdf", "-v").out
            explained = re.search(r"mesh volume / CAD volume .* (\S+) %", text)
            self.assertLess(float(explained[1]), 3, "no more than the gaps leave open")

    def test_refuses_a_group_by_numbers_that_repairs_changed(self):
        (self.folder / "groups.toml").write_text('[[group]]\nname = "far field"\nfaces = "7-12"\ntolerance = 1\n')
        self.expect_error(USAGE, "st-import", MODELS / "gappy_boxes.brep", "-o", self.folder / "g.hdf", "--groups",
                          self.folder / "groups.toml", "--sew", "1",
                          says=["was sewn by the tolerance of a group", "new numbers"])

    def test_takes_the_place_of_the_largest_deviation(self):
        for tolerance, bound, code in ((None, "0.001", INCOMPLETE), (5, "0.001", OK), (None, "5", OK),
                                       (0.001, "5", INCOMPLETE)):
            (self.folder / "g.toml").write_text('[[group]]\nname = "ball"\nfaces = 1\n' +
                                                (f"tolerance = {tolerance}\n" if tolerance else ""))
            make_chain(MODELS / "sphere.brep", self.folder, import_options=["--groups", self.folder / "g.toml"],
                       **COARSE)
            run = Run("st-check", self.folder / "mesh.hdf", "--geometry", self.folder / "geometry.hdf",
                      "--max-deviation", bound, "--json")
            self.assertEqual(run.code, code, run)
            self.assertEqual(run.json()["failed"], [] if code == OK else ["max-deviation"])

    def test_decides_what_is_merged_for_meshing(self):
        for tolerance, n_edges in ((None, 0), (0.3, 4)):
            (self.folder / "g.toml").write_text('[[group]]\nname = "all"\nfaces = "1-6"\n' +
                                                (f"tolerance = {tolerance}\n" if tolerance else ""))
            folder = make_chain(MODELS / "thin_plate.brep", self.folder,
                                import_options=["--groups", self.folder / "g.toml"],
                                raster_options=["--lmin", "2", "--lmax", "2"])
            run = must("st-mesh", folder / "geometry.hdf", folder / "sizing.hdf", "-o", folder / "p.hdf", "--json")
            self.assertEqual(len(run.json()["merged"]["edges"]), n_edges, run)

    def test_stays_within_what_a_flow_domain_makes_anew(self):
        (self.folder / "groups.toml").write_text('[[group]]\nname = "far field"\ngroups = "farfield"\ntolerance = 1\n'
                                                 '[[group]]\nname = "body"\nfaces = "1-6"\ntolerance = "2mm"\n')
        json = must("st-import", MODELS / "box.step", "-o", self.folder / "g.hdf", "--groups",
                    self.folder / "groups.toml", "--farfield", "box:2", "--json").json()
        self.assertEqual(json["free_edges"], 0)
        self.assertEqual([f["entity"] for f in json["findings"]
                          if f["what"].startswith("tolerance not used for sewing")], ['group "body"'])
        _, info = groups_of(self.folder / "g.hdf")
        self.assertEqual({g["name"]: g["attributes"]["tolerance"] for g in info["tables"][0]["groups"]},
                         {"body": 2, "far field": 1})


class Names(ToolTest):
    """A STEP file is text: names in every encoding are put into that of the assembly."""

    CASES = {
        "Flügel": ["Flügel".encode(), "Flügel".encode("latin-1"),
                   rb"Fl\X2\00FC\X0\gel", rb"Fl\X\FCgel", rb"Fl\S\|gel"],
        "主翼表面": ["主翼表面".encode(), "主翼表面".encode("shift-jis"),
                 rb"\X2\4E3B7FFC88689762\X0\ "[:-1]],
        "🚀": ["🚀".encode(), rb"\X4\0001F680\X0\ "[:-1]],
        "aile – 5 €": ["aile – 5 €".encode("cp1252")],
    }

    def test_survive_as_utf8_in_geometry_mesh_and_exports(self):
        step = (MODELS / "assembly.step").read_bytes()
        for name, forms in self.CASES.items():
            for n, form in enumerate(forms):
                with self.subTest(name, form=form):
                    model = self.folder / "m.step"
                    model.write_bytes(step.replace(b"('pin_mantle'", b"('" + form +
                                                   b"'").replace(b"PRODUCT('pin','pin'", b"PRODUCT('pin','" + form +
                                                                 b"'"))
                    must("st-import", model, "-o", self.folder / "geometry.hdf")
                    tables, json = groups_of(self.folder / "geometry.hdf")
                    self.assertEqual(list(json["face_names"]), [name])
                    self.assertIn(f"assembly/{name}#1", [p["path"] for p in json["parts"]])
                    if n == len(forms) - 1:
                        self.expect_in_exports(model, name)

    def expect_in_exports(self, model, name):
        make_chain(model, self.folder, **COARSE)
        _, json = groups_of(self.folder / "mesh.hdf")
        self.assertEqual(list(json["face_names"]), [name])
        for suffix, text in (("vtu", f'Name="face:{name}"'), ("msh", f'"{name}"'),
                             ("ascii.stl", f"solid {name.replace(' ', '_')}\n"), ("ply", f" {name}\n")):
            must("st-export", self.folder / "mesh.hdf", "-o", self.folder / f"mesh.{suffix}")
            self.assertIn(text.encode(), (self.folder / f"mesh.{suffix}").read_bytes(), suffix)

    def test_of_iges_faces_and_parts_are_read_in_every_encoding(self):
        iges = corpus_file(self, "aero_d150_wing.igs").read_bytes()
        for name, form in (("Bottom", b"Bottom"), ("Flügel", "Flügel".encode("latin-1")),
                           ("主翼上", "主翼上".encode("shift-jis")), ("翼主", "翼主".encode())):
            with self.subTest(name):
                named = iges.replace(b"6HBottom", b"6H" + form).replace(b"D150_wing_1ID", form + b"_wi_1ID")
                (self.folder / "m.igs").write_bytes(named)
                must("st-import", self.folder / "m.igs", "-o", self.folder / "g.hdf")
                tables, json = groups_of(self.folder / "g.hdf")
                self.assertEqual({n: len(f) for n, f in tables["main"].items()},
                                 {name: 3, "Top": 3, "Inside": 1, "Outside": 1})
                self.assertEqual([p["name"] for p in json["parts"]], [name + "_wi_1ID"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
