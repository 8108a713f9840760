# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Words of the command line: help, versions, mistakes. Nothing is solved or drawn here."""

import unittest

from process import SCENES, ProgramTest

EARTH = SCENES / "earth.json"
COMMANDS = ["render", "sky", "sea", "view", "info", "bench", "validate"]


class Help(ProgramTest):
    def test_every_command_teaches_itself(self):
        for command in COMMANDS:
            for word in ["--help", "-h"]:
                text = self.expect_success(command, word).stdout
                self.assertTrue(text.startswith("Usage: terrella " + command), text)
                examples = text.split("\nExamples:\n")[1]
                self.assertGreaterEqual(examples.count("terrella " + command), 2)
                self.assertLessEqual(max(len(line) for line in text.splitlines()), 82)

    def test_help_lists_every_command(self):
        for word in ["--help", "-h", "help"]:
            text = self.expect_success(word).stdout
            for command in COMMANDS:
                self.assertIn("\n  " + command + " ", text)

    def test_version(self):
        self.assertRegex(self.expect_success("--version").stdout, r"^terrella \d+\.\d+\.\d+\n$")

    def test_output_that_cannot_be_delivered_is_a_failure(self):
        with open("/dev/full", "w") as full:
            done = self.run_full(full)
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot be written", done.stderr)

    def run_full(self, full):
        import subprocess
        from process import PROGRAM
        return subprocess.run([PROGRAM, "--help"], stdout=full, stderr=subprocess.PIPE, text=True)


class Mistakes(ProgramTest):
    def expect_usage(self, *words, mentions=()):
        self.expect_failure(2, words, mentions)

    def test_commands(self):
        self.expect_usage(mentions=["--help"])
        self.expect_usage("rendr", mentions=["did you mean render?"])
        self.expect_usage("xyzzy", mentions=["xyzzy", "--help"])
        self.expect_usage("", mentions=["unknown command"])
        self.expect_usage("two\nlines", mentions=["two?lines"])

    def test_options(self):
        self.expect_usage("render", EARTH, "--veiw", "orbit", mentions=["did you mean --view?"])
        self.expect_usage("render", EARTH, "-x", mentions=["-x"])
        self.expect_usage("render", EARTH, "--zzzzzzzzzz=3", mentions=["render --help"])
        self.expect_usage("render", EARTH, "--size", mentions=["--size needs a value"])
        self.expect_usage("render", EARTH, "--quiet=yes", mentions=["--quiet takes no value"])
        self.expect_usage("render", EARTH, "--view=", mentions=["empty"])
        self.expect_usage("render", mentions=["SCENE is missing"])
        self.expect_usage("render", EARTH, EARTH, mentions=["one argument too many"])
        self.expect_usage("render", "", mentions=["empty"])
        self.expect_usage("bench", "sover", mentions=["did you mean solver?"])
        self.expect_usage("bench", "--runs", "2.5", mentions=["whole number"])

    def test_sizes(self):
        for size in ["0x10", "10x0", "100000x10", "10x100000", "0", "100000", "10x", "x10", "NaN", "nanx5",
                     "-3x4", "3x-4", "10x10x10", "10 x 10", "1e3x10", "", "99999999999999999999x1",
                     "16384x16384"]:
            self.expect_usage("render", EARTH, "--size", size, mentions=["--size"])

    def test_numbers(self):
        for value in ["", "x", "nan", "inf", "-inf", "1e999", "0x10", "1,2", "12deg", " 1", "1 ", "--", "1e", "."]:
            self.expect_usage("render", EARTH, "--latitude", value, mentions=["--latitude"])
        self.expect_usage("render", EARTH, "--latitude", "90.1", mentions=["more than 90"])
        self.expect_usage("render", EARTH, "--latitude=-91", mentions=["less than -90"])
        self.expect_usage("render", EARTH, "--fov", "0", mentions=["less than"])
        self.expect_usage("render", EARTH, "--ev100", "automatic", mentions=["not a number"])
        self.expect_usage("render", EARTH, "--tone", "sepia", mentions=["filmic, exponential"])

    def test_lists(self):
        for text in ["", ",", "1,,2", "1:2", "1:2:3:4", "1:10:0", "1:10:-1", "10:1:1", "0:1:1e-9", "a:b:c", "1:2:nan",
                     "0,181", "-1"]:
            self.expect_usage("sky", EARTH, "--view-zenith", text, mentions=["--view-zenith"])

    def test_options_that_contradict_each_other(self):
        scene = self.write_scene()
        self.expect_usage("render", scene, "--altitude", 5, "--height-above-ground", 6, mentions=["both"])
        self.expect_usage("render", scene, "--sun-elevation", 5, "--subsolar-latitude", 6,
                          mentions=["either"])
        self.expect_usage("render", scene, "--view", "orbit", "--sun-elevation", 5, mentions=["--sun-azimuth"])
        self.expect_usage("sky", scene, "--queries", "x.csv", "--altitude", 0, mentions=["both"])
        self.expect_usage("sky", scene, "--altitude", 0, mentions=["--sun-zenith"])

    def test_views_and_suffixes(self):
        scene = self.write_scene()
        self.expect_usage("render", scene, "--view", "orbitt", mentions=["orbitt", "ground, orbit"])
        for name in ["x.jpg", "x", "png", ".", "folder.png/x"]:
            self.expect_usage("render", scene, "-o", name, mentions=["--output"])
        self.expect_usage("view", scene, "--screenshot", "x.exr", mentions=["--screenshot"])

    def test_views_are_listed(self):
        text = self.expect_success("render", self.write_scene(), "--views").stdout
        self.assertEqual(text.split(), ["ground", "orbit"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
