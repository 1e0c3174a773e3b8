# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses a file with stages that goes past their views: there, fields are reached with mor_view_read and
mor_view_write alone, so that what a stage does not declare is not there."""

import re
import sys

import source

STAGE = re.compile(r"\bmor_view \*view, const mor_step \*step\)\s*\{")
FIELD = re.compile(r"\bset(?:\.|->)data\b")


def check(root):
    problems = []
    for path in source.list_files(root, (".c",)):
        text = source.read_text(root, path)
        if path.startswith("tests/") or not STAGE.search(text):
            continue
        for match in FIELD.finditer(text):
            problems.append(f"{path}:{source.line_of(text, match.start())}: '{match.group(0)}' goes past the view of a "
                            "stage; ask mor_view_read or mor_view_write, for a message mor_view_quote")
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Stages past their views", check(source.parse_root().root),
                           "What a stage does not declare is not there."))
