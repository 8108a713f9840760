#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""From a catalogue of stars as its package has it (GeoJSON) to the table that scenes name, brightest first.

stars.py SOURCE.json OUT.csv
"""
import json
import pathlib
import sys

HEADER = "right_ascension_deg,declination_deg,magnitude,colour_index"
UNKNOWN_COLOUR = 0.65  # B-V of the Sun, for the few stars without one


def read_stars(path):
    """(magnitude, right ascension, declination, B-V) of each star, the angles in degrees."""
    for feature in json.loads(path.read_text(encoding="utf-8"))["features"]:
        right_ascension_deg, declination_deg = feature["geometry"]["coordinates"]
        colour = feature["properties"]["bv"]
        yield (float(feature["properties"]["mag"]), right_ascension_deg % 360, declination_deg,
               float(colour) if colour else UNKNOWN_COLOUR)


def main():
    source, out = (pathlib.Path(word) for word in sys.argv[1:])
    lines = [f"{ra:.4f},{dec:.4f},{magnitude:.2f},{colour:.3f}"
             for magnitude, ra, dec, colour in sorted(read_stars(source))]
    part = out.with_suffix(".part")
    part.write_text("\n".join(["# J2000, magnitude V, colour index B-V", HEADER, *lines, ""]), encoding="utf-8")
    part.replace(out)


main()
