# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella sea: light in the water as numbers."""

import csv
import io
import unittest

from process import THIN_SCENE, ProgramTest

FLAGS = ["--depth", "2,100", "--sun-zenith", "30", "--view-zenith", "140", "--wavelength", "450,650"]


class Answers(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write_scene({**THIN_SCENE, "ocean": {"water": {"chlorophyll_mg_m3": 0}, "bed": {"albedo": 0.4}}})

    def rows(self, *words):
        return list(csv.DictReader(io.StringIO(self.expect_success("sea", self.scene, *words).stdout)))

    def test_deep_water_is_blue_and_the_bed_shows(self):
        shallow_blue, shallow_red, deep_blue, deep_red = (float(row["star_per_sr"]) for row in self.rows(*FLAGS))
        self.assertGreater(deep_blue, 20 * deep_red)
        self.assertGreater(shallow_red, 20 * deep_red)
        self.assertGreater(shallow_blue, deep_blue)

    def test_radiance_is_of_both_lights(self):
        for row in self.rows(*FLAGS):
            parts = [float(row[name]) for name in ["star_per_sr", "star_W_m2_nm", "sky_per_sr", "sky_W_m2_nm"]]
            self.assertAlmostEqual(float(row["radiance_W_m2_sr_nm"]) / (parts[0] * parts[1] + parts[2] * parts[3]), 1, 6)
            self.assertTrue(all(part > 0 for part in parts), parts)

    def test_paths_say_the_same_and_how_sure_they_are(self):
        words = FLAGS[2:] + ["--depth", "2"]
        for ours, theirs in zip(self.rows(*words), self.rows(*words, "--solver", "reference", "--paths", "20000")):
            for light in ["star", "sky"]:
                value, error = float(theirs[light + "_per_sr"]), float(theirs[light + "_standard_error"])
                self.assertGreater(error, 0)
                self.assertLess(abs(float(ours[light + "_per_sr"]) - value), 0.03 * value + 3 * error)

    def test_an_eye_under_water_sees_the_sky_in_the_window(self):
        words = FLAGS[2:4] + ["--depth", "50", "--eye-depth", "1", "--view-zenith", "20,80", "--wavelength", "450"]
        window, beside = (float(row["sky_per_sr"]) for row in self.rows(*words))
        self.assertGreater(window, 10 * beside)

    def test_what_cannot_be_asked(self):
        self.expect_failure(2, ["sea", self.scene, "--depth", "2"], ["--sun-zenith"])
        self.expect_failure(2, ["sea", self.scene, *FLAGS, "--paths", "5"], ["--solver reference"])
        up = ["--depth", "2", "--sun-zenith", "30", "--view-zenith", "40", "--wavelength", "450"]
        self.expect_failure(1, ["sea", self.scene, *up], ["query 1", "look down"])
        self.expect_failure(1, ["sea", self.scene, *up, "--eye-depth", "3"], ["eye's depth"])
        self.expect_failure(1, ["sea", self.write_scene(name="dry.json"), *FLAGS], ["no ocean"])


if __name__ == "__main__":
    unittest.main()
