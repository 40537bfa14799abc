"""Whether the walls of two meshes are the same, to the last bit, away from what moved; exits with 5 when they are not.

usage: away.py BEFORE.hdf AFTER.hdf DISTANCE X Y Z DOWN     the middle of what moved, and how far it went along z

The symmetry plane is left out: below the aircraft the store is what is nearest, and asks for the lengths there.
"""
import sys

import h5py
import numpy


def walls_of(path):
    """Corners of each triangle, [n, 3, 3]."""
    with h5py.File(path) as file:
        grid, roles = file["VTKHDF"], file["st/group/role"][:]
        corners = grid["Points"][:][grid["Connectivity"][:].reshape(-1, 3)]
        return corners[roles[grid["CellData/group"][:] - 1] == b"wall"]


def main(before, after, distance, x, y, z, down):
    sets, n_walls = [], 0
    for corners in (walls_of(before), walls_of(after)):
        is_away = numpy.ones(len(corners), bool)
        for middle in ((x, y, z), (x, y, z + down)):
            is_away &= (numpy.linalg.norm(corners - middle, axis=2) > distance).all(axis=1)
        sets.append({t.tobytes() for t in corners[is_away]})
        n_walls = len(corners)
    changed = sets[0] ^ sets[1]
    print(f"{n_walls} triangles on walls, {len(sets[1])} away from the store, {len(changed)} of these changed")
    return 5 if changed or not sets[0] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], *map(float, sys.argv[3:8])))
