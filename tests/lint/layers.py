#!/usr/bin/env python3
"""Proves the layering of the house: who includes what, and how long a main is.

usage: layers.py SOURCE_DIR              exit 1 and one line per violation
       layers.py SOURCE_DIR --self-test  plants one violation of each rule in a copy and expects to find it
"""
import re
import shutil
import sys
import tempfile
from pathlib import Path

# Each layer and the layers it may include, itself apart.
BELOW = {
    "base": set(),
    "geometry": {"base"},
    "mesh": {"base"},
    "comm": {"base"},
    "sizing": {"base", "geometry", "mesh"},
    "meshing": {"base", "geometry", "mesh", "sizing"},
    "io": {"base", "geometry", "mesh", "sizing"},
    "stages": {"base", "geometry", "mesh", "comm", "sizing", "meshing", "io"},
}
# Third-party headers and their home. The home keeps them out of its public headers, unless it is a tool.
HOMES = {
    "MPI": (re.compile(r"^(mpi|mpi_.*)\.h$"), "comm"),
    "HDF5": (re.compile(r"^(hdf5|H5.*|hdf5_hl)\.h(pp)?$"), "io"),
    "OpenCASCADE": (re.compile(r"^opencascade/.*|.*\.(hxx|lxx|gxx)$"), "geometry"),
    "CLI11": (re.compile(r"^CLI/.*|^CLI11\.hpp$"), "tools"),
    "toml++": (re.compile(r"^toml(\+\+)?/.*|^toml\.hpp$"), "tools or io"),
}
EIGEN_HOME = "lib/base/eigen.h"  # includes Eigen for all others, which use its fixed sizes alone
EIGEN_HEADER = re.compile(r"^(unsupported/)?Eigen/")
EIGEN_DYNAMIC = re.compile(r"\bEigen::(Dynamic|(Matrix|RowVector|Vector|Array)X)")
MAIN_LIMIT = 80
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
SUFFIXES = {".h", ".hpp", ".cpp", ".cc", ".inl"}


def includes(path):
    """(line number, header) of every include of a file."""
    text = path.read_text(encoding="utf-8", errors="replace")
    return [(text.count("\n", 0, m.start()) + 1, m.group(1)) for m in INCLUDE.finditer(text)]


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in SUFFIXES) if folder.is_dir() else []


def public_headers(root, layer):
    """Headers of a layer that another layer, a tool or a header of this kind includes."""
    users = [p for p in sources(root / "lib") + sources(root / "tools") if p.parts[len(root.parts):][:2] != ("lib", layer)]
    used = {h for p in users for _, h in includes(p) if h.startswith(layer + "/")}
    while True:
        more = {h for u in used if (root / "lib" / u).is_file() for _, h in includes(root / "lib" / u) if h.startswith(layer + "/")}
        if more <= used:
            return used
        used |= more


def foreign_violations(root, home_of):
    """home_of(path) names the layer, or tools, a file belongs to."""
    public = {f"lib/{h}" for layer in BELOW for h in public_headers(root, layer)}
    for path in sources(root / "lib") + sources(root / "tools"):
        where = str(path.relative_to(root))
        for line, header in includes(path):
            for package, (pattern, home) in HOMES.items():
                if not pattern.match(header):
                    continue
                if home_of(path) not in home.split(" or "):
                    yield f"{where}:{line}: {header} of {package} may only be included in {home}"
                elif where in public:
                    yield f"{where}:{line}: {header} of {package} in a public header"


def layer_violations(root, home_of):
    for path in sources(root / "lib"):
        layer, where = home_of(path), path.relative_to(root)
        if layer not in BELOW:
            yield f"{where}: unknown layer {layer}"
            continue
        for line, header in includes(path):
            target = header.split("/")[0]
            if "/" in header and target in BELOW and target != layer and target not in BELOW[layer]:
                yield f"{where}:{line}: {layer} must not include {header}"
            if "/" in header and target in {"common", "tools"} | {p.name for p in (root / "tools").glob("st-*")}:
                yield f"{where}:{line}: a library must not include {header}"


def eigen_violations(root):
    for path in sources(root / "lib") + sources(root / "tools"):
        where = str(path.relative_to(root))
        for line, header in includes(path):
            if EIGEN_HEADER.match(header) and where != EIGEN_HOME:
                yield f"{where}:{line}: {header} may only be included in {EIGEN_HOME}"
        text = path.read_text(encoding="utf-8", errors="replace")
        for m in EIGEN_DYNAMIC.finditer(text):
            line = text.count("\n", 0, m.start()) + 1
            yield f"{where}:{line}: {m.group()}: only matrices of fixed size are used"


def main_violations(root):
    for path in sorted((root / "tools").glob("st-*/main.cpp")):
        n_lines = len(path.read_text(encoding="utf-8").splitlines())
        if n_lines >= MAIN_LIMIT:
            yield f"{path.relative_to(root)}: {n_lines} lines; a main has less than {MAIN_LIMIT}"
    for path in sources(root / "lib"):
        if re.search(r"^\s*int\s+main\s*\(", path.read_text(encoding="utf-8", errors="replace"), re.M):
            yield f"{path.relative_to(root)}: main in a library"


def violations(root):
    def home_of(path):
        parts = path.relative_to(root).parts
        return parts[1] if parts[0] == "lib" else "tools"

    found = [*foreign_violations(root, home_of), *layer_violations(root, home_of)]
    return [*found, *eigen_violations(root), *main_violations(root)]


PLANTS = {
    "lib/meshing/planted.cpp": "#include <mpi.h>\n",
    "lib/sizing/planted.cpp": '#include "hdf5.h"\n',
    "lib/mesh/planted.cpp": "#include <TopoDS_Face.hxx>\n",
    "lib/stages/planted.cpp": "#include <CLI/CLI.hpp>\n",
    "tools/st-info/planted.cpp": "#include <BRep_Tool.hxx>\n",
    "lib/base/planted.cpp": '#include "geometry/model.h"\n',
    "lib/geometry/planted.cpp": '#include "mesh/surface_mesh.h"\n',
    "lib/comm/planted.cpp": '#include "sizing/size_field.h"\n',
    "lib/io/planted.cpp": '#include "comm/communicator.h"\n',
    "lib/mesh/planted_eigen.cpp": "#include <Eigen/Dense>\n",
    "lib/sizing/planted_dynamic.cpp": "Eigen::MatrixXd m;\n",
    "lib/mesh/planted_main.cpp": "int main() {}\n",
    "tools/st-planted/main.cpp": "\n" * MAIN_LIMIT,
    "lib/odd/planted.cpp": "\n",
}


def self_test(root):
    """Every planted violation is found, each in its own file, and so is a foreign header in a public one."""
    missed = []
    for name, text in PLANTS.items():
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder)
            for part in ("lib", "tools"):
                shutil.copytree(root / part, copy / part)
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            (copy / name).write_text(text)
            if not any(v.startswith(name) for v in violations(copy)):
                missed.append(name)
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        for part in ("lib", "tools"):
            shutil.copytree(root / part, copy / part)
        header = copy / "lib/comm/communicator.h"
        header.write_text("#include <mpi.h>\n" + header.read_text())
        if not any("public header" in v for v in violations(copy)):
            missed.append("mpi.h in lib/comm/communicator.h")
    return [f"self test: planted violation not found: {m}" for m in missed]


def main():
    root = Path(sys.argv[1]).resolve()
    found = self_test(root) if "--self-test" in sys.argv[2:] else violations(root)
    print("\n".join(found) or "no violation")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
