#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""The library as others use it: installed into a folder, found by pkg-config, linked and run.

usage: install_test.py BUILD_FOLDER CC
"""
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

CONSUMER = r"""
#include <stdio.h>
#include <terrella/terrella.h>
int main(void)
{
    trl_context_desc desc = trl_context_desc_default();
    trl_context *ctx = NULL;
    const trl_result result = trl_context_create(&desc, &ctx);
    printf("%s %s\n", trl_version(), trl_result_name(result));
    trl_context_destroy(&ctx);
    return result == TRL_OK ? 0 : 1;
}
"""


def run(command, **more):
    done = subprocess.run(command, text=True, capture_output=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def find_one(root, name):
    found = sorted(root.rglob(name))
    if not found:
        sys.exit(f"{name} was not installed")
    return found[0]


def ask_pkg_config(root, *words):
    environment = dict(os.environ, PKG_CONFIG_SYSROOT_DIR=str(root),
                       PKG_CONFIG_PATH=str(find_one(root, "terrella.pc").parent))
    return run(["pkg-config", *words, "terrella"], env=environment)


def main():
    build, compiler = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder) / "root"
        run(["meson", "install", "-C", build, "--no-rebuild", "--destdir", str(root)])
        find_one(root, "earth.json")
        source = pathlib.Path(folder) / "consumer.c"
        source.write_text(CONSUMER, encoding="utf-8")
        program = source.with_suffix("")
        flags = shlex.split(ask_pkg_config(root, "--cflags", "--libs"))
        run([compiler, "-std=c11", "-Wall", "-Wextra", "-Werror", str(source), "-o", str(program), *flags])
        libraries = dict(os.environ, LD_LIBRARY_PATH=str(find_one(root, "libterrella.so.0").parent))
        version = ask_pkg_config(root, "--modversion").strip()
        said = run([str(program)], env=libraries).strip()
        if said != f"{version} ok":
            sys.exit(f"pkg-config says {version}, the program {said}")
        said = run([str(find_one(root, "bin/terrella")), "--version"]).strip()
        if version not in said:
            sys.exit(f"the installed program says {said}, not {version}")


if __name__ == "__main__":
    main()
