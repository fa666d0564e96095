# SPDX-License-Identifier: MIT
"""The Python module lsys for pip, built by CMake. pyproject.toml has its description."""

import pathlib
import re

from skbuild import setup

cmake = pathlib.Path(__file__).with_name("CMakeLists.txt").read_text(encoding="utf-8")
version = re.search(r"project\(lsc VERSION ([0-9.]+)", cmake).group(1)

setup(
    version=version,
    packages=["lsys"],
    package_dir={"lsys": "runtime/python/lsys"},
    package_data={"lsys": ["*.pyi", "py.typed"]},
    cmake_install_dir="runtime/python",
    cmake_install_target="install-python-module",
    cmake_args=["-DLSYS_TESTS=OFF", "-DLSYS_VIEWER=OFF", "-DLSYS_SHARED=OFF", "-DLSYS_PYTHON=ON",
                "-DLSYS_PYTHON_FOLDER=."],
)
