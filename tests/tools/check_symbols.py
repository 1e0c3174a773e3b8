# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Reads the symbol tables of the static libraries of a build. Refuses mutable variables that live as long as the
program, and library code that prints, exits, reads the environment or takes memory behind the back of the counter."""

import fnmatch
import glob
import os
import re
import subprocess
import sys

import source

# Sections whose content may change while the program runs. Constant tables of pointers lie in .data.rel.ro.
WRITABLE = re.compile(r"\.(data|bss|tdata|tbss)(?!\.rel\.ro)(\..*)?$|\*COM\*$")

# library:object:symbol patterns of variables that may be mutable, each with its reason.
ALLOWED_VARIABLES = {
    "libmor_core_base.a:process_lock.*:process_mutex": "libraries with one state per process need one lock per process",
}

# What the library must not call -> (why, patterns of library:object where it may).
FORBIDDEN_CALLS = {
    r"exit|quick_exit|abort": ("ends the process; return a mor_status", ()),
    r"_exit": ("ends the process; return a mor_status", ("libmor_relaxation_mesh.a:isolate.*",)),  # ends a child
    r"(__)?(printf|vprintf)(_chk)?|puts|putchar|stdout|perror": (
        "prints; report through mor_context_log or a FILE * given by the caller", ()),
    r"stderr": ("prints; report through mor_context_log", ()),
    r"getenv|secure_getenv|setenv|putenv": ("reads or changes the environment; take an argument", ()),
    r"rand|srand|random|srandom|drand48|rand_r": ("is not reproducible; use core/base/random.h", ()),
    r"setlocale": ("changes the whole process; use uselocale or read numbers without a locale", ()),
    r"malloc|calloc|realloc|reallocarray|aligned_alloc|posix_memalign|strn?dup|v?asprintf|__v?asprintf_chk": (
        "takes memory that the context does not count; use core/base/memory.h", ("libmor_core_base.a:memory.*",)),
}

# The program: it may print, read the environment, and map a status to an exit code.
PROGRAM_LIBRARIES = ("libmor_cases_driver_command.a",)


def matches(place, patterns):
    return any(fnmatch.fnmatchcase(place, pattern) for pattern in patterns)


def read_symbols(library, objdump="objdump"):
    """(object, section, symbol) of each entry of a library's symbol table."""
    done = subprocess.run([objdump, "-t", "-w", library], capture_output=True, text=True, check=True)
    member = ""
    for line in done.stdout.splitlines():
        header = re.match(r"(\S+):\s+file format", line)
        if header:
            member = header.group(1)
            continue
        # value, seven flag characters (the sixth is d for sections and files), section, size, name
        entry = re.match(r"[0-9a-f]+ (.{7}) (\S+)\s+[0-9a-f]+\s+(?:\.hidden )?(\S+)$", line)
        if entry and entry.group(1)[5] != "d":
            yield member, entry.group(2), entry.group(3)


def check_library(library):
    problems = []
    name = os.path.basename(library)
    for member, section, symbol in read_symbols(library):
        place = f"{name}:{member}"
        if WRITABLE.match(section) and not matches(f"{place}:{symbol}", ALLOWED_VARIABLES):
            problems.append(f"{place}: {symbol} is a mutable variable of file scope (section {section}); make it "
                            "const, or move it into the context or the object it belongs to")
        if section != "*UND*" or name in PROGRAM_LIBRARIES:
            continue
        for pattern, (reason, places) in FORBIDDEN_CALLS.items():
            if re.fullmatch(pattern, symbol) and not matches(place, places):
                problems.append(f"{place}: {symbol} {reason}")
    return problems


def check_exports(shared, headers):
    """The shared library shows the functions that these headers declare, and nothing else."""
    done = subprocess.run(["nm", "-D", "--defined-only", shared], capture_output=True, text=True, check=True)
    shown = {line.split()[-1] for line in done.stdout.splitlines() if not re.search(r" _\w+$", line)}
    declared = set()
    for header in headers:
        with open(header, encoding="utf-8") as file:
            public = re.findall(r"visibility push\(default\)(.*?)visibility pop", file.read(), re.DOTALL)
        code = source.without_comments("".join(public))
        declared |= set(re.findall(r"\b(mor_\w+)\(", code))
    name = os.path.basename(shared)
    return ([f"{name}: shows {symbol}, which no public header declares; hide it" for symbol in sorted(shown - declared)]
            + [f"{name}: does not show {symbol}, which a public header declares"
               for symbol in sorted(declared - shown)])


# What the shared library is to show is declared in them, between the pragmas of visibility.
PUBLIC_HEADERS = ("cases/moraine.h", "core/base/status.h")


def check(build, root=None):
    libraries = sorted(glob.glob(os.path.join(build, "**", "libmor_*.a"), recursive=True))
    if not libraries:
        return [f"{build}: there is no libmor_*.a in it; build first"]
    problems = [problem for library in libraries for problem in check_library(library)]
    for shared in glob.glob(os.path.join(build, "lib", "libmoraine.so")):
        problems.extend(check_exports(shared, [os.path.join(root, header) for header in PUBLIC_HEADERS]))
    return problems


if __name__ == "__main__":
    options = source.parse_root([("build", "folder of an optimized build")])
    sys.exit(source.report("Hidden state and forbidden calls", check(options.build, options.root),
                           "A library must leave the process to the program."))
