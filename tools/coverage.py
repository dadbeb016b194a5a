# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Sums up what `gcov --json-format --stdout` says on standard input: coverage.py TOP [-m].

A file that several objects were made of (headers, mostly) is one: a line or a branch was run if it was
run in any of them. Why lines were not run says tools/coverage.gaps: lines "FILE[:FUNCTION] KIND", and what
each kind means, as "= KIND reason".
"""

import json
import os
import sys
from collections import defaultdict

ROOMS = ("core/", "sdk/impinge/")


def read(top, stream):
    """{file: {line: count}}, {file: {(line, number of the branch): count}}, {file: {line: function}}."""
    lines = defaultdict(lambda: defaultdict(int))
    branches = defaultdict(lambda: defaultdict(int))
    functions = defaultdict(dict)
    for text in stream:
        if not text.startswith("{"):
            continue
        for file in json.loads(text)["files"]:
            name = os.path.relpath(os.path.realpath(file["file"]), top)
            if not name.startswith(ROOMS):
                continue
            for line in file["lines"]:
                number = line["line_number"]
                lines[name][number] += line["count"]
                functions[name][number] = line.get("function_name", "")
                for k, branch in enumerate(line["branches"]):
                    branches[name][number, k] += branch["count"]
    return lines, branches, functions


def read_gaps(path):
    """{kind: reason} and {file or file:function: kind}."""
    kinds, gaps = {}, {}
    with open(path, encoding="utf-8") as file:
        for text in file:
            words = text.split(maxsplit=2)
            if words and words[0] == "=":
                kinds[words[1]] = words[2].strip()
            elif len(words) == 2 and words[0] != "#":
                gaps[words[0]] = words[1]
    return kinds, gaps


def share(counts):
    run = sum(1 for count in counts if count > 0)
    return run, len(counts), 100 * run / len(counts) if counts else 100.0


def spans(numbers):
    """[1, 2, 3, 7] -> "1-3 7"."""
    parts = []
    for n in numbers:
        if parts and parts[-1][1] == n - 1:
            parts[-1][1] = n
        else:
            parts.append([n, n])
    return " ".join(f"{a}-{b}" if a != b else f"{a}" for a, b in parts)


def row(title, line_counts, branch_counts):
    a, b = share(line_counts), share(branch_counts)
    print(f"{title:42} {a[0]:5} of {a[1]:5} {a[2]:6.1f} %   {b[0]:5} of {b[1]:5} {b[2]:6.1f} %")


def by_function(missed, functions):
    """[(function, its lines)], in order."""
    parts = defaultdict(list)
    for number in missed:
        parts[functions[number]].append(number)
    return parts.items()


def main():
    top = os.path.realpath(sys.argv[1])
    lines, branches, functions = read(top, sys.stdin)
    kinds, gaps = read_gaps(os.path.join(top, "tools/coverage.gaps"))
    unrun = defaultdict(int)
    if not lines:
        sys.exit("coverage: nothing was run")
    print(f"{'':42} {'lines':>14} {'':8}   {'branches':>14}")
    for name in sorted(lines):
        row(name, lines[name].values(), branches[name].values())
        missed = sorted(n for n, count in lines[name].items() if count == 0)
        for function, numbers in by_function(missed, functions[name]):
            kind = gaps.get(f"{name}:{function}", gaps.get(name, "unexplained"))
            unrun[kind] += len(numbers)
            if "-m" in sys.argv[2:]:
                print(f"    not run: {function} {spans(numbers)} ({kind})")
    for room in ROOMS:
        names = [name for name in lines if name.startswith(room)]
        row(room + " in all", [c for n in names for c in lines[n].values()],
            [c for n in names for c in branches[n].values()])
    for kind, count in sorted(unrun.items(), key=lambda item: -item[1]):
        print(f"{count:5} lines not run, {kind}: {kinds.get(kind, 'see -m')}")


main()
