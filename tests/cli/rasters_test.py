# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Rasters larger than they may be, and rasters behind a network, through the program."""

import array
import copy
import math
import os
import pathlib
import struct
import sys
import tempfile
import unittest

from process import THIN_SCENE, ProgramTest, read_png, require_gl

sys.path.insert(0, os.environ["TERRELLA_RANGE_SERVER"])
import range_server  # noqa: E402


def write_tiff(path, width, height):
    """A globe of 16-bit heights in tiles of 256 x 256, as little of TIFF and GeoTIFF as that needs."""
    tiles_x, tiles_y = -(-width // 256), -(-height // 256)
    offsets, data = [], bytearray()
    waves = [900 * math.sin(14 * math.pi * x / width) for x in range(256 * tiles_x)]
    for tile in range(tiles_x * tiles_y):
        texels = array.array("h")
        first = tile % tiles_x * 256
        for y in range(256):
            wave = math.sin(9 * math.pi * (tile // tiles_x * 256 + y) / height)
            texels.extend([int(wave * w + 400) for w in waves[first:first + 256]])
        offsets.append(len(data))
        data += texels.tobytes()
    keys = struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326)
    pixel = 360 / width
    scale = struct.pack("<3d", pixel, pixel, 0)
    tie = struct.pack("<6d", 0, 0, 0, -180, 90, 0)
    count = len(offsets)
    extra = 8 + len(data)
    places = {"offsets": extra, "sizes": extra + 4 * count}
    places["keys"] = places["sizes"] + 4 * count
    places["scale"] = places["keys"] + len(keys)
    places["tie"] = places["scale"] + len(scale)
    directory = places["tie"] + len(tie)
    entries = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, 16), (259, 3, 1, 1), (262, 3, 1, 1),
               (277, 3, 1, 1), (322, 4, 1, 256), (323, 4, 1, 256), (324, 4, count, places["offsets"]),
               (325, 4, count, places["sizes"]), (339, 3, 1, 2), (33550, 12, 3, places["scale"]),
               (33922, 12, 6, places["tie"]), (34735, 3, 16, places["keys"])]
    with open(path, "wb") as file:
        file.write(struct.pack("<2sHI", b"II", 42, directory) + data)
        file.write(struct.pack(f"<{count}I", *(8 + offset for offset in offsets)))
        file.write(struct.pack(f"<{count}I", *([2 * 256 * 256] * count)))
        file.write(keys + scale + tie + struct.pack("<H", len(entries)))
        for tag, kind, number, value in entries:
            file.write(struct.pack("<HHII", tag, kind, number, value))
        file.write(struct.pack("<I", 0))


def globe_scene(elevation):
    scene = copy.deepcopy(THIN_SCENE)
    scene["surface"] = {"layers": [{"elevation": elevation}]}
    return scene


class RastersTest(ProgramTest):
    """Held whole, a globe of 3840 x 1920 heights takes 69 MB: of the least memory there is, 64, it is held in tiles."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory(prefix="terrella-test-")
        cls.addClassCleanup(folder.cleanup)
        cls.served = pathlib.Path(folder.name)
        write_tiff(cls.served / "globe.tif", 3840, 1920)

    def setUp(self):
        super().setUp()
        (self.served / "served").unlink(missing_ok=True)
        self.server = range_server.start(self.served)
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        host = self.server.server_address[0]
        self.url = f"http://{host}:{self.server.server_port}/globe.tif"
        self.environment["no_proxy"] = host

    def render(self, elevation, *words):
        scene = self.write_scene(globe_scene(elevation))
        self.expect_success("render", scene, "--view", "orbit", "--size", "96x96", "-o", "a.png", "-q", *words)
        return read_png(self.work / "a.png")

    def count_differences(self, a, b):
        return sum(abs(x - y) > 3 for row, other in zip(a[2], b[2]) for x, y in zip(row, other))

    def test_tiles_and_the_network_show_what_memory_does(self):
        whole = self.render(str(self.served / "globe.tif"))
        tiled = self.render(str(self.served / "globe.tif"), "--memory", "64")
        self.assertLess(self.count_differences(whole, tiled), 96 * 96 * 3 // 100)
        remote = self.render(self.url, "--allow-remote")
        self.assertLess(self.count_differences(whole, remote), 96 * 96 * 3 // 100)
        requests = (self.served / "served").read_text().splitlines()
        self.assertTrue(requests)
        self.assertEqual({line.split()[1] for line in requests}, {"/globe.tif"})

    def test_a_scene_alone_reaches_no_network(self):
        scene = self.write_scene(globe_scene(self.url))
        self.expect_failure(1, ["render", scene, "-o", "a.png"],
                            ["surface.layers[0].elevation", "--allow-remote"])
        self.assertFalse((self.served / "served").exists())

    def test_a_file_that_is_not_there_is_one_error(self):
        scene = self.write_scene(globe_scene(self.url.replace("globe", "none")))
        done = self.run_program("render", scene, "-o", "a.png", "-q", "--allow-remote")
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertIn("none.tif", lines[0])

    def test_a_server_that_fails_half_way_is_left_out(self):
        # The file has no overviews: its coarse level needs all of it.
        (self.served / "fault").write_text("500 200000")
        self.addCleanup((self.served / "fault").unlink)
        scene = self.write_scene(globe_scene(self.url))
        done = self.run_program("render", scene, "--view", "orbit", "--size", "32x32", "-o", "a.png", "-q", "--allow-remote")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        for word in ["globe.tif", "left out"]:
            self.assertIn(word, lines[0])

    def test_too_little_memory_is_refused(self):
        scene = self.write_scene()
        self.expect_failure(2, ["render", scene, "--memory", "1"], ["--memory", "64"])


def write_small_tiff(path, width, height, code="h", value=lambda x, y: 100, place=True, nodata=None):
    """One strip, uncompressed; `place`: it is the whole globe, else it lies nowhere."""
    kinds = {"h": (16, 2), "f": (32, 3), "c": (64, 6)}  # "c": complex, which no height is
    bits, form = kinds[code]
    texels = [value(x, y) for y in range(height) for x in range(width)]
    data = b"".join(struct.pack("<2f" if code == "c" else "<" + code, *([t, 0] if code == "c" else [t])) for t in texels)
    blobs, entries = [], [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, bits), (259, 3, 1, 1), (262, 3, 1, 1),
                          (273, 4, 1, 8), (277, 3, 1, 1), (278, 4, 1, height), (279, 4, 1, len(data)), (339, 3, 1, form)]
    if place:
        blobs += [(33550, 12, 3, struct.pack("<3d", 360 / width, 180 / height, 0)),
                  (33922, 12, 6, struct.pack("<6d", 0, 0, 0, -180, 90, 0)),
                  (34735, 3, 16, struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326))]
    if nodata is not None:
        text = f"{nodata:<8}".encode() + b"\0"
        blobs.append((42113, 2, len(text), text))
    tail = bytearray()
    for tag, kind, count, blob in blobs:
        entries.append((tag, kind, count, 8 + len(data) + len(tail)))
        tail += blob + b"\0" * (len(blob) % 2)
    directory = struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *entry) for entry in sorted(entries))
    start = struct.pack("<2sHI", b"II", 42, 8 + len(data) + len(tail))
    pathlib.Path(path).write_bytes(start + data + tail + directory + struct.pack("<I", 0))


def hill(x, y):
    return (x * 37 + y * 91) % 1900


class BadRastersTest(ProgramTest):
    """A bad raster over a good one: one line that names it, and the picture is the good one's."""

    def render(self, files, *words, name="a.png"):
        scene = copy.deepcopy(THIN_SCENE)
        scene["surface"] = {"layers": [{"elevation": file, "scale": 10} for file in files]}
        done = self.run_program("render", self.write_scene(scene), "--view", "orbit", "--size", "64x64", "-o", name,
                                "-q", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr.splitlines(), read_png(self.work / name)

    def check(self, bad, says, *words):
        lines, picture = self.render(["good.tif", bad], *words)
        self.assertEqual(len(lines), 1, lines)
        self.assertIn(bad, lines[0])
        self.assertIn("left out", lines[0])
        for word in says:
            self.assertIn(word, lines[0])
        self.assertEqual(picture, self.good)

    def setUp(self):
        super().setUp()
        write_small_tiff(self.data / "good.tif", 96, 48, value=hill)
        lines, self.good = self.render(["good.tif"])
        self.assertEqual(lines, [])

    def test_bad_files_are_told_and_left_out(self):
        write_small_tiff(self.data / "cut.tif", 96, 48, value=hill)
        whole = (self.data / "cut.tif").read_bytes()
        (self.data / "cut.tif").write_bytes(whole[:4000])  # the directory is behind the data
        self.check("cut.tif", [])
        (self.data / "words.tif").write_text("not a raster")
        self.check("words.tif", [])
        (self.data / "empty.tif").write_bytes(b"")
        self.check("empty.tif", [])
        write_small_tiff(self.data / "complex.tif", 8, 4, "c")
        self.check("complex.tif", [])
        write_small_tiff(self.data / "nowhere.tif", 8, 8, place=False)
        self.check("nowhere.tif", ["georeference"])
        write_small_tiff(self.data / "void.tif", 8, 4, nodata=100)
        self.check("void.tif", ["data"])
        write_small_tiff(self.data / "nan.tif", 8, 4, "f", value=lambda x, y: math.nan)
        self.check("nan.tif", ["data"])

    def test_data_that_is_cut_off(self):
        # The directory before the data, as writers of large files have it: the strip ends too early.
        write_small_tiff(self.data / "whole.tif", 96, 48, value=hill)
        data = (self.data / "whole.tif").read_bytes()
        broken = data.replace(struct.pack("<HHII", 273, 4, 1, 8), struct.pack("<HHII", 273, 4, 1, len(data) - 100))
        (self.data / "short.tif").write_bytes(broken)
        self.check("short.tif", [])

    def test_odd_shapes_are_drawn(self):
        for width, height in [(1, 1), (100000, 1), (1, 300), (2, 1)]:
            write_small_tiff(self.data / "odd.tif", width, height, value=lambda x, y: 300)
            lines, picture = self.render(["good.tif", "odd.tif"])
            self.assertLessEqual(len(lines), 1, (width, height, lines))
            self.assertEqual(len(picture[2]), 64)

    def test_some_that_are_no_numbers_are_gaps(self):
        write_small_tiff(self.data / "some.tif", 96, 48, "f",
                         value=lambda x, y: [math.nan, math.inf, -math.inf][y % 3] if x < 9 else hill(x, y))
        lines, picture = self.render(["some.tif"])
        self.assertEqual(lines, [])
        differ = sum(a != b for row, other in zip(picture[2], self.good[2]) for a, b in zip(row, other))
        self.assertLess(differ, 64 * 64 * 3 // 4)

    def test_more_layers_than_a_picture_shows_are_told_once(self):
        names = []
        for i in range(6):
            names.append(f"globe{i}.tif")
            write_small_tiff(self.data / names[-1], 16, 8, value=hill)
        lines, _ = self.render(names)
        self.assertEqual(len(lines), 1, lines)
        for word in ["6 layers of elevation", "shows 4"]:
            self.assertIn(word, lines[0])


class BadTilesTest(ProgramTest):
    """The same of rasters that are held in tiles."""

    def render(self, file, *words):
        scene = self.write_scene(globe_scene(str(file)))
        done = self.run_program("render", scene, "--view", "orbit", "--size", "96x96", "-o", "a.png", "-q", "--memory",
                                "64", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr.splitlines()

    def test_a_file_without_its_second_half(self):
        path = self.data / "globe.tif"
        write_tiff(path, 3840, 1920)
        data = path.read_bytes()
        # All tiles of the southern half point behind the file's end.
        (directory,) = struct.unpack("<I", data[4:8])
        (entries,) = struct.unpack("<H", data[directory:directory + 2])
        for i in range(entries):
            tag, _, count, value = struct.unpack("<HHII", data[directory + 2 + 12 * i:directory + 14 + 12 * i])
            if tag == 324:
                offsets = list(struct.unpack(f"<{count}I", data[value:value + 4 * count]))
                offsets[count // 2:] = [len(data) + 1000] * (count - count // 2)
                data = data[:value] + struct.pack(f"<{count}I", *offsets) + data[value + 4 * count:]
        path.write_bytes(data)
        lines = self.render(path)
        self.assertEqual(len(lines), 1, lines)
        self.assertIn("globe.tif", lines[0])


if __name__ == "__main__":
    require_gl()
    unittest.main()
