# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Draws the rooms and their dependencies from CMakeLists.txt, and refuses a docs/design/rooms.svg that shows others.
With --write yes it writes the drawing. An arrow points at what a room depends on; one that others imply is left out."""

import os
import sys

import source

DRAWING = "docs/design/rooms.svg"
BOX_WIDTH, BOX_HEIGHT, GAP, ROW, MARGIN = 182, 34, 18, 88, 24
COLORS = {"core": "#cfe0f3", "materials": "#d6ecd2", "bodies": "#f8dfc4", "relaxation": "#e4d8f0", "cases": "#e6e6e6"}
NAMES = {"core": "the particle method", "materials": "laws", "bodies": "rocks",
         "relaxation": "shapes and their particles", "cases": "the program"}


def reach(rooms):
    """Room -> all rooms below it."""
    below = {}

    def visit(room):
        if room not in below:
            below[room] = set()
            for other in rooms[room]:
                below[room] |= {other} | visit(other)
        return below[room]

    for room in rooms:
        visit(room)
    return below


def reduce(rooms):
    """The arrows that no others imply."""
    below = reach(rooms)
    return {room: [one for one in dict.fromkeys(others)
                   if not any(one in below[other] for other in others if other != one)]
            for room, others in rooms.items()}


def find_levels(rooms):
    level = {}

    def visit(room):
        if room not in level:
            level[room] = 1 + max((visit(other) for other in rooms[room]), default=-1)
        return level[room]

    for room in rooms:
        visit(room)
    return level


def arrange(rooms, arrows):
    """Rows of rooms, the lowest first, each ordered so that arrows are short."""
    level = find_levels(rooms)
    rows = [[room for room in rooms if level[room] == k] for k in range(1 + max(level.values()))]
    above = {room: [other for other in rooms if room in arrows[other]] for room in rooms}
    for sweep in range(24):
        place = {room: (k + 0.5) / len(row) for row in rows for k, room in enumerate(row)}
        for row in rows if sweep % 2 == 0 else reversed(rows):
            near = {room: (arrows[room] if sweep % 2 == 0 else above[room]) or [room] for room in row}
            row.sort(key=lambda room: (sum(place[one] for one in near[room]) / len(near[room]), room))
            place.update({room: (k + 0.5) / len(row) for k, room in enumerate(row)})
    return rows


def draw(rooms):
    arrows = reduce(rooms)
    rows = arrange(rooms, arrows)
    width = 2 * MARGIN + max(len(row) for row in rows) * (BOX_WIDTH + GAP) - GAP
    height = 2 * MARGIN + 40 + len(rows) * ROW - (ROW - BOX_HEIGHT)
    corner = {}
    for k, row in enumerate(rows):
        start = (width - len(row) * (BOX_WIDTH + GAP) + GAP) / 2
        for n, room in enumerate(row):
            corner[room] = (start + n * (BOX_WIDTH + GAP), height - MARGIN - BOX_HEIGHT - k * ROW)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
             'font-size="13">',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
             'orient="auto"><path d="M0 0L8 4L0 8z" fill="#667"/></marker></defs>',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for k, (folder, color) in enumerate(COLORS.items()):
        x = MARGIN + k * 280
        lines.append(f'<rect x="{x}" y="{MARGIN - 12}" width="18" height="18" rx="3" fill="{color}" stroke="#667"/>')
        lines.append(f'<text x="{x + 25}" y="{MARGIN + 2}">{folder}: {NAMES[folder]}</text>')
    for room, others in arrows.items():
        for other in others:
            x0, y0 = corner[room][0] + BOX_WIDTH / 2, corner[room][1] + BOX_HEIGHT
            x1, y1 = corner[other][0] + BOX_WIDTH / 2, corner[other][1]
            lines.append(f'<path d="M{x0:g} {y0:g}C{x0:g} {y0 + 30:g} {x1:g} {y1 - 34:g} {x1:g} {y1 - 2:g}" '
                         'fill="none" stroke="#667" stroke-opacity="0.7" marker-end="url(#tip)"/>')
    for room, (x, y) in corner.items():
        top = room.split("/")[0]
        label = room.removeprefix("cases/driver/")
        lines.append(f'<rect x="{x:g}" y="{y:g}" width="{BOX_WIDTH}" height="{BOX_HEIGHT}" rx="5" '
                     f'fill="{COLORS[top]}" stroke="#667"/>')
        lines.append(f'<text x="{x + BOX_WIDTH / 2:g}" y="{y + 22:g}" text-anchor="middle">{label}</text>')
    lines.append("</svg>")
    return "\n".join(lines) + "\n"


def check(root):
    path = os.path.join(root, DRAWING)
    shown = source.read_text(root, DRAWING) if os.path.exists(path) else ""
    if shown != draw(source.read_rooms(root)):
        return [f"{DRAWING}: shows other rooms than CMakeLists.txt; run tests/tools/check_rooms_drawing.py --root . "
                "--write yes"]
    return []


if __name__ == "__main__":
    options = source.parse_root([("write", "yes: write the drawing; no: compare only")])
    if options.write == "yes":
        with open(os.path.join(options.root, DRAWING), "w", encoding="utf-8") as file:
            file.write(draw(source.read_rooms(options.root)))
    sys.exit(source.report("Drawing of the rooms", check(options.root), "The drawing follows the build."))
