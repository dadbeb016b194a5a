#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0
"""Reads what impinge-verify --coq has written without Coq, and tries each lemma and theorem at random points of its
premises. Prints how many there are and how many leave a range other than a point to a constant; fails where one is false.

    coq_goals.py GOALS.v"""

import math
import random
import re
import sys

FUNCTIONS = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "atan": math.atan, "exp": math.exp, "ln": math.log,
             "sqrt": math.sqrt, "Rabs": abs}
POINTS = 50


def expression(term):
    """A term of Coq in Python: functions applied to words, powers."""
    term = re.sub(r"(leaf\w+)((?: \w+)+)", lambda m: f"{m[1]}({','.join(m[2].split())})", term)
    term = re.sub(rf"\b({'|'.join(FUNCTIONS)}) (\w+)", r"\1(\2)", term)
    return " ".join(term.replace("^", "**").split())


def define(scope, name, arguments, body):
    """Adds a definition, whose `let`s are its first lines."""
    *lets, last = body.split(" in ")
    lines = [expression(let.strip().removeprefix("let ").replace(":=", "=")) for let in lets]
    exec("\n ".join([f"def {name}({','.join(arguments.split())}):", *lines, f"return {expression(last)}"]), scope)


def is_true(scope, statement, draw):
    """Tries a statement at points of its premises."""
    *premises, conclusion = statement.split(" -> ")
    ranges = []
    for premise in premises:
        lo, name, hi = premise.strip().split(" <= ")
        ranges.append((name, eval(expression(lo)), eval(expression(hi))))
    conclusion = eval(f"lambda {','.join(name for name, _, _ in ranges)}: {expression(conclusion)}", scope)
    return all(conclusion(*(draw.choice((lo, hi, draw.uniform(lo, hi))) for _, lo, hi in ranges))
               for _ in range(POINTS)), sum(name[0] in "kl" and hi - lo > 1e-9 for name, lo, hi in ranges)


def main(path):
    """Tries all of a file."""
    with open(path, encoding="ascii") as file:
        text = file.read()
    scope, draw, count, wide = dict(FUNCTIONS), random.Random(1), 0, 0
    for name, arguments, body in re.findall(r"Definition (\w+) \(([\w ]+) : R\) : R :=\s*(.*?)\.\n", text, re.S):
        define(scope, name, arguments, body)
    for name, statement in re.findall(r"(?:Lemma|Theorem) (leaf\w+) : forall [\w ]+ : R,\n(.*?)\.\nProof", text, re.S):
        holds, ranges = is_true(scope, statement, draw)
        if not holds:
            print(f"{name} is false")
            return 1
        count += 1
        wide += ranges > 0
    print(f"{count} statements, {wide} of ranges")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
