#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Sums Meson's test logs (testlog.json) into "N passed, N failed, N skipped".

With CI set, skipped tests are failures. Exits with 1 if anything failed or nothing ran.
"""
import json
import os
import sys

PASSED = {"OK", "EXPECTEDFAIL"}
SKIPPED = {"SKIP"}


def read_results(path):
    with open(path, encoding="utf-8") as log:
        for line in log:
            if line.strip():
                entry = json.loads(line)
                yield entry["name"], entry["result"]


def main(paths):
    passed, skipped, failed = [], [], []
    for path in paths:
        folder = path.split("/meson-logs/")[0]
        for name, result in read_results(path):
            group = passed if result in PASSED else skipped if result in SKIPPED else failed
            group.append(f"{folder}: {name}: {result.lower()}")
    if os.environ.get("CI", "") not in ("", "0", "false"):
        failed += [line + " (not allowed in CI)" for line in skipped]
        skipped = []
    for line in failed + skipped:
        print(line)
    print(f"{len(passed)} passed, {len(failed)} failed, {len(skipped)} skipped", flush=True)
    return 0 if passed and not failed else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
