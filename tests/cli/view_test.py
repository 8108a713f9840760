# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella view: a window on a virtual display."""

import os
import shutil
import subprocess
import sys
import unittest

from process import PROGRAM, ProgramTest, count_values, read_png

DISPLAY = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24"]


class Window(ProgramTest):
    def run_window(self, *words):
        command = DISPLAY + [PROGRAM, "view", str(self.write_scene())] + [str(word) for word in words]
        return subprocess.run(command, cwd=self.work, env=self.environment, capture_output=True, text=True,
                              timeout=300)

    def test_draws_what_render_draws(self):
        done = self.run_window("--size", "160x90", "--frames", 3, "--screenshot", "window.png", "--ev100", "12")
        self.assertEqual(done.returncode, 0, done.stderr)
        width, height, rows = read_png(self.work / "window.png")
        self.assertEqual((width, height), (160, 90))
        self.assertGreater(count_values(rows), 10)
        self.expect_success("render", self.folder / "scene.json", "--size", "160x90", "-o", "render.png", "--ev100",
                            "12")
        drawn = read_png(self.work / "render.png")[2]
        # The same passes on another context; where the sun was resolved by other steps a pixel may round otherwise.
        differences = [abs(a - b) for one, other in zip(rows, drawn) for a, b in zip(one, other)]
        self.assertLess(sum(differences) / len(differences), 0.1)

    def test_a_picture_alone_means_one_frame(self):
        done = self.run_window("--size", "64x64", "--screenshot", "window.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(read_png(self.work / "window.png")[:2], (64, 64))

    def test_no_display(self):
        self.environment.pop("DISPLAY", None)
        self.environment.pop("WAYLAND_DISPLAY", None)
        self.expect_failure(1, ["view", self.write_scene()], ["display"])

    def test_picture_that_cannot_be_written(self):
        self.expect_failure(1, ["view", self.write_scene(), "--screenshot", "missing/a.png"], ["cannot be written"])


if __name__ == "__main__":
    if not shutil.which("xvfb-run") and os.environ.get("TRL_REQUIRE_GPU") != "1":
        print("skipped: no xvfb-run")
        sys.exit(77)
    unittest.main(verbosity=2)
