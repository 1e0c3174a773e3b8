# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Installs a build into a scratch folder, moves it, and uses it as a stranger would: the program of the library's guide
against the shared and the static library and through CMake, the template of a law, the header in C++. What the library
computes is compared with what the installed program computes, bit for bit."""

import argparse
import glob
import json
import os
import re
import shutil
import struct
import subprocess
import sys

SETTINGS = ["spacing=8 mm", "end=0.05 s"]  # those of the guide's program
PRINTED = re.compile(r"t = (\S+) s: run_out (\S+) m, particle 0 at \((\S+), (\S+)\) m/s\n")


class Failure(Exception):
    """What did not work, for people."""


def run(command, env=None, cwd=None):
    done = subprocess.run(command, capture_output=True, text=True, env=env, cwd=cwd, check=False)
    if done.returncode != 0:
        raise Failure(f"'{' '.join(command)}' ended with code {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def expect(condition, text):
    if not condition:
        raise Failure(text)


class Install:
    """An installed copy in a scratch folder."""

    def __init__(self, options):
        self.options = options
        self.scratch = options.scratch
        shutil.rmtree(self.scratch, ignore_errors=True)
        os.makedirs(self.scratch)
        self.prefix = os.path.join(self.scratch, "moved")
        self.guide = os.path.join(options.source, "docs/guide/use_as_library.md")
        self.env = dict(os.environ, MORAINE_CACHE="", LC_ALL="C")

    def install(self):
        """With DESTDIR and a prefix that is not there, then to where it is used: it must not matter where it lies."""
        staged = os.path.join(self.scratch, "staged")
        run([self.options.cmake, "--install", self.options.build, "--prefix", "/opt/moraine"],
            env=dict(self.env, DESTDIR=staged))
        os.rename(os.path.join(staged, "opt/moraine"), self.prefix)
        shutil.rmtree(staged)
        archives = glob.glob(os.path.join(self.prefix, "lib*/**/libmoraine.a"), recursive=True)
        self.libraries = os.path.dirname(archives[0])
        self.program = os.path.join(self.prefix, "bin/moraine")
        self.include = os.path.join(self.prefix, "include/moraine")
        self.case = os.path.join(self.prefix, "share/moraine/cases/column-2d/case.cfg")
        self.env["PKG_CONFIG_PATH"] = os.path.join(self.libraries, "pkgconfig")

    def check_files(self):
        for name in ("share/man/man1/moraine.1", "share/bash-completion/completions/moraine",
                     "share/doc/moraine/README.md", "share/doc/moraine/docs/index.md",
                     "share/doc/moraine/cases/README.md",  # pages link to cases beside them
                     "share/moraine/template/CMakeLists.txt", "share/moraine/template_rates/CMakeLists.txt",
                     "share/moraine/template_rates/bank.cfg",
                     "bin/moraine"):
            expect(os.path.isfile(os.path.join(self.prefix, name)), f"{name} was not installed")
        stray = [path for path in glob.glob(os.path.join(self.prefix, "**"), recursive=True)
                 if path.endswith((".h", ".c")) and not path.startswith((self.include, os.path.join(
                     self.prefix, "share/moraine/template")))]
        expect(not stray, f"sources were installed that nobody may use: {stray}")

    def check_headers(self):
        """Each compiles alone, against installed headers only; those of core/base only because others need them."""
        headers = sorted(glob.glob(os.path.join(self.include, "**/*.h"), recursive=True))
        expect(len(headers) >= 6, f"headers are missing: {headers}")
        texts = {os.path.relpath(path, self.include): open(path, encoding="utf-8").read() for path in headers}
        sources = glob.glob(os.path.join(self.prefix, "share/moraine/template*/*.c"))
        template = "".join(open(path, encoding="utf-8").read() for path in sources)
        for name in texts:
            run([self.options.cc, "-std=c11", "-fsyntax-only", "-Wall", "-Werror", "-x", "c", f"-I{self.include}",
                 os.path.join(self.include, name)])
            users = [other for other, text in {**texts, "template": template}.items() if f'"{name}"' in text]
            expect(users or not name.startswith("core/base"), f"{name} is installed, but no installed header needs it")

    def check_cpp(self):
        compiler = shutil.which("g++") or shutil.which("clang++")
        if compiler is None:
            return
        path = os.path.join(self.scratch, "header.cpp")
        with open(path, "w", encoding="utf-8") as file:
            file.write("#include <moraine.h>\nint main() { mor_session *s = nullptr; "
                       "return mor_session_new(&s) == MOR_OK && mor_status_text(MOR_OK)[0] == 'o' ? 0 : 1; }\n")
        flags = run(["pkg-config", "--cflags", "--libs", "moraine"], env=self.env).split()
        program = os.path.join(self.scratch, "header")
        run([compiler, "-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", path, *flags, "-o", program])
        run([program], env=dict(self.env, LD_LIBRARY_PATH=self.libraries))

    def write_program(self):
        """The first C program of the guide."""
        with open(self.guide, encoding="utf-8") as file:
            text = re.search(r"```c\n(.*?)```", file.read(), re.DOTALL).group(1)
        expect(text.count("\n") <= 25, "the first program of the guide is to be short")
        path = os.path.join(self.scratch, "column.c")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def compile_program(self, source, name, *arguments):
        """With the line of the guide."""
        flags = run(["pkg-config", "--cflags", "--libs", *arguments, "moraine"], env=self.env).split()
        program = os.path.join(self.scratch, name)
        run([self.options.cc, source, *flags, "-o", program])
        return program

    def needs_library(self, program):
        return "libmoraine" in run(["objdump", "-p", program])

    def check_program(self):
        """Shared, static and through CMake, all with the bits of the installed program."""
        source = self.write_program()
        shared = self.compile_program(source, "column")
        expect(self.needs_library(shared), "the program of the guide does not use the shared library")
        shared_env = dict(self.env, LD_LIBRARY_PATH=self.libraries)
        printed = run([shared, self.case], env=shared_env)
        self.compare(printed)
        wrong = subprocess.run([shared, "/nowhere/case.cfg"], capture_output=True, text=True, env=shared_env,
                               check=False)
        expect(wrong.returncode == 1 and "/nowhere/case.cfg" in wrong.stderr, f"no message for a bad file: {wrong}")
        hidden = os.path.join(self.scratch, "hidden")  # without it, --static finds the archive
        os.makedirs(hidden)
        for path in glob.glob(os.path.join(self.libraries, "libmoraine.so*")):
            shutil.move(path, hidden)
        static = self.compile_program(source, "column_static", "--static")
        expect(not self.needs_library(static), "the program linked with --static needs the shared library")
        expect(run([static, self.case], env=self.env) == printed, "the static library computes something else")
        for path in os.listdir(hidden):
            shutil.move(os.path.join(hidden, path), self.libraries)
        self.check_cmake(source, printed)

    def compare(self, printed):
        numbers = PRINTED.fullmatch(printed)
        expect(numbers, f"the program of the guide printed '{printed}'")
        folder = os.path.join(self.scratch, "run")
        words = [word for setting in SETTINGS for word in ("--set", setting)]
        subprocess.run([self.program, "run", self.case, "-o", folder, "--set", "output.pictures=false", *words],
                       capture_output=True, env=self.env, check=False)  # so short a run misses its expectations
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            results = json.load(file)["results"]
        value = results["run_out"]["value"]
        expect(value == float(numbers.group(2)), f"the library found run_out {numbers.group(2)}, the program {value!r}")
        last = sorted(glob.glob(os.path.join(folder, "snapshots/*.h5")))[-1]
        with open(last, "rb") as file:
            field = file.read()
        velocity = struct.pack("<2d", float(numbers.group(3)), float(numbers.group(4)))
        expect(any(velocity) and velocity in field, f"{last} holds no particle of the velocity that the library tells")

    def check_cmake(self, source, printed):
        project = os.path.join(self.scratch, "project")
        os.makedirs(project)
        shutil.copy(os.path.join(self.options.source, "tests/install/CMakeLists.txt"), project)
        shutil.copy(source, project)
        build = os.path.join(project, "build")
        run([self.options.cmake, "-S", project, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
             f"-DCMAKE_C_COMPILER={self.options.cc}"])
        run([self.options.cmake, "--build", build])
        for name in ("column", "column_static"):  # CMake tells the program where the shared library is
            expect(run([os.path.join(build, name), self.case], env=self.env) == printed, f"{name} of CMake differs")
        expect(not self.needs_library(os.path.join(build, "column_static")), "moraine::static is not static")

    def check_template(self):
        """Each built as a project of its own and checked."""
        for name, law, case in (("template", "undrained_clay", "slump.cfg"),
                                ("template_rates", "viscoplastic_soil", "bank.cfg")):
            self.check_template_run(self.build_template(name, law), law, case)

    def build_template(self, name, law):
        folder = os.path.join(self.scratch, f"my_{law}")
        shutil.copytree(os.path.join(self.prefix, "share/moraine", name), folder)
        build = os.path.join(folder, "build")
        run([self.options.cmake, "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
             f"-DCMAKE_C_COMPILER={self.options.cc}"])
        run([self.options.cmake, "--build", build])
        table = run([self.program, "check-material", os.path.join(build, f"{law}.so")], env=self.env)
        expect(law in table and "failed" not in table, table)
        return folder

    def check_template_run(self, folder, law, case):
        """The law in its case."""
        results = os.path.join(folder, "results")
        run([self.program, "run", os.path.join(folder, case), "-o", results, "--set", "end=0.2 s", "--set",
             "output.pictures=false"], env=self.env)
        with open(os.path.join(results, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        expect(summary["provenance"]["plugins"][0]["models"] == f"{law} 1.0", summary["provenance"])
        value = summary["results"]["run_out"]["value"]
        expect(value > 2.0, f"a bank that cannot stand has not moved: run_out {value}")

    def check_template_umat(self):
        """Built with the line of its page, checked and run."""
        compiler = shutil.which("gfortran")
        expect(compiler, "gfortran is needed: apt-get install gfortran")
        folder = os.path.join(self.scratch, "my_umat")
        shutil.copytree(os.path.join(self.prefix, "share/moraine/template_umat"), folder)
        run([compiler, "-O2", "-shared", "-fPIC", "-o", "libumat.so", "drucker_prager.f90"], cwd=folder)
        with open(os.path.join(folder, "fixed.f"), "w", encoding="utf-8") as file:
            file.write("      SUBROUTINE UMAT(A)\n      INCLUDE 'ABA_PARAM.INC'\n"
                       "      DIMENSION A(nprecd)\n      END\n")
        run([compiler, "-c", "-I", ".", "fixed.f"], cwd=folder)
        table = run([self.program, "check-material", "heap.cfg"], env=self.env, cwd=folder)
        expect("soil 'sand': umat" in table and "failed" not in table, table)
        run([self.program, "run", "heap.cfg", "-o", "results", "--set", "end=0.1 s", "--set", "output.pictures=false"],
            env=self.env, cwd=folder)
        with open(os.path.join(folder, "results/summary.json"), encoding="utf-8") as file:
            value = json.load(file)["results"]["run_out"]["value"]
        expect(value > 0.2, f"a column that cannot stand has not moved: run_out {value}")

    def check_program_alone(self):
        """The installed program needs no library of ours, and its own words are there."""
        expect(not self.needs_library(self.program), "the program needs libmoraine.so, which may not be found")
        expect("moraine " in run([self.program, "--version"], env=self.env), "the program does not tell its version")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("source", "build", "scratch", "cmake", "cc"):
        parser.add_argument(f"--{name}", required=True)
    install = Install(parser.parse_args())
    try:
        install.install()
        install.check_files()
        install.check_headers()
        install.check_cpp()
        install.check_program_alone()
        install.check_program()
        install.check_template()
        install.check_template_umat()
    except Failure as failure:
        print(failure, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
