# SPDX-FileCopyrightText: 2026 the Terrella authors
# SPDX-License-Identifier: MIT
"""Keys pressed in a window of an X display, through libX11 alone."""

import ctypes
import time

KEY_PRESS, KEY_RELEASE = 2, 3
KEY_MASKS = {KEY_PRESS: 1, KEY_RELEASE: 2}


class KeyEvent(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("root", ctypes.c_ulong),
                ("subwindow", ctypes.c_ulong), ("time", ctypes.c_ulong), ("x", ctypes.c_int), ("y", ctypes.c_int),
                ("x_root", ctypes.c_int), ("y_root", ctypes.c_int), ("state", ctypes.c_uint),
                ("keycode", ctypes.c_uint), ("same_screen", ctypes.c_int), ("more", ctypes.c_long * 24)]


class Keyboard:
    """Of the display's only window with a title."""

    def __init__(self, display):
        self.x11 = ctypes.CDLL("libX11.so.6")
        for name in ["XOpenDisplay", "XDefaultRootWindow", "XStringToKeysym"]:
            getattr(self.x11, name).restype = ctypes.c_void_p if name == "XOpenDisplay" else ctypes.c_ulong
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(display.encode()))
        self.root = self.x11.XDefaultRootWindow(self.display)
        self.time = 0

    def close(self):
        self.x11.XCloseDisplay(self.display)

    def find_window(self):
        """The window and its title; (0, "") when there is none yet."""
        root, parent, children, count = (ctypes.c_ulong(), ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(),
                                         ctypes.c_uint())
        self.x11.XQueryTree(self.display, ctypes.c_ulong(self.root), ctypes.byref(root), ctypes.byref(parent),
                            ctypes.byref(children), ctypes.byref(count))
        for window in children[:count.value]:
            name = ctypes.c_char_p()
            if self.x11.XFetchName(self.display, ctypes.c_ulong(window), ctypes.byref(name)) and name.value:
                return window, name.value.decode()
        return 0, ""

    def wait_for_title(self, is_wanted, seconds=200):
        """The title, when it is one that is wanted; at last the one that there is."""
        end = time.monotonic() + seconds
        title = self.find_window()[1]
        while not is_wanted(title) and time.monotonic() < end:
            time.sleep(0.05)
            title = self.find_window()[1]
        return title

    def send(self, kind, key):
        window = self.find_window()[0]
        self.time += 1  # a time that comes again would be taken for a repeated event
        code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(self.x11.XStringToKeysym(key.encode())))
        event = KeyEvent(type=kind, display=self.display, window=window, root=self.root, time=self.time,
                         keycode=code & 0xff, same_screen=1)
        self.x11.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(KEY_MASKS[kind]),
                            ctypes.byref(event))
        self.x11.XFlush(self.display)

    def press(self, key):
        self.send(KEY_PRESS, key)
        self.send(KEY_RELEASE, key)
