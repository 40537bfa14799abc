"""Artifacts as numpy arrays. docs/artifacts.md says what each dataset holds; lengths are in the model unit."""
import json

import h5py
import numpy

from .sources import Sources

MAX_LEVEL = 20  # of an octree: keys have this many bits along each axis
NEWEST_VERSION = {"geometry": 2, "raster": 8, "sizing": 7, "patches": 2, "mesh": 1, "failures": 1}
CELL_CHUNK = 65536  # points whose sizes are computed at once


class Artifact:
    """Any artifact: its header, and every dataset by name: artifact["/st/face/area"]."""

    def __init__(self, path):
        self.path = str(path)
        with h5py.File(path) as file:
            if "st" not in file or "schema" not in file["st"].attrs:
                raise ValueError(f"{path}: is no artifact of ST")
            attributes = {name: self._plain(value) for name, value in file["st"].attrs.items()}
            self.names = []
            file.visititems(self._add_name)
            self._groups = {name: {k: self._plain(v) for k, v in file[name].attrs.items()}
                            for name in ("st/sizing",) if name in file}
        self.schema = attributes["schema"]
        version, newest = attributes["schema_version"], NEWEST_VERSION.get(self.schema, 0)
        if version > newest:
            raise ValueError(f"{path}: {self.schema} of version {version}; this module reads up to {newest}")
        self.unit = attributes["unit"] or None
        self.unit_in_m = attributes.get("unit_in_m")
        self.hash = attributes["content_hash"]
        self.geometry_hash = attributes.get("geometry_hash") or self.hash
        self.tool, self.tool_version = attributes.get("tool"), attributes.get("tool_version")
        self.options = json.loads(attributes.get("options") or "{}")
        self.inputs = json.loads(attributes.get("inputs") or "[]")
        self.is_complete = bool(attributes.get("is_complete", 1))

    @staticmethod
    def _plain(value):
        if isinstance(value, (bytes, numpy.bytes_)):
            return bytes(value).decode("utf-8", "replace")
        if isinstance(value, h5py.Empty):
            return ""
        return value.item() if isinstance(value, numpy.ndarray) and value.size == 1 else value

    def _add_name(self, name, item):
        if isinstance(item, h5py.Dataset):
            self.names.append("/" + name)

    def __contains__(self, name):
        return name in self.names

    def __getitem__(self, name):
        """A dataset as an array, strings as a list of str."""
        with h5py.File(self.path) as file:
            data = file[name]
            if data.dtype.kind in "SO":
                return [v.decode("utf-8", "replace") if isinstance(v, bytes) else str(v) for v in data[...].tolist()]
            return data[...]

    def get(self, name, default=None):
        return self[name] if name in self else default

    def __repr__(self):
        return f"<{type(self).__name__} {self.path}>"


class Geometry(Artifact):
    """geometry.hdf: faces, edges, groups, findings. All have the numbers of the CAD, from 0; joined ones the lowest."""

    def __init__(self, path):
        super().__init__(path)
        self.face_name, self.edge_name = self["/st/face/name"], self["/st/edge/name"]
        self.face_area, self.edge_length = self["/st/face/area"], self["/st/edge/length"]
        self.group_name, self.face_group = self["/st/group/name"], self["/st/face/group"]
        # of each face and edge, those that are one with it: several where they are joined, none where part of a lower
        self.cad_faces = [[f] for f in range(len(self.face_name))]
        self.cad_edges = [[e] for e in range(len(self.edge_name))]
        if "/st/composites/member" in self:
            self._join()

    def _join(self):
        members, offsets = self["/st/composites/member"], self["/st/composites/member_offsets"]
        unions = [members[a:b].tolist() for a, b in zip(offsets, offsets[1:])]
        for union in unions:
            area = self.face_area[union].sum()
            self.face_area[union] = 0
            self.face_area[union[0]] = area
            for f in union:
                self.cad_faces[f] = union if f == union[0] else []
        length, chains = self.edge_length.copy(), self._chains({f for union in unions for f in union})
        self.edge_length[:] = 0
        self.cad_edges = [[] for _ in length]
        for edges in chains:
            self.cad_edges[edges[0]], self.edge_length[edges[0]] = edges, length[edges].sum()

    def _chains(self, joined_faces):
        """Edges that are left, those that go on as one together; poles of joined faces are gone."""
        gone = set(self["/st/composites/joined_edges"].tolist())
        coedges, loops = self["/st/loop/coedge_offsets"], self["/st/face/loop_offsets"]
        edge, uses = self["/st/coedge/edge"], {}
        for f in range(len(loops) - 1):
            for e in edge[coedges[loops[f]]:coedges[loops[f + 1]]].tolist():
                uses.setdefault(e, set()).add(f)
        is_pole = self["/st/edge/is_degenerate"]
        gone |= {e for e, faces in uses.items() if is_pole[e] and faces <= joined_faces}
        inside, chain, at = set(self["/st/composites/joined_vertices"].tolist()), {}, {}
        for e, ends in enumerate(self["/st/edge/vertices"].reshape(-1, 2).tolist()):
            if e in gone:
                continue
            chain[e] = [e]
            for v in set() if is_pole[e] else inside.intersection(ends):
                at.setdefault(v, []).append(e)
        for a, b in at.values():
            if chain[a] is not chain[b]:
                chain[a] += chain[b]
                for e in chain[b]:
                    chain[e] = chain[a]
        return sorted(sorted(edges) for edges in {id(c): c for c in chain.values()}.values())

    def faces_of(self, group):
        """Numbers, from 0, of the faces of a group."""
        return numpy.flatnonzero(self.face_group == self.group_name.index(group))

    @property
    def findings(self):
        """What the import found: dictionaries of what, entity, xyz, size, is_repair."""
        keys = ("what", "entity", "xyz", "size", "is_repair")
        return [dict(zip(keys, row)) for row in zip(*(self.get(f"/st/finding/{k}", []) for k in keys))]


def _compact(keys):
    """Every third bit of Morton keys, put together."""
    values = numpy.zeros(keys.shape, dtype=numpy.int64)
    for bit in range(MAX_LEVEL):
        values |= ((keys >> numpy.uint64(3 * bit)) & numpy.uint64(1)).astype(numpy.int64) << bit
    return values


def _spread(values):
    keys = numpy.zeros(values.shape, dtype=numpy.uint64)
    for bit in range(MAX_LEVEL):
        keys |= ((values >> bit) & 1).astype(numpy.uint64) << numpy.uint64(3 * bit)
    return keys


class _Octree(Artifact):
    """The cells that rasters and sizings have in common."""

    def __init__(self, path):
        super().__init__(path)
        self.root = self["/st/octree/root"]
        self.leaf_key, self.leaf_level = self["/st/octree/leaf_key"], self["/st/octree/leaf_level"]
        self.numbers = self._groups.get("st/sizing", {})

    @property
    def n_cells(self):
        return len(self.leaf_key)

    def cells(self):
        """Centres (n, 3) and edges (n) of the cells, in the octree's own frame."""
        edge = self.root[3] / 2.0 ** self.leaf_level
        corner = numpy.stack([_compact(self.leaf_key >> numpy.uint64(axis)) for axis in range(3)], axis=1)
        return self.root[:3] + corner * (self.root[3] / 2**MAX_LEVEL) + 0.5 * edge[:, None], edge


class Raster(_Octree):
    """raster.hdf: sample lengths in cells, before prolongation."""

    def __init__(self, path):
        super().__init__(path)
        self.stored_length = self["/st/octree/stored_length"]


class Sizing(_Octree):
    """sizing.hdf: the length asked for at any place."""

    def __init__(self, path):
        super().__init__(path)
        self.cell = self["/st/octree/cell"].astype(float)
        frame = self.get("/st/octree/frame")
        self._turn, self._shift, self._scale = numpy.eye(3), numpy.zeros(3), 1.0
        if frame is not None:  # rotation by rows, scale and translation; which is which is said in docs/artifacts.md
            self._turn, self._scale, self._shift = frame[:9].reshape(3, 3), frame[9], frame[10:13]
        self._split = None
        if len(self.get("/st/split/leaf", [])):
            self._split = (self["/st/split/leaf"], self["/st/split/plane"].astype(float),
                           self["/st/split/cell"].astype(float))

        self._sources = Sources(self)
        self._cone = self.get("/st/cone/cone")
        if self._cone is not None:
            self._cone = self._cone.astype(float)
            self._first, self._of_site = self["/st/cone/first"].astype(numpy.int64), self["/st/cone/of_site"]

    @staticmethod
    def _linear(cell, offset):
        """Linear in the cell, no more than its neighbourhood allows."""
        return numpy.minimum(cell[:, 0] + numpy.einsum("ij,ij->i", cell[:, 1:4], offset), numpy.abs(cell[:, 4]))

    def _by_cones(self, site, place):
        """The smallest of length + slope * distance over the samples of each cell; places from the root's corner."""
        n = self._first[site + 1] - self._first[site]
        row = numpy.repeat(numpy.arange(len(site)), n)
        rank = numpy.arange(len(row)) - numpy.repeat(numpy.cumsum(n) - n, n)
        cone = self._cone[self._of_site[self._first[site][row] + rank]]
        way = place[row] - cone[:, :3]
        for side, half in ((cone[:, 5:8], cone[:, 11]), (cone[:, 8:11], cone[:, 12])):
            along = numpy.clip(numpy.einsum("ij,ij->i", way, side), -half, half)
            way -= along[:, None] * side
        length = numpy.full(len(site), float(self.numbers["far_length"]))
        numpy.minimum.at(length, row, cone[:, 3] + cone[:, 4] * numpy.linalg.norm(way, axis=1))
        return length

    def _length(self, site, cell, offset, place):
        """Of the octree, before scale. Sites are cells, then second parts."""
        if self._cone is None:
            length = self._linear(cell, offset)
        else:
            length = self._by_cones(site, place)
        return length

    def size(self, points):
        """The requested length at each of `points` (n, 3); the length across where lengths are stretched."""
        points = numpy.asarray(points, dtype=float).reshape(-1, 3)
        parts = [self._size(points[i:i + CELL_CHUNK]) for i in range(0, len(points), CELL_CHUNK)]
        return numpy.concatenate(parts) if parts else numpy.zeros(0)

    def _size(self, points):
        local = (points - self._shift) @ self._turn / self._scale
        end = 2**MAX_LEVEL
        grid = numpy.clip((local - self.root[:3]) * (end / self.root[3]), 0, end)
        place = numpy.minimum(grid.astype(numpy.int64), end - 1)
        key = _spread(place[:, 0]) | _spread(place[:, 1]) << numpy.uint64(1) | _spread(place[:, 2]) << numpy.uint64(2)
        leaf = numpy.searchsorted(self.leaf_key, key, side="right") - 1
        extent = 1 << (MAX_LEVEL - self.leaf_level[leaf].astype(numpy.int64))[:, None]
        offset = (grid - place // extent * extent - 0.5 * extent) * (self.root[3] / end)
        place = local - self.root[:3]
        length = self._length(leaf, self.cell[leaf], offset, place)
        if self._split is not None:
            self._use_parts(leaf, offset, place, length)
        self._sources.lower(local, length)
        return self._scale * self.numbers["scale"] * numpy.maximum(length, self.numbers["smallest_length"])

    def _use_parts(self, leaf, offset, place, length):
        """Where a mesh separates a cell: the second part behind the plane, the smaller one close to it."""
        split_leaf, plane, cell = self._split
        at = numpy.minimum(numpy.searchsorted(split_leaf, leaf), len(split_leaf) - 1)
        mine = numpy.flatnonzero((split_leaf[at] == leaf) & (self.cell[leaf, 4] < 0))
        part = at[mine]
        second = self._length(len(self.cell) + part, cell[part], offset[mine], place[mine])
        height = numpy.einsum("ij,ij->i", plane[part, :3], offset[mine]) - plane[part, 3]
        is_second = numpy.where(numpy.abs(height) > plane[part, 4], height <= 0, second < length[mine])
        length[mine] = numpy.where(is_second, second, length[mine])


class Patches(Artifact):
    """patches.hdf: one triangulation per face, before they are merged."""

    def __init__(self, path):
        super().__init__(path)
        self.face_name = self["/st/face/name"]
        self.patch_face = self["/st/patch/face"]
        self.n_triangles = len(self["/st/triangle/nodes"])

    @property
    def failures(self):
        """Faces without a complete patch: dictionaries of face (from 0), cause, remedy, xyz."""
        keys = ("face", "cause", "remedy", "xyz")
        return [dict(zip(keys, row)) for row in zip(*(self.get(f"/st/failure/{k}", []) for k in keys))]


class _Grid(Artifact):
    """What VTK shows of an artifact."""

    def __init__(self, path):
        super().__init__(path)
        self.points = self["/VTKHDF/Points"]

    def cell_data(self, name):
        return self[f"/VTKHDF/CellData/{name}"]

    def point_data(self, name):
        return self[f"/VTKHDF/PointData/{name}"]


class Mesh(_Grid):
    """mesh.hdf: nodes, triangles, and what CAD says of them. face and group count from 1, as names do minus one."""

    def __init__(self, path):
        super().__init__(path)
        self.triangles = self["/VTKHDF/Connectivity"].reshape(-1, 3)
        self.face, self.group = self.cell_data("face"), self.cell_data("group")
        self.face_name, self.group_name = self["/st/face/name"], self["/st/group/name"]
        self.size = self.point_data("size")

    def areas(self):
        """Of each triangle."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        return 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)

    def quality(self):
        """4 sqrt(3) A over the sum of the squared sides: 1 for equilateral triangles."""
        corners = self.points[self.triangles]
        sides = numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2)
        return 4 * 3**0.5 * self.areas() / (sides**2).sum(axis=1)

    def of_group(self, name):
        """Numbers, from 0, of the triangles of a group."""
        return numpy.flatnonzero(self.group == self.group_name.index(name) + 1)

    def area_of(self, name):
        return float(self.areas()[self.of_group(name)].sum())


class Failures(_Grid):
    """patches.failures.hdf: faces that were not meshed, to look at."""


KINDS = {"geometry": Geometry, "raster": Raster, "sizing": Sizing, "patches": Patches, "mesh": Mesh,
         "failures": Failures}


def read(path):
    """The artifact of a file, as the class of its kind."""
    schema = Artifact(path).schema
    return KINDS.get(schema, Artifact)(path)
