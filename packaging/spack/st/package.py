"""Spack recipe: spack repo add packaging/spack && spack dev-build st@0.2.0 in the root of the sources."""
from spack.package import CMakePackage, depends_on, generator, license, variant, version


class St(CMakePackage):
    """Triangulated surfaces of CAD models for computational fluid dynamics."""

    license("Apache-2.0")
    version("0.2.0")

    variant("tests", default=False, description="Build the tests")

    generator("ninja")
    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("python@3.9:", type=("build", "run"))
    depends_on("py-h5py", type="run")
    depends_on("py-numpy", type="run")
    depends_on("gmake", type="run")
    depends_on("opencascade@7.6:7.7+data_exchange")
    depends_on("hdf5@1.10:~mpi")
    depends_on("openmpi")
    depends_on("zlib-api")
    depends_on("fmt")
    depends_on("eigen@3.4:")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("tomlplusplus")
    depends_on("xxhash")
    depends_on("googletest", when="+tests")

    def cmake_args(self):
        return [self.define_from_variant("ST_TESTS", "tests")]
