#!/usr/bin/env python3
"""Packs a folder as a wheel: usage: wheel.py FOLDER OUT_DIR VERSION PLATFORM TOOL...

FOLDER holds the package st with its programs in st/bin. Each tool gets a command of its name. Equal folders give equal
wheels. Prints the wheel's path."""
import base64
import hashlib
import stat
import sys
import zipfile
from pathlib import Path

METADATA = """Metadata-Version: 2.1
Name: st-mesh
Version: {version}
Summary: Automatic parallel surface meshing: from CAD to a mesh for CFD
License: Apache-2.0
Requires-Python: >=3.9
Requires-Dist: numpy
Requires-Dist: h5py
Description-Content-Type: text/plain

Tools that turn a CAD model into a surface mesh for CFD, and the Python module st, which runs them and reads what they
make. Licences of everything in it are in st/licenses.
"""
WHEEL = """Wheel-Version: 1.0
Generator: st
Root-Is-Purelib: false
Tag: py3-none-{platform}
"""
TIME = (1980, 1, 1, 0, 0, 0)


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def write(archive, name, data, executable, records):
    info = zipfile.ZipInfo(name, TIME)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = (stat.S_IFREG | (0o755 if executable else 0o644)) << 16
    archive.writestr(info, data, compresslevel=9)  # an info of its own has none
    records.append(f"{name},sha256={digest(data)},{len(data)}")


def main(folder, out, version, platform, *tools):
    folder, info = Path(folder), f"st_mesh-{version}.dist-info"
    wheel = Path(out) / f"st_mesh-{version}-py3-none-{platform}.whl"
    records = []
    with zipfile.ZipFile(wheel, "w", compresslevel=9) as archive:
        for path in sorted(p for p in folder.rglob("*") if p.is_file()):
            name = str(path.relative_to(folder))
            write(archive, name, path.read_bytes(), name.startswith("st/bin/"), records)
        commands = "".join(f"{tool} = st.tools:command\n" for tool in tools)
        texts = {"METADATA": METADATA.format(version=version), "WHEEL": WHEEL.format(platform=platform),
                 "entry_points.txt": "[console_scripts]\n" + commands}
        for name, text in texts.items():
            write(archive, f"{info}/{name}", text.encode(), False, records)
        archive.writestr(zipfile.ZipInfo(f"{info}/RECORD", TIME), "\n".join([*records, f"{info}/RECORD,,", ""]))
    print(wheel)
    return 0


if __name__ == "__main__":
    if len(sys.argv) < 6:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    sys.exit(main(*sys.argv[1:]))
