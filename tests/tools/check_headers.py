# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Compiles each header alone, and twice in one file: it must include what it needs and carry its own guard."""

import concurrent.futures
import subprocess
import sys

import source

FLAGS = ["-std=c11", "-D_GNU_SOURCE", "-fopenmp", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", "-x", "c",
         "-fsyntax-only"]


def expected_guard(path):
    return "MOR_" + path.replace("/", "_").replace(".", "_").replace("-", "_").upper()


def check_header(root, compiler, path):
    problems = []
    guard = expected_guard(path)
    if f"#ifndef {guard}\n#define {guard}\n" not in source.read_text(root, path):
        problems.append(f"{path}:1: no guard {guard} (#ifndef, then #define on the next line)")
    program = f'#include "{path}"\n#include "{path}"\nint mor_translation_unit_is_not_empty;\n'
    done = subprocess.run([compiler, *FLAGS, f"-I{root}", "-"], input=program, capture_output=True, text=True, cwd=root,
                          check=False)
    if done.returncode != 0:
        first = next((line for line in done.stderr.splitlines() if "error" in line), done.stderr.strip())
        problems.append(f"{path}:1: does not compile alone: {first}")
    return problems


def check(root, compiler):
    headers = source.list_files(root, (".h",))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = pool.map(lambda path: check_header(root, compiler, path), headers)
        return [problem for problems in found for problem in problems]


if __name__ == "__main__":
    options = source.parse_root([("compiler", "the C compiler of the build")])
    sys.exit(source.report("Headers that do not stand alone", check(options.root, options.compiler),
                           "Include in the header what its declarations use, and name the guard after the path."))
