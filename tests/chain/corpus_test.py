"""The chain with no option but the file name, on real CAD files (ST_CORPUS, by default ../shared/corpus beside the
repository): a mesh that passes st-check and, where it is there, the independent judge ../tools/meshcheck.sh beside the
corpus."""
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from chain import CORPUS, ToolTest, main_on_corpus, make_chain, must  # noqa: E402

FAST = [
    "aero_onera_m6_sharpte.brep",
    "aero_evtol_bet.brep",
    "aero_d150_wing.igs",
    "mech_netgen_screw.step",
    "mech_as1_oc_214.stp",
    "mech_occt_linkrods.step",
    "basic_refine_sphere_cube.brep",
    "basic_refine_cone_cone.brep",
    "aero_d150_wing_body_half.brep",
]


class Corpus(ToolTest):
    def check(self, name):
        folder = make_chain(CORPUS / name, self.folder / "chain", n_ranks=2)
        must("st-check", folder / "mesh.hdf", "--geometry", folder / "geometry.hdf", "--sizing", folder / "sizing.hdf",
             "--max-free-sharp", 0)
        judge = CORPUS.parent / "tools" / "meshcheck.sh"
        if not judge.exists():
            print(f"SKIPPED: judge not found beside the corpus, {name} was checked by st-check alone", flush=True)
            return
        done = subprocess.run([judge, folder / "mesh.hdf", "--cad", CORPUS / name], capture_output=True, text=True,
                              timeout=600)
        self.assertEqual(done.returncode, 0, f"{name}: {done.stdout} {done.stderr}")


if __name__ == "__main__":
    main_on_corpus(Corpus, [(name,) for name in FAST])
