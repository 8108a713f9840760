# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella sky: numbers in, numbers out."""

import signal
import time
import unittest

from process import IS_SLOW, SCENES, ProgramTest

HEADER = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg,wavelength_nm"
ANSWER = HEADER + ",radiance_W_m2_sr_nm"
FLAGS = ["--altitude", "0", "--sun-zenith", "60", "--view-zenith", "0,45.0,100", "--azimuth", "0,90",
         "--wavelength", "450,6.5e2"]
ROWS = [f"0,60,{view},{azimuth},{wavelength}" for view in ["0", "45.0", "100"] for azimuth in ["0", "90"]
        for wavelength in ["450", "6.5e2"]]


class Answers(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write_scene()

    def ask(self, text, **more):
        path = self.folder / "queries.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return self.expect_success("sky", self.scene, "--queries", path, **more).stdout

    def test_flags_and_tables_say_the_same(self):
        by_flags = self.expect_success("sky", self.scene, *FLAGS).stdout
        lines = by_flags.splitlines()
        self.assertEqual(lines[0], ANSWER)
        self.assertEqual([line.rsplit(",", 1)[0] for line in lines[1:]], ROWS)
        values = [float(line.rsplit(",", 1)[1]) for line in lines[1:]]
        self.assertTrue(all(0.0 < value < 1.0 for value in values), values)
        # Rayleigh's law: thin air scatters (650 / 450)^4 = 4.4 times as much blue; the ground adds as much to both.
        self.assertGreater(values[0], 3.5 * values[1])
        table = "\n".join([HEADER] + ROWS) + "\n"
        self.assertEqual(self.ask(table), by_flags)
        self.assertEqual(self.ask(table.replace("\n", "\r\n")), by_flags)
        self.assertEqual(self.ask(b"\xef\xbb\xbf" + table.encode()), by_flags)
        self.assertEqual(self.ask(table.rstrip("\n").replace("\n", "\n\n")), by_flags)
        quoted = "\n".join(",".join(f' "{field}" ' for field in line.split(",")) for line in table.splitlines())
        self.assertEqual(self.ask(quoted), by_flags)
        done = self.expect_success("sky", self.scene, "--queries", "-", input=table)
        self.assertEqual(done.stdout, by_flags)
        self.expect_success("sky", self.scene, *FLAGS, "-o", "answers.csv")
        self.assertEqual((self.work / "answers.csv").read_text(), by_flags)
        self.assertEqual([path.name for path in self.work.iterdir()], ["answers.csv"])

    def test_columns_in_any_order_and_others_between(self):
        straight = self.ask(HEADER + "\n0,60,30,0,550\n")
        turned = self.ask("wavelength_nm,note,azimuth_deg,view_zenith_deg,sun_zenith_deg,altitude_m\n"
                          "550,hello,0,30,60,0\n")
        self.assertEqual(turned, straight)

    def test_no_queries_no_answers(self):
        self.assertEqual(self.ask(HEADER), ANSWER + "\n")

    def test_ranges_include_both_ends(self):
        done = self.expect_success("sky", self.scene, "--altitude", "0", "--sun-zenith", "60", "--view-zenith",
                                   "0:0.3:0.1,80:60:-10", "--azimuth=-5", "--wavelength", "550")
        shown = [line.split(",")[2] for line in done.stdout.splitlines()[1:]]
        self.assertEqual(shown, ["0", "0.1", "0.2", "0.3", "80", "70", "60"])

    def test_solvers_agree_and_orders_add_up(self):
        views = ["sky", self.scene, "--altitude", "0", "--sun-zenith", "50", "--view-zenith", "30,70",
                 "--azimuth", "90", "--wavelength", "550"]
        solved = self.columns(self.expect_success(*views).stdout, "radiance_W_m2_sr_nm")
        traced = self.expect_success(*views, "--solver", "reference", "--paths", "20000").stdout
        self.assertTrue(traced.splitlines()[0].endswith(",radiance_W_m2_sr_nm,standard_error"))
        again = self.expect_success(*views, "--solver", "reference", "--paths", "20000", "--seed", "0").stdout
        self.assertEqual(traced, again)
        for exact, value, error in zip(solved, self.columns(traced, "radiance_W_m2_sr_nm"),
                                       self.columns(traced, "standard_error")):
            self.assertGreater(error, 0.0)
            # Four standard errors: one in 16 000 by chance; 0.5 % is what the solver may be off.
            self.assertLess(abs(value - exact), 4 * error + 5e-3 * exact)
        sums = [self.columns(self.expect_success(*views, "--orders", orders).stdout, "radiance_W_m2_sr_nm")
                for orders in ["1", "2", "all"]]
        for first, second, everything in zip(*sums):
            self.assertLess(1.02 * first, second)
            self.assertLess(second, everything)
        self.assertEqual(sums[2], solved)
        single = self.expect_success(*views, "--solver", "reference", "--paths", "20000", "--orders", "1").stdout
        for exact, value, error in zip(sums[0], self.columns(single, "radiance_W_m2_sr_nm"),
                                       self.columns(single, "standard_error")):
            self.assertLess(abs(value - exact), 4 * error + 5e-3 * exact)

    def test_single_is_exact_in_the_plane_of_the_star_only(self):
        def ask(azimuth, *more):
            views = ["sky", self.scene, "--altitude", "0", "--sun-zenith", "92", "--view-zenith", "40,80",
                     "--azimuth", azimuth, "--wavelength", "450,650"]
            return self.columns(self.expect_success(*views, *more).stdout, "radiance_W_m2_sr_nm")
        for single, exact in zip(ask(0, "--solver", "single"), ask(0, "--orders", "1")):
            self.assertLess(abs(single - exact), 1e-4 * exact)
        # Opposite the star the air is in shadow up to farther away: 4 to 76 % too bright, most near the horizon.
        for single, exact in zip(ask(180, "--solver", "single"), ask(180, "--orders", "1")):
            self.assertGreater(single, 1.03 * exact)
        self.assertGreater(ask(180, "--solver", "single")[2], 1.5 * ask(180, "--orders", "1")[2])
        self.expect_failure(1, ["sky", self.scene, "--altitude", "0", "--sun-zenith", "92", "--view-zenith", "40",
                                "--azimuth", "0", "--wavelength", "450", "--solver", "single", "--orders", "2"],
                            ["single", "one order"])

    @staticmethod
    def columns(text, name):
        lines = [line.split(",") for line in text.splitlines()]
        return [float(line[lines[0].index(name)]) for line in lines[1:]]

    def test_needs_no_gl(self):
        self.environment.update(LIBGL_DRIVERS_PATH="/nonexistent", __EGL_VENDOR_LIBRARY_DIRS="/nonexistent",
                                DISPLAY="")
        self.ask(HEADER + "\n0,60,30,0,550\n")


class Mistakes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write_scene()

    def expect_wrong(self, text, *mentions):
        path = self.folder / "queries.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        done = self.expect_failure(1, ["sky", self.scene, "--queries", path], mentions)
        self.assertEqual(done.stdout, "")

    def test_tables(self):
        self.expect_wrong("", "queries.csv:1", "empty")
        self.expect_wrong("\n\n", "empty")
        self.expect_wrong(HEADER.replace("azimuth_deg", "azimuth"), "queries.csv:1", "azimuth_deg", "missing")
        self.expect_wrong(HEADER + ",azimuth_deg\n", "queries.csv:1", "azimuth_deg", "more than once")
        self.expect_wrong(HEADER + "\n1,2,3,4\n", "queries.csv:2", "4 fields", "5")
        self.expect_wrong(HEADER + "\n0,0,0,0,550\n\n1,2,3,4,550,6\n", "queries.csv:4", "6 fields")
        self.expect_wrong(b"\x00\x01\x02", "not a text file")
        self.expect_wrong("," * 1000, "queries.csv:1", "columns")

    def test_fields(self):
        good = ["0", "60", "30", "0", "550"]
        names = HEADER.split(",")
        for column, values in enumerate([["-1", "nan", "1e13"], ["-0.1", "180.1"], ["181", "x"], ["inf", "1e3"],
                                         ["0", "-550", "", "5 50"]]):
            for value in values:
                row = list(good)
                row[column] = value
                self.expect_wrong(HEADER + "\n" + ",".join(good) + "\n" + ",".join(row) + "\n", "queries.csv:3",
                                  names[column])

    def test_files(self):
        self.expect_failure(1, ["sky", self.scene, "--queries", self.folder / "none.csv"], ["none.csv"])
        self.expect_failure(1, ["sky", self.scene, "--queries", self.folder], [str(self.folder)])
        for output in ["missing/answers.csv", ".", "/dev/null"]:
            self.expect_failure(1, ["sky", self.scene, *FLAGS, "-o", output], [output, "cannot be written"])

    def test_too_many(self):
        self.expect_failure(2, ["sky", self.scene, "--altitude", "0", "--sun-zenith", "0:180:0.001", "--view-zenith",
                                "0:180:0.001", "--azimuth", "0", "--wavelength", "550"], ["queries"])


class Interruption(ProgramTest):
    def test_nothing_is_left(self):
        # Wide enough to take long on any machine.
        wavelengths = "400:700:20" if IS_SLOW else "400:700:2"
        work = self.start_program("sky", SCENES / "earth.json", "--altitude", "0", "--sun-zenith", "60",
                                  "--view-zenith", "0", "--azimuth", "0", "--wavelength", wavelengths, "-o", "answers.csv")
        time.sleep(1.5)
        self.assertIsNone(work.poll(), "was done before it could be interrupted")
        work.send_signal(signal.SIGINT)
        output, errors = work.communicate(timeout=120)
        self.assertEqual(work.returncode, 1, errors)
        self.assertEqual(output, "")
        told = [line for line in errors.splitlines() if "error" in line]
        self.assertEqual(len(told), 1, errors)
        self.assertIn("cancelled", told[0])
        self.assertEqual(list(self.work.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
