# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Refuses files that call one another in a circle, read from the symbol tables of an optimized build: whoever reads a
file needs to know those below it only."""

import glob
import os
import re
import subprocess
import sys

import source

LINE = re.compile(r"(.*)/lib(\S+)\.a\[(\S+?)\.c\.o\]: (\S+) (\w)\b")


def read_calls(build):
    """File -> {file it calls: a symbol}, both as library:name."""
    owners, wanted = {}, {}
    libraries = sorted(glob.glob(os.path.join(build, "**", "libmor_*.a"), recursive=True))
    for library in libraries:
        done = subprocess.run(["nm", "-A", "-P", library], capture_output=True, text=True, check=True)
        for line in done.stdout.splitlines():
            match = LINE.match(line)
            if not match:
                continue
            file = f"{match.group(2)}:{match.group(3)}"
            if match.group(5) in "TDRBWVi":
                owners.setdefault(match.group(4), file)
            elif match.group(5) == "U":
                wanted.setdefault(file, set()).add(match.group(4))
    calls = {}
    for file, symbols in wanted.items():
        calls[file] = {owners[symbol]: symbol for symbol in sorted(symbols) if owners.get(symbol, file) != file}
    return calls, len(libraries)


def find_circle(calls):
    """One circle as a list of files, the first again at its end; None where there is none."""
    state = {}
    for start in sorted(calls):
        if start in state:
            continue
        trail, stack = [start], [iter(sorted(calls[start]))]
        state[start] = "open"
        while stack:
            follower = next(stack[-1], None)
            if follower is None:
                state[trail.pop()] = "done"
                stack.pop()
            elif state.get(follower) == "open":
                return trail[trail.index(follower):] + [follower]
            elif follower not in state:
                state[follower] = "open"
                trail.append(follower)
                stack.append(iter(sorted(calls.get(follower, {}))))
    return None


def check(build):
    calls, n_libraries = read_calls(build)
    if n_libraries == 0:
        return [f"{build}: there is no libmor_*.a in it; build first"]
    circle = find_circle(calls)
    if circle is None:
        return []
    steps = [f"{one} calls {calls[one][other]} of {other}" for one, other in zip(circle, circle[1:])]
    return [f"{circle[0]}: call circle: {'; '.join(steps)}"]


if __name__ == "__main__":
    options = source.parse_root([("build", "folder of an optimized build")])
    sys.exit(source.report("Call circles", check(options.build),
                           "Move the function to the lower file, or hand the upper one's down as an argument."))
