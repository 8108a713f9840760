# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""What the tests of the program share: running it, scenes that are solved quickly, reading pictures."""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PROGRAM = os.environ["TERRELLA_PROGRAM"]
SCENES = pathlib.Path(os.environ["TERRELLA_SCENES"])
# A build with sanitizers, where solving takes several times as long: tests repeat less.
IS_SLOW = os.environ.get("TERRELLA_IS_SLOW") == "1"
# The tests of a file share the cache, so that a scene is solved once; one that is about the cache sets its own.
SHARED_CACHE = tempfile.TemporaryDirectory(prefix="terrella-test-cache-")

# A thin grey atmosphere of one constituent: the solver needs a moment for it.
THIN_SCENE = {
    "terrella": 1,
    "name": "Thin",
    "star": {"spectral_irradiance": 1.5, "angular_radius_deg": 0.27},
    "planet": {"radius_m": 6371000, "ground_albedo": 0.2},
    "atmosphere": {
        "height_m": 60000,
        "constituents": [
            {
                "name": "gas",
                "scattering_per_m": {"power_law": {"at_nm": 550, "value": 2e-6, "exponent": -4}},
                "profile": {"exponential": {"scale_height_m": 8000}},
                "phase": "isotropic",
            }
        ],
    },
    "views": {
        "ground": {
            "camera": {"latitude_deg": 10, "longitude_deg": 20, "altitude_m": 100, "heading_deg": 90,
                       "pitch_deg": 5, "vertical_fov_deg": 60},
            "sun": {"elevation_deg": 30, "azimuth_deg": 120},
        },
        "orbit": {
            "camera": {"latitude_deg": 0, "longitude_deg": 0, "altitude_m": 9000000, "heading_deg": 0,
                       "pitch_deg": -90, "vertical_fov_deg": 60},
            "sun": {"subsolar_latitude_deg": 10, "subsolar_longitude_deg": 50},
        },
    },
}


def has_gl():
    text = subprocess.run([PROGRAM, "info"], capture_output=True, text=True).stdout
    return "OpenGL          none" not in text


def require_gl():
    """Ends with the status that means skipped, unless skipping is forbidden."""
    if not has_gl() and os.environ.get("TRL_REQUIRE_GPU") != "1":
        print("skipped: no OpenGL without a window")
        sys.exit(77)


class ProgramTest(unittest.TestCase):
    """Each test has a folder of its own, with data in it, and finds nothing left behind."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="terrella-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.data = self.folder / "data"
        self.cache = pathlib.Path(SHARED_CACHE.name)
        self.work = self.folder / "work"
        self.data.mkdir()
        self.work.mkdir()
        self.environment = dict(os.environ, TERRELLA_DATA=str(self.data),
                                TERRELLA_CACHE=str(self.cache))

    def run_program(self, *words, **more):
        more.setdefault("timeout", 300)
        more.setdefault("env", self.environment)
        command = [PROGRAM] + [str(word) for word in words]
        return subprocess.run(command, cwd=self.work, capture_output=True, text=True, **more)

    def start_program(self, *words):
        command = [PROGRAM] + [str(word) for word in words]
        return subprocess.Popen(command, cwd=self.work, env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def write_scene(self, scene=None, name="scene.json"):
        path = self.folder / name
        path.write_text(json.dumps(scene or THIN_SCENE))
        return path

    def expect_success(self, *words, **more):
        done = self.run_program(*words, **more)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("error", done.stderr)
        return done

    def check_failure(self, done, status, mentions):
        self.assertEqual(done.returncode, status, done.stderr)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("terrella: error: "), lines[0])
        for mention in mentions:
            self.assertIn(mention, lines[0])

    def expect_failure(self, status, words, mentions=(), **more):
        """One line that says what is wrong, the exit status, and no file left behind."""
        before = sorted(self.work.rglob("*"))
        done = self.run_program(*words, **more)
        self.check_failure(done, status, mentions)
        self.assertEqual(sorted(self.work.rglob("*")), before)
        return done


def read_png(path):
    """Width, height and rows of RGB bytes of a PNG without interlacing."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height, depth, colour = struct.unpack(">IIBB", data[16:26])
    assert depth == 8 and colour in (2, 6)
    channels = 3 if colour == 2 else 4
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    return width, height, unfilter(zlib.decompress(packed), width * channels, channels)


def read_exr_luminance(path):
    """Rows of luminances of one of the program's OpenEXR files: 32-bit floats, packed by zip."""
    data = pathlib.Path(path).read_bytes()
    where = data.index(b"dataWindow\0box2i\0") + 21
    left, top, right, bottom = struct.unpack("<4i", data[where:where + 16])
    width, height = right - left + 1, bottom - top + 1
    channels = "ABGR" if b"A\0" in data[data.index(b"chlist"):][:16] else "BGR"
    # Names and values of attributes end with an empty name; then come the places of blocks of 16 rows.
    at = 8
    while data[at]:
        at = data.index(0, data.index(0, at) + 1) + 1
        at += 4 + struct.unpack("<I", data[at:at + 4])[0]
    rows = []
    for (place,) in struct.iter_unpack("<Q", data[at + 1:at + 1 + 8 * -(-height // 16)]):
        y, size = struct.unpack("<iI", data[place:place + 8])
        raw = data[place + 8:place + 8 + size]
        count = min(16, height - y)
        if size < 4 * len(channels) * width * count:
            packed = bytearray(zlib.decompress(raw))
            for i in range(1, len(packed)):
                packed[i] = (packed[i - 1] + packed[i] - 128) & 255
            raw = bytearray(len(packed))
            raw[0::2], raw[1::2] = packed[:(len(packed) + 1) // 2], packed[(len(packed) + 1) // 2:]
        for row in range(count):
            line = struct.unpack_from(f"<{len(channels) * width}f", raw, 4 * len(channels) * width * row)
            blue, green, red = (line[i * width:(i + 1) * width] for i in map(channels.index, "BGR"))
            rows.append([0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in zip(red, green, blue)])
    return rows


def predict_paeth(left, above, corner):
    estimate = left + above - corner
    distances = [(abs(estimate - left), left), (abs(estimate - above), above),
                 (abs(estimate - corner), corner)]
    return min(distances, key=lambda pair: pair[0])[1]


def unfilter(raw, stride, channels):
    rows, above = [], bytearray(stride)
    for start in range(0, len(raw), stride + 1):
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            guess = (0, left, above[i], (left + above[i]) // 2,
                     predict_paeth(left, above[i], corner))[kind]
            row[i] = (row[i] + guess) & 255
        rows.append(row)
        above = row
    return rows


def count_values(rows):
    return len({value for row in rows for value in row})
