#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Fails unless the shared library exports functions named trl_*, and nothing else.

usage: exports.py NM LIBRARY HEADER...
Every TRL_API function that a header declares must be there too, so that what is promised is also defined.
"""
import re
import subprocess
import sys

DECLARATION = re.compile(r"TRL_API\b[^;(]*?\b(trl_\w+)\s*\(", re.DOTALL)


def exported(nm, library):
    text = subprocess.run([nm, "-D", "--defined-only", library], check=True, text=True,
                          capture_output=True).stdout
    return {line.split()[-1].split("@")[0] for line in text.splitlines()}


def declared(headers):
    names = set()
    for header in headers:
        with open(header, encoding="utf-8") as file:
            names |= set(DECLARATION.findall(file.read()))
    return names


def main():
    nm, library, *headers = sys.argv[1:]
    names = exported(nm, library)
    wanted = declared(headers)
    problems = [f"{name} is exported" for name in sorted(names) if not name.startswith("trl_")]
    problems += [f"{name} is exported but not declared" for name in sorted(names - wanted)
                 if name.startswith("trl_")]
    problems += [f"{name} is declared but not exported" for name in sorted(wanted - names)]
    if not wanted:
        problems.append("no header declares anything: is the pattern right?")
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
