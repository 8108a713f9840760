#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Has clang read every C file of a build folder, with the build's own options and warnings as errors.

usage: compile_clang.py CLANG BUILD_FOLDER
Nothing is generated. OpenMP is left out, whose headers clang has in a package of its own: so the code
without it is read too. What clang calls a promotion to double, gcc calls passing an argument.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

WITH_VALUE = {"-o", "-MF", "-MQ"}
DROPPED = {"-c", "-MD", "-fopenmp"}
ADDED = ["-fsyntax-only", "-fno-color-diagnostics", "-Werror", "-Wno-unknown-warning-option",
         "-Wno-unknown-pragmas", "-Wno-double-promotion"]


def options_of(entry):
    """The options of a compile command without what names outputs."""
    words = shlex.split(entry["command"])[1:]
    kept = []
    skip = False
    for word in words:
        if skip or word in DROPPED or word.startswith("-fsanitize"):
            skip = False
        elif word in WITH_VALUE:
            skip = True
        elif word != entry["file"]:
            kept.append(word)
    return kept


def read_commands(folder):
    """One entry for each file, however many targets it is part of."""
    entries = json.loads((folder / "compile_commands.json").read_text(encoding="utf-8"))
    return {entry["file"]: entry for entry in entries if entry["file"].endswith(".c")}


def check(clang, folder, entry):
    command = [clang, *options_of(entry), *ADDED, entry["file"]]
    done = subprocess.run(command, cwd=folder, text=True, capture_output=True)
    return "" if done.returncode == 0 else done.stderr or " ".join(command)


def main():
    clang, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    entries = list(read_commands(folder).values())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        problems = [words for words in pool.map(lambda e: check(clang, folder, e), entries) if words]
    print("".join(problems))
    print(f"{len(entries)} files, {len(problems)} with problems")
    sys.exit(1 if problems or not entries else 0)


if __name__ == "__main__":
    main()
