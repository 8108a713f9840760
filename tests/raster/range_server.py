# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Serves a folder on the loopback, in ranges of bytes as object stores do, and counts what it served.

range_server.py FOLDER: prints its port, then serves until its standard input closes. FOLDER/served holds a line
"BYTES PATH" for every request, whatever became of it. While there is a FOLDER/fault with "KIND BYTE" in it, ranges that
reach beyond that byte are not served: KIND is a status (500), or "stall" to say nothing for ten seconds.
"""
import http.server
import pathlib
import re
import sys
import threading
import time


class RangeHandler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    folder = pathlib.Path(".")
    lock = threading.Lock()

    def count(self, size):
        with self.lock, open(self.folder / "served", "a", encoding="utf-8") as served:
            served.write(f"{size} {self.path}\n")

    def is_at_fault(self, last):
        """Answers in the fault's way and returns true where there is one."""
        try:
            kind, byte = (self.folder / "fault").read_text(encoding="utf-8").split()
        except (OSError, ValueError):
            return False
        if last <= int(byte):
            return False
        self.count(0)
        if kind == "stall":
            time.sleep(10)
            self.close_connection = True
        else:
            self.send_response(int(kind))
            self.send_header("Content-Length", "0")
            self.end_headers()
        return True

    def answer(self, has_body):
        path = self.folder / self.path.lstrip("/")
        if "/" in self.path[1:] or not path.is_file():
            self.count(0)
            self.send_response(404)
            self.send_header("Content-Length", "0")
            self.end_headers()
            return
        size = path.stat().st_size
        wanted = re.fullmatch(r"bytes=(\d+)-(\d*)", self.headers.get("Range", ""))
        first = int(wanted.group(1)) if wanted else 0
        last = min(int(wanted.group(2)) if wanted and wanted.group(2) else size - 1, size - 1)
        if has_body and self.is_at_fault(last):
            return
        self.send_response(206 if wanted else 200)
        if wanted:
            self.send_header("Content-Range", f"bytes {first}-{last}/{size}")
        self.send_header("Accept-Ranges", "bytes")
        self.send_header("Content-Length", str(last - first + 1))
        self.end_headers()
        self.count(last - first + 1 if has_body else 0)
        if has_body:
            with open(path, "rb") as file:
                file.seek(first)
                self.wfile.write(file.read(last - first + 1))

    def do_GET(self):
        self.answer(True)

    def do_HEAD(self):
        self.answer(False)

    def log_message(self, *words):
        pass


def start(folder):
    """A server in threads of this process; its port is server_port, and shutdown() ends it."""
    handler = type("Handler", (RangeHandler,), {"folder": pathlib.Path(folder)})
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


if __name__ == "__main__":
    print(start(sys.argv[1]).server_port, flush=True)
    sys.stdin.read()
