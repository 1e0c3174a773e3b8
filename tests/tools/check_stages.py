# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses, in every file with a function that is given the view of a stage, fields that are reached by way of a set:
there, mor_view_read and mor_view_write give them, and mor_view_quote for messages, so that what a stage does not
declare is not there. Whatever else a stage might reach, as by a pointer kept from before or by a function of another
file without a view, is found while it runs, by the checked build (docs/design/checked_build.md)."""

import re
import sys

import source

# The definition of a function that takes a view, whatever its name: a stage, or what a stage calls.
VIEW = re.compile(r"\bmor_view \*\w+[^;{}]*\)\s*\{")
# Fields of a set, whatever the set is called: set.data, set->data, rocks->data[MOR_FIELD_VELOCITY].
FIELD = re.compile(r"\bset(?:\.|->)data\b|\b\w+(?:\.|->)data\s*\[[^\]]*?(?:MOR_FIELD_|\bfield)")
HOME = "core/time/view.c"


def check(root):
    problems = []
    for path in source.list_files(root, (".c",)):
        text = source.without_comments(source.read_text(root, path))
        if path.startswith("tests/") or path == HOME or not VIEW.search(text):
            continue
        for match in FIELD.finditer(text):
            problems.append(f"{path}:{source.line_of(text, match.start())}: '{match.group(0)}' goes past the view of a "
                            "stage; ask mor_view_read or mor_view_write, for a message mor_view_quote")
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Fields past the views of stages", check(source.parse_root().root),
                           "What a stage does not declare is not there."))
