#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""The table of shaders holds every file, names what its rebuild depends on, and refuses a wrong include.

usage: embedder_test.py EMBED_SHADERS
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

EMBEDDER = sys.argv.pop()


class Embedder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name) / "shaders"
        (self.root / "sky").mkdir(parents=True)
        (self.root / "sky" / "sky.frag").write_text('#include "lib.glsl"\n', encoding="utf-8")
        (self.root / "lib.glsl").write_text("#include <math.h>\n", encoding="utf-8")
        (self.root / "notes.txt").write_text("not a shader", encoding="utf-8")
        self.output = pathlib.Path(self.folder.name) / "table.c"
        self.depfile = pathlib.Path(self.folder.name) / "table.d"

    def run_embedder(self):
        return subprocess.run([sys.executable, EMBEDDER, self.root, self.output, "--depfile",
                               self.depfile], text=True, capture_output=True)

    def test_table_and_depfile_hold_every_shader_and_folder(self):
        self.assertEqual(self.run_embedder().returncode, 0)
        table = self.output.read_text(encoding="utf-8")
        self.assertIn('{"lib.glsl", (const char *)text_0}', table)
        self.assertIn('{"sky/sky.frag", (const char *)text_1}', table)
        self.assertNotIn("notes", table)
        target, paths = self.depfile.read_text(encoding="utf-8").split(": ", 1)
        self.assertEqual(target, str(self.output))
        wanted = {self.root, self.root / "sky", self.root / "sky/sky.frag", self.root / "lib.glsl"}
        self.assertEqual(set(map(pathlib.Path, paths.split())), wanted)

    def test_an_include_of_nothing_stops_with_its_place(self):
        (self.root / "sky" / "sky.frag").write_text('\n\n#include "gone.glsl"\n', encoding="utf-8")
        done = self.run_embedder()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("shaders/sky/sky.frag:3: no shader gone.glsl", done.stderr)
        self.assertFalse(self.output.exists())

    def test_a_continued_line_stops_with_its_place(self):
        (self.root / "lib.glsl").write_text("#define A \\\n    1\n", encoding="utf-8")
        done = self.run_embedder()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("shaders/lib.glsl:1: a line cannot be continued", done.stderr)


if __name__ == "__main__":
    unittest.main()
