# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""A small good project in a temporary folder, which each test of the checks spoils in one way."""

import os
import shutil
import tempfile
import unittest

import check_headers

TAG = "/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.\n * SPDX-License-Identifier: Apache-2.0 */\n"


def header(path, body):
    guard = check_headers.expected_guard(path)
    return f"{TAG}#ifndef {guard}\n#define {guard}\n\n{body}\n#endif\n"


GOOD = {
    "CMakeLists.txt": """# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
mor_add_room(core/base)
mor_add_room(core/particle DEPENDS core/base)
mor_add_room(core/material/kit DEPENDS core/base)
mor_add_room(core/material DEPENDS core/base core/material/kit)
mor_add_room(core/io DEPENDS core/base core/material DOORS hdf5)
mor_add_room(materials DEPENDS core/base core/material/kit FUSED)
mor_add_room(materials/frame DEPENDS core/base core/material/kit)
mor_add_room(bodies DEPENDS core/base)
mor_add_room(cases/driver/case DEPENDS core/base)
""",
    "core/base/context.h": header("core/base/context.h", "typedef struct mor_context { int n; } mor_context;\n"),
    "core/base/length.h": header("core/base/length.h", """#include "core/base/context.h"

/** Returns the length of a vector.
 *  @param a [in]  shape [3], unit m
 *  Returns: unit m. */
double mor_length(const double *a);
"""),
    "core/base/length.c": TAG + """#include "core/base/length.h"

#include <math.h>

double mor_length(const double *a)
{
    /* "{" in a comment and in a string must not matter: { */
    const char *const brace = "{";
    return sqrt(a[0] * a[0]) * (brace[0] == '{');
}
""",
    "core/particle/set.h": header("core/particle/set.h", '#include "core/base/context.h"\n'),
    "materials/clay.c": TAG + '#include "core/base/context.h"\n',
    "tests/unit/core/base/test_length.c": TAG + """#include "core/base/length.h"

static void length_is_positive(void **state)
{
    (void)state;
    assert_true(1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(length_is_positive)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
""",
    "README.md": "# Moraine\n\nSee [the code](core/base/length.c) and [Debian](https://www.debian.org).\n",
}


class Sample(unittest.TestCase):
    """A small good project, changed by each test."""

    def setUp(self):
        self.root = tempfile.mkdtemp(prefix="moraine_checks_")
        self.addCleanup(shutil.rmtree, self.root)
        for path, text in GOOD.items():
            self.write(path, text)

    def write(self, path, text):
        place = os.path.join(self.root, path)
        os.makedirs(os.path.dirname(place), exist_ok=True)
        with open(place, "w", encoding="utf-8") as file:
            file.write(text)

    def expect(self, problems, *fragments):
        """Exactly one problem, whose message holds all fragments; none when no fragment is given."""
        problems = list(problems)
        self.assertEqual(len(problems), 1 if fragments else 0, problems)
        for fragment in fragments:
            self.assertIn(fragment, problems[0])
