# SPDX-License-Identifier: Apache-2.0
"""Recipe for Spack: the folder `packages/dust` of a repository of your own holds this file; then
`spack repo add REPOSITORY && spack install dust`. The address of the checkout stands in `git`."""

from spack.package import *


class Dust(CMakePackage):
    """Bulk solids, the air around them and the dust that gets loose: discrete elements coupled to a
    volume-averaged Navier-Stokes solver, for transfer points of belt conveyors."""

    homepage = "https://example.org/dust"
    git = "https://example.org/dust.git"

    license("Apache-2.0")

    version("main", branch="main")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("tbb")
    depends_on("eigen@3.4:")
    depends_on("yaml-cpp@0.7:")
    depends_on("spdlog@1.10:")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("boost@1.74:")
    depends_on("cli11@2.1:")
    depends_on("nlohmann-json@3.11:")
    depends_on("zlib-api")
    depends_on("doctest", type="test")

    conflicts("%gcc@:11", msg="C++20 as g++ 12 has it")

    generator("ninja")

    def cmake_args(self):
        return [self.define("DUST_BUILD_TESTS", self.run_tests)]
