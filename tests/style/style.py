#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""What all files of the tree have in common, each point a test of its own.

usage: style.py POINT ROOT, or style.py --self-test
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

C_FAMILY = {".c", ".h", ".cpp", ".glsl", ".vert", ".frag", ".tesc", ".tese"}
WITH_HEAD = C_FAMILY | {".py", ".sh"}
TEXT = WITH_HEAD | {".md", ".txt", ".json", ".build", ".map", ""}
MAX_COLUMNS = 100
MAX_BYTES = 1_000_000
# Of the person who wrote a file, or of where the project is built: neither belongs into the tree. The brackets
# keep this file from finding itself.
FOREIGN = re.compile(r"(?<![\w.}])/(?:wor[k]|roo[t]|mn[t])/\w|/hom[e]/\w+/"
                     r"|https?://[\w.-]*(?:artifactor[y]|nexu[s]|devp[i]|\.interna[l]|\.loca[l]|\.cor[p])\b"
                     r"|https?://(?:\d+\.){3}\d+")
SUBJECT = re.compile(r"^[a-z0-9][a-z0-9_/-]*(?:, [a-z0-9][a-z0-9_/-]*)*: [^A-Z\s].*[^.\s]$")


def run_git(root, *words):
    """Lines of what git says; None where this is no clone. A clone of another user's is fine."""
    if not (root / ".git").exists() or not shutil.which("git"):
        return None
    command = ["git", "-c", "safe.directory=*", "-C", str(root), *words]
    return subprocess.run(command, check=True, text=True, capture_output=True).stdout.splitlines()


def list_files(root):
    """Everything that is or could be committed."""
    names = run_git(root, "ls-files", "--cached", "--others", "--exclude-standard")
    if names is None:
        paths = (path for path in root.rglob("*") if path.is_file())
        return sorted(path for path in paths
                      if path.relative_to(root).parts[0] not in {"build", "demo", ".git"})
    return [root / name for name in sorted(set(names)) if (root / name).is_file()]


def read_lines(root, suffixes):
    """(path, number, line) of all files with these suffixes."""
    for path in list_files(root):
        if path.suffix in suffixes:
            for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").split("\n"), 1):
                yield path, number, line


def check_heads(root):
    """Each source file begins with its licence, after `#!` if there is one."""
    for path in list_files(root):
        if path.suffix not in WITH_HEAD:
            continue
        lines = path.read_text(encoding="utf-8").split("\n")
        at = 1 if lines[0].startswith("#!") else 0
        head = [line.lstrip("/# ") for line in lines[at:at + 2]]
        if len(head) < 2 or not head[0].startswith("SPDX-FileCopyrightText: ") or \
                head[1] != "SPDX-License-Identifier: MIT":
            yield f"{path}:1: the two SPDX lines are missing"


def check_lines(root):
    """No line of C or GLSL is wider than the formatter's, tabs and trailing spaces are nowhere."""
    for path, number, line in read_lines(root, C_FAMILY):
        if len(line) > MAX_COLUMNS:
            yield f"{path}:{number}: {len(line)} columns, more than {MAX_COLUMNS}"
        if "\t" in line or line != line.rstrip():
            yield f"{path}:{number}: a tab or a space at the end"


def check_sizes(root):
    """Data comes from packages, not from the tree."""
    for path in list_files(root):
        if path.stat().st_size > MAX_BYTES:
            yield f"{path}: {path.stat().st_size} bytes, more than {MAX_BYTES}"


def check_words(root):
    """No folder of somebody's machine, no host that only some can reach."""
    for path, number, line in read_lines(root, TEXT):
        match = FOREIGN.search(line)
        if match:
            yield f"{path}:{number}: {match.group(0)} is the name of a machine's folder or host"


def is_good_subject(subject):
    return len(subject) <= 72 and SUBJECT.match(subject) is not None


def check_commits(root):
    """Subjects of the last commit and of those that are not published yet, which can still be changed."""
    published = run_git(root, "for-each-ref", "--format=%(refname)", "refs/remotes/origin/HEAD") or []
    ranges = [["-1"]] + [[f"{name}..HEAD"] for name in published]
    subjects = {}
    for limits in ranges:
        for line in run_git(root, "log", "--no-merges", "--format=%h %s", *limits) or []:
            name, subject = line.split(" ", 1)
            subjects[name] = subject
    for name, subject in subjects.items():
        if not is_good_subject(subject):
            yield f"{name}: \"{subject}\" is not `area: lower-case subject` of at most 72 characters"


def check_format(root):
    """clang-format would change nothing. Other versions than 14 would: they skip, except in CI."""
    tool = shutil.which("clang-format-14") or shutil.which("clang-format")
    version = subprocess.run([tool, "--version"], text=True, capture_output=True).stdout if tool else ""
    if " version 14." not in version:
        print(f"clang-format 14 is not here: {version or 'none'}")
        sys.exit(1 if os.environ.get("CI") else 77)
    files = [str(path) for path in list_files(root) if path.suffix in C_FAMILY]
    done = subprocess.run([tool, "--style=file", "--dry-run", "-Werror", *files], text=True,
                          capture_output=True)
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if "clang-format-violations" in line]
        yield from lines or [done.stderr]


POINTS = {"heads": check_heads, "lines": check_lines, "sizes": check_sizes, "words": check_words,
          "commits": check_commits, "format": check_format}


def self_test():
    """Each point finds what is wrong in a small tree, and nothing else."""
    head = "// SPDX-FileCopyrightText: 2026 the Terrella authors\n// SPDX-License-Identifier: MIT\n"
    wrong = {"heads": ("a.c", "int a;\n"), "lines": ("b.c", head + "//" + "x" * 99 + "\n"),
             "sizes": ("c.bin", "x" * (MAX_BYTES + 1)), "words": ("d.md", "see /wor" + "k/here\n")}
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "right.c").write_text(head + "//" + "x" * 98 + "\n", encoding="utf-8")
        (root / "right.py").write_text("#!/usr/bin/env python3\n" + head.replace("//", "#"), encoding="utf-8")
        for name, text in wrong.values():
            (root / name).write_text(text, encoding="utf-8")
        for point, (name, _) in wrong.items():
            found = list(POINTS[point](root))
            if len(found) != 1 or name not in found[0]:
                sys.exit(f"{point}: expected a complaint about {name}, got {found}")
    for subject in ["area: what changed", "sky, scatter: a table", "tests/base: x y", "c: 1 thing"]:
        if not is_good_subject(subject):
            sys.exit(f"{subject} should be a good subject")
    for subject in ["What changed", "area: What", "area: changed.", "area:x", "Area: x", "a: " + "x" * 70]:
        if is_good_subject(subject):
            sys.exit(f"{subject} should not be a good subject")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    problems = list(POINTS[sys.argv[1]](pathlib.Path(sys.argv[2])))
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
