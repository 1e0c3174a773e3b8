# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses code outside materials/ that knows a parameter of a material by its key: parameters with a role are found by
the role (core/base/schema.h), so that a law is free in its choice of words."""

import re
import sys

import source

KEY = re.compile(r'\.key = "(\w+)",\s*\\?\s*\.role = MOR_ROLE_')
FREE = ("materials/", "tests/")


def find_keys(root):
    """Keys of all parameters that have a role."""
    keys = set()
    for path in source.list_files(root, (".c", ".h")):
        if path.startswith("materials/"):
            keys.update(KEY.findall(source.read_text(root, path)))
    return keys


def check(root):
    problems = []
    keys = find_keys(root)
    if not keys:
        return ["materials: no parameter has a role; give each that others need one of MOR_ROLE_..."]
    literal = re.compile('"(' + "|".join(sorted(keys)) + ')"')
    for path in source.list_files(root, (".c", ".h")):
        if path.startswith(FREE):
            continue
        text = source.read_text(root, path)
        for match in literal.finditer(text):
            problems.append(f"{path}:{source.line_of(text, match.start())}: '{match.group(1)}' is a key of some laws "
                            "only; find the parameter by its role, as mor_params_role_value does")
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Parameters looked up by key", check(source.parse_root().root),
                           "A parameter is known by its role."))
