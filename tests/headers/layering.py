#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Fails where a folder includes one that stands below it (docs/internals.md), or an app a private header.

With --self-test, checks the checker against a small tree that breaks each rule once.
"""
import pathlib
import re
import sys
import tempfile

# Lowest first: a folder may include itself and what stands before it. Those in one tuple do not see each other.
LAYERS = [("shared",), ("base",), ("spectrum",), ("scatter",), ("reference",), ("raster",), ("gpu",),
          ("sky", "terrain"), ("ocean", "cloud"), ("scene",), ("frame",), ("api",)]
RANK = {name: rank for rank, names in enumerate(LAYERS) for name in names}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')


def includes(path):
    """(line number, name, whether in angle brackets) of every include."""
    text = path.read_text(encoding="utf-8")
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(2), match.group(1) == "<"


def check_library_file(path, folder):
    """Messages for one file of src/<folder>/."""
    for number, name, _ in includes(path):
        first = name.split("/")[0]
        if first == folder or first == "terrella" or first not in RANK or "/" not in name:
            continue
        if RANK[first] >= RANK[folder]:
            yield f"{path}:{number}: {folder} must not include {name}"


def check_public_file(path):
    """Public headers include each other and the C library only."""
    for number, name, is_angled in includes(path):
        if not is_angled or name.split("/")[0] in RANK:
            yield f"{path}:{number}: a public header must not include {name}"


def check_app_file(path, app):
    """Apps see public headers, their own, and other libraries."""
    for number, name, is_angled in includes(path):
        first = name.split("/")[0]
        if first in RANK and not (path.parent / name).exists() and not (app / name).exists():
            yield f"{path}:{number}: an app must include public headers only, not {name}"
        elif not is_angled and ".." in name:
            yield f"{path}:{number}: {name} leaves the app's folder"


def check_gl(path, folder):
    """GL is called by src/gpu only."""
    for number, name, _ in includes(path):
        if folder != "gpu" and re.match(r"(epoxy|GL|GLES\d?|EGL)/", name):
            yield f"{path}:{number}: {name}: GL belongs to src/gpu"


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".c", ".h", ".cpp", ".hpp"})


def check_tree(root):
    problems = []
    for path in sources(root / "src"):
        folder = path.relative_to(root / "src").parts[0]
        if folder not in RANK:
            problems.append(f"{path}: src/{folder} has no place among the layers")
            continue
        problems += check_library_file(path, folder)
        problems += check_gl(path, folder)
    for path in sources(root / "include"):
        problems += check_public_file(path)
    for path in sources(root / "apps"):
        app = root / "apps" / path.relative_to(root / "apps").parts[0]
        problems += check_app_file(path, app)
    return problems


def self_test():
    wrong = {"src/base/a.c": '#include "scatter/medium.h"\n',
             "src/sky/b.c": '#include "terrain/mesh.h"\n',
             "src/sky/c.c": '#include <epoxy/gl.h>\n',
             "src/nowhere/d.c": "\n",
             "include/terrella/e.h": '#include "base/context.h"\n',
             "apps/cli/f.c": '#include "base/context.h"\n'}
    right = {"src/scatter/g.c": '#include "base/context.h"\n#include "shared/phase.glsl"\n'
                                '#include <terrella/context.h>\n#include "scatter/g.h"\n',
             "src/gpu/h.c": "#include <epoxy/gl.h>\n",
             "apps/cli/i.c": '#include <terrella/terrella.h>\n#include "options.h"\n'}
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**wrong, **right}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        problems = check_tree(root)
        found = {str(pathlib.Path(p.split(":")[0]).relative_to(root)) for p in problems}
    if found != set(wrong):
        sys.exit(f"expected complaints about {sorted(wrong)}, got {sorted(found)}")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    problems = check_tree(pathlib.Path(sys.argv[1]))
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
