"""Keys, mouse buttons and windows of an X display, for random_events.py.

Xlib and its extension XTEST are called directly: a program per key, such as xdotool, would be too
slow.
"""
import collections
import ctypes

CLICKS = {"left": 1, "middle": 2, "right": 3, "wheel up": 4, "wheel down": 5, "wheel left": 6,
          "wheel right": 7, "back": 8, "forward": 9}

# Keys that the preview knows. Escape is missing because it can end the preview. Q is missing because
# it ends the preview together with Control, and a program that had lost the focus meanwhile may hold
# Control for pressed when it no longer is.
KEYS = (list("abcdefghijklmnoprstuvwxyz0123456789") + [f"F{i}" for i in range(1, 13)] +
        """grave Return space period comma apostrophe slash semicolon minus equal bracketleft
        bracketright backslash Left Right Up Down Prior Next Home End Insert Delete Tab BackSpace
        KP_Add KP_Subtract KP_Enter""".split())
FIRST_KEYCODE, LAST_KEYCODE = 8, 255

ERROR_HANDLER = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)


class Input:
    def __init__(self, display):
        self.x = ctypes.CDLL("libX11.so.6")
        self.test = ctypes.CDLL("libXtst.so.6")
        for function in (self.x.XOpenDisplay, self.x.XDefaultRootWindow):
            function.restype = ctypes.c_void_p
        self.x.XStringToKeysym.restype = ctypes.c_ulong
        self.x.XKeysymToKeycode.restype = ctypes.c_ubyte
        # The window may disappear at any time: an error of X is no reason to end.
        self.handler = ERROR_HANDLER(lambda display, error: 0)
        self.x.XSetErrorHandler(self.handler)
        opened = self.x.XOpenDisplay(display.encode())
        if not opened:
            raise OSError(f"cannot open the display {display}")
        self.display = ctypes.c_void_p(opened)
        self.root = ctypes.c_ulong(self.x.XDefaultRootWindow(self.display))
        self.window = ctypes.c_ulong(0)
        self.held_keys = set()
        self.held_buttons = set()
        self.escape = self.keycode("Escape")
        self.newest = collections.deque(maxlen=40)  # The last keys, for a report.
        self.quit = self.keycode("q")

    def keycode(self, name):
        return self.x.XKeysymToKeycode(self.display,
                                       ctypes.c_ulong(self.x.XStringToKeysym(name.encode())))

    def random_keycode(self, random):
        """A key of the preview or, for one press in five, any key but Escape and Q."""
        code = self.keycode(random.choice(KEYS))
        if random.random() < 0.2:
            code = random.randint(FIRST_KEYCODE, LAST_KEYCODE)
        return code if code not in (0, self.escape, self.quit) else self.keycode("space")

    # --- keys and buttons ------------------------------------------------------------------------

    def key(self, code, down):
        self.newest.append(f"{code}{'+' if down else '-'}")
        (self.held_keys.add if down else self.held_keys.discard)(code)
        self.test.XTestFakeKeyEvent(self.display, code, int(down), ctypes.c_ulong(0))
        self.x.XFlush(self.display)

    def press(self, name, *modifiers):
        codes = [self.keycode(key) for key in (*modifiers, name)]
        for code in codes:
            self.test.XTestFakeKeyEvent(self.display, code, 1, ctypes.c_ulong(0))
        for code in reversed(codes):
            self.test.XTestFakeKeyEvent(self.display, code, 0, ctypes.c_ulong(0))
        self.x.XFlush(self.display)

    def button(self, number, down):
        (self.held_buttons.add if down else self.held_buttons.discard)(number)
        self.test.XTestFakeButtonEvent(self.display, number, int(down), ctypes.c_ulong(0))
        self.x.XFlush(self.display)

    def click(self, number):
        self.button(number, True)
        self.button(number, False)

    def move(self, x, y):
        self.test.XTestFakeMotionEvent(self.display, -1, x, y, ctypes.c_ulong(0))
        self.x.XFlush(self.display)

    def release_all(self):
        for code in list(self.held_keys):
            self.key(code, False)
        for number in list(self.held_buttons):
            self.button(number, False)

    # --- the window ------------------------------------------------------------------------------

    def children(self, window):
        root, parent = ctypes.c_ulong(), ctypes.c_ulong()
        found, count = ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        if not self.x.XQueryTree(self.display, window, ctypes.byref(root), ctypes.byref(parent),
                                 ctypes.byref(found), ctypes.byref(count)):
            return []
        windows = [ctypes.c_ulong(found[i]) for i in range(count.value)]
        if found:
            self.x.XFree(found)
        return windows

    def find(self, title):
        """Finds the window with this title, on the whole display. Returns whether it exists."""
        for window in self.children(self.root):
            name = ctypes.c_char_p()
            if self.x.XFetchName(self.display, window, ctypes.byref(name)) and \
                    name.value == title.encode():
                self.window = window
                return True
        return False

    def focus(self):
        self.x.XSetInputFocus(self.display, self.window, 1, ctypes.c_ulong(0))
        self.x.XFlush(self.display)

    def blur(self):
        self.x.XSetInputFocus(self.display, self.root, 1, ctypes.c_ulong(0))
        self.x.XFlush(self.display)

    def resize(self, width, height):
        self.x.XResizeWindow(self.display, self.window, width, height)
        self.x.XMoveWindow(self.display, self.window, 0, 0)
        self.x.XFlush(self.display)

    def expose(self):
        self.x.XClearArea(self.display, self.window, 0, 0, 0, 0, 1)
        self.x.XFlush(self.display)

    def show(self, shown):
        (self.x.XMapWindow if shown else self.x.XUnmapWindow)(self.display, self.window)
        self.x.XFlush(self.display)

    def size(self):
        root = ctypes.c_ulong()
        numbers = [ctypes.c_int(), ctypes.c_int()] + [ctypes.c_uint() for _ in range(4)]
        self.x.XGetGeometry(self.display, self.window, ctypes.byref(root),
                            *(ctypes.byref(number) for number in numbers))
        return numbers[2].value, numbers[3].value
