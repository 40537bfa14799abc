#!/usr/bin/env python3
"""Proves where third-party packages are used, and how long a main is. Who includes what: house.py.

usage: layers.py SOURCE_DIR              exit 1 and one line per violation
       layers.py SOURCE_DIR --self-test  plants one violation of each rule in a copy and expects to find it
"""
import re
import sys
import tempfile

import house
from house import House, folder_of, includes, lies_in, sources

# Third-party headers. Their homes are marked in the drawing; a home in lib keeps them out of its public headers.
PACKAGES = {
    "MPI": re.compile(r"^(mpi|mpi_.*)\.h$"),
    "HDF5": re.compile(r"^(hdf5|H5.*|hdf5_hl)\.h(pp)?$"),
    "OpenCASCADE": re.compile(r"^opencascade/.*|.*\.(hxx|lxx|gxx)$"),
    "CLI11": re.compile(r"^CLI/.*|^CLI11\.hpp$"),
    "toml++": re.compile(r"^toml(\+\+)?/.*|^toml\.hpp$"),
}
EIGEN_HOME = "lib/base/eigen.h"  # includes Eigen for all others, which use its fixed sizes alone
EIGEN_SPARSE = "lib/base/sparse.cpp"  # large systems of equations
EIGEN_HEADER = re.compile(r"^(unsupported/)?Eigen/")
EIGEN_DYNAMIC = re.compile(r"\bEigen::(Dynamic|(Matrix|RowVector|Vector|Array)X)")
MAIN_LIMIT = 80


def layer_of(folder):
    return folder.split("/")[0]


def public_headers(root):
    """Headers that another layer or a tool includes, or a header of this kind of the same layer."""
    headers = {p.relative_to(root / "lib").as_posix(): p for p in sources(root / "lib")}
    users = [(layer_of(folder_of(p, root)), p) for p in sources(root / "lib")]
    users += [("", p) for p in sources(root / "tools")]
    public = {h for layer, p in users for _, h in includes(p) if h in headers and layer_of(h) != layer}
    while True:
        more = {h for u in public for _, h in includes(headers[u]) if h in headers and layer_of(h) == layer_of(u)}
        if more <= public:
            return {f"lib/{h}" for h in public}
        public |= more


def package_violations(root):
    rooms = House(root).rooms
    unknown = {p for r in rooms for p in r.packages} - set(PACKAGES)
    yield from (f"{house.DRAWING}: {p}: no such package in tests/lint/layers.py" for p in sorted(unknown))
    public = public_headers(root)
    for path in sources(root / "lib") + sources(root / "tools"):
        where = path.relative_to(root).as_posix()
        for line, header in includes(path):
            for package, pattern in PACKAGES.items():
                if not pattern.match(header):
                    continue
                homes = [r.name for r in rooms if package in r.packages]
                if not any(lies_in(folder_of(path, root), h) for h in homes):
                    yield f"{where}:{line}: {header} of {package} may only be included in {' or '.join(homes)}"
                elif where in public:
                    yield f"{where}:{line}: {header} of {package} in a public header"


def eigen_violations(root):
    for path in sources(root / "lib") + sources(root / "tools"):
        where = path.relative_to(root).as_posix()
        if where == EIGEN_SPARSE:
            continue
        for line, header in includes(path):
            if EIGEN_HEADER.match(header) and where != EIGEN_HOME:
                yield f"{where}:{line}: {header} may only be included in {EIGEN_HOME} and {EIGEN_SPARSE}"
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
    return [*package_violations(root), *eigen_violations(root), *main_violations(root)]


PLANTS = {
    "lib/meshing/planted.cpp": "#include <mpi.h>\n",
    "lib/sizing/planted.cpp": '#include "hdf5.h"\n',
    "lib/mesh/planted.cpp": "#include <TopoDS_Face.hxx>\n",
    "lib/stages/planted.cpp": "#include <CLI/CLI.hpp>\n",
    "lib/base/planted.cpp": "#include <toml++/toml.h>\n",
    "tools/st-info/planted.cpp": "#include <BRep_Tool.hxx>\n",
    "lib/mesh/planted_eigen.cpp": "#include <Eigen/Dense>\n",
    "lib/sizing/planted_dynamic.cpp": "Eigen::MatrixXd m;\n",
    "lib/mesh/planted_main.cpp": "int main() {}\n",
    "tools/st-planted/main.cpp": "\n" * MAIN_LIMIT,
}


def self_test(root):
    """Every planted violation is found, each in its own file, and so is a foreign header in a public one."""
    missed = []
    for name, text in PLANTS.items():
        with tempfile.TemporaryDirectory() as folder:
            copy = house.copy_of(root, folder)
            house.plant(copy, name, text)
            if not any(v.startswith(name) for v in violations(copy)):
                missed.append(name)
    with tempfile.TemporaryDirectory() as folder:
        copy = house.copy_of(root, folder)
        header = next((copy / "lib/comm").rglob("communicator.h"))
        header.write_text("#include <mpi.h>\n" + header.read_text())
        if not any("public header" in v for v in violations(copy)):
            missed.append("mpi.h in communicator.h")
    return [f"self test: planted violation not found: {m}" for m in missed]


if __name__ == "__main__":
    sys.exit(house.main(violations, self_test))
