# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses pages of docs/reference/ that differ from what the program prints. With --write it brings them up to date."""

import os
import subprocess
import sys

import source

FOLDER = "docs/reference"

# page: what is listed, title, lead. A page without a title is printed by the program as it stands.
PAGES = {
    "case_file.md": ("keys", None, None),
    "sweep_file.md": ("sweep", None, None),
    "fields.md": ("fields", "Fields of particles", """
Each line: name, components x [unit], whether snapshots hold it, meaning, and the stage or the material that writes it.
Six components are a symmetric tensor in the order xx, yy, zz, xy, yz, zx; nine are a matrix by rows. Stress is positive
in tension."""),
    "probes.md": ("probes", "Probes", """
What a case can measure. Each line: type, [unit; unit in plane strain], meaning. Which keys a type takes is in
[case_file.md](case_file.md); which measure of a run-out to report is in
[measure_run_out.md](../guide/measure_run_out.md)."""),
    "materials.md": ("materials", "Material models", """
Each model with its literature and its parameters in SI units, [-] for none. The role of a parameter is what the program
finds it by, whatever its name. Ranges and defaults are in [case_file.md](case_file.md). Laws of other programs, `umat`
and `mfront`: [use_a_umat.md](../guide/use_a_umat.md)."""),
    "tests.md": ("tests", "Element tests", """
What `moraine material` can be told. How to use it is in [test_a_material.md](../guide/test_a_material.md)."""),
}


def compose(page, printed):
    """The text a page must have, given what the program prints."""
    what, title, lead = PAGES[page]
    if title is None:
        return printed
    return f"# {title}\n\nPrinted by `moraine list {what}`.{lead}\n\n```text\n{printed}```\n"


def print_list(program, what):
    done = subprocess.run([program, "list", what], capture_output=True, encoding="utf-8", check=True)
    return done.stdout


def find_difference(found, wanted):
    """Number of the first line that differs, with both lines."""
    left, right = found.split("\n"), wanted.split("\n")
    for number, (a, b) in enumerate(zip(left, right), 1):
        if a != b:
            return number, a, b
    number = min(len(left), len(right))
    return number + 1, *(lines[number] if len(lines) > number else "the end" for lines in (left, right))


def check(root, program):
    for page, (what, _, _) in PAGES.items():
        path = f"{FOLDER}/{page}"
        if not os.path.exists(os.path.join(root, path)):
            yield f"{path}:1: the page is missing; write it with check_reference.py --write"
            continue
        found, wanted = source.read_text(root, path), compose(page, print_list(program, what))
        if found != wanted:
            number, page_line, program_line = find_difference(found, wanted)
            yield (f"{path}:{number}: the page says '{page_line}', the program prints '{program_line}'; bring it up to "
                   "date with check_reference.py --write")


def write(root, program):
    os.makedirs(os.path.join(root, FOLDER), exist_ok=True)
    for page, (what, _, _) in PAGES.items():
        text = compose(page, print_list(program, what))
        with open(os.path.join(root, FOLDER, page), "w", encoding="utf-8", newline="\n") as file:
            file.write(text)


if __name__ == "__main__":
    is_writing = "--write" in sys.argv
    sys.argv = [argument for argument in sys.argv if argument != "--write"]
    options = source.parse_root([("program", "the built moraine")])
    if is_writing:
        write(options.root, options.program)
    sys.exit(source.report("Pages of the reference that differ from the program",
                           list(check(options.root, options.program)), "The program itself prints its reference."))
