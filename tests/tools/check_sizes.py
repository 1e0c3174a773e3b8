# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses functions and macros over 60 lines, files over 600 lines and rooms over 4000 lines."""

import posixpath
import sys

import source

FUNCTION_LINES = 60
MACRO_LINES = 60
FILE_LINES = 600
ROOM_LINES = 4000


def check_functions(path, text, problems):
    try:
        functions = source.find_functions(text)
    except source.Unbalanced as unbalanced:
        problems.append(f"{path}:{unbalanced.line}: braces do not balance, so functions cannot be measured; keep each "
                        "pair of braces in the same branch of an #if")
        return
    for name, first, last in functions:
        lines = last - first + 1
        if lines > FUNCTION_LINES:
            problems.append(f"{path}:{first}: {name} has {lines} lines, {FUNCTION_LINES} are allowed; split it")


def check_macros(path, text, problems):
    for match in source.DIRECTIVE.finditer(text):
        lines = match.group(0).count("\n") + 1
        if lines > MACRO_LINES:
            problems.append(f"{path}:{source.line_of(text, match.start())}: a macro has {lines} lines, {MACRO_LINES} "
                            "are allowed; make it a function")


def check(root):
    problems = []
    rooms = dict.fromkeys(source.read_rooms(root), 0)
    for path in source.list_files(root, (".c", ".h", ".py", ".sh", "CMakeLists.txt")):
        text = source.read_text(root, path)
        lines = text.count("\n")
        if lines > FILE_LINES:
            problems.append(f"{path}: has {lines} lines, {FILE_LINES} are allowed; split it by topic")
        if path.endswith((".c", ".h")):
            check_functions(path, text, problems)
            check_macros(path, text, problems)
            if posixpath.dirname(path) in rooms:
                rooms[posixpath.dirname(path)] += lines
    problems.extend(f"{room}: has {lines} lines of source, {ROOM_LINES} are allowed; make two rooms of it"
                    for room, lines in rooms.items() if lines > ROOM_LINES)
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Functions, files and rooms that are too long", check(source.parse_root().root),
                           "Small functions on one screen, and rooms that can be learned in an afternoon."))
