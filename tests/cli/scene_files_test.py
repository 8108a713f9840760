# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Scene files that are missing, cut off or wrong, as the program tells of them."""

import copy
import json
import unittest

from process import SCENES, THIN_SCENE, ProgramTest


class SceneFiles(ProgramTest):
    def expect_wrong(self, path, *mentions):
        self.expect_failure(1, ["render", path, "--views"], mentions)

    def test_files_that_are_not_scenes(self):
        self.expect_wrong(self.folder / "missing.json", "missing.json")
        self.expect_wrong(self.folder, str(self.folder))
        for name, content in [("empty.json", b""), ("zeros.json", bytes(1000)), ("text.json", b"hello"),
                              ("list.json", b"[]"), ("deep.json", b"[" * 100000),
                              ("latin.json", b'{"name": "\xff"}')]:
            path = self.folder / name
            path.write_bytes(content)
            self.expect_wrong(path, name)

    def test_a_scene_cut_off_anywhere(self):
        whole = (SCENES / "earth.json").read_bytes().rstrip()
        path = self.folder / "cut.json"
        # 61 places over the whole text, and the last ones, where least is missing.
        places = list(range(0, len(whole), len(whole) // 60)) + [len(whole) - k for k in (1, 2, 3, 5, 8)]
        for length in places:
            path.write_bytes(whole[:length])
            self.expect_wrong(path, "cut.json")

    def test_every_command_tells_it(self):
        path = self.folder / "wrong.json"
        path.write_text("{")
        queries = ["--altitude", 0, "--sun-zenith", 0, "--view-zenith", 0, "--azimuth", 0, "--wavelength", 550]
        for words in [["info", path], ["render", path], ["view", path], ["sky", path] + queries,
                      ["bench", "solver", "--scene", path, "--json"]]:
            self.expect_failure(1, words, ["wrong.json:1"])

    def test_values_that_cannot_be(self):
        def change(*keys):
            *above, last, value = keys
            scene = copy.deepcopy(THIN_SCENE)
            part = scene
            for key in above:
                part = part[key]
            part[last] = value
            return scene

        gas = ["atmosphere", "constituents", 0]
        wrong = [
            (change("terrella", 99), "terrella"),
            (change("planet", "radius_m", -1), "radius_m"),
            (change("planet", "radius_m", "big"), "radius_m"),
            (change("planet", "radius_m", None), "radius_m"),
            (change("planet", "ground_albedo", -0.1), "ground_albedo"),
            (change("planet", "ground_albedo", 1.5), "ground_albedo"),
            (change("planet", "raduis_m", 1), "radius_m"),
            (change("atmosphere", "height_m", 0), "height_m"),
            (change(*gas, "scattering_per_m", -1e-6), "scattering_per_m"),
            (change(*gas, "phase", {"henyey_greenstein": {"g": 1.5}}), "phase"),
            (change(*gas, "profile", {"exponential": {"scale_height_m": -8}}), "profile"),
            (change("star", "spectral_irradiance", [[500, 1], [400, 1]]), "spectral_irradiance"),
        ]
        for scene, mention in wrong:
            self.expect_wrong(self.write_scene(scene), "scene.json:", mention)
        path = self.folder / "nan.json"
        path.write_text(json.dumps(THIN_SCENE).replace("6371000", "NaN"))
        self.expect_wrong(path, "nan.json:1")


if __name__ == "__main__":
    unittest.main(verbosity=2)
