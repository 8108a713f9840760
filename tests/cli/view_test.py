# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella view: a window on a virtual display."""

import os
import shutil
import subprocess
import sys
import unittest

from keyboard import KEY_PRESS, KEY_RELEASE, Keyboard
from process import PROGRAM, THIN_SCENE, ProgramTest, count_values, read_png

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

    def start_display(self):
        """A display whose windows can be asked and pressed keys in."""
        read_end, write_end = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24"],
                                  pass_fds=[write_end], stderr=subprocess.DEVNULL)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        os.close(write_end)
        with os.fdopen(read_end) as told:
            self.environment["DISPLAY"] = ":" + told.readline().strip()
        self.environment.pop("WAYLAND_DISPLAY", None)
        keyboard = Keyboard(self.environment["DISPLAY"])
        self.addCleanup(keyboard.close)
        return keyboard

    def write_hills(self):
        """A scene with relief, in text."""
        rows = [" ".join(str(500 + 400 * ((x + y) % 3)) for x in range(36)) for y in range(18)]
        head = "ncols 36\nnrows 18\nxllcorner -180\nyllcorner -90\ncellsize 10\n"
        (self.data / "hills.asc").write_text(head + "\n".join(rows) + "\n")
        (self.data / "hills.prj").write_text('GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257]],'
                                             'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]')
        return self.write_scene(dict(THIN_SCENE, surface={"layers": [{"elevation": "hills.asc"}]}))

    def test_keys_change_the_mesher_in_flight(self):
        keyboard = self.start_display()
        view = self.start_program("view", self.write_hills(), "--view", "ground", "--size", "96x64")
        self.addCleanup(view.communicate)
        self.addCleanup(view.kill)
        meshers = ["quadtree", "hemisphere", "projective", "tessellated"]

        def find_mesher(title):
            return next((name for name in meshers if f", {name}, " in title), "")

        def find_place(title):
            return title.split(", ")[-4]

        title = keyboard.wait_for_title(lambda title: find_mesher(title) and "solving" not in title)
        begun_at = find_place(title)
        seen = [find_mesher(title)]
        self.assertEqual(seen, ["quadtree"], title)
        keyboard.send(KEY_PRESS, "e")  # up, as long as it is held
        while len(seen) == 1 or seen[-1] != "quadtree":
            before = seen[-1]
            keyboard.press("n")
            seen.append(find_mesher(keyboard.wait_for_title(lambda title: find_mesher(title) not in ["", before], 60)))
            self.assertNotEqual(seen[-1], before)
        keyboard.send(KEY_RELEASE, "e")
        self.assertGreaterEqual(set(seen), set(meshers[:3]), seen)
        self.assertEqual(seen[-1], "quadtree", seen)
        self.assertNotEqual(find_place(keyboard.find_window()[1]), begun_at)
        keyboard.press("Escape")
        self.assertEqual(view.wait(60), 0)


if __name__ == "__main__":
    if not shutil.which("xvfb-run") and os.environ.get("TRL_REQUIRE_GPU") != "1":
        print("skipped: no xvfb-run")
        sys.exit(77)
    unittest.main(verbosity=2)
