# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Proves that each check accepts good source and refuses bad source: every sample is a small project in a temporary
folder with one defect."""

import os
import subprocess
import sys
import unittest

import check_calls
import check_docstrings
import check_headers
import check_includes
import check_rooms_drawing
import check_sizes
import check_stages
import check_symbols
import check_tests
import check_roles
import check_sessions
import source
from self_test_sample import GOOD, TAG, Sample, header
from self_test_pages import Reference, Text  # found by unittest by their names here

COMPILER, CTEST = "cc", "ctest"


class Includes(Sample):
    def refuse(self, path, line, *fragments):
        self.write(path, TAG + line + "\n")
        self.expect(check_includes.check(self.root), path + ":3", *fragments)

    def test_good_source_passes(self):
        self.expect(check_includes.check(self.root))

    def test_base_must_not_see_particles(self):
        self.refuse("core/base/bad.c", '#include "core/particle/set.h"', "core/particle/set.h", "nothing else")

    def test_materials_must_not_see_particles(self):
        self.refuse("materials/sand.c", '#include "core/particle/set.h"', "core/base, core/material")

    def test_materials_template_must_not_see_what_is_not_installed(self):
        self.write("materials/frame/sum.h", TAG)
        self.refuse("materials/template/sand.c", '#include "materials/frame/sum.h"', "core/base, core/material/kit")

    def test_depending_on_a_room_does_not_show_the_rooms_below_it(self):
        self.write("core/material/params.h", TAG)
        self.write("core/material/kit/material.h", TAG)
        self.write("core/io/good.c", TAG + '#include "core/material/params.h"\n')
        self.refuse("core/io/bad.c", '#include "core/material/kit/material.h"',
                    "core/io may include its own headers and core/base, core/material")

    def test_nobody_includes_cases(self):
        self.write("cases/driver/case/case.h", TAG)
        self.refuse("bodies/bad.c", '#include "cases/driver/case/case.h"', "bodies may include")

    def test_the_program_sees_its_commands_and_the_library_only(self):
        self.write("CMakeLists.txt", source.read_text(self.root, "CMakeLists.txt") + "mor_add_room(cases)\n"
                   "mor_add_room(cases/driver/run)\nmor_add_room(cases/driver/command DEPENDS cases)\n")
        self.write("cases/moraine.h", TAG)
        self.write("cases/driver/run/run.h", TAG)
        self.write("cases/driver/command/good.c", TAG + '#include "cases/moraine.h"\n')
        self.write("cases/driver/main.c", TAG + '#include "cases/moraine.h"\n')
        self.refuse("cases/driver/command/bad.c", '#include "cases/driver/run/run.h"', "headers and cases")
        self.write("cases/driver/command/bad.c", TAG)
        self.refuse("cases/driver/main.c", '#include "cases/driver/run/run.h"', "cases, cases/driver/command")

    def test_nobody_includes_tests(self):
        self.write("tests/common/tools.h", TAG)
        self.refuse("cases/driver/bad.c", '#include "tests/common/tools.h"', "cases/driver may include")

    def test_unit_tests_lie_in_the_folder_of_a_room(self):
        self.write("tests/unit/core/particle/test_set.c", TAG)
        self.write("tests/property/test_any.c", TAG)
        self.expect(check_includes.check(self.root))
        for folder, fragment in (("tests/unit", "in no room"), ("tests/unit/core", "core is no room"),
                                 ("tests/unit/core/base/more", "core/base/more is no room")):
            with self.subTest(folder):
                path = f"{folder}/test_bad.c"
                self.write(path, TAG)
                self.expect(check_includes.check(self.root), path + ":1", fragment, "move it to")
                os.remove(os.path.join(self.root, path))

    def test_paths_start_at_the_top(self):
        self.refuse("core/base/bad.c", '#include "context.h"', "write the path from the top folder")

    def test_outside_library_stays_behind_its_door(self):
        self.write("core/io/hdf5_file.c", TAG + "#include <hdf5.h>\n")
        self.refuse("core/io/bad.c", "#include <hdf5.h>", "core/io/hdf5_file.c")

    def test_every_outside_library_has_a_door(self):
        for outside in ("libconfig.h", "udunits2.h", "udunits2/udunits2.h", "embree3/rtcore.h", "cairo.h",
                        "cairo/cairo.h", "muParserDLL.h",
                        "cvode/cvode.h", "nvector/nvector_serial.h", "sundials/sundials_types.h", "jansson.h", "gdal.h",
                        "gdal/gdal.h", "assimp/scene.h", "dlfcn.h", "omp.h", "png.h", "cmocka.h"):
            with self.subTest(outside):
                self.refuse("core/sph/bad.c", f"#include <{outside}>", outside, "behind its door")

    def test_unknown_library_is_refused(self):
        self.refuse("core/base/bad.c", "#include <gsl/gsl_math.h>", "neither libc nor")

    def test_openmp_stays_in_one_file(self):
        self.write("core/base/parallel.h", TAG + "#pragma omp parallel\n")
        for line in ("#pragma omp simd", '_Pragma("omp simd")', "MOR_PRAGMA_(omp simd)"):
            with self.subTest(line):
                self.refuse("core/sph/bad.c", line, "core/base/parallel.h only")

    def test_comments_do_not_count(self):
        self.write("core/base/fine.c", TAG + '/* #include "core/particle/set.h" */\n// #pragma omp simd\n')
        self.expect(check_includes.check(self.root))

    def test_cycles_are_refused(self):
        self.write("core/base/a.h", TAG + '#include "core/base/b.h"\n')
        self.write("core/base/b.h", TAG + '#include "core/base/a.h"\n')
        self.expect(check_includes.check(self.root), "include cycle", "core/base/a.h -> core/base/b.h -> core/base/a.h")


class Headers(Sample):
    def test_good_source_passes(self):
        self.expect(check_headers.check(self.root, COMPILER))

    def test_missing_include_is_refused(self):
        self.write("core/base/bad.h", header("core/base/bad.h", "int64_t mor_bad(void);\n"))
        self.expect(check_headers.check(self.root, COMPILER), "core/base/bad.h:1", "does not compile alone", "int64_t")

    def test_missing_guard_is_refused(self):
        self.write("core/base/bad.h", TAG + "int mor_bad(void);\n")
        self.expect(check_headers.check(self.root, COMPILER), "no guard MOR_CORE_BASE_BAD_H")


class Stages(Sample):
    STAGE = "mor_status mor_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step)\n{\n%s\n}\n"

    def test_good_source_passes(self):
        self.write("core/base/kick.c", TAG + self.STAGE % "    double *v = mor_view_write(view, 1);")
        self.write("core/base/setup.c", TAG + "void f(mor_set *set)\n{\n    set->data[0] = NULL;\n}\n")
        self.expect(check_stages.check(self.root))

    def test_stage_past_its_view_is_refused(self):
        self.write("core/base/kick.c", TAG + self.STAGE % "    double *v = soil->set.data[1];")
        self.expect(check_stages.check(self.root), "core/base/kick.c:5: 'set.data' goes past the view of a stage")

    def test_what_a_stage_calls_and_other_names_of_a_set_are_held_to_the_same_rule(self):
        helper = "static void drift(mor_view *mine,\n                  double time)\n{\n    %s\n}\n"
        for line, found in (("double *x = group->set.data[0];", "set.data"),
                            ("double *x = rocks->data[MOR_FIELD_POSITION];", "rocks->data[MOR_FIELD_"),
                            ("double *x = rocks->data[it->field_rate];", "")):
            with self.subTest(line):
                self.write("core/base/drift.c", TAG + helper % line)
                self.expect(check_stages.check(self.root), f"core/base/drift.c:6: '{found}")


class Sizes(Sample):
    def write_function(self, n_lines):
        body = "    a += 1;\n" * (n_lines - 5)
        self.write("core/base/long.c", f"{TAG}static int\nmor_long(int a)\n{{\n{body}    return a;\n}}\n")

    def test_good_source_passes(self):
        self.expect(check_sizes.check(self.root))

    def test_function_of_the_largest_size_passes(self):
        self.write_function(60)
        self.expect(check_sizes.check(self.root))

    def test_longer_function_is_refused(self):
        self.write_function(61)
        self.expect(check_sizes.check(self.root), "core/base/long.c:3: mor_long has 61 lines, 60 are allowed")

    def test_large_room_is_refused(self):
        for k in range(7):
            self.write(f"core/particle/part_{k}.c", TAG + "int a;\n" * 590)
        self.expect(check_sizes.check(self.root), "core/particle: has 4152 lines of source, 4000 are allowed")

    def test_long_file_is_refused(self):
        self.write("core/base/long.c", TAG + "int a;\n" * 599)
        self.expect(check_sizes.check(self.root), "has 601 lines, 600 are allowed")

    def test_long_macro_is_refused(self):
        self.write("core/base/long.c", TAG + "#define LONG \\\n" + "    a += 1; \\\n" * 60 + "\n")
        self.expect(check_sizes.check(self.root), "a macro has 62 lines")

    def test_unbalanced_braces_are_refused(self):
        self.write("core/base/odd.c", TAG + "#ifdef A\nint f(void) {\n#else\nint g(void) {\n#endif\n}\n")
        self.expect(check_sizes.check(self.root), "braces do not balance")

    def test_every_function_is_found(self):
        text = """struct a { int b; };
static const int table[] = {1, 2};
int *first(int (*call)(void)) { return 0; }
__attribute__((noinline)) static double second(void)
{
    if (1) { }
    return 0;
}
typedef enum e { A, B } e;
"""
        self.assertEqual(source.find_functions(text), [("first", 3, 3), ("second", 4, 8)])


class Symbols(Sample):
    def check_code(self, code, library="libmor_core_base.a", name="part"):
        self.write(f"{name}.c", code)
        place = os.path.join(self.root, name)
        subprocess.run([COMPILER, "-O1", "-c", "-fPIE", f"{place}.c", "-o", f"{place}.o"], check=True)
        subprocess.run(["ar", "rcs", os.path.join(self.root, library), f"{place}.o"], check=True)
        return check_symbols.check(self.root)

    def test_constants_pass(self):
        self.expect(self.check_code('const char *const names[] = {"a", "b"};\nstatic const int n = 3;\n'
                                    "int f(void);\nint f(void) { static const int k[2] = {1, 2}; return k[n - 2]; }\n"))

    def test_variables_are_refused(self):
        for code in ("int counter;", "int counter = 1;", "static int counter; int f(void) { return counter++; }",
                     "int f(void) { static int counter = 5; return counter++; }", "_Thread_local int counter;",
                     "_Thread_local int counter = 3;", 'const char *counter = "a";'):
            with self.subTest(code):
                self.expect(self.check_code(code + "\n"), "counter", "mutable variable of file scope")

    def test_the_lock_of_the_process_is_the_only_variable(self):
        code = ("#include <pthread.h>\nstatic pthread_mutex_t {} = PTHREAD_MUTEX_INITIALIZER;\nint f(void);\n"
                "int f(void) {{ return pthread_mutex_lock(&{}); }}\n")
        self.expect(self.check_code(code.format("process_mutex", "process_mutex"), name="process_lock"))
        self.expect(self.check_code(code.format("second", "second"), name="process_lock"), "second", "mutable variable")
        os.remove(os.path.join(self.root, "libmor_core_base.a"))
        self.expect(self.check_code(code.format("process_mutex", "process_mutex")), "part.o", "mutable variable")

    def test_calls_that_belong_to_the_program_are_refused(self):
        for call, reason in (("exit(1)", "ends the process"), ("abort()", "ends the process"), ('puts("a")', "prints"),
                             ('fprintf(stderr, "%d", 1)', "prints"), ('getenv("A")', "environment"),
                             ("rand()", "not reproducible"), ("malloc(3)", "memory")):
            with self.subTest(call):
                value = "" if call.startswith(("exit", "abort")) else "return (long)"
                code = f"#include <stdio.h>\n#include <stdlib.h>\nlong f(void);\nlong f(void) {{ {value}{call}; }}\n"
                self.expect(self.check_code(code), reason)

    def test_program_may_print_and_exit(self):
        code = '#include <stdio.h>\nint f(void) { return puts("a"); }\n'
        self.expect(self.check_code(code, "libmor_cases_driver_command.a"))

    def test_memory_is_taken_in_one_place(self):
        code = "#include <stdlib.h>\nvoid *f(void) { return malloc(3); }\n"
        self.expect(self.check_code(code, name="memory.c"))

    def test_empty_build_is_refused(self):
        self.expect(check_symbols.check(self.root), "build first")

    def test_the_shared_library_shows_what_the_public_header_declares(self):
        self.write("moraine.h", "#pragma GCC visibility push(default)\nint mor_a(void); /* mor_c( */\n"
                   "int mor_b(int n);\n#pragma GCC visibility pop\nint mor_d(void);\n")
        public = [os.path.join(self.root, "moraine.h")]
        shared = os.path.join(self.root, "libmoraine.so")
        for names, fragments in ((("mor_a", "mor_b"), ()), (("mor_a", "mor_b", "mor_c"), ("shows mor_c",)),
                                 (("mor_a",), ("does not show mor_b",))):
            self.write("code.c", "".join(f"int {name}(void);\nint {name}(void) {{ return 0; }}\n" for name in names))
            subprocess.run([COMPILER, "-shared", "-fPIC", os.path.join(self.root, "code.c"), "-o", shared], check=True)
            self.expect(check_symbols.check_exports(shared, public), *fragments)


class Docstrings(Sample):
    def check_text(self, body):
        return [message for _, message in check_docstrings.check_header(header("core/base/bad.h", body))]

    def test_good_source_passes(self):
        self.expect(check_docstrings.check(self.root))

    def test_good_forms_pass(self):
        for body in (
                "/** Sets n. */\nvoid mor_f(int n);\n",
                "/** @param x [in]  shape [n,3]; unit m/s2\n *  Returns: MOR_OK. */\n"
                "mor_status mor_f(const mor_a *a, const double *x);\n",
                "/** Length of a vector, shape [3]; unit: that of the vector. */\n"
                "static inline double mor_f(const double *a)\n{\n    return a[0];\n}\n",
                "/** @param user [in,out]  owned by the caller */\nvoid mor_f(void *user);\n",
                "/** A record. */\ntypedef struct mor_a {\n    double x[3]; /* position, m */\n"
                "    double *y;   /* shape [n]; unit kg/m3 */\n    int n;\n} mor_a;\n",
                "/** A record, SI. */\ntypedef struct mor_a {\n    double x, y;\n} mor_a;\n",
                "/** A table. */\ntypedef struct mor_a {\n    /** Distance [m] of a point, shape [3], unit m. */\n"
                "    double (*f)(const mor_a *a, const double *point);\n} mor_a;\n"):
            with self.subTest(body):
                self.expect(self.check_text(body))

    def test_bad_forms_are_refused(self):
        for body, fragment in (
                ("void mor_f(int n);\n", "mor_f has no docstring"),
                ("/** @param x [in]  unit m */\nvoid mor_f(const double *x);\n", "parameter x has no shape"),
                ("/** @param x [in]  shape [n] */\nvoid mor_f(const double *x);\n", "parameter x has no unit"),
                ("/** @param x [in]  how long it takes */\nvoid mor_f(double x);\n", "parameter x has no unit"),
                ("/** @param a [out]  the thing */\nvoid mor_f(mor_a **a);\n", "parameter a has no shape"),
                ("/** @param n [in]  a count */\nvoid mor_f(int n, int m);\n", "parameter m is not described"),
                ("/** @param n [in]  a count */\nmor_status mor_f(int n);\n", "no 'Returns:'"),
                ("/** Returns how much. */\ndouble mor_f(void);\n", "what it returns has no unit"),
                ("/** Returns how much. */\nstatic inline double mor_f(void)\n{\n    return 1.0;\n}\n",
                 "returns has no"),
                ("/** A record. */\ntypedef struct mor_a {\n    double x; /* place */\n} mor_a;\n", "x has no unit"),
                ("/** A record. */\ntypedef struct mor_a {\n    int *x; /* places */\n} mor_a;\n", "x has no shape"),
                ("/** A table. */\ntypedef struct mor_a {\n    void (*f)(const double *point);\n} mor_a;\n",
                 "f has no docstring")):
            with self.subTest(body):
                self.expect(self.check_text(body), fragment)


class Calls(Sample):
    def build(self, library, **files):
        for name, code in files.items():
            self.write(f"{name}.c", code)
            place = os.path.join(self.root, name)
            subprocess.run([COMPILER, "-O1", "-c", f"{place}.c", "-o", f"{place}.c.o"], check=True)
            subprocess.run(["ar", "rcs", os.path.join(self.root, library), f"{place}.c.o"], check=True)

    def test_files_in_order_pass(self):
        self.build("libmor_core_base.a", low="int low(void) { return 1; }\n",
                   high="int low(void);\nint high(void) { return low(); }\n")
        self.expect(check_calls.check(self.root))

    def test_circle_is_refused(self):
        self.build("libmor_core_base.a", one="int two(void);\nint one(int n) { return n > 0 ? two() : 0; }\n",
                   two="int three(void);\nint two(void) { return three(); }\n")
        self.build("libmor_bodies.a", three="int one(int n);\nint three(void) { return one(0); }\n")
        self.expect(check_calls.check(self.root), "call circle", "mor_bodies:three calls one of mor_core_base:one")

    def test_empty_build_is_refused(self):
        self.expect(check_calls.check(self.root), "build first")


class Roles(Sample):
    LAW = TAG + 'static const mor_schema P[] = {{.key = "friction_angle",\n    .role = MOR_ROLE_FRICTION_ANGLE}};\n'

    def test_a_key_in_its_law_passes(self):
        self.write("materials/clay.c", self.LAW)
        self.expect(check_roles.check(self.root))

    def test_a_key_elsewhere_is_refused(self):
        self.write("materials/clay.c", self.LAW)
        self.write("core/base/bad.c", TAG + 'double a(void) { return find("friction_angle"); }\n')
        self.expect(check_roles.check(self.root), "core/base/bad.c:3", "friction_angle", "by its role")

    def test_laws_without_roles_are_refused(self):
        self.expect(check_roles.check(self.root), "no parameter has a role")


class Sessions(Sample):
    STEP = "mor_status mor_session_step(mor_session *session)\n{\n    %s\n    return MOR_OK;\n}\n"

    def use(self, first_line):
        self.write("cases/moraine.h", TAG + "mor_status mor_session_step(mor_session *session);\n")
        self.write("cases/driver/library/step.c", TAG + self.STEP % first_line)
        return check_sessions.check(self.root)

    def test_a_function_that_begins_its_work_passes(self):
        self.expect(self.use("MOR_SESSION_WORK(session);"))

    def test_a_function_in_the_locale_of_the_program_is_refused(self):
        self.expect(self.use("int k = 0;"), "library/step.c:3", "mor_session_step", "MOR_SESSION_WORK")

    def test_a_function_that_is_not_found_is_refused(self):
        self.use("MOR_SESSION_WORK(session);")
        self.write("cases/driver/library/step.c", TAG)
        self.expect(check_sessions.check(self.root), "'mor_session_step' is not defined")

    def test_a_header_without_functions_is_refused(self):
        self.write("cases/moraine.h", TAG)
        self.expect(check_sessions.check(self.root), "no function of a session")


class RoomsDrawing(Sample):
    def test_a_drawing_of_these_rooms_passes(self):
        drawing = check_rooms_drawing.draw(source.read_rooms(self.root))
        self.write(check_rooms_drawing.DRAWING, drawing)
        self.expect(check_rooms_drawing.check(self.root))
        for room in source.read_rooms(self.root):
            self.assertIn(f">{room.removeprefix('cases/driver/')}</text>", drawing)

    def test_a_room_that_is_not_drawn_is_told(self):
        self.write(check_rooms_drawing.DRAWING, check_rooms_drawing.draw({"core/base": []}))
        self.expect(check_rooms_drawing.check(self.root), "shows other rooms")

    def test_implied_arrows_are_left_out(self):
        rooms = {"core/a": [], "core/b": ["core/a"], "core/c": ["core/a", "core/b"]}
        self.assertEqual(check_rooms_drawing.reduce(rooms), {"core/a": [], "core/b": ["core/a"], "core/c": ["core/b"]})


class Tests(Sample):
    def test_good_source_passes(self):
        self.expect(check_tests.check(self.root, {"unit/test_length"}))

    def test_unregistered_test_is_refused(self):
        self.expect(check_tests.check(self.root, {"unit/other"}), "tests/unit/core/base/test_length.c",
                    "CTest does not run it")

    def test_unregistered_test_below_a_tier_is_refused(self):
        self.write("tests/property/deep/test_a.c", TAG + "static void f(void) { assert_true(1); }\n")
        self.expect(check_tests.check(self.root, {"unit/test_length"}), "deep/test_a.c", "CTest does not run it")

    def test_unregistered_fuzzer_is_refused(self):
        self.write("tests/fuzz/fuzz_a.c", TAG)
        self.expect(check_tests.check(self.root, {"unit/test_length"}), "fuzz_a.c", "CTest does not run it")

    def test_file_without_assertion_is_refused(self):
        text = GOOD["tests/unit/core/base/test_length.c"].replace("assert_true(1)", "/* assert_true(1) */")
        self.write("tests/unit/core/base/test_length.c", text)
        self.expect(check_tests.check(self.root, {"unit/test_length"}), "nothing in it asserts")

    def test_comparison_in_single_precision_is_refused(self):
        text = GOOD["tests/unit/core/base/test_length.c"].replace("assert_true(1)", "assert_float_equal(1.0, 1.0, 0.0)")
        self.write("tests/unit/core/base/test_length.c", text)
        self.expect(check_tests.check(self.root, {"unit/test_length"}), "compares in single precision")

    def test_function_in_no_group_is_refused(self):
        text = GOOD["tests/unit/core/base/test_length.c"].replace("cmocka_unit_test(length_is_positive)", "")
        self.write("tests/unit/core/base/test_length.c", text)
        self.expect(check_tests.check(self.root, {"unit/test_length"}), "length_is_positive is in no group")

    def test_registered_tests_are_read_from_ctest(self):
        self.write("CTestTestfile.cmake", "add_test(unit/test_length true)\n")
        self.assertEqual(check_tests.list_registered(self.root, CTEST), {"unit/test_length"})


if __name__ == "__main__":
    if len(sys.argv) == 3:
        COMPILER, CTEST = sys.argv[1:]
        del sys.argv[1:]
    unittest.main(verbosity=1)
