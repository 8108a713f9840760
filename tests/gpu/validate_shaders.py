#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Runs glslangValidator on every built-in pass, as desktop GLSL and as GLSL ES.

A pass that needs defines says in a comment of its own which ones to validate it with, a line for each variant:
    // validate: LAYER_COUNT 3; HAS_WATER 1
A pass without such lines is validated without defines.

usage: validate_shaders.py SHADER_DUMP
Ends with 77 (skipped) where glslangValidator is not installed, unless TRL_REQUIRE_GPU=1.
"""
import os
import re
import shutil
import subprocess
import sys

STAGES = {"vert": ("330", "300"), "frag": ("330", "300"), "tesc": ("400", "320"), "tese": ("400", "320")}
VARIANT = re.compile(r"^// validate:(.*)$", re.MULTILINE)


def find_variants(dump, name):
    """Lists of defines."""
    text = subprocess.run([dump, name, "330"], text=True, capture_output=True).stdout
    lines = [match.split(";") for match in VARIANT.findall(text)]
    return [[define.strip() for define in line if define.strip()] for line in lines] or [[]]


def validate(validator, dump, name, version, defines):
    """The validator's words, empty when it is content."""
    stage = name.rsplit(".", 1)[1]
    source = subprocess.run([dump, name, version, *defines], text=True, capture_output=True)
    if source.returncode != 0:
        return source.stderr
    done = subprocess.run([validator, "--stdin", "-S", stage], input=source.stdout, text=True,
                          capture_output=True)
    if done.returncode == 0:
        return ""
    files = [line for line in source.stdout.splitlines() if line.startswith("// file ")]
    return done.stdout + "\n".join(files) + "\n"


def main():
    validator = shutil.which("glslangValidator")
    if not validator:
        print("glslangValidator is not installed")
        sys.exit(1 if os.environ.get("TRL_REQUIRE_GPU") == "1" else 77)
    dump = sys.argv[1]
    names = subprocess.run([dump], check=True, text=True, capture_output=True).stdout.split()
    passes = [name for name in names if name.rsplit(".", 1)[1] in STAGES]
    problems = []
    for name in passes:
        for defines in find_variants(dump, name):
            for version in STAGES[name.rsplit(".", 1)[1]]:
                words = validate(validator, dump, name, version, defines)
                if words:
                    problems.append(f"{name} as {version} with {defines}:\n{words}")
    print("\n".join(problems))
    print(f"{len(passes)} passes, {len(problems)} problems")
    sys.exit(1 if problems or not passes else 0)


if __name__ == "__main__":
    main()
