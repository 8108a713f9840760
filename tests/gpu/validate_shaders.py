#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Runs glslangValidator on every built-in pass, as desktop GLSL and as GLSL ES, without any define.

usage: validate_shaders.py SHADER_DUMP
Ends with 77 (skipped) where glslangValidator is not installed, unless TRL_REQUIRE_GPU=1.
"""
import os
import shutil
import subprocess
import sys

STAGES = {"vert": ("330", "300"), "frag": ("330", "300"), "tesc": ("400", "320"), "tese": ("400", "320")}


def validate(validator, dump, name, version):
    """The validator's words, empty when it is content."""
    stage = name.rsplit(".", 1)[1]
    source = subprocess.run([dump, name, version], text=True, capture_output=True)
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
        for version in STAGES[name.rsplit(".", 1)[1]]:
            words = validate(validator, dump, name, version)
            if words:
                problems.append(f"{name} as {version}:\n{words}")
    print("\n".join(problems))
    print(f"{len(passes)} passes, {len(problems)} problems")
    sys.exit(1 if problems or not passes else 0)


if __name__ == "__main__":
    main()
