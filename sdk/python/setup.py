# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Notes where libimpinge is when the module is built: pip's copy then finds it without the environment.
All else stands in pyproject.toml."""

import pathlib
import subprocess

from setuptools import setup
from setuptools.command.build_py import build_py


def library() -> str:
    """The path of the library that pkg-config knows; empty: it knows none."""
    try:
        asked = subprocess.run(["pkg-config", "--variable=libdir", "impinge"], check=True,
                               capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return str(pathlib.Path(asked.stdout.strip()) / "libimpinge.so.0")


class Build(build_py):
    """Adds impinge/_installed.py."""

    def run(self) -> None:
        super().run()
        found = library()
        if found and not getattr(self, "editable_mode", False):
            target = pathlib.Path(self.build_lib) / "impinge" / "_installed.py"
            target.write_text(f"LIBRARY = {found!r}\n")
        elif not found:
            self.announce("pkg-config does not know impinge: set PKG_CONFIG_PATH to the lib/pkgconfig "
                          "below its prefix, or IMPINGE_LIBRARY when the module runs", level=3)


setup(cmdclass={"build_py": Build})
