# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella render: pictures, what is told about them, and what is left when something fails."""

import copy
import signal
import struct
import time
import unittest

from process import IS_SLOW, SCENES, THIN_SCENE, ProgramTest, count_values, read_png, require_gl

SIZE = "96x54"


def add_layers(*layers):
    scene = copy.deepcopy(THIN_SCENE)
    scene["surface"] = {"layers": list(layers)}
    return scene


def make_tiff(width, height):
    """A little-endian TIFF of one strip of 16-bit heights, equirectangular by its geographic tags."""
    pixels = b"".join(struct.pack("<h", (x * y) % 3000) for y in range(height) for x in range(width))
    scale = struct.pack("<3d", 360.0 / width, 180.0 / height, 0.0)
    tie = struct.pack("<6d", 0, 0, 0, -180.0, 90.0, 0)
    keys = struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326)
    blobs_at = 8 + len(pixels)
    entries = [(256, 3, 1, width), (257, 3, 1, height), (258, 3, 1, 16), (259, 3, 1, 1), (262, 3, 1, 1),
               (273, 4, 1, 8), (277, 3, 1, 1), (278, 3, 1, height), (279, 4, 1, len(pixels)), (339, 3, 1, 2),
               (33550, 12, 3, blobs_at), (33922, 12, 6, blobs_at + 24), (34735, 3, 16, blobs_at + 72)]
    directory_at = blobs_at + 24 + 48 + 32
    directory = struct.pack("<H", len(entries))
    for tag, kind, count, value in entries:
        directory += struct.pack("<HHII", tag, kind, count, value)
    return struct.pack("<2sHI", b"II", 42, directory_at) + pixels + scale + tie + keys + directory + bytes(4)


class Pictures(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write_scene()

    def test_png(self):
        done = self.expect_success("render", self.scene, "--size", SIZE, "-o", "a.png")
        self.assertRegex(done.stdout, r"^wrote a\.png: 96x54, \d+\.\d s\n$")
        width, height, rows = read_png(self.work / "a.png")
        self.assertEqual((width, height), (96, 54))
        self.assertGreater(count_values(rows), 10)
        self.assertEqual([path.name for path in self.work.iterdir()], ["a.png"])

    def test_exr(self):
        self.expect_success("render", self.scene, "--view", "orbit", "--size", SIZE, "-o", "a.EXR", "--quiet")
        data = (self.work / "a.EXR").read_bytes()
        self.assertEqual(data[:4], b"\x76\x2f\x31\x01")
        at = data.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
        self.assertEqual(struct.unpack("<4i", data[at:at + 16]), (0, 0, 95, 53))

    def test_default_name_and_replacement(self):
        (self.work / "terrella.png").write_text("old")
        self.expect_success("render", self.scene, "--size", "8x8")
        self.assertEqual(read_png(self.work / "terrella.png")[:2], (8, 8))

    def test_quiet_and_timings(self):
        done = self.expect_success("render", self.scene, "--size", "8x8", "--quiet", "--timings")
        self.assertIn("GPU ms", done.stdout)
        self.assertNotIn("wrote", done.stdout)
        self.assertGreater(len(done.stdout.splitlines()), 3)
        self.assertEqual(done.stderr, "")

    def test_options_change_the_picture(self):
        def draw(*options):
            self.expect_success("render", self.scene, "--size", SIZE, "-o", "a.png", *options)
            return read_png(self.work / "a.png")[2]

        plain = draw("--ev100", "12")
        self.assertEqual(draw("--ev100", "12"), plain)
        changes = [["--ev100", "10"], ["--ev100", "12", "--bias", "1"], ["--ev100", "12", "--tone", "exponential"],
                   ["--ev100", "12", "--sun-elevation", "10"], ["--ev100", "12", "--heading", "200"],
                   ["--ev100", "12", "--altitude", "50000"], ["--ev100", "12", "--fov", "20"],
                   ["--ev100", "12", "--spectrum", "rgb"]]
        for options in changes:
            self.assertNotEqual(draw(*options), plain, options)

    def test_samples_smooth_a_picture_of_the_same_size(self):
        pictures = []
        for samples in ["1", "2"]:
            self.expect_success("render", self.scene, "--size", "32x18", "--ev100", "12",
                                "--samples", samples, "-o", "a.png")
            pictures.append(read_png(self.work / "a.png"))
        self.assertEqual(pictures[0][:2], pictures[1][:2])
        self.assertNotEqual(pictures[0][2], pictures[1][2])
        for wrong in ["0", "5", "1.5", "x"]:
            self.expect_failure(2, ["render", self.scene, "--samples", wrong], ["--samples"])

    def test_a_view_from_one_pixel(self):
        for size in ["1x1", "1x37", "37x1"]:
            self.expect_success("render", self.scene, "--size", size, "-o", "a.png")


class Flights(ProgramTest):
    """From one view to another, as numbered pictures or into a video program that stands in for ffmpeg."""

    def setUp(self):
        super().setUp()
        self.words = ["render", self.write_scene(), "--view", "orbit", "--to", "ground", "--size", "32x18"]

    def test_numbered_pictures_lead_from_view_to_view(self):
        done = self.expect_success(*self.words, "--seconds", 0.5, "--fps", 20, "--ev100", 14, "-o", "f-%03d.png")
        self.assertEqual([path.name for path in sorted(self.work.iterdir())], [f"f-{i:03}.png" for i in range(10)])
        self.assertIn("10 frames of 32x18", done.stdout)
        # The first and the last are the views themselves; of codes, a dither may differ.
        for view, frame in [("orbit", 0), ("ground", 9)]:
            self.expect_success(*self.words[:2], "--view", view, "--size", "32x18", "--ev100", 14, "-o", "one.png")
            _, _, alone = read_png(self.work / "one.png")
            _, _, flown = read_png(self.work / f"f-{frame:03}.png")
            self.assertLess(max(abs(a - b) for a, b in zip(b"".join(alone), b"".join(flown))), 3)

    def test_exposure_follows_the_picture_within_a_second(self):
        # From the dark side of orbit to the day: the first frame of day is not yet exposed for it.
        words = [*self.words, "--fps", 4]
        self.expect_success(*words, "--seconds", 3, "-o", "f%d.png")
        levels = []
        for i in range(12):
            _, _, rows = read_png(self.work / f"f{i}.png")
            levels.append(sum(map(sum, rows)) / (32 * 18 * 3))
        steps = [abs(b - a) for a, b in zip(levels, levels[1:])]
        # 12 frames over all of the range of codes: none takes half of it.
        self.assertLess(max(steps), 127)
        self.assertGreater(min(levels), 5)

    def fake_encoder(self, text):
        folder = self.folder / "bin"
        folder.mkdir()
        program = folder / "ffmpeg"
        program.write_text("#!/bin/sh\n" + text)
        program.chmod(0o755)
        self.environment["PATH"] = f"{folder}:{self.environment['PATH']}"

    def test_a_video_is_piped(self):
        # Keeps what it was told and given where a video would be.
        self.fake_encoder('for last; do :; done\necho "$@" > words.txt\ncat > "$last"\n')
        self.expect_success(*self.words, "--seconds", 0.2, "-o", "flight.mp4")
        self.assertEqual((self.work / "flight.mp4").stat().st_size, 5 * 32 * 18 * 4)
        words = (self.work / "words.txt").read_text().split()
        for word in ["rawvideo", "rgba", "32x18", "25"]:
            self.assertIn(word, words)
        self.assertEqual(sorted(path.name for path in self.work.iterdir()), ["flight.mp4", "words.txt"])

    def test_a_video_that_fails_leaves_nothing(self):
        self.fake_encoder("exit 3\n")
        words = [*self.words, "--seconds", 0.2, "-o"]
        done = self.run_program(*words, "flight.mkv")
        self.assertEqual(done.returncode, 1)
        self.assertIn("flight.mkv: ffmpeg", done.stderr)
        self.assertEqual(list(self.work.iterdir()), [])
        self.environment["PATH"] = "/nowhere"
        self.expect_failure(1, [*words, "flight.mp4"], ["not installed", "flight-%04d.png"])

    def test_wrong_words(self):
        name = ["--seconds", 0.2, "-o"]
        self.expect_failure(2, [*self.words, *name, "f.png"], ["f.png", "flight-%04d.png"])
        self.expect_failure(2, [*self.words, *name, "f-%04x.png"], ["f-%04x.png"])
        self.expect_failure(2, [*self.words, *name, "f-%d-%d.png"], ["f-%d-%d.png"])
        self.expect_failure(2, [*self.words, *name, "f.gif"], ["f.gif", ".mp4"])
        self.expect_failure(2, [*self.words, *name, "f%d.png", "--to", "ground,orbti"], ["orbti"])
        self.expect_failure(2, [*self.words, *name, "f%d.png", "--compare", "spectral,single"], ["--to", "--compare"])
        self.expect_failure(2, [*self.words, *name, "f.mp4", "--size", "33x18"], ["even", "33x18"])
        self.expect_failure(2, [*self.words[:2], "--fps", 10], ["--fps", "--to"])


class Traced(ProgramTest):
    """Pictures by the path tracer, without OpenGL."""

    def setUp(self):
        super().setUp()
        self.scene = self.write_scene()
        self.words = ["render", self.scene, "--size", "12x8", "--reference", "--paths", "32"]

    def test_same_seed_same_picture(self):
        seeds = [["--seed", "3"], ["--seed", "3"], ["--seed", "4"]]
        pictures = []
        for seed in seeds:
            done = self.expect_success(*self.words, "-o", "a.exr", "--error", "e.exr", *seed)
            self.assertRegex(done.stdout, r"^wrote a\.exr: 12x8, \d+\.\d s\n$")
            pictures.append([(self.work / name).read_bytes() for name in ["a.exr", "e.exr"]])
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])
        self.assertNotEqual(pictures[0][0], pictures[0][1])

    def test_png_is_nearly_what_is_drawn(self):
        def mean(rows):
            return sum(sum(row) for row in rows) / sum(len(row) for row in rows)

        means = []
        for orders in ["all"] if IS_SLOW else ["1", "2", "all"]:
            common = ["--ev100", "10", "--orders", orders]
            self.expect_success(*self.words[:-1], "128", *common, "-o", "a.png")
            self.expect_success("render", self.scene, "--size", "12x8", *common, "-o", "b.png")
            width, height, traced = read_png(self.work / "a.png")
            self.assertEqual((width, height), (12, 8))
            # Steps of 255: pixels of the horizon are drawn as one or the other, but traced as both; that makes 1.8.
            means.append(mean(read_png(self.work / "b.png")[2]))
            self.assertAlmostEqual(mean(traced), means[-1], delta=3)
        if not IS_SLOW:
            self.assertLess(means[0] + 1, means[1])

    def test_terrain(self):
        self.expect_success(*self.words, "-o", "plain.exr")
        (self.data / "h.tif").write_bytes(make_tiff(256, 128))
        self.write_scene(add_layers({"name": "h", "elevation": "h.tif", "scale": 10}))  # under the same name
        self.expect_success(*self.words, "-o", "hills.exr")
        self.assertTrue((self.work / "hills.exr").read_bytes() != (self.work / "plain.exr").read_bytes())
        projective = ["--mesher", "projective", "--grid"]
        self.expect_success(*self.words[:4], *projective, "64x48", "-o", "small.exr")
        self.expect_success(*self.words[:4], *projective, "640x480", "-o", "large.exr")
        self.assertTrue((self.work / "small.exr").read_bytes() != (self.work / "large.exr").read_bytes())
        quadtree = ["--mesher", "quadtree", "--mesh-error"]
        self.expect_success(*self.words[:4], *quadtree, "0.1", "-o", "fine.exr")
        self.expect_success(*self.words[:4], *quadtree, "100", "-o", "coarse.exr")
        self.assertTrue((self.work / "fine.exr").read_bytes() != (self.work / "coarse.exr").read_bytes())
        (self.data / "h.tif").write_bytes(b"not a picture at all")
        done = self.expect_success(*self.words, "-o", "left-out.exr")
        self.assertRegex(done.stderr, r"^terrella: warning: .*h\.tif.*; left out\n$")
        self.assertEqual((self.work / "left-out.exr").read_bytes(), (self.work / "plain.exr").read_bytes())

    def test_wrong_words(self):
        for more in [["--samples", "2"], ["--timings"], ["--mesher", "hemisphere"], ["--sky-model", "single"],
                     ["--compare", "spectral,single"]]:
            self.expect_failure(2, self.words + more, ["--reference", more[0]])
        for grid in ["15x16", "16x9999", "31x32"]:
            self.expect_failure(2, ["render", self.scene, "--mesher", "projective", "--grid", grid], ["--grid", grid])
        self.expect_failure(2, ["render", self.scene, "--mesher", "hemisphere", "--grid", "64x64"], ["--grid", "projective"])
        self.expect_failure(2, ["render", self.scene, "--mesher", "hemisphere", "--mesh-error", "2"],
                            ["--mesh-error", "quadtree"])
        self.expect_failure(2, ["render", self.scene, "--mesher", "quadtree", "--mesh-error", "0"], ["--mesh-error", "0.1"])
        for alone in [["--paths", "9"], ["--seed", "1"], ["--error", "e.exr"]]:
            self.expect_failure(2, ["render", self.scene] + alone, ["--reference", alone[0]])
        for other in [["--sky-model", "single"], ["--compare", "spectral,single"]]:
            self.expect_failure(2, ["render", self.scene, "--orders", "2"] + other, ["--orders", "spectral"])
        self.expect_failure(2, self.words + ["--error", "e.png"], ["e.png", ".exr"])
        self.expect_failure(2, self.words + ["--spectrum", "rgb"], ["--spectrum", "--reference"])
        self.expect_failure(2, self.words[:-1] + ["0"], ["--paths"])
        self.expect_failure(1, self.words + ["--error", "missing/e.exr"], ["missing/e.exr", "cannot be written"])

    def test_interruption_leaves_nothing(self):
        work = self.start_program(*self.words[:-1], "1000000", "-o", "a.exr", "--error", "e.exr")
        time.sleep(1)
        work.send_signal(signal.SIGINT)
        _, errors = work.communicate(timeout=300)
        self.assertEqual(work.returncode, 1, errors)
        self.assertIn("cancelled", errors)
        self.assertEqual(list(self.work.iterdir()), [])


class Comparisons(ProgramTest):
    """One sheet of several models: margins of 8 pixels, lines of 12 (apps/cli/compare.c)."""

    def setUp(self):
        super().setUp()
        self.scene = self.write_scene()

    def compare(self, models, *words):
        done = self.run_program("render", self.scene, "--size", SIZE, "--compare", models, *words)
        if "pictures are not made by" in done.stderr:
            self.skipTest("a model is not there")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_sheet_of_two(self):
        told = self.compare("spectral,single", "-o", "two.png")
        self.assertRegex(told, r"(?m)^single - spectral: luminance [+-]\d+\.\d\d % in the mean, .*Delta E \d")
        self.assertRegex(told, r"(?m)^wrote two\.png: 216x186, \d+\.\d s$")
        width, height, rows = read_png(self.work / "two.png")
        self.assertEqual((width, height), (2 * (96 + 8) + 8, 38 + 54 + 20 + 54 + 4 + 12 + 4))
        # The first picture is the one that the model draws alone, and gives the exposure.
        self.expect_success("render", self.scene, "--size", SIZE, "-o", "one.png")
        alone = read_png(self.work / "one.png")[2]
        first = [row[3 * 8:3 * (8 + 96)] for row in rows[38:38 + 54]]
        self.assertEqual([bytes(row) for row in first], [bytes(row) for row in alone])
        second = [row[3 * 112:3 * (112 + 96)] for row in rows[38:38 + 54]]
        self.assertGreater(count_values(second), 10)
        self.assertNotEqual(first, second)
        # One scattering has less light than all: the map is blue, or nearly white where there is little more.
        middle = rows[112 + 27]
        red, blue = middle[3 * 160], middle[3 * 160 + 2]
        self.assertLessEqual(red, blue + 5)

    def test_radiances_of_two(self):
        self.compare("spectral,single", "-o", "two.exr")
        data = (self.work / "two.exr").read_bytes()
        at = data.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
        self.assertEqual(struct.unpack("<4i", data[at:at + 16]), (0, 0, 2 * 96 - 1, 2 * 54 - 1))

    def test_wrong_models(self):
        for models, mention in [("spectral", "not enough"), ("spectral,spectral", "twice"), ("spectral,nishita", "nishita"),
                                ("spectral,", "''"), (",", "''"), ("spectral,reference", "reference")]:
            self.expect_failure(2, ["render", self.scene, "--compare", models], ["--compare", mention])
        for more in [["--sky-model", "spectral"], ["--timings"], ["--spectrum", "rgb"]]:
            self.expect_failure(2, ["render", self.scene, "--compare", "spectral,single"] + more,
                                ["--compare", more[0]])


class Rayleigh(ProgramTest):
    scene = SCENES / "bare-sphere.json"  # has a gas

    def draw(self, *more):
        self.expect_success("render", self.scene, "--size", SIZE, "--sky-model", "rayleigh", "-q", "-o", "a.exr", *more)
        return (self.work / "a.exr").read_bytes()

    def test_each_option_reaches_the_picture(self):
        plain = self.draw()
        self.assertEqual(plain, self.draw("--rayleigh-samples", "5", "--rayleigh-wavelengths", "10"))
        for more in [["samples", "13"], ["wavelengths", "3"], ["optical-depth", "fit"], ["height-scale", "15"],
                     ["out-scattering", "off"]]:
            self.assertNotEqual(plain, self.draw("--rayleigh-" + more[0], more[1]), more)

    def test_wrong_options(self):
        for name, value in [("samples", "4"), ("samples", "1"), ("samples", "67"), ("wavelengths", "41"),
                            ("wavelengths", "3.5"), ("optical-depth", "table"), ("height-scale", "0"),
                            ("out-scattering", "maybe")]:
            self.expect_failure(2, ["render", self.scene, "--rayleigh-" + name, value], ["--rayleigh-" + name])


class Eclipses(ProgramTest):
    """Bodies in odd places: one line that says what is wrong, or a picture of numbers."""

    def write_eclipse(self, body=None, star=None, camera=None, place=None, layers=()):
        scene = add_layers(*layers) if layers else copy.deepcopy(THIN_SCENE)
        scene["star"].update(star or {})
        scene["bodies"] = [{"name": "Moon", "radius_m": 1737400, "distance_m": 363300000, "geometric_albedo": 0.1}]
        scene["bodies"][0].update(body or {})
        view = scene["views"]["ground"]
        view["camera"].update(camera or {})
        view["bodies"] = {"Moon": place or {"offset_from_sun_deg": [0, 0]}}
        return self.write_scene(scene, "eclipse.json")

    def draw(self, **changes):
        scene = self.write_eclipse(**changes)
        self.expect_success("render", scene, "--size", "24x16", "--ev100", "8", "-o", "a.png", "-q")
        return sum(sum(row) for row in read_png(self.work / "a.png")[2]) / (24 * 16 * 3)

    def test_bodies_where_none_can_be(self):
        cases = [
            ({"body": {"radius_m": 0}}, ["radius_m", "is 0", ">= 1"]),
            ({"body": {"distance_m": 1e6}}, ["distance_m", "reach into the planet or its air"]),
            ({"place": {"offset_from_sun_deg": [0, 0], "distance_m": 1e6}}, ["views.ground.bodies.Moon.distance_m"]),
            ({"camera": {"altitude_m": 3.57e8}, "place": {"latitude_deg": 10, "longitude_deg": 20}},
             ["the camera is inside the body \"Moon\""]),
            ({"star": {"corona": -1}}, ["star.corona", "is -1"]),
        ]
        for changes, mentions in cases:
            self.expect_failure(1, ["render", self.write_eclipse(**changes), "-q"], mentions)

    def test_odd_shadows(self):
        day = self.draw(body={"radius_m": 1})
        self.assertGreater(day, 200)
        self.assertLess(self.draw(), 20)
        # Everything is dark; just clear of the air; a star as wide as the sky; a point.
        self.assertLess(self.draw(body={"radius_m": 1e8, "distance_m": 2e8}), 1)
        self.assertLess(self.draw(body={"distance_m": 8168401}), 1)
        if IS_SLOW:  # what follows solves twice more
            return
        self.assertGreater(self.draw(star={"angular_radius_deg": 80}), 200)
        self.assertLess(self.draw(star={"angular_radius_deg": 0}), 20)

    def test_terrain(self):
        (self.data / "h.tif").write_bytes(make_tiff(64, 32))
        layers = [{"name": "h", "elevation": "h.tif"}]
        self.assertLess(self.draw(layers=layers), 20)
        self.assertGreater(self.draw(layers=layers, body={"radius_m": 1}), 100)

    def test_corona(self):
        aim = {"camera": {"heading_deg": 120, "pitch_deg": 30, "vertical_fov_deg": 2}}
        self.assertGreater(self.draw(star={"corona": 1}, **aim), self.draw(**aim) + 20)


class Failures(ProgramTest):
    def expect_wrong(self, scene, *mentions, output="a.png"):
        self.expect_failure(1, ["render", scene, "--size", SIZE, "-o", output], mentions)

    def test_output_is_checked_before_the_work(self):
        scene = self.write_scene(add_layers({"name": "h", "elevation": "missing.tif"}))
        (self.work / "file").write_text("")
        (self.work / "folder.png").mkdir()
        for output in ["missing/a.png", "file/a.png", "folder.png"]:
            # The raster is missing too, but the output comes first.
            self.expect_wrong(scene, output, "cannot be written", output=output)

    def test_missing_raster(self):
        self.expect_wrong(self.write_scene(add_layers({"name": "h", "elevation": "missing.tif"})), "missing.tif")

    def test_optional_raster(self):
        scene = self.write_scene(add_layers({"name": "h", "elevation": "missing.tif", "optional": True}))
        self.expect_success("render", scene, "--size", "8x8")

    def test_broken_raster(self):
        """One line tells of it, and the planet is drawn without."""
        scene = self.write_scene(add_layers({"name": "h", "elevation": "h.tif"}))
        whole = make_tiff(256, 128)
        path = self.data / "h.tif"
        path.write_bytes(whole)
        self.expect_success("render", scene, "--size", "8x8", "-o", "whole.png")
        (self.work / "whole.png").unlink()
        for length in [0, 4, 8, 100, len(whole) // 2, len(whole) - 100, len(whole) - 10]:
            path.write_bytes(whole[:length])
            done = self.expect_success("render", scene, "--size", "8x8", "-o", "bare.png")
            self.assertRegex(done.stderr, r"^terrella: warning: .*h\.tif.*; left out\n$")
        path.write_bytes(b"not a picture at all")
        done = self.expect_success("render", scene, "--size", "8x8", "-o", "bare.png")
        self.assertRegex(done.stderr, r"^terrella: warning: .*h\.tif.*; left out\n$")

    def test_interruption_leaves_nothing(self):
        work = self.start_program("render", self.write_scene(), "--size", "4096x4096", "-o", "a.png")
        time.sleep(0.3)
        if work.poll() is None:
            work.send_signal(signal.SIGINT)
        output, errors = work.communicate(timeout=300)
        # It may have been quick: then the picture is whole.
        if work.returncode == 0:
            self.assertEqual(read_png(self.work / "a.png")[:2], (4096, 4096))
            return
        # Before the program listens, the signal ends it as it ends any program.
        if work.returncode != -signal.SIGINT:
            self.assertEqual(work.returncode, 1, errors)
            self.assertIn("cancelled", errors)
        self.assertEqual(list(self.work.iterdir()), [])


class Cache(ProgramTest):
    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"

    def draw(self, scene, name):
        done = self.expect_success("render", scene, "--size", SIZE, "-o", name)
        return (self.work / name).read_bytes(), done

    def test_broken_tables_are_made_again(self):
        scene = self.write_scene()
        self.environment["TERRELLA_CACHE"] = str(self.folder / "other")
        fresh, _ = self.draw(scene, "fresh.exr")
        self.environment["TERRELLA_CACHE"] = str(self.cache)
        self.assertEqual(self.draw(scene, "filled.exr")[0], fresh)
        tables = [path for path in self.cache.rglob("*") if path.is_file()]
        self.assertGreater(len(tables), 0)
        self.assertEqual(self.draw(scene, "read.exr")[0], fresh)
        for table in tables:
            whole = table.read_bytes()
            # Its head, its numbers, its length: each of them is looked at. Every picture solves again.
            broken = [self.flip(whole, 0), self.flip(whole, len(whole) - 1)]
            if not IS_SLOW:
                broken += [b"", whole + b"x", whole[:len(whole) // 2]]
            for content in broken:
                self.break_and_draw(scene, fresh, table, content)
            self.assertEqual(table.read_bytes(), whole)

    @staticmethod
    def flip(whole, place):
        flipped = bytearray(whole)
        flipped[place] ^= 0x10
        return bytes(flipped)

    def break_and_draw(self, scene, fresh, table, content):
        table.write_bytes(content)
        self.assertEqual(self.draw(scene, "again.exr")[0], fresh)

    def test_a_cache_that_cannot_be_written_is_no_failure(self):
        scene = self.write_scene()
        (self.folder / "file").write_text("")
        self.environment["TERRELLA_CACHE"] = str(self.folder / "file" / "cache")
        done = self.run_program("render", scene, "--size", "8x8")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    require_gl()
    unittest.main(verbosity=2)
