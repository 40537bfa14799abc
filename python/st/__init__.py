"""ST from Python: its artifacts as numpy arrays, its tools as functions. Needs h5py and numpy.

    import st
    mesh = st.mesh("wing.step", preset="rans", progress=print)
    print(mesh.points.shape, mesh.triangles.shape, mesh.area_of("WING"), mesh.size.min())
    st.mesh("wing.step", "out", **{"st-raster": {"lmax": "2%"}})
    print(st.read("out/sizing.hdf").size(mesh.points).min())
"""
from .artifact import Artifact, Failures, Geometry, Mesh, Patches, Raster, Sizing, read
from .tools import ToolError, mesh, run

__all__ = ["Artifact", "Failures", "Geometry", "Mesh", "Patches", "Raster", "Sizing", "ToolError", "mesh", "read",
           "run"]
