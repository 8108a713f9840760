# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella bench and terrella info: the form of what they print. No time is judged here."""

import copy
import json
import unittest

from process import IS_SLOW, SCENES, THIN_SCENE, ProgramTest, require_gl
from render_test import add_layers, make_tiff


class Bench(ProgramTest):
    def measure(self, *words, runs=1):
        done = self.expect_success("bench", *words, "--json", "--shrink", 8, "--runs", runs, "--scene",
                                   self.write_scene())
        return [json.loads(line) for line in done.stdout.splitlines()]

    def check_form(self, bench, name, runs=1):
        self.assertEqual(list(bench), ["bench", "source", "machine", "rows", "notes"])
        self.assertEqual(bench["bench"], name)
        self.assertEqual(list(bench["machine"]), ["cpu", "cores", "load_average", "gl_renderer"])
        self.assertGreater(len(bench["rows"]), 0)
        for row in bench["rows"]:
            self.assertEqual(list(row), ["case", "metric", "unit", "median", "min", "runs"])
            self.assertLessEqual(row["min"], row["median"])
            self.assertEqual(row["runs"], runs)

    def test_list_names_all_and_measures_nothing(self):
        lines = self.expect_success("bench", "--list").stdout.splitlines()
        names = [line.split()[0] for line in lines]
        self.assertEqual(names[:4], ["solver", "tables", "sky-frame", "start"])
        self.assertEqual(len(set(names)), len(names))
        for line in lines:
            self.assertGreater(len(line.split()), 3, line)

    def test_terrain_error(self):
        (self.data / "h.tif").write_bytes(make_tiff(256, 128))
        path = self.write_scene(add_layers({"name": "h", "elevation": "h.tif", "scale": 0.1}))
        words = ["bench", "terrain-error", "--json", "--runs", 1, "--mesher", "hemisphere", "--scene", path]
        rows = json.loads(self.expect_success(*words).stdout)["rows"]
        values = {(row["case"], row["metric"]): row["median"] for row in rows}
        worst = values["all views, hemisphere", "worst RMS"]
        self.assertTrue(0 < worst < 1, worst)
        self.assertEqual({row["unit"] for row in rows}, {"px", "ms", "MB", "%", "", "px ms"})
        self.assertTrue(all(values[key] == 0 for key in values if key[1] == "holes"))
        # A scene of the sphere alone has no mesh.
        words[-1] = self.write_scene(name="bare.json")
        self.expect_failure(1, words, ["no mesh"])

    def test_unknown_names_are_told(self):
        self.expect_failure(2, ["bench", "solvre"], ["solvre", "solver"])
        self.expect_failure(2, ["bench", "gravity"], ["gravity", "--list"])

    def test_named_twice_runs_once(self):
        self.assertEqual(len(self.measure("start", "start")), 1)

    def test_solver_and_tables(self):
        solver, tables = self.measure("solver", "tables")
        self.check_form(solver, "solver")
        self.check_form(tables, "tables")
        rows = {row["metric"]: row for row in solver["rows"]}
        self.assertEqual(rows["solve"]["unit"], "s")
        self.assertGreater(rows["solve"]["min"], 0.0)
        self.assertGreaterEqual(rows["orders"]["min"], 2)
        self.assertGreater(rows["peak memory"]["min"], 1.0)
        self.assertGreater({row["metric"]: row for row in tables["rows"]}["table"]["min"], 0.0)

    @unittest.skipIf(IS_SLOW, "large pictures; what it calls is tested with sanitizers by three wavelengths")
    def test_frames(self):
        frames, = self.measure("sky-frame")
        self.check_form(frames, "sky-frame")
        self.assertIn("8 times narrower", frames["notes"][0])
        whole = [row for row in frames["rows"] if row["metric"] == "frame"]
        self.assertEqual({row["case"] for row in whole},
                         {f"{view} {size}" for view in ["ground", "orbit"] for size in ["1024x576", "1920x1080"]})
        rows = {(row["case"], row["metric"]): row for row in frames["rows"]}
        for case in ["ground 1024x576", "orbit 1024x576"]:
            # A camera that stands still has its maps of the sky.
            still, moving = rows[case, "pass sky maps (CPU)"], rows[case, "moving pass sky maps (CPU)"]
            self.assertLess(still["min"], moving["min"])
            passes = [row for name, row in rows.items() if name[0] == case and name[1].startswith("pass ")]
            together = rows[case, "passes together"]
            self.assertLessEqual(max(row["min"] for row in passes), together["min"])
            self.assertGreater(rows[case, "moving frame"]["min"], 0.0)

    def test_projective_frames_want_ground(self):
        # Its progress may be told before: nothing may be solved yet.
        done = self.run_program("bench", "pgm-fps", "--scene", self.write_scene())
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr.splitlines()[-1], "^terrella: error: .*no ground.*make data")

    @unittest.skipIf(IS_SLOW, "many meshes and pictures; what it calls is tested with sanitizers by terrain_projective")
    def test_projective_frames_by_grid_and_screen(self):
        (self.data / "h.tif").write_bytes(make_tiff(256, 128))
        scene = add_layers({"name": "h", "elevation": "h.tif"})
        del scene["views"]["orbit"]
        words = ["bench", "pgm-fps", "--shrink", "8", "--runs", "1", "--scene"]
        bench = json.loads(self.expect_success(*words, self.write_scene(scene), "--json").stdout)
        rows = {(row["case"], row["metric"]): row for row in bench["rows"]}
        self.assertEqual(len(rows), 2 * 9)
        for grid in [512, 768, 1024]:
            for screen in [512, 768, 1024]:
                case = f"ground, grid {grid}^2, screen {screen}^2"
                self.assertGreater(rows[case, "frame"]["min"], 0.0)
                self.assertGreater(rows[case, "step"]["min"], 0.0)

    def test_waves_have_a_scene_of_their_own(self):
        self.expect_failure(1, ["bench", "michelic-table2", "--scene", self.write_scene()],
                            ["michelic-table2", "--scene"])
        self.expect_failure(1, ["bench", "ocean-frame", "--scene", self.write_scene()],
                            ["ocean-frame", "--scene"])

    @unittest.skipIf(IS_SLOW, "16 pictures of 1920 x 1080")
    def test_layers_of_noise_by_grids(self):
        scene = copy.deepcopy(THIN_SCENE)
        # Mostly sky, for the pictures of this bench are large.
        scene["views"] = {"up": {"camera": {"latitude_deg": 10, "longitude_deg": 20, "height_above_ground_m": 30000,
                                            "heading_deg": 0, "pitch_deg": 60, "vertical_fov_deg": 40},
                                 "sun": {"elevation_deg": 40, "azimuth_deg": 0}}}
        words = ["bench", "michelic-table1", "--shrink", "8", "--runs", "1", "--scene"]
        self.expect_failure(1, [*words, self.write_scene(scene)], ["no ground of noise"])
        scene["surface"] = {"noise": {"seed": 1}}
        path = self.write_scene(scene)
        self.expect_failure(1, [*words, path, "--mesher", "quadtree"], ["michelic-table1", "tessellated"])
        bench = json.loads(self.expect_success(*words, path, "--json").stdout)
        rows = {(row["case"], row["metric"]): row for row in bench["rows"]}
        self.assertEqual(len(rows), 12 * 5)
        paper = {"continents": [0.8, 0.5, 0.9], "1 layer": [1.0, 0.7, 1.3],
                 "5 layers": [1.3, 1.3, 1.9], "10 layers": [1.7, 2.6, 2.6]}
        for layers, printed in paper.items():
            for side, ms in zip([50, 100, 200], printed):
                case = f"{layers}, {side} x {side}"
                self.assertEqual(rows[case, "ground"]["paper"], ms)
                parts = [rows[case, f"its {part}"]["min"] for part in ["vertices", "mesh", "colours and normals"]]
                self.assertGreater(parts[0], 0)
                self.assertAlmostEqual(rows[case, "ground"]["min"], sum(parts), delta=0.01 * sum(parts))

    def test_planets_with_air_and_without(self):
        (self.data / "h.tif").write_bytes(make_tiff(256, 128))
        scene = add_layers({"name": "h", "elevation": "h.tif"})
        words = ["bench", "schafhitzel-table1", "--shrink", "8", "--json", "--runs", "1", "--scene"]
        bench = json.loads(self.expect_success(*words, self.write_scene(scene)).stdout)
        rows = {(row["case"], row["metric"]): row["median"] for row in bench["rows"]}
        for view in ["ground", "orbit"]:
            for metric in ["whole scene, 1024 x 576", "triangles", "with air", "without air"]:
                self.assertGreater(rows[view, metric], 0)
            share = rows[view, "with air"] / rows[view, "without air"]
            # The three numbers are printed to six digits: the two of the share may each be wrong by 5e-6 of themselves.
            self.assertAlmostEqual(rows[view, "the air takes"], 100 * (1 - share), delta=100 * share * 2e-5)
        self.assertIn("15 %", " ".join(bench["notes"]))
        # The sphere alone is no terrain.
        self.expect_failure(1, [*words, self.write_scene(name="bare.json")], ["no ground", "make data"])

    @unittest.skipIf(IS_SLOW, "large pictures; what it calls is tested with sanitizers by three wavelengths")
    def test_table_of_a_paper(self):
        table, = self.measure("schafhitzel-table2")
        self.assertIn("Table 2", table["source"])
        rows = {(row["case"], row["metric"]): row for row in table["rows"]}
        for side, paper in [(128, 608.49), (256, 181.54), (512, 48.67)]:
            case = f"{side} x {side} vertices"
            self.assertEqual(rows[case, "optimized (3D table)"]["paper"], paper)
            self.assertGreater(rows[case, "optimized (3D table)"]["min"], 0.0)
            self.assertGreater(rows[case, "vertex shader"]["min"], 0.0)
            self.assertGreater(rows[case, "optimized / vertex shader"]["min"], 0.0)

    @unittest.skipIf(IS_SLOW, "many pictures; what it calls is tested with sanitizers by render")
    def test_samples_and_wavelengths_of_the_model_rayleigh(self):
        done = self.expect_success("bench", "santana-samples", "santana-spectrum", "santana-fit", "--json", "--runs", 1)
        samples, spectrum, fit = [json.loads(line) for line in done.stdout.splitlines()]
        rows = {(row["case"], row["metric"]): row for row in samples["rows"]}
        self.assertEqual(rows["full-disc, 13 to 5 samples", "error"]["paper"], 16.15)
        # From the ground the star is in the picture: its disc must not hide the sky's error.
        for view in ["full-disc", "limb", "ground", "sunset"]:
            errors = [rows[f"{view}, {n} samples", "error"]["min"] for n in [3, 5, 7, 9, 11, 13]]
            self.assertEqual(errors, sorted(errors, reverse=True))
            self.assertGreater(errors[0], 0.01)
        rows = {(row["case"], row["metric"]): row for row in spectrum["rows"]}
        self.assertEqual(rows["full-disc, 20 to 10 wavelengths", "error"]["paper"], 9.81)
        self.assertGreater(rows["ground, 3 wavelengths", "error"]["min"], rows["ground, 10 wavelengths", "error"]["min"])
        rows = {(row["case"], row["metric"]): row for row in fit["rows"]}
        self.assertEqual(rows["10 heights, degree 5", "mean error"]["paper"], 2.84)
        self.assertLess(rows["texture", "mean error"]["min"], rows["10 heights, degree 5", "mean error"]["min"])

    @unittest.skipIf(IS_SLOW, "solves nine times; what it calls is tested with sanitizers by the others")
    def test_precomputation_of_a_paper(self):
        table, = self.measure("elek-precompute")
        rows = {(row["case"], row["metric"]): row for row in table["rows"]}
        self.assertEqual(rows["the paper's tables", "time"]["paper"], 5400)
        self.assertEqual(rows["the paper's tables", "tables"]["paper"], 10)
        for count in [3, 8, 15, 16]:
            case = f"pictures, {count} wavelengths"
            self.assertGreater(rows[case, "solve and table"]["min"], 0.0)
            self.assertGreater(rows[case, "tables"]["min"], 1.0)
        self.assertGreater(rows["numbers, 6 orders", "solve"]["min"], 0.0)

    @unittest.skipIf(IS_SLOW, "large pictures; what it calls is tested with sanitizers by three wavelengths")
    def test_frames_of_a_paper(self):
        table, = self.measure("elek-fps")
        rows = {(row["case"], row["metric"]): row for row in table["rows"]}
        for size, average, least in [("1024x768", 180, 85), ("2560x2048", 60, 29)]:
            rates = [rows[f"{view} {size}", "frames"]["min"] for view in ["ground", "orbit"]]
            self.assertEqual(rows[f"all views {size}", "average"]["paper"], average)
            self.assertEqual(rows[f"all views {size}", "least"]["paper"], least)
            self.assertAlmostEqual(rows[f"all views {size}", "least"]["min"], min(rates), delta=0.01 * min(rates))
            # As many frames in all as views: the harmonic mean.
            mean = len(rates) / sum(1 / rate for rate in rates)
            self.assertAlmostEqual(rows[f"all views {size}", "average"]["min"], mean, delta=0.01 * mean)

    def test_three_wavelengths_are_not_sixteen(self):
        table, = self.measure("elek-rgb-vs-spectral")
        rows = {(row["case"], row["metric"]): row["median"] for row in table["rows"]}
        for view in ["ground", "orbit"]:
            # Something differs, and white stays white: far less than another colour would.
            self.assertGreater(rows[view, "luminance, mean difference"], 0.01)
            self.assertLess(rows[view, "luminance, mean difference"], 50)
            self.assertGreater(rows[view, "colour, mean distance in u'v'"], 1e-5)
            self.assertLess(rows[view, "colour, mean distance in u'v'"], 0.1)

    def test_start(self):
        start, = self.measure("start", runs=2)
        self.check_form(start, "start", runs=2)
        self.assertEqual(start["rows"][0]["unit"], "s")
        self.assertEqual(list(self.work.iterdir()), [])

    def test_a_table_for_people(self):
        done = self.expect_success("bench", "solver", "--runs", "1", "--scene", self.write_scene())
        self.assertIn("peak memory", done.stdout)


class Info(ProgramTest):
    def test_says_what_there_is(self):
        text = self.expect_success("info", SCENES / "earth.json").stdout
        for word in ["terrella ", "GDAL ", "viewer ", "data ", "cache ", "OpenGL ", "scene ", "missing"]:
            self.assertIn(word, text)
        self.assertIn(str(self.data), text)

    def test_needs_no_gl(self):
        self.environment.update(LIBGL_DRIVERS_PATH="/nonexistent", __EGL_VENDOR_LIBRARY_DIRS="/nonexistent",
                                DISPLAY="")
        text = self.expect_success("info").stdout
        self.assertIn("OpenGL          none", text)


if __name__ == "__main__":
    require_gl()
    unittest.main(verbosity=2)
