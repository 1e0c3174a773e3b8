# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""What the checks of the source share: which files there are, C text without comments, functions with their extent."""

import argparse
import os
import re
import sys

FOLDERS = ("core", "materials", "bodies", "relaxation", "cases", "tests", "docs", ".ci")


def list_files(root, suffixes=None):
    """Paths of the project's files, relative to root with '/', sorted; suffixes filters by ending."""
    found = [name for name in os.listdir(root) if os.path.isfile(os.path.join(root, name))]
    for folder in FOLDERS:
        for place, folders, names in os.walk(os.path.join(root, folder)):
            folders[:] = [name for name in folders if name != "__pycache__"]
            relative = os.path.relpath(place, root).replace(os.sep, "/")
            found.extend(f"{relative}/{name}" for name in names)
    if suffixes is not None:
        found = [path for path in found if path.endswith(tuple(suffixes))]
    return sorted(found)


def read_text(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        return file.read()


ROOM = re.compile(r"^mor_add_room\(([^)]*)\)", re.MULTILINE)
SECTIONS = ("DEPENDS", "DOORS", "EXCLUDE", "FUSED")


def read_rooms(root):
    """Folder -> folders whose headers it may include, from the calls of mor_add_room in CMakeLists.txt."""
    rooms = {}
    for match in ROOM.finditer(read_text(root, "CMakeLists.txt")):
        words = match.group(1).split()
        rooms[words[0]] = []
        section = None
        for word in words[1:]:
            section = word if word in SECTIONS else section
            if section == "DEPENDS" and word != section:
                rooms[words[0]].append(word)
    return rooms


def keep_lines(match):
    """Blanks a piece of text but keeps its line breaks, so that line numbers stay true."""
    return re.sub(r"[^\n]", " ", match.group(0))


COMMENT_OR_STRING = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)
COMMENT = re.compile(r'(/\*.*?\*/|//[^\n]*)|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)


def without_comments(text):
    """C text with comments blanked, strings kept."""
    return COMMENT.sub(lambda match: keep_lines(match) if match.group(1) else match.group(0), text)


def without_comments_and_strings(text):
    return COMMENT_OR_STRING.sub(keep_lines, text)


def code_only(text):
    """C text with comments, strings and preprocessor lines blanked."""
    return DIRECTIVE.sub(keep_lines, without_comments_and_strings(text))


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


class Unbalanced(Exception):
    """Braces do not match; holds the line where this shows."""

    def __init__(self, line):
        super().__init__(f"line {line}")
        self.line = line


def find_functions(text):
    """(name, first line, last line) of each function with a body, from its return type to its closing brace."""
    code = code_only(text)
    functions = []
    depth = 0
    begin = 0  # one past the end of the previous item at file scope
    head = ""
    opened = 0
    for match in re.finditer(r"[{};]", code):
        sign, offset = match.group(0), match.start()
        if sign == "{":
            if depth == 0:
                head, opened = code[begin:offset], begin
            depth += 1
            continue
        if sign == "}":
            depth -= 1
            if depth < 0:
                raise Unbalanced(line_of(code, offset))
            if depth == 0:
                name = function_name(head)
                if name is not None:
                    first = opened + len(head) - len(head.lstrip())
                    functions.append((name, line_of(code, first), line_of(code, offset)))
        if depth == 0:
            begin = match.end()
    if depth != 0:
        raise Unbalanced(line_of(code, len(code)))
    return functions


def function_name(head):
    """The name a head such as 'static int f(int a)' defines, or None when it is no function."""
    head = re.sub(r"__attribute__\s*\(\(.*?\)\)", " ", head, flags=re.DOTALL)
    match = re.search(r"([A-Za-z_]\w*)\s*\((?:.*)\)\s*$", head, re.DOTALL)
    if match is None or "=" in head.split("(")[0]:
        return None
    return head.split("(")[0].split()[-1].lstrip("*") if head.split("(")[0].split() else None


def report(title, problems, advice, warnings=()):
    """Prints the outcome and returns the exit code."""
    for warning in warnings:
        print(f"note: {warning}")
    for problem in problems:
        print(problem)
    if problems:
        print(f"\n{title}: {len(problems)} found. {advice}")
        return 1
    print(f"{title}: none found")
    return 0


def parse_root(extra=()):
    """Command line: the root of the project, then what a check needs besides."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", required=True, help="top folder of the project")
    for name, text in extra:
        parser.add_argument(f"--{name}", required=True, help=text)
    options = parser.parse_args()
    if not os.path.isfile(os.path.join(options.root, "CMakeLists.txt")):
        sys.exit(f"--root {options.root}: there is no CMakeLists.txt in it; give the top folder of the project")
    return options
