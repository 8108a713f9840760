# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""The scenes that come with the program: each is read and drawn, and its planet looks as it does from Earth or on it."""

import json
import math
import unittest

from process import IS_SLOW, SCENES, ProgramTest, read_exr_luminance, read_png, require_gl

# Earth's rasters are not in the folder of a test.
NEEDS_DATA = {"earth", "cloudy-earth"}
# What shows something else than a planet.
NO_PLANETS = {"bare-sphere", "clear-sky", "eclipse"}
# By the path tracer all are drawn, from solved air only these: dense air takes seconds a wavelength.
DRAWN = ["mars", "moon"]
NAMES = sorted(path.stem for path in SCENES.glob("*.json") if "schema" not in path.name)
# Abscissae and weights of Gauss and Legendre's rule of four points, from 0 to 1.
GAUSS = [(0.5 - side * x, w) for x, w in [(0.430568, 0.173927), (0.169991, 0.326073)] for side in (1, -1)]


class Scenes(ProgramTest):
    def test_planets_have_the_same_three_views(self):
        for name in NAMES:
            views = self.expect_success("render", SCENES / f"{name}.json", "--views").stdout
            if name not in NO_PLANETS:
                for view in ["noon", "sunset", "orbit"]:
                    self.assertIn(view, views, name)

    def test_each_is_traced(self):
        for name in NAMES:
            if name not in NEEDS_DATA:
                self.expect_success("render", SCENES / f"{name}.json", "--reference", "--paths", "1", "--size", "8x5",
                                    "-o", "traced.png")

    @unittest.skipIf(IS_SLOW, "solves two atmospheres")
    def test_some_are_drawn(self):
        for name in DRAWN:
            self.expect_success("render", SCENES / f"{name}.json", "--spectrum", "rgb", "--size", "16x9", "-o",
                                "drawn.png")

    @unittest.skipIf(IS_SLOW, "solves a dense atmosphere")
    def test_no_ground_shows_through_the_clouds_of_venus(self):
        self.expect_success("render", SCENES / "venus.json", "--view", "limb", "--spectrum", "rgb", "--size", "16x90",
                            "-o", "limb.png")
        rows = [sum(row) / len(row) for row in read_png(self.work / "limb.png")[2]]
        clouds = [row for row in rows if row > 100]
        self.assertGreater(len(clouds), 45)
        # From the limb down brighter and brighter, and in no place by steps: the horizon of the ground was a line.
        for above, below in zip(clouds, clouds[1:]):
            self.assertTrue(-1 < below - above < 6, clouds)


    @unittest.skipIf(IS_SLOW, "solves a dense atmosphere")
    def test_venus_is_white(self):
        scene = json.loads((SCENES / "venus.json").read_text())
        del scene["surface"]
        scene["views"] = {"full": {"camera": {"latitude_deg": 0, "longitude_deg": 0, "altitude_m": 1e8,
                                              "heading_deg": 0, "pitch_deg": -90, "vertical_fov_deg": 7.2},
                                   "sun": {"subsolar_latitude_deg": 0, "subsolar_longitude_deg": 0}}}

        def whole_light():
            self.expect_success("render", self.write_scene(scene), "--spectrum", "rgb", "--size", "64x64", "-o", "full.exr")
            return sum(map(sum, read_exr_luminance(self.work / "full.exr")))

        venus = whole_light()
        del scene["atmosphere"]
        scene["planet"]["ground_albedo"] = 1
        # Mallama et al. 2006 (Icarus 182): 0.67 in V, of a white disc; a white Lambertian sphere has 2/3 (Lambert 1760).
        geometric_albedo = 2 / 3 * venus / whole_light()
        self.assertGreater(geometric_albedo, 0.62)
        self.assertLess(geometric_albedo, 0.75)


class Photometry(ProgramTest):
    def ask(self, name, wavelengths, queries):
        """Radiances times pi over the star's irradiance: 1 is white and lit from the zenith. One list a wavelength."""
        star = json.loads((SCENES / f"{name}.json").read_text())["star"]["spectral_irradiance"]
        star = {nm: value for nm, value in star}
        lines = ["altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg,wavelength_nm"]
        lines += [",".join(str(field) for field in query) + f",{nm}" for nm in wavelengths for query in queries]
        done = self.expect_success("sky", SCENES / f"{name}.json", "--queries", "-", input="\n".join(lines) + "\n")
        values = [float(line.rsplit(",", 1)[1]) for line in done.stdout.splitlines()[1:]]
        self.assertEqual(len(values), len(lines) - 1)
        count = len(queries)
        return [[math.pi * value / star[nm] for value in values[i * count:(i + 1) * count]]
                for i, nm in enumerate(wavelengths)]

    def geometric_albedos(self, name, wavelengths):
        """Of the disc seen from the star, relative to a white Lambertian one of the planet's radius."""
        scene = json.loads((SCENES / f"{name}.json").read_text())
        radius = scene["planet"]["radius_m"]
        height = 0.999 * scene["atmosphere"]["height_m"]
        rings = []
        # The brightness breaks at the limb: one rule for the disc, one for the air around it.
        for inner, outer in [(0.0, radius), (radius, radius + height)]:
            for x, weight in GAUSS:
                distance = inner + (outer - inner) * x
                rings.append((distance, 2.0 * distance * (outer - inner) * weight / radius**2))
        angles = [math.degrees(math.asin(distance / (radius + height))) for distance, _ in rings]
        answers = self.ask(name, wavelengths, [(height, angle, 180.0 - angle, 180) for angle in angles])
        return [sum(value * weight for value, (_, weight) in zip(row, rings)) for row in answers]

    @unittest.skipIf(IS_SLOW, "solves two wavelengths of dense air")
    def test_titan_is_orange(self):
        blue, green = self.geometric_albedos("titan", [440, 550])
        # 0.21 to 0.22 in V; B - V is 1.28: 0.56 of the Sun's blue.
        self.assertAlmostEqual(green, 0.21, delta=0.03)
        self.assertAlmostEqual(blue / green, 0.56, delta=0.08)

    @unittest.skipIf(IS_SLOW, "solves two wavelengths of sharply scattering air")
    def test_skies_of_mars(self):
        noon = (2, 30, 60, 90)
        beside_setting_sun, away_from_it = (2, 87, 82, 0), (2, 87, 60, 90)
        blue, red = self.ask("mars", [440, 640], [noon, beside_setting_sun, away_from_it])
        ratio = [b / r for b, r in zip(blue, red)]
        # Dust takes the blue by day. At sunset what is scattered at small angles is blue, and only that.
        self.assertLess(ratio[0], 0.7)
        self.assertLess(ratio[2], 0.7)
        self.assertGreater(ratio[1], 1.2 * ratio[2])


if __name__ == "__main__":
    require_gl()
    unittest.main(verbosity=2)
