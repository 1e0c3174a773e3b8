# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses a function of the library that works in the locale of the program: in cases/driver/library each one that
cases/moraine.h declares with a session and a status must begin with MOR_SESSION_WORK(session), which gives its thread
the locale C until it returns."""

import re
import sys

import source

HEADER = "cases/moraine.h"
FOLDER = "cases/driver/library/"
SCOPE = "MOR_SESSION_WORK(session);"
DECLARED = re.compile(r"^mor_status (mor_\w+)\(mor_session \*session\b", re.MULTILINE)


def check(root):
    problems = []
    declared = set(DECLARED.findall(source.read_text(root, HEADER)))
    defined = set()
    for path in source.list_files(root, (".c",)):
        if not path.startswith(FOLDER):
            continue
        text = source.read_text(root, path)
        for match in re.finditer(r"^mor_status (mor_\w+)\([^;{}]*\)\n\{\s*([^\n]*)", text, re.MULTILINE):
            if match.group(1) in declared:
                defined.add(match.group(1))
                if match.group(2) != SCOPE:
                    problems.append(f"{path}:{source.line_of(text, match.start())}: '{match.group(1)}' does not begin "
                                    f"with '{SCOPE}'")
    problems.extend(f"{HEADER}: '{name}' is not defined in {FOLDER}" for name in sorted(declared - defined))
    return problems or ([] if declared else [f"{HEADER}: no function of a session returns a status"])


if __name__ == "__main__":
    sys.exit(source.report("Functions that work in the locale of the program", check(source.parse_root().root),
                           "Numbers are read and written with a decimal point in any locale."))
