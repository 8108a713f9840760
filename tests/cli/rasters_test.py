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
import unittest

from process import THIN_SCENE, ProgramTest, read_png, require_gl

sys.path.insert(0, os.environ["TERRELLA_RANGE_SERVER"])
import range_server  # noqa: E402


def write_tiff(path, width, height):
    """A globe of 16-bit heights in tiles of 256 x 256, as little of TIFF and GeoTIFF as that needs."""
    tiles_x, tiles_y = -(-width // 256), -(-height // 256)
    offsets, data = [], bytearray()
    for tile in range(tiles_x * tiles_y):
        texels = array.array("h")
        for y in range(256):
            v = (tile // tiles_x * 256 + y) / height
            wave = 900 * math.sin(9 * math.pi * v)
            u0 = tile % tiles_x * 256 / width
            texels.extend(int(wave * math.sin(14 * math.pi * (u0 + x / width)) + 400) for x in range(256))
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
    """Of the globe, 3072 x 1536 heights, held whole 44 MB of the 64 that there are to be."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.served = pathlib.Path(cls.shared_cache) / "served-folder"
        cls.served.mkdir()
        write_tiff(cls.served / "globe.tif", 3072, 1536)

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

    def test_too_little_memory_is_refused(self):
        scene = self.write_scene()
        self.expect_failure(2, ["render", scene, "--memory", "1"], ["--memory", "64"])


if __name__ == "__main__":
    require_gl()
    unittest.main()
