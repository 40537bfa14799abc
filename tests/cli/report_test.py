"""st-report: one file that holds everything, and, where Chromium is installed, a page whose controls work."""
import base64
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import INCOMPLETE, INPUT, MODELS, USAGE, Run, ToolTest, artifacts_of, must  # noqa: E402

# What a person does, and what the page must then show; printed into its title, which --dump-dom gives.
PROBE = """<script>
const said = {};
addEventListener("error", e => { said.error = e.message; });
function coloured() {
  draw();
  const p = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, p);
  let n = 0;
  for (let i = 0; i < p.length; i += 4) if (p[i] + p[i + 1] + p[i + 2] < 740) ++n;
  return n / (p.length / 4);
}
setTimeout(() => {
  said.verdict = $("verdict").textContent;
  said.checks = $("checks").innerText;
  if (gl) {
    said.shown = coloured();
    const seen = [...document.querySelectorAll("#groups input")].filter(box => box.checked);
    for (const box of seen) box.click();
    said.hidden = coloured();
    for (const box of seen) box.click();
    $("none").click();
    said.none = coloured();
    $("all").click();
    said.all = [...document.querySelectorAll("#groups input")].every(box => box.checked) && coloured() > 0;
    for (const box of document.querySelectorAll("#groups input")) if (!seen.includes(box)) box.click();
    slow.drawing = 1000; isMoving = true;
    said.while_moving = coloured();
    isMoving = false;
    if (check) { $("by").value = "quality"; $("by").onchange(); }
    said.legend = $("legend").textContent;
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "+" }));
    const half = camera.half, yaw = camera.yaw;
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    said.turned = camera.yaw !== yaw;
    if (meta.sizes) {
      if (check) { $("by").value = "cause"; $("by").onchange(); }
      said.causes = $("legend").textContent;
      const before = coloured();
      $("sliced").checked = true; $("axis").value = "z"; $("axis").onchange();
      said.cells = slice.count / 6;
      said.plane = $("at").textContent;
      said.covered = coloured() - before;
      $("sliced").checked = false; $("sliced").onchange();
      said.cleared = coloured() - before;
    }
    canvas.setPointerCapture = () => {};  // made for real pointers
    said.out = axes().out;
    lookFrom("+z");
    said.from_above = axes().out;
    lookFrom("");
    const pick = (x, y) => {
      const at = { clientX: x, clientY: y, bubbles: true };
      for (const type of ["pointerdown", "pointerup"]) canvas.dispatchEvent(new PointerEvent(type, at));
      canvas.dispatchEvent(new MouseEvent("click", at));
    };
    $("lined").checked = false;
    const all = canvas.getBoundingClientRect(), pixel = 2 * camera.half / all.height;
    const middle = f => ballOf(f).centre.map((x, k) => x - camera.focus[k]);
    const onScreen = c => [all.left + all.width / 2 + dot(axes().right, c) / pixel,
      all.top + all.height / 2 - dot(axes().up, c) / pixel];
    const target = cadFaces.map(f => onScreen(middle(f))).find(([x, y]) => faceAt(x, y));
    $("lined").checked = true;
    said.edges_in_front = cadEdges.filter(e => {
      const middle = [0, 1, 2].map(k => (lineEnds[6 * e.first + k] + lineEnds[6 * (e.first + e.count) - 3 + k]) / 2);
      const at = onScreen(middle.map((x, k) => x - camera.focus[k]));
      return edgeAt(...at, faceAt(...at)) === e;
    }).length;
    said.edges = cadEdges.length;
    $("lined").checked = false;
    if (target) {
      pick(...target);
      said.picked_face = $("picked_faces").textContent;
      said.face_rule = $("rule").textContent;
      $("meaning_of_faces").value = "size"; $("meaning_of_faces").onchange();
      said.size_rule = $("rule").textContent;
      $("takes").value = "group";
      pick(...target); pick(...target);
      said.group_rule = $("rule").textContent;
      pick(...target);
      said.no_face = $("picked").hidden;
      $("meaning_of_faces").value = "";
      hovering = target; sayUnder(); hovering = null;
      said.under = $("under").textContent;
      const [named, wild, same] = [[1, "a"], [1, "a*"], [2, "a"]].map(([number, name]) => ({ number, name }));
      const three = [1, 2, 4].map(number => ({ number, name: "" }));
      said.listed = [[three, []], [[named], [named]], [[wild], [wild]], [[named], [named, same]]]
        .map(([chosen, all]) => listed(chosen, all));
    }
    const raw = [...document.querySelectorAll("pre")].filter(e => !e.closest("details"));
    said.json_shown = raw.some(e => e.textContent.includes("{"));
    said.asked = $("asked").textContent;
    said.compared = $("compared").textContent;
    said.charts = $("charts").textContent;
    said.surfaces = document.querySelectorAll("#wings figure").length;
    if (cadEdges.length) {
      $("lined").checked = true;
      const box = canvas.getBoundingClientRect(), s = 2 * camera.half / box.height, { right, up } = axes();
      const i = 6 * cadEdges[0].first, middle = k => (lineEnds[i + k] + lineEnds[i + 3 + k]) / 2 - camera.focus[k];
      const on = axis => [0, 1, 2].reduce((sum, k) => sum + axis[k] * middle(k), 0) / s;
      const place = { clientX: box.left + box.width / 2 + on(right), clientY: box.top + box.height / 2 - on(up),
        bubbles: true };
      const click = () => {
        for (const type of ["pointerdown", "pointerup"]) canvas.dispatchEvent(new PointerEvent(type, place));
        canvas.dispatchEvent(new MouseEvent("click", place));
      };
      click();
      said.picked_faces = $("picked_faces").textContent;
      said.picked = $("picked_edges").textContent;
      said.rule = $("rule").textContent;
      said.on_edge = cadEdges.some(e => said.picked.startsWith("edge " + e.number));
      if (navigator.clipboard) navigator.clipboard.writeText = async text => { said.clipboard = text; };
      $("copy").click();
      said.copied = getSelection().toString();
      $("unpick").click();
      said.unpicked = $("picked").hidden;
      $("lined").checked = false;
    }
    said.wings = $("wings").textContent;
    const near = (place, half) => camera.half < half &&
      Math.hypot(...place.map((x, k) => x - camera.focus[k])) < camera.half + 0.001 * meta.diagonal;  // four digits
    if (target) {
      const under = faceAt(...target).place, half = camera.half;
      canvas.dispatchEvent(new MouseEvent("dblclick", { clientX: target[0], clientY: target[1], bubbles: true }));
      said.flown_to_double_click = near(under, half);
      $("fit").click();
    }
    const station = document.querySelector("#wings td button"), least = camera.half;
    if (station) {
      const focus = camera.focus.join();
      station.click();
      said.flown_to_station = camera.half < least && camera.focus.join() !== focus && !$("mark").hidden;
      $("fit").click();
    }
    const button = document.querySelector("#findings button");
    if (button) button.click();
    setTimeout(() => {
      const place = button && button.title.split(", ").map((x, k) => x.replaceAll(",", "") - meta.centre[k]);
      said.flown = !button || near(place, least);
      said.near = coloured();
      document.title = JSON.stringify(said);
    }, 1500);
  } else document.title = JSON.stringify(said);
}, 1500);
</script></body>"""


def script(page, name):
    return re.search(f'<script type="[^"]*" id="{name}">(.*?)</script>', page, re.S).group(1)


HEADLESS = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--force-prefers-reduced-motion", "--enable-logging=stderr", "--virtual-time-budget=8000"]


class Browser(ToolTest):
    def browse(self, file):
        """What the probe says in a browser, or None without one."""
        browser = shutil.which("chromium")
        if not browser:
            print("SKIPPED: no chromium, st-report's page was not tried in a browser", file=sys.stderr)
            return None
        probed = self.folder / "probed.html"
        probed.write_text(file.read_text(encoding="utf-8").replace("</body>", PROBE), encoding="utf-8")
        done = subprocess.run([browser, *HEADLESS, "--window-size=1300,900",
                               f"--user-data-dir={self.folder / 'browser'}", "--dump-dom", f"file://{probed}"],
                              capture_output=True, text=True, timeout=120)
        title = re.search("<title>(.*?)</title>", done.stdout, re.S)
        self.assertTrue(title and title.group(1).startswith("{"), done.stdout[-500:] + done.stderr[-500:])
        console = [line for line in done.stderr.splitlines() if "CONSOLE" in line and "GPU stall" not in line]
        self.assertEqual(console, [])
        return json.loads(title.group(1).replace("&quot;", '"').replace("&amp;", "&"))

    def expect_groups_to_be_switched(self, said):
        self.assertEqual((said["hidden"], said["none"], said["all"]), (0, 0, True), said)

    def expect_one_printed_page(self, file):
        browser = shutil.which("chromium")
        if not browser:
            self.skipTest("no chromium")
        pdf = self.folder / "page.pdf"
        subprocess.run([browser, *HEADLESS, f"--user-data-dir={self.folder / 'browser'}", "--no-pdf-header-footer",
                        f"--print-to-pdf={pdf}", f"file://{file}"], capture_output=True, timeout=120, check=True)
        self.assertEqual(len(re.findall(rb"/Type\s*/Page\b(?!s)", pdf.read_bytes())), 1)


class Report(Browser):
    def report(self, model, *options):
        made = artifacts_of(model)
        file = self.folder / "report.html"
        must("st-report", made / "mesh.hdf", "-o", file, *options)
        return made, file

    def test_holds_the_whole_mesh_and_refers_to_nothing_else(self):
        made, file = self.report("two_boxes")
        page = file.read_text(encoding="utf-8")
        counts = json.loads(must("st-info", made / "mesh.hdf", "--json").out.splitlines()[-1])["counts"]
        corners = base64.b64decode(script(page, "corners"))
        nodes = base64.b64decode(script(page, "nodes"))
        self.assertEqual(len(corners), 12 * counts["triangles"])
        self.assertEqual(len(nodes), 12 * counts["nodes"])
        self.assertLess(max(struct.unpack(f"<{len(corners) // 4}I", corners)), counts["nodes"])
        meta = json.loads(script(page, "meta"))
        self.assertEqual(sum(g["count"] for g in meta["groups"]), counts["triangles"])
        self.assertEqual(meta["values"], ["quality", "size_ratio"])
        outside = re.sub(r'"http://www\.w3\.org/[^"]*"', "", page)
        self.assertEqual(re.findall(r"https?://.{30}|src=.{30}|@import|url\(", outside), [])

    def test_geometry_and_sizing_add_what_they_know(self):
        made = artifacts_of("two_boxes")
        _, file = self.report("two_boxes", "--geometry", made / "geometry.hdf", "--sizing", made / "sizing.hdf")
        page = file.read_text(encoding="utf-8")
        self.assertEqual(json.loads(script(page, "meta"))["values"], ["quality", "size_ratio", "deviation"])
        check = json.loads(script(page, "check"))
        self.assertIn("causes", check)
        self.assertIn("all", check["sizes"])

    def test_controls_work_in_a_browser(self):
        made = artifacts_of("two_boxes")
        _, file = self.report("two_boxes", "--geometry", made / "geometry.hdf", "--sizing", made / "sizing.hdf")
        said = self.browse(file)
        if said is None:
            return
        self.assertNotIn("error", said)
        self.assertIn("passes all checks", said["verdict"])
        self.assertGreater(said["shown"], 0.05, said)
        self.expect_groups_to_be_switched(said)
        self.assertTrue(said["flown_to_double_click"], said)
        self.assertAlmostEqual(said["while_moving"], said["shown"], delta=0.1 * said["shown"])
        self.assertIn("Quality", said["legend"])
        self.assertTrue(said["turned"] and said["flown"], said)
        self.assertGreater(said["near"], 0.05, said)
        self.assertIn("the largest length", said["causes"])
        self.assertGreater(said["cells"], 10, said)
        self.assertRegex(said["plane"], r"^z = \S+ mm$")
        self.assertGreater(said["covered"], 0.02, said)
        self.assertAlmostEqual(said["cleared"], 0, delta=0.001)
        self.assertTrue(said["on_edge"] and said["unpicked"], said)
        self.assertRegex(said["rule"], r"^\[\[size\]\]\nedges = \d+\ntrailing_edge = true$")
        self.assertEqual(said["copied"].split(), said["rule"].split())
        self.assertEqual(said.get("clipboard", said["rule"]), said["rule"])
        self.assertEqual(said["picked_faces"], "", "a click on an edge takes no face behind it")
        self.assertEqual(said["wings"], "")
        self.expect_faces_to_be_picked(said)
        self.assertLessEqual(said["edges_in_front"], said["edges"] - 6, "three of each box are behind it")
        self.assertGreater(said["edges_in_front"], 6, said)

    def expect_faces_to_be_picked(self, said):
        self.assertRegex(said["picked_face"], r"^face \d+.*, group .*, area \S+ mm²$")
        self.assertIn(said["picked_face"], said["under"])
        self.assertRegex(said["face_rule"], r'^\[\[group\]\]\nname = "my group"\nfaces = (\d+|".+")$')
        self.assertRegex(said["size_rule"], r'^\[\[size\]\]\nfaces = .+\nlmax = "LENGTH"$')
        self.assertRegex(said["group_rule"], r"^\[\[size\]\]\nfaces = .+\nlmax")
        self.assertTrue(said["no_face"], said)
        self.assertEqual(said["listed"], ['["1-2", 4]', '"a"', 1, 1])

    def test_says_what_was_asked_for_and_hides_raw_data(self):
        made = artifacts_of("two_boxes")
        _, file = self.report("two_boxes", "--geometry", made / "geometry.hdf", "--sizing", made / "sizing.hdf")
        meta = json.loads(script(file.read_text(encoding="utf-8"), "meta"))
        self.assertEqual([o["tool"] for o in meta["origins"]], ["st-import", "st-raster", "st-prolong", "st-merge"])
        self.assertEqual(sum(f[1] for f in meta["faces"]), sum(g["count"] for g in meta["groups"]))
        said = self.browse(file)
        if said is None:
            return
        self.assertRegex(said["asked"], r"largest length \S+ mm.*growth of length per distance 0\.\d")
        self.assertFalse(said["json_shown"], "raw data are folded away")
        self.assertIn("requested", said["charts"])

    def test_a_preset_is_named(self):
        geometry = artifacts_of("two_boxes") / "geometry.hdf"
        must("st-raster", geometry, "--preset", "preview", cwd=self.folder)
        options = must("st-info", "raster.hdf", "--json", cwd=self.folder).json()["options"]
        self.assertEqual(options["preset"], "preview")
        must("st-report", geometry, "raster.hdf", cwd=self.folder)
        said = self.browse(self.folder / "report.html")
        if said is not None:
            self.assertIn("preset preview", said["asked"])

    def test_a_half_is_looked_at_from_outside(self):
        for side in ("y=5", "y=5-", "z=5-", "x=5"):
            must("st-import", MODELS / "box.brep", "--symmetry", side, "-o", "geometry.hdf", cwd=self.folder)
            must("st-report", "geometry.hdf", cwd=self.folder)
            said = self.browse(self.folder / "report.html")
            if said is None:
                return
            out = said["out"]["xyz".index(side[0])]
            self.assertGreater(-out if side.endswith("-") else out, 0.2, (side, said["out"]))
            self.assertAlmostEqual(said["from_above"][2], 1)

    def test_prints_on_one_page(self):
        made = artifacts_of("two_boxes")
        _, file = self.report("two_boxes", "--geometry", made / "geometry.hdf", "--sizing", made / "sizing.hdf")
        self.expect_one_printed_page(file)

    def test_a_mesh_that_passes_with_notes_says_them(self):
        _, file = self.report("touching_boxes")
        said = self.browse(file)
        if said is None:
            return
        self.assertIn("This mesh passes part by part, which touch or cross in", said["verdict"])
        self.assertRegex(said["checks"], r"contacts\s*note\s*[1-9]")

    def test_a_mesh_that_fails_gets_its_report(self):
        _, file = self.report("plate_with_hole")
        said = self.browse(file)
        if said is None:
            return
        self.assertNotIn("error", said)
        self.assertIn("does not pass: it has open edges", said["verdict"])
        self.assertTrue(said["flown"], said)

    def test_a_remeshed_mesh_shows_what_is_new(self):
        made = artifacts_of("two_boxes")
        (self.folder / "s.toml").write_text('[[source]]\ntype = "point"\nat = [0, 0, 0]\nlength = 0.5\nradius = 2\n')
        must("st-prolong", made / "raster.hdf", "--sources", "s.toml", "-o", "sizing.hdf", cwd=self.folder)
        mesh, geometry = made / "mesh.hdf", made / "geometry.hdf"
        must("st-remesh", mesh, geometry, "sizing.hdf", "--merged", "new.hdf", cwd=self.folder)
        must("st-report", "new.hdf", "--sizing", "sizing.hdf", cwd=self.folder)
        file = self.folder / "report.html"
        page = file.read_text(encoding="utf-8")
        names = json.loads(script(page, "meta"))["values"]
        self.assertEqual(names, ["quality", "size_ratio", "is_new"])
        values = base64.b64decode(script(page, "values"))
        numbers = struct.unpack(f"<{len(values) // 4}f", values)
        is_new = numbers[2 * len(numbers) // 3:]
        self.assertEqual(set(is_new), {0.0, 1.0})
        said = self.browse(file)
        self.assertNotIn("error", said or {})
        self.assertEqual((said or {}).get("compared", ""), "")
        must("st-report", "new.hdf", geometry, "sizing.hdf", "--before", mesh, cwd=self.folder)
        said = self.browse(file)
        if said is not None:
            self.assertNotIn("error", said)
            before = must("st-info", mesh, "--json").json()["counts"]["triangles"]
            self.assertRegex(said["compared"], rf"triangles kept.*triangles{before:,}")
            self.assertIn("before", said["charts"])
        self.expect_error(USAGE, "st-report", "new.hdf", "--before", geometry, "-o", "r.html", cwd=self.folder,
                          says="give a mesh")

    def test_a_mesh_with_a_face_missing_says_so(self):
        made = artifacts_of("two_boxes")
        must("st-mesh", made / "geometry.hdf", made / "sizing.hdf", "--faces", "2-6", "-o", "part.hdf", cwd=self.folder)
        must("st-merge", "part.hdf", "--allow-incomplete", "-o", "part_mesh.hdf", cwd=self.folder)
        must("st-report", "part_mesh.hdf", "--geometry", made / "geometry.hdf", cwd=self.folder)
        said = self.browse(self.folder / "report.html")
        if said is not None:
            self.assertNotIn("error", said)
            self.assertIn("faces are missing", said["verdict"])

    def test_a_run_without_a_mesh_names_the_faces_that_failed(self):
        model = MODELS / "crossed_loop.brep"
        must("st-import", model, "-o", "geometry.hdf", cwd=self.folder)
        must("st-raster", "geometry.hdf", "--allow-incomplete", cwd=self.folder)
        must("st-prolong", "raster.hdf", "--allow-incomplete", cwd=self.folder)
        run = Run("st-mesh", "geometry.hdf", "sizing.hdf", cwd=self.folder)
        self.assertEqual(run.code, INCOMPLETE, run)
        must("st-report", "patches.hdf", "geometry.hdf", "sizing.hdf", "raster.hdf", cwd=self.folder)
        file = self.folder / "report.html"
        unmeshed = json.loads(script(file.read_text(encoding="utf-8"), "meta"))["unmeshed"]
        self.assertTrue(unmeshed and all(f["cause"] and len(f["xyz"]) == 3 for f in unmeshed), unmeshed)
        self.assertTrue(all(f["is_closed"] for f in unmeshed), unmeshed)
        self.expect_nothing_left(self.folder, "geometry.hdf", "raster.hdf", "sizing.hdf", "patches.hdf",
                                 "patches.failures.hdf", "report.html")
        said = self.browse(file)
        if said is not None:
            self.assertNotIn("error", said)
            self.assertIn("closed from its edges alone", said["verdict"])
            self.assertTrue(said["flown"], said)
            self.assertGreater(said["hidden"], 0.001, "the loops of the failed face are always drawn")
            self.assertIn("loops of a face that was not meshed", said["legend"])

    def test_a_geometry_alone_shows_the_cad(self):
        made = artifacts_of("two_boxes")
        file = self.folder / "report.html"
        run = must("st-report", made / "geometry.hdf", made / "sizing.hdf", "-o", file, "--json")
        self.assertNotIn("passes", run.json())
        page = file.read_text(encoding="utf-8")
        self.assertEqual(json.loads(script(page, "check")), None)
        runs = json.loads(script(page, "meta"))["lines"]
        self.assertEqual(24 * sum(n for _, _, n in runs), len(base64.b64decode(script(page, "lines"))))
        said = self.browse(file)
        if said is None:
            return
        self.assertNotIn("error", said)
        self.assertEqual(said["verdict"], "This CAD is closed.")
        self.assertGreater(said["shown"], 0.05, said)
        self.assertEqual(said["hidden"], 0, said)
        self.assertGreater(said["covered"], 0.02, said)

    def test_st_export_writes_the_same_page(self):
        geometry = artifacts_of("two_boxes") / "geometry.hdf"
        must("st-report", geometry, "-o", self.folder / "a.html")
        must("st-export", geometry, "-o", self.folder / "b.html")
        self.assertEqual((self.folder / "a.html").read_bytes(), (self.folder / "b.html").read_bytes())

    def test_free_edges_of_the_cad_are_drawn(self):
        must("st-import", MODELS / "plate_with_hole.brep", "-o", "geometry.hdf", cwd=self.folder)
        must("st-report", "geometry.hdf", cwd=self.folder)
        said = self.browse(self.folder / "report.html")
        if said is not None:
            self.assertNotIn("error", said)
            self.assertIn("This CAD is open: 5 free edges", said["verdict"])
            self.assertIn("free edge: the CAD is open here", said["legend"])
            self.assertTrue(said["flown"], said)
            self.assertGreater(said["hidden"], 0.001, said)

    def test_artifacts_come_in_any_order_and_one_of_each_kind(self):
        made = artifacts_of("two_boxes")
        pages = []
        for files in (["mesh", "geometry", "sizing"], ["sizing", "raster", "geometry", "patches", "mesh"]):
            must("st-report", *[made / f"{name}.hdf" for name in files], "-o", "report.html", cwd=self.folder)
            page = (self.folder / "report.html").read_text(encoding="utf-8")
            arrays = ("meta", "nodes", "values", "causes", "cells", "lengths")
            pages.append({name: script(page, name) for name in arrays})
            meta = json.loads(pages[-1]["meta"])
            meta.pop("origins")  # names each file
            pages[-1]["meta"] = meta
        self.assertEqual(pages[0], pages[1])
        n_triangles = len(base64.b64decode(pages[0]["values"])) // 12
        self.assertEqual(len(base64.b64decode(pages[0]["causes"])), 2 * n_triangles)
        cells = base64.b64decode(pages[0]["cells"])
        self.assertEqual(len(cells), 3 * len(base64.b64decode(pages[0]["lengths"])))
        self.expect_error(USAGE, "st-report", made / "sizing.hdf", "-o", "r.html", says="give mesh.hdf",
                          cwd=self.folder)
        self.expect_error(USAGE, "st-report", made / "mesh.hdf", made / "mesh.hdf", "-o", "r.html",
                          says="one of each kind", cwd=self.folder)

    def test_times_are_those_that_make_wrote(self):
        made = artifacts_of("two_boxes")
        (self.folder / "st-mesh.seconds").write_text("1.250\n")
        (self.folder / "st-import.seconds").write_text("0.5\n")
        _, file = self.report("two_boxes", "--times", self.folder)
        self.assertEqual(json.loads(script(file.read_text(encoding="utf-8"), "meta"))["times"],
                         [["st-import", 0.5], ["st-mesh", 1.25]])
        (self.folder / "none").mkdir()
        self.expect_error(INPUT, "st-report", made / "mesh.hdf", "-o", self.folder / "r.html", "--times",
                          self.folder / "none", says="st-mesh.seconds")

    def test_output_must_not_be_an_input(self):
        made = artifacts_of("two_boxes")
        copy = self.folder / "mesh.hdf"
        shutil.copy(made / "mesh.hdf", copy)
        self.expect_error(USAGE, "st-report", copy, "-o", copy, says="is an input")


@unittest.skipUnless(os.environ.get("ST_AIRCRAFT"), "the test pages.report runs it")
class Aircraft(Browser):
    def test_the_report_of_the_bundled_aircraft_works(self):
        said = self.browse(Path(os.environ["ST_AIRCRAFT"]) / "report.html")
        if said is None:
            return
        self.assertNotIn("error", said)
        self.assertEqual(said["verdict"], "This mesh passes all checks.")
        self.assertGreater(said["shown"], 0.05, said)
        self.expect_groups_to_be_switched(said)
        self.assertAlmostEqual(said["while_moving"], said["shown"], delta=0.1 * said["shown"])
        self.assertTrue(said["turned"] and said["flown"] and said["flown_to_station"], said)
        self.assertGreater(said["near"], 0.05, said)
        self.assertGreater(said["cells"], 1000, said)
        self.assertIn("Lifting surfaces", said["wings"])
        self.assertEqual(said["surfaces"], 4, "a table for each")
        self.assertIn("trailing edge", said["wings"])
        self.expect_one_printed_page(Path(os.environ["ST_AIRCRAFT"]) / "report.html")


if __name__ == "__main__":
    unittest.main()
