# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses text that has no place in the project: missing licence tags, long lines, tabs, words of unfinished work,
traces of one machine, links of the documentation that lead nowhere, and options of the program in what the library
says."""

import os
import posixpath
import re
import sys

import source

TAG = ("Moraine: soil-rock mixtures by smoothed particle hydrodynamics.", "SPDX-License-Identifier: Apache-2.0")
TAGGED = (".c", ".h", ".def", ".py", ".sh", ".cmake", "CMakeLists.txt")
TEXT = TAGGED + (".md", ".cfg", ".json", ".dict", "dev", ".ci/run", ".clang-format", ".gitignore")
TABLES = (".def",)  # one entry a line, however long
LINE_LENGTH = 120
DELIBERATE = ("tests/regression/bad_", "tests/fuzz/corpus/")  # malformed on purpose

# The project speaks of itself alone. Paths outside it may be named in tests, which look for optional data there.
OUTSIDE_PATHS = re.compile(r"\.\./shared\b|(?<![\w.])/root/|(?<![\w.])/home/")
UNFINISHED = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b|\b(stub(bed)?|placeholders?|not (yet )?implemented|dummy value)\b"
                        r"|@@\w+@@")
# A program that uses the library has no options: its messages say what to do in words of their own.
OF_PROGRAM = ("tests/", "cases/driver/command/", "cases/driver/main.c")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]+|\bwith -[a-z]\b|"
                    r"\bmoraine (?:run|render|list|check|explain|relax|preview)\b")
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s#]*)(?:#([^)\s]*))?\)")
HEADING = re.compile(r"^#{1,6} +(.*)$", re.MULTILINE)
CODE_BLOCK = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
TEMPLATE = re.compile(r"\{'\w+': ")  # what a script that fills in numbers leaves behind


def check_lines(path, text):
    lines = text.split("\n")
    for number, line in enumerate(lines, 1):
        place = f"{path}:{number}"
        if path.endswith(TAGGED) and not path.endswith(TABLES) and len(line) > LINE_LENGTH:
            yield f"{place}: {len(line)} characters, {LINE_LENGTH} are allowed; break the line"
        if path.endswith(TAGGED) and "\t" in line:
            yield f"{place}: a tab; indent with spaces"
        if path.endswith(TAGGED) and line != line.rstrip():
            yield f"{place}: spaces at the end of the line; remove them"
        if not path.startswith("tests/"):
            for match in OUTSIDE_PATHS.finditer(line):
                yield f"{place}: '{match.group(0)}' is a path of one machine; name places relative to the project"
        if not path.startswith("tests/tools/"):
            for match in UNFINISHED.finditer(line):
                yield f"{place}: '{match.group(0)}' marks unfinished work; finish it or leave it out"
    if text and not text.endswith("\n"):
        yield f"{path}:{len(lines)}: no line break at the end of the file; add one"


def check_tag(path, text):
    top = text.split("\n", 3)[:3]
    if not any(first.endswith(TAG[0]) and TAG[1] in second for first, second in zip(top, top[1:])):
        yield f"{path}:1: no licence tag; begin as core/base/context.h does"


def check_messages(path, text):
    code = source.without_comments(text)
    for string in STRING.finditer(code):
        for match in OPTION.finditer(string.group(0)):
            yield (f"{path}:{source.line_of(code, string.start())}: '{match.group(0)}' is of the program; the library "
                   "serves other programs too: say what to do without it")


def find_anchors(text):
    """The names by which a page's headings are linked to, as the renderers of Markdown make them."""
    count = {}
    for heading in HEADING.findall(CODE_BLOCK.sub("", text)):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        number = count.get(name, 0)
        count[name] = number + 1
        yield f"{name}-{number}" if number else name


def check_links(root, path, text):
    for match in LINK.finditer(text):
        target, anchor = match.groups()
        if re.match(r"[a-z]+:", target):
            continue
        line = source.line_of(text, match.start())
        place = posixpath.normpath(posixpath.join(posixpath.dirname(path), target)) if target else path
        if not os.path.exists(os.path.join(root, place)):
            yield f"{path}:{line}: the link {target} leads nowhere; there is no {place}"
        elif anchor and place.endswith(".md") and anchor not in find_anchors(source.read_text(root, place)):
            yield f"{path}:{line}: the link {target}#{anchor} leads nowhere; no heading of {place} has that name"
    for match in TEMPLATE.finditer(text):
        yield f"{path}:{source.line_of(text, match.start())}: '{match.group(0)}' is of a script; write the number"


def check(root):
    problems = []
    for path in source.list_files(root):
        if not path.endswith(TEXT) or path.startswith(DELIBERATE):
            continue
        text = source.read_text(root, path)
        problems.extend(check_lines(path, text))
        if path.endswith(TAGGED):
            problems.extend(check_tag(path, text))
        if path.endswith((".c", ".h")) and not path.startswith(OF_PROGRAM):
            problems.extend(check_messages(path, text))
        if path.endswith(".md"):
            problems.extend(check_links(root, path, text))
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Text to mend", check(source.parse_root().root), "One style everywhere, and no loose ends."))
