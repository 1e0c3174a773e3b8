# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses functions over 120 lines, files over 600 lines and macros over 60 lines; notes functions over 60 lines."""

import sys

import source

FUNCTION_LINES = 120
FUNCTION_LINES_NOTED = 60
MACRO_LINES = 60
FILE_LINES = 600


def check_functions(path, text, problems, notes):
    try:
        functions = source.find_functions(text)
    except source.Unbalanced as unbalanced:
        problems.append(f"{path}:{unbalanced.line}: braces do not balance, so functions cannot be measured; keep each "
                        "pair of braces in the same branch of an #if")
        return
    for name, first, last in functions:
        lines = last - first + 1
        message = f"{path}:{first}: {name} has {lines} lines"
        if lines > FUNCTION_LINES:
            problems.append(f"{message}, {FUNCTION_LINES} are allowed; split it")
        elif lines > FUNCTION_LINES_NOTED:
            notes.append(f"{message}; {FUNCTION_LINES_NOTED} are the aim")


def check_macros(path, text, problems):
    for match in source.DIRECTIVE.finditer(text):
        lines = match.group(0).count("\n") + 1
        if lines > MACRO_LINES:
            problems.append(f"{path}:{source.line_of(text, match.start())}: a macro has {lines} lines, {MACRO_LINES} "
                            "are allowed; make it a function")


def check(root):
    problems, notes = [], []
    for path in source.list_files(root, (".c", ".h", ".py", ".sh", "CMakeLists.txt")):
        text = source.read_text(root, path)
        lines = text.count("\n")
        if lines > FILE_LINES:
            problems.append(f"{path}: has {lines} lines, {FILE_LINES} are allowed; split it by topic")
        if path.endswith((".c", ".h")):
            check_functions(path, text, problems, notes)
            check_macros(path, text, problems)
    return problems, notes


if __name__ == "__main__":
    found, noted = check(source.parse_root().root)
    sys.exit(source.report("Functions and files that are too long", found,
                           "Small functions on one screen are the house rule.", noted))
