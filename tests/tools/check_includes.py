# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses an include that the folder may not have, an include cycle, an outside library away from its door, OpenMP
away from core/base/parallel.h, and a unit test outside the folder of a room. The rooms, and who may include whom, stand
in CMakeLists.txt, in the calls of mor_add_room."""

import posixpath
import re
import sys

import source

# Outside header (pattern) -> the files that may include it.
DOORS = {
    r"hdf5\.h|H5\w+\.h": ("core/io/hdf5_file.c",),
    r"libconfig\.h": ("core/io/case_file/case_file.c",),
    r"(udunits2/)?udunits2?\.h": ("core/base/units.c",),
    r"(sundials|arkode|cvode)/.*": ("core/time/ode/ode.c",),
    r"(nvector|sunmatrix|sunlinsol|sunnonlinsol)/.*": ("core/time/ode/ode.c", "core/material/element/newton.c"),
    r"kinsol/.*": ("core/material/element/newton.c",),
    r"embree3/.*": ("cases/driver/picture/view/scene.c", "relaxation/mesh/mesh_distance.c"),
    r"(libpng\d*/)?png\.h": ("cases/driver/picture/draw/png_file.c",),
    r"cairo(/cairo)?(-\w+)?\.h": ("cases/driver/picture/draw/canvas.c",),
    r"jansson\.h": ("core/io/summary/summary.c",),
    r"muParser.*\.h": ("core/formula/formula.c",),
    r"(gdal/)?(gdal|cpl_|ogr).*\.h": ("relaxation/terrain/terrain_read.c",),
    r"assimp/.*": ("relaxation/mesh/mesh_read.c",),
    r"(dlfcn|link)\.h": ("core/material/shared_object.c",),
    r"omp\.h": ("core/base/parallel.h",),
    r"cmocka\.h": ("tests/",),
    r"setjmp\.h": ("tests/", "cases/driver/main.c", "cases/driver/picture/draw/png_file.c"),
    r"(x86|imm)intrin\.h|arm_neon\.h": ("core/base/", "core/particle/lanes.h", "core/sph/", "core/material/",
                                       "materials/", "tests/bench/peak.h"),
}

LIBC = re.compile(
    r"(assert|complex|ctype|dirent|errno|fcntl|fenv|float|inttypes|iso646|libgen|limits|locale|math|poll|pthread|sched"
    r"|semaphore|signal|spawn|stdalign|stdarg|stdatomic|stdbool|stddef|stdint|stdio|stdlib|stdnoreturn|string|strings"
    r"|tgmath|threads|time|uchar|unistd|wchar|wctype|ftw|getopt|malloc"
    r"|sys/(ioctl|mman|random|resource|stat|time|times|types|uio|utsname|wait))\.h")

GENERATED = {"moraine_build.h": "cases/driver/library"}
# A user's project in the tree: it may include what that room may, which is what is installed.
KITS = {"materials/template": "materials/frame", "materials/template_rates": "materials/frame"}
# The program is its commands and the library behind cases/moraine.h.
MAINS = {"cases/driver/main.c": ("cases", "cases/driver/command")}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)
OPENMP = re.compile(r'#[ \t]*pragma[ \t]+omp\b|_Pragma[ \t]*\([ \t]*"[ \t]*omp\b|MOR_PRAGMA_\([ \t]*omp\b')


def may_include(path, header, rooms):
    """Tests see everything; a room sees itself and what it depends on; nobody else sees anything but main.c."""
    room, other = posixpath.dirname(path), posixpath.dirname(header)
    if path.startswith("tests/"):
        return other in rooms or header.startswith("tests/")
    if path in MAINS:
        return other in MAINS[path]
    return room == other or other in rooms.get(KITS.get(room, room), ())


def check_project_header(path, header, known, rooms):
    if header in GENERATED:
        if not path.startswith(GENERATED[header] + "/"):
            return f'"{header}" is for {GENERATED[header]} only'
        return None
    if header not in known:
        return f'"{header}" is no file of the project; write the path from the top folder, as "core/base/context.h"'
    if not may_include(path, header, rooms):
        room = KITS.get(posixpath.dirname(path), posixpath.dirname(path))
        allowed = ", ".join(MAINS.get(path) or rooms.get(room, ())) or "nothing else"
        return f'"{header}": {posixpath.dirname(path) or "this folder"} may include its own headers and {allowed}'
    return None


def check_outside_header(path, header):
    for pattern, places in DOORS.items():
        if re.fullmatch(pattern, header):
            if any(path == place or (place.endswith("/") and path.startswith(place)) for place in places):
                return None
            doors = " or ".join(places) or "no file yet; add its door to DOORS in tests/tools/check_includes.py"
            return f"<{header}> belongs behind its door: {doors}"
    if LIBC.fullmatch(header):
        return None
    return f"<{header}> is neither libc nor a library with a door in tests/tools/check_includes.py"


def check_place(path, rooms):
    """Unit tests lie as the rooms do: what core/io holds is tested in tests/unit/core/io."""
    if not path.startswith("tests/unit/"):
        return None
    room = posixpath.dirname(path).removeprefix("tests/unit").lstrip("/")
    if room in rooms:
        return None
    return (f"{path}:1: " + (f"{room} is no room" if room else "it lies in no room") + " of CMakeLists.txt; move it to "
            "tests/unit/<room of what it tests>, as tests/unit/core/base")


def find_cycle(graph):
    """One cycle of the include graph as a list of files, or None."""
    state = {}

    def visit(node, trail):
        state[node] = "open"
        for follower in graph.get(node, ()):
            if state.get(follower) == "open":
                return trail[trail.index(follower):] + [follower]
            if follower not in state:
                cycle = visit(follower, trail + [follower])
                if cycle:
                    return cycle
        state[node] = "done"
        return None

    for node in sorted(graph):
        if node not in state:
            cycle = visit(node, [node])
            if cycle:
                return cycle
    return None


def check(root):
    files = source.list_files(root, (".c", ".h", ".def"))
    known = set(files)
    rooms = source.read_rooms(root)
    problems = []
    graph = {}
    for path in files:
        problem = check_place(path, rooms)
        if problem:
            problems.append(problem)
        text = source.without_comments(source.read_text(root, path))
        graph[path] = []
        for match in INCLUDE.finditer(text):
            ours, outside = match.groups()
            problem = check_project_header(path, ours, known, rooms) if ours else check_outside_header(path, outside)
            if problem:
                problems.append(f"{path}:{source.line_of(text, match.start(ours and 1 or 2))}: {problem}")
            elif ours in known:
                graph[path].append(ours)
        if path != "core/base/parallel.h":
            for match in OPENMP.finditer(text):
                problems.append(f"{path}:{source.line_of(text, match.start())}: OpenMP is written in "
                                "core/base/parallel.h only; use or add a macro there")
    cycle = find_cycle(graph)
    if cycle:
        problems.append(f"{cycle[0]}: include cycle: {' -> '.join(cycle)}")
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Forbidden includes and misplaced tests", check(source.parse_root().root),
                           "Move the code to the folder that may see what it needs, or pass it as an argument."))
