# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Builds the Python module. There are three ways:

- from these files alone: the module notes where pkg-config says that libimpinge is;
- with IMPINGE_BUILD, a folder in which Impinge was built: the wheel holds library, plugins and command
  (`make wheel`);
- with the sources in the folder `source` (`make sdist`): they are built first, and then it is as before.

All else stands in pyproject.toml."""

import os
import pathlib
import re
import shutil
import subprocess
import sysconfig
from typing import Dict, List, Tuple

from setuptools import setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
SYSTEM = re.compile(r"(linux-vdso|ld-linux.*|libc|libm|libdl|librt|libpthread)\.so")  # of every Linux


def library() -> str:
    """The path of the library that pkg-config knows; empty: it knows none."""
    try:
        asked = subprocess.run(["pkg-config", "--variable=libdir", "impinge"], check=True,
                               capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return str(pathlib.Path(asked.stdout.strip()) / "libimpinge.so.0")


def build_tree() -> str:
    """A folder in which Impinge is built; empty: the wheel is to hold the module alone."""
    if os.environ.get("IMPINGE_BUILD"):
        return os.environ["IMPINGE_BUILD"]
    configure = HERE / "source" / "configure"
    if not configure.exists():
        return ""
    folder = HERE / "build" / "impinge"
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([str(configure), "--quiet", "--disable-mpi", "--without-pythondir"], cwd=folder, check=True)
    # What autotools made is in the sources, whatever times their unpacking left.
    still = [f"{tool}=:" for tool in ("ACLOCAL", "AUTOCONF", "AUTOHEADER", "AUTOMAKE")]
    subprocess.run(["make", f"-j{os.cpu_count() or 1}", *still, "all"], cwd=folder, check=True)
    return str(folder)


def needed(file: pathlib.Path, tree: pathlib.Path) -> Dict[str, str]:
    """The libraries that a file needs and not every Linux has: paths by names."""
    found = subprocess.run(["ldd", str(file)], check=True, capture_output=True, text=True,
                           env={**os.environ, "LD_LIBRARY_PATH": str(tree / ".libs")}).stdout
    pairs = re.findall(r"^\s*(\S+) => (\S+)", found, re.MULTILINE)
    return {name: path for name, path in pairs
            if not SYSTEM.match(name) and not name.startswith("libimpinge")}


def copy_bundle(tree: pathlib.Path, target: pathlib.Path) -> None:
    """Library, plugins, command and data as in a build tree, in which the command finds its own; the
    libraries that they need lie beside libimpinge."""
    command = tree / "tools" / ".libs" / "impinge"
    command = command if command.exists() else tree / "tools" / "impinge"
    files = {".libs/libimpinge.so.0": tree / ".libs" / "libimpinge.so.0", "tools/impinge": command}
    files.update({f"plugins/.libs/{p.name}": p for p in sorted((tree / "plugins" / ".libs").glob("*.so"))})
    for file in list(files.values()):
        for name, path in needed(file, tree).items():
            files[f".libs/{name}"] = pathlib.Path(path)
    for name, file in files.items():
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(os.path.realpath(file), target / name)
        if shutil.which("strip"):
            subprocess.run(["strip", "--strip-unneeded", str(target / name)], check=True)
    shutil.copytree(tree / "tools" / "built-data", target / "tools" / "built-data", dirs_exist_ok=True)
    (target / "config.status").write_text("")


def oldest_glibc(folder: pathlib.Path) -> Tuple[int, ...]:
    """The version of glibc that the files of a bundle need."""
    versions: List[Tuple[int, ...]] = [(2, 17)]
    for file in folder.rglob("*"):
        if file.is_file() and file.read_bytes()[:4] == b"\x7fELF":
            text = subprocess.run(["objdump", "-T", str(file)], check=True, capture_output=True, text=True).stdout
            versions += [tuple(map(int, v.split("."))) for v in re.findall(r"GLIBC_(\d+\.\d+)", text)]
    return max(versions)


class Build(build_py):
    """Adds impinge/_bundle, or impinge/_installed.py."""

    def run(self) -> None:
        super().run()
        if getattr(self, "editable_mode", False):
            return
        target, tree = pathlib.Path(self.build_lib) / "impinge", build_tree()
        found = library()
        if tree:
            copy_bundle(pathlib.Path(tree).resolve(), target / "_bundle")
        elif found:
            (target / "_installed.py").write_text(f"LIBRARY = {found!r}\n")
        else:
            self.announce("pkg-config does not know impinge: set PKG_CONFIG_PATH to the lib/pkgconfig "
                          "below its prefix, or IMPINGE_LIBRARY when the module runs", level=3)


class Wheel(bdist_wheel):
    """A wheel with a bundle is for this machine, and for glibc from the version that it needs."""

    def get_tag(self) -> Tuple[str, str, str]:
        folder = pathlib.Path(self.bdist_dir) / "impinge" / "_bundle"
        if not folder.exists():
            return super().get_tag()
        machine = sysconfig.get_platform().partition("-")[2]
        return "py3", "none", "manylinux_%d_%d_%s" % (*oldest_glibc(folder)[:2], machine)


setup(cmdclass={"build_py": Build, "bdist_wheel": Wheel})
