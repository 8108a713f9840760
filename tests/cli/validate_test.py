# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""terrella validate: the form of what it prints, and that the page stands alone."""

import base64
import html.parser
import json
import unittest

from process import ProgramTest, require_gl

PATHS = 200
VOID = {"meta", "img", "br", "path", "circle", "rect", "polyline"}


class Page(html.parser.HTMLParser):
    """Collects what a page refers to; fails where tags are not closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.links, self.ids, self.text, self.tags = [], [], set(), [], []
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        for name, value in attrs:
            if name in ("src", "href", "data", "action"):
                self.links.append(value)
            if name == "id":
                self.ids.add(value)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text.append(data)


class Validate(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write_scene()

    def validate(self, *words):
        """Whatever the verdict is, the status must say the same."""
        done = self.run_program("validate", self.scene, "--quick", "--paths", PATHS, *words)
        self.assertIn(done.returncode, [0, 1], done.stderr)
        return done

    def test_json(self):
        done = self.validate("--json")
        found = json.loads(done.stdout)
        self.assertEqual(list(found), ["passed", "bounds", "spectral", "seconds", "machine", "scenes", "clouds"])
        self.assertEqual(found["clouds"], [])  # compared with the scenes that ship alone
        self.assertEqual(done.returncode, 0 if found["passed"] else 1)
        self.assertEqual(found["bounds"], {"mean": 0.01, "largest": 0.02})
        self.assertEqual(found["spectral"]["views"], 9)
        scene, = found["scenes"]
        self.assertEqual(scene["name"], "Thin")
        self.assertEqual([(view["place"], view["sun_elevation_deg"]) for view in scene["views"]],
                         [(place, sun) for place in ["ground", "10 km", "orbit"] for sun in [60, 3, -6]])
        for view in scene["views"]:
            reference, spectral = view["reference"], view["models"]["spectral"]
            self.assertEqual(reference["paths"], [PATHS] * 18)
            self.assertEqual(len(reference["radiance"]), 18)
            self.assertEqual(len(reference["standard_error"]), 18)
            self.assertEqual(len(spectral["radiance"]), 18)
            self.assertIn(spectral["verdict"], ["good", "mean", "noisy", "bad"])
            self.assertGreaterEqual(spectral["largest"], 0.0)
        counted = [found["spectral"][word] for word in ["good", "mean_only", "noisy", "bad"]]
        self.assertEqual(sum(counted), 9)
        # Thin air by day: what is computed exactly and what is traced agree.
        noon = scene["views"][0]
        for exact, traced in zip(noon["models"]["spectral"]["radiance"], noon["reference"]["radiance"]):
            self.assertAlmostEqual(exact / traced, 1.0, delta=0.2)

    def test_page(self):
        # A name that could break the page.
        scene = dict(json.loads(self.scene.read_text()), name="<b>&\"Thin")
        self.scene = self.write_scene(scene, "odd.json")
        done = self.validate("--html", "report.html")
        self.assertIn("spectral: 9 views", done.stdout)
        text = (self.work / "report.html").read_text()
        self.assertTrue(text.startswith("<!DOCTYPE html>"))
        page = Page(text)
        words = "".join(page.text)
        for word in ["What the numbers mean", "When the spectral model passes", "All scenes", "path tracer", "<b>&\"Thin", "sun 6° below the horizon"]:
            self.assertIn(word, words)
        # Nothing is fetched: pictures stand in the page, links stay in it.
        self.assertGreater(len(page.links), 9)
        for link in page.links:
            if link.startswith("#"):
                self.assertIn(link[1:], page.ids)
            else:
                self.assertTrue(link.startswith("data:image/png;base64,"), link[:40])
                picture = base64.b64decode(link.split(",", 1)[1], validate=True)
                self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
                self.assertEqual(picture[-8:-4], b"IEND")
        for word in ["http:", "https:", "url(", "@import", "<script"]:
            self.assertNotIn(word, text)
        self.assertEqual(page.tags.count("svg"), 2 * 9)
        # Each view: four pictures, and a map of each model.
        self.assertEqual(page.tags.count("img"), 7 * 9)
        self.assertLess(len(text), 3000000 * 9 / 75)
        self.assertEqual([path.name for path in self.work.iterdir()], ["report.html"])

    def test_values_have_paths_of_their_own(self):
        """However little time there is, each has those of the first look; the rest goes where it decides most."""
        done = self.run_program("validate", self.scene, "--quick", "--seconds", 3, "--json")
        self.assertIn(done.returncode, [0, 1], done.stderr)
        for view in json.loads(done.stdout)["scenes"][0]["views"]:
            reference = view["reference"]
            self.assertGreaterEqual(min(reference["paths"]), 64)
            floor = 0.01 * sum(reference["radiance"]) / 18
            noise = [error / max(value, floor) for error, value in zip(reference["standard_error"], reference["radiance"])]
            # Each number is printed to six digits, so three may be wrong by 5e-6 of themselves.
            self.assertAlmostEqual(sum(noise) / 18 / reference["noise"], 1.0, delta=2e-5)

    def test_what_is_wrong_is_told(self):
        self.expect_failure(2, ["validate", self.scene, "--paths", "1"], ["--paths"])
        self.expect_failure(2, ["validate", self.scene, "--paths", "5", "--seconds", "5"], ["--seconds"])
        self.expect_failure(1, ["validate", "missing.json"], ["missing.json"])
        self.expect_failure(1, ["validate", self.scene, "--html", "none/report.html"], ["none/report.html"])


if __name__ == "__main__":
    require_gl()
    unittest.main(verbosity=2)
