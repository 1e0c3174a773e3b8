# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses a test source that CTest does not run, a test that cannot fail because nothing in it asserts, and comparisons
in single precision."""

import json
import re
import subprocess
import sys

import source

TIERS = ("unit", "property", "physics", "regression")
SINGLE = re.compile(r"\bassert_float_(?:not_)?equal\b")
ASSERTION = re.compile(r"\b(assert_\w+|fail_msg|fail|mor_expect\w*|(?:\w+_)?scene_expect\w*)[ \t]*\(")
TEST = re.compile(r"\bstatic\s+void\s+(\w+)\s*\(\s*void\s*\*\*\s*\w+\s*\)")


def list_registered(build, ctest):
    """Names of the tests that CTest knows in a build folder."""
    command = [ctest, "--show-only=json-v1", "--test-dir", build]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {test["name"] for test in json.loads(done.stdout)["tests"]}


def registered_name(path):
    """The name CTest must know for a test source, or None for a file that is no test."""
    match = re.fullmatch(r"tests/(\w+)/(?:.+/)?([^/]+)\.c", path)
    if match is None:
        return None
    tier, stem = match.groups()
    if tier in TIERS:
        return f"{tier}/{stem}"
    return f"fuzz/{stem}" if tier == "fuzz" and stem.startswith("fuzz_") else None


def check_source(path, text):
    code = source.without_comments_and_strings(text)
    if not ASSERTION.search(code):
        yield f"{path}:1: nothing in it asserts, so it cannot fail; assert the law its name states"
    for match in SINGLE.finditer(code):
        yield (f"{path}:{source.line_of(code, match.start())}: assert_float_equal compares in single precision; use "
               "assert_near of tests/common/near.h")
    for match in TEST.finditer(code):
        uses = len(re.findall(rf"\b{match.group(1)}\b", code))
        if uses < 2:
            yield (f"{path}:{source.line_of(code, match.start())}: {match.group(1)} is in no group, so it never runs; "
                   "list it in the group of this file")


def check(root, registered):
    problems = []
    for path in source.list_files(root, (".c",)):
        name = registered_name(path)
        if name is None:
            continue
        if name not in registered:
            problems.append(f"{path}:1: CTest does not run it; configure again, and see tests/CMakeLists.txt for the "
                            "names it looks for")
        if not name.startswith("fuzz/"):
            problems.extend(check_source(path, source.read_text(root, path)))
    return problems


if __name__ == "__main__":
    options = source.parse_root([("build", "the build folder"), ("ctest", "the ctest program")])
    sys.exit(source.report("Tests that do not test", check(options.root, list_registered(options.build, options.ctest)),
                           "A test must run, and must be able to fail."))
