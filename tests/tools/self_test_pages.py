# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Proves that the checks of text and of the pages of reference accept good pages and refuse bad ones."""

import os

import check_reference
import check_text
import source
from self_test_sample import TAG, Sample


class Text(Sample):
    def refuse(self, path, text, *fragments):
        self.write(path, text)
        self.expect(check_text.check(self.root), path, *fragments)

    def test_options_of_the_program_in_messages_of_the_library_are_refused(self):
        for message, found in (("add --resume to go on", "--resume"), ("choose another one with -o", "with -o"),
                               ("see moraine list fields", "moraine list")):
            with self.subTest(message):
                code = TAG + f'/* as with -o */\nconst char *const text = "{message}";\n'
                self.write("cases/driver/command/command.c", code)
                self.refuse("core/base/bad.c", code, ":4", f"'{found}' is of the program")

    def test_good_source_passes(self):
        self.expect(check_text.check(self.root))

    def test_missing_tag_is_refused(self):
        self.refuse("core/base/bad.c", "int a;\n", "no licence tag")

    def test_layout_is_checked(self):
        for line, fragment in (("int a; //" + "x" * 112, "121 characters"), ("\tint a;", "a tab"),
                               ("int a; ", "spaces at")):
            with self.subTest(fragment):
                self.refuse("core/base/bad.c", TAG + line + "\n", ":3", fragment)

    def test_last_line_must_end(self):
        self.refuse("core/base/bad.c", TAG + "int a;", "no line break")

    def test_input_that_is_malformed_on_purpose_passes(self):
        self.write("tests/regression/bad_cases/cut.cfg", "title = ")
        self.write("tests/fuzz/corpus/case/cut.cfg", "TODO")
        self.expect(check_text.check(self.root))

    def test_paths_of_a_machine_are_refused(self):
        for word in ("/home/me/x.md", "../shared/x.md", "/root/x.md"):
            with self.subTest(word):
                self.refuse("docs/bad.md", f"See {word}.\n", "docs/bad.md:1")

    def test_optional_data_outside_may_be_named_in_tests(self):
        self.write("tests/physics/test_a.c", TAG + '/* "../shared/data" */\n')
        self.expect(check_text.check(self.root))

    def test_unfinished_work_is_refused(self):
        for word in ("TODO", "FIXME", "a stub", "placeholder", "not implemented", "not yet implemented", "@@ROWS@@"):
            with self.subTest(word):
                self.refuse("core/base/bad.c", f"{TAG}/* {word} */\n", "unfinished")

    def test_dead_link_is_refused(self):
        self.refuse("docs/bad.md", "[there](../core/base/none.c#top)\n", "leads nowhere", "core/base/none.c")

    def test_link_to_a_heading_that_is_not_there_is_refused(self):
        page = "# Its title\n\n## A part: [one](good.md#its-title)\n\n## A part\n\n```\n# code\n```\n"
        self.write("docs/good.md", page)
        for anchor in ("its-title", "a-part-one", "a-part"):
            with self.subTest(anchor):
                self.write("docs/links.md", f"[there](good.md#{anchor})\n")
                self.expect(check_text.check(self.root))
        for anchor in ("none", "code", "a-part-1"):
            with self.subTest(anchor):
                self.refuse("docs/links.md", f"[there](good.md#{anchor})\n", "leads nowhere", "no heading")

    def test_remains_of_a_script_are_refused(self):
        self.refuse("docs/bad.md", "| 30 {'share': '0.1'} rocks |\n", "docs/bad.md:1", "of a script")


class Reference(Sample):
    """A program of a few lines stands for moraine: it prints what it is asked to list."""

    def setUp(self):
        super().setUp()
        self.write("moraine", "#!/bin/sh\nprintf '%s of a set\\nlast line\\n' \"$2\"\n")
        self.program = os.path.join(self.root, "moraine")
        os.chmod(self.program, 0o755)
        check_reference.write(self.root, self.program)

    def check(self):
        return check_reference.check(self.root, self.program)

    def change(self, page, old, new):
        path = f"{check_reference.FOLDER}/{page}"
        text = source.read_text(self.root, path)
        self.assertIn(old, text)
        self.write(path, text.replace(old, new))

    def test_pages_just_written_pass(self):
        self.expect(self.check())

    def test_missing_page_is_refused(self):
        os.remove(os.path.join(self.root, check_reference.FOLDER, "probes.md"))
        self.expect(self.check(), "docs/reference/probes.md:1", "missing")

    def test_changed_word_is_refused(self):
        self.change("case_file.md", "keys of", "lock of")
        self.expect(self.check(), "docs/reference/case_file.md:1", "'lock of a set'", "'keys of a set'")

    def test_lost_line_is_refused(self):
        self.change("fields.md", "last line\n", "")
        self.expect(self.check(), "docs/reference/fields.md", "the program prints 'last line'")

    def test_line_too_many_is_refused(self):
        self.change("case_file.md", "last line\n", "last line\nmore\n")
        self.expect(self.check(), "docs/reference/case_file.md:3", "the page says 'more'")

    def test_changed_title_is_refused(self):
        self.change("materials.md", "# Material models", "# Models")
        self.expect(self.check(), "docs/reference/materials.md:1")
