#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# A six-joint arm, a table of its joints and a fixture, asked from the command line, from C and from
# Python; and the Python module by itself.

load ../support/cli_helper

setup() {
    cd "$BATS_TEST_TMPDIR"
    export IMPINGE_LIBRARY=$top_builddir/.libs/libimpinge.so
    export IMPINGE_PLUGIN_PATH=$top_builddir/plugins/.libs PYTHONDONTWRITEBYTECODE=1
    unset PYTHONPATH IMPINGE_COMMAND
    arm=$top_srcdir/tools/data/arm.json examples=$top_srcdir/sdk/examples
}

# As far as a tolerance of a thousandth determines it.
answer='^holds, tightest 2\.88[0-9] mm at t = 0\.5[56][0-9]? between link5 and fixture$'

needs_python() {
    [ "$PYTHON3" != no ] || skip "no python3 with numpy and pytest"
    # A library with AddressSanitizer cannot be loaded by a program without it.
    ! nm -D "$IMPINGE_LIBRARY" | grep -q __asan_init || skip "the library has sanitizers"
}

@test "the arm's clearance from the command line" {
    run -0 "$IMPINGE" clearance "$arm" --require 2 --tolerance 1e-3
    [[ $output == 'holds: at least 2, nearest distance 2.88'*' at t = 0.5'*' between "link5" and "fixture"'* ]]
    run -1 "$IMPINGE" clearance "$arm" --require 3
}

@test "the arm's clearance from C" {
    ! nm -D "$IMPINGE_LIBRARY" | grep -q __asan_init || skip "the library has sanitizers"
    gcc -std=c11 -Wall -Wextra -Werror -I"$top_srcdir/core" -I"$top_srcdir/sdk" "$examples/arm.c" \
        "$IMPINGE_LIBRARY" -o arm
    LD_LIBRARY_PATH=$top_builddir/.libs run -0 ./arm "$arm"
    [[ $output =~ $answer ]]
}

@test "without numpy the module names the cure, in one line" {
    needs_python
    mkdir empty
    echo 'raise ModuleNotFoundError("no module", name="numpy")' >empty/numpy.py
    PYTHONPATH=$PWD/empty:$top_srcdir/sdk/python run -1 "$PYTHON3" -c 'import impinge'
    [ "${lines[-1]}" = 'ModuleNotFoundError: impinge needs numpy: pip install numpy, or apt-get install python3-numpy' ]
    [[ $output != *_values.py* ]]
}

@test "the arm's clearance from Python" {
    needs_python
    PYTHONPATH=$top_srcdir/sdk/python run -0 "$PYTHON3" "$examples/arm.py" "$arm"
    [[ ${lines[0]} =~ $answer ]]
    [ "${#lines[@]}" -eq 11 ]
}

@test "a patch's clearance over time, from arrays to arrays" {
    needs_python
    PYTHONPATH=$top_srcdir/sdk/python run -0 "$PYTHON3" "$examples/profile.py"
    [ "${#lines[@]}" -eq 13 ]
    [[ ${lines[0]} == '0.00 to 0.08: '*'holds' && ${lines[-1]} == 'tightest in slice 11, 0.158'* && ${lines[10]} == *violated ]]
}

@test "edges of a robot in joint space, and a picture" {
    needs_python
    IMPINGE_COMMAND=$IMPINGE PYTHONPATH=$top_srcdir/sdk/python run -0 "$PYTHON3" "$examples/robot.py" \
        "$top_srcdir/tools/data/arm.urdf" arm.png
    [ "${#lines[@]}" -eq 3 ]
    [[ ${lines[0]} == 'to lift = -0.4: clear, '*' mm apart' && ${lines[2]} == 'to lift = 0.8: '*' touches shelf at t = 0.'* ]]
    [ -s arm.png ]
}

@test "the Python module keeps its tests" {
    needs_python
    IMPINGE_VERIFY=$top_builddir/tools/impinge-verify PYTHONPATH=$top_srcdir/sdk/python run "$PYTHON3" -m pytest -q -p no:cacheprovider \
        "$top_srcdir/tests/python"
    echo "$output"
    [ "$status" -eq 0 ]
}

@test "robots overlap nothing before their contact, as FCL sees it" {
    needs_python
    "$PYTHON3" -c 'import yaml' || skip "no python3-yaml"
    pkg-config --exists fcl || skip "no FCL (libfcl-dev)"
    PYTHONPATH=$top_srcdir/sdk/python run "$PYTHON3" -m pytest -q -p no:cacheprovider \
        "$top_srcdir/tests/peers"
    echo "$output"
    [ "$status" -eq 0 ]
}

@test "the Python module and programs that use it have types" {
    needs_python
    "$PYTHON3" -c 'import mypy' || skip "no python3-mypy"
    MYPYPATH=$top_srcdir/sdk/python run "$PYTHON3" -m mypy --strict --cache-dir cache \
        "$top_srcdir/sdk/python/impinge" "$top_srcdir/tests/python/typed.py"
    echo "$output"
    [ "$status" -eq 0 ]
}

pip_installs() {
    "$PYTHON3" -c 'import ensurepip, setuptools, wheel' ||
        skip "no python3-venv, python3-setuptools or python3-wheel"
    cp -R "$top_srcdir/sdk/python" source
    chmod -R u+w source
    "$PYTHON3" -m venv --system-site-packages venv
    venv/bin/python -m pip install --quiet --no-index --no-build-isolation ./source
}

@test "pip installs the Python module without reaching an index" {
    needs_python
    pip_installs
    run -0 venv/bin/python -c 'import impinge; print(impinge.__file__, impinge.version())'
    [[ $output == *venv*'libimpinge '* ]]
    run -0 venv/bin/python -c 'import impinge; print(impinge.__version__)'
    [ "libimpinge $output" = "$(venv/bin/python -c 'import impinge; print(impinge.version())')" ]
}

@test "a wheel brings library, plugins and command along, and needs nothing else of Impinge" {
    needs_python
    "$PYTHON3" -c 'import ensurepip, setuptools, wheel' ||
        skip "no python3-venv, python3-setuptools or python3-wheel"
    cp -R "$top_srcdir/sdk/python" source
    chmod -R u+w source
    (cd source && IMPINGE_BUILD=$top_builddir "$PYTHON3" -c \
        'import setuptools.build_meta as b; b.build_wheel("..")') >log 2>&1 || { cat log; false; }
    [[ $(ls ./*.whl) == ./impinge-*-py3-none-manylinux_2_*_"$(uname -m)".whl ]]
    "$PYTHON3" -m venv --system-site-packages venv
    venv/bin/python -m pip install --quiet --no-index ./*.whl
    rm -rf source
    cd /
    run -0 env -i "$BATS_TEST_TMPDIR/venv/bin/python" -c 'import impinge
scene = impinge.Scene.from_pair("sphere", "torus center=3,0,0 ! translate velocity=-2,0,0")
print(scene.solve().verdict, impinge._find.find_command(impinge._library.library))
print(len(scene.view(width=64, height=64).data) > 100)
print({name for line in open("/proc/self/maps") for name in [line.split()[-1]]
       if name.endswith(".so.0") and "impinge" in name})'
    [ "${lines[0]}" = "contact $(echo "$BATS_TEST_TMPDIR"/venv/lib/python3*/site-packages/impinge/_bundle/tools/impinge)" ]
    [ "${lines[1]}" = True ]
    [[ ${lines[2]} == "{'$BATS_TEST_TMPDIR/venv/"*"/_bundle/.libs/libimpinge.so.0'}" ]]
}

# As make install leaves it below a prefix that the dynamic linker does not know.
prefix_of_our_own() {
    mkdir -p prefix/lib/pkgconfig
    cp -L "$IMPINGE_LIBRARY" prefix/lib/libimpinge.so.0
    printf '%s\n' "libdir=$PWD/prefix/lib" 'Name: impinge' 'Description: x' 'Version: 1' \
        >prefix/lib/pkgconfig/impinge.pc
}

@test "a module from pip finds the library that pkg-config knew when it was built" {
    needs_python
    prefix_of_our_own
    PKG_CONFIG_PATH=$PWD/prefix/lib/pkgconfig pip_installs
    unset IMPINGE_LIBRARY
    run -0 env -u PKG_CONFIG_PATH -u LD_LIBRARY_PATH venv/bin/python -c 'import impinge
from impinge import _find, _library
print(_find.library_folder(_library.library))'
    [ "$output" = "$PWD/prefix/lib" ]
    mv prefix moved
    run -1 env -u PKG_CONFIG_PATH -u LD_LIBRARY_PATH PATH="$PWD/venv/bin" venv/bin/python -c 'import impinge'
    [[ $output == *'let IMPINGE_LIBRARY name its libimpinge.so.0'* ]]
}
