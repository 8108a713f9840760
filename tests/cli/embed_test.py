# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""The example of docs/start.md draws a picture and tells what is wrong.

usage: embed_test.py EMBED
"""

import os
import subprocess
import sys
import unittest

from process import ProgramTest, count_values, read_png, require_gl

EMBED = os.path.abspath(sys.argv.pop())


class Embed(ProgramTest):
    def run_embed(self, *words):
        return subprocess.run([EMBED] + [str(word) for word in words], cwd=self.work, env=self.environment,
                              capture_output=True, text=True)

    def test_draws(self):
        done = self.run_embed(self.write_scene(), "sky.png")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        width, height, rows = read_png(self.work / "sky.png")
        self.assertEqual((width, height), (320, 180))
        self.assertGreater(count_values(rows), 10)

    def test_tells_what_is_wrong(self):
        self.check_failure(self.run_embed("missing.json", "sky.png"), 1, ["missing.json"])
        self.check_failure(self.run_embed(self.write_scene(), "missing/sky.png"), 1, ["missing/sky.png"])


if __name__ == "__main__":
    require_gl()
    unittest.main(verbosity=2)
