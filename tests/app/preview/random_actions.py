"""Random actions of a user and of other programs, for random_events.py."""
import collections
import heapq
import socket
import subprocess
import time

from random_input import CLICKS
from random_requests import BAD

SCREEN = (900, 600)     # Small, because a frame with 8 samples is slow with AddressSanitizer.
REST_SIZE = (660, 400)  # The least size at which the dock lies below the panes, and a bit.
MOST_WAITING = 12       # Control messages without a reply. More would only measure the queue.
SIZES = [(386, 220), (402, 260), (640, 400), (800, 300), (200, 150), (1, 1), (900, 30), (30, 600),
         SCREEN, REST_SIZE]
MODIFIERS = [()] * 11 + [("Shift_L",)] * 3 + [("Control_L",)] * 4 + [
    ("Alt_L",), ("Control_L", "Shift_L"), ("Super_L",), ("Shift_R",)]


class Actions:
    """Needs the attributes options, input, files, control, requests, screen and guest."""

    def __init__(self, generator):
        self.random = generator
        self.counts = collections.Counter()
        self.schedule = []  # (when, number, function): what is to be done later
        self.scheduled = 0
        self.drops = []     # Running programs that drop a file.

    def later(self, seconds, function, *arguments):
        self.scheduled += 1
        heapq.heappush(self.schedule, (time.monotonic() + seconds, self.scheduled,
                                       lambda: function(*arguments)))

    def act_key(self):
        modifiers = [self.input.keycode(name) for name in self.random.choice(MODIFIERS)]
        code = self.input.random_keycode(self.random)
        for key in (*modifiers, code):
            self.input.key(key, True)
        hold = self.random.choice([0.0, 0.0, 0.05, self.random.uniform(0.1, 1.5)])
        for key in (code, *modifiers):
            self.later(hold, self.input.key, key, False)

    def point(self):
        width, height = self.input.size()
        return self.random.randint(-5, width + 5), self.random.randint(-5, height + 5)

    def act_move(self):
        self.input.move(*self.point())

    def act_click(self):
        button = self.random.choice([1] * 8 + list(CLICKS.values()))
        self.input.move(*self.point())
        for i in range(self.random.choice([1, 1, 1, 2, 3])):
            self.later(0.06 * i, self.input.click, button)

    def act_wheel(self):
        button = self.random.randint(CLICKS["wheel up"], CLICKS["wheel right"])
        for i in range(self.random.randint(1, 5)):
            self.later(0.02 * i, self.input.click, button)

    def act_drag(self):
        button = self.random.choice([1, 1, 2, 3])
        self.input.move(*self.point())
        self.input.button(button, True)
        steps = self.random.randint(1, 12)
        for i in range(steps):
            self.later(0.03 * i, self.input.move, *self.point())
        self.later(0.03 * steps, self.input.button, button, False)

    def act_resize(self):
        size = self.random.choice(SIZES + [None] * 4)
        self.input.resize(*(size or (self.random.randint(1, SCREEN[0]),
                                     self.random.randint(1, SCREEN[1]))))

    def act_window(self):
        """Loses the focus, the picture or the window for a moment."""
        kind = self.random.choice(["blur", "expose", "hide"])
        if kind == "expose":
            self.input.expose()
        elif kind == "blur":
            self.input.blur()
        else:
            self.input.show(False)
            self.later(0.5, self.input.show, True)
        self.later(0.7, self.input.focus)

    def drop(self, path, *arguments):
        self.drops.append(subprocess.Popen(
            [self.options.drop_file, str(self.input.window.value), str(path), *arguments],
            env={"DISPLAY": self.screen.display}, stderr=subprocess.DEVNULL))

    def act_drop(self):
        self.drops = [drop for drop in self.drops if drop.poll() is None]
        if len(self.drops) < 3:
            dies = self.random.random() < 0.1
            moment = self.random.choice(["enter", "status", "drop", "request"])
            self.drop(self.files.to_drop(self.random), *(["--die", moment] if dies else []))

    def act_file(self):
        rest = self.files.rewrite(self.random)
        if rest:
            self.later(self.random.uniform(0.0, 1.5), rest)

    def act_message(self):
        if len(self.control.waiting) < MOST_WAITING:
            self.requests.send(self.control, self.random)

    def act_rude(self):
        """Another client writes whole and half lines, reads nothing, and goes away."""
        client = socket.socket(socket.AF_UNIX)
        client.setblocking(False)
        data = b'{"request":"subscribe","to":["times","polls","errors"]}\n'
        for _ in range(self.random.randint(0, 40)):
            data += self.random.choice([*BAD, b'{"request":"get"}']) + b"\n"
        try:
            client.connect(str(self.guest.socket_file))
            client.send(data[:self.random.randint(0, len(data))])
        except OSError:
            pass  # Too many clients wait, or one line is longer than the buffer.
        self.later(self.random.uniform(0.0, 20.0), client.close)

    # Kinds of actions by how often they come.
    WEIGHTS = {"key": 40, "move": 12, "click": 14, "wheel": 5, "drag": 5, "message": 14,
               "resize": 1.2, "window": 0.4, "drop": 1.0, "file": 1.5, "rude": 0.4}

    def act(self):
        kind = self.random.choices(list(self.WEIGHTS), self.WEIGHTS.values())[0]
        self.counts[kind] += 1
        getattr(self, f"act_{kind}")()

    def run_schedule(self, until_empty=False):
        while self.schedule and (until_empty or self.schedule[0][0] <= time.monotonic()):
            when, _, function = self.schedule[0]
            self.control.pump(max(0.0, when - time.monotonic()))
            heapq.heappop(self.schedule)
            function()
