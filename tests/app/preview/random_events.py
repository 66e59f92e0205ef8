#!/usr/bin/env python3
"""Sends random events to the preview's window: random_events.py DIPTYCH DROP_FILE COUNTER SOURCES.

Starts `diptych preview` under an X server of its own, and for --seconds sends it keys, mouse
events, new sizes, dropped files, changes of watched files, and good and bad control messages.
Prints a line each minute. Fails if the preview ends by itself, does not reply to a control message
for a minute, or leaves a report of a sanitizer, at its end a report of leaks included; and if
memory, open files or threads grow.

Damaged models make assimp fail in the process in which the preview lets it work. The preview goes
on, so the test counts these reports and goes on too.

DROP_FILE is drop_file.c, COUNTER the library of count_allocated.c, SOURCES the top of the sources.
With --prefer FILE, FILE takes the place of DIPTYCH if it exists.

Memory is compared in one known state, which the test brings about after every --cycle seconds: the
first scene, default settings, a fixed size, and every tool used once and closed.
"""
import argparse
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import time

from random_actions import REST_SIZE, SCREEN, Actions
from random_files import Files
from random_guest import Control, Failure, Guest, Screen
from random_input import Input
from random_requests import TOPICS, Requests

BAR_PX = 32                 # Height of the folded dock.
SILENCE_S = 60.0            # The longest time that a control message may wait for its reply.
ACTIONS_PER_S = 30.0
# What the preview keeps in the known state depends on its past, by bounded amounts: renderers of
# tools keep buffers for the largest scene they drew. So the test compares the least memory of the
# last third of the cycles with the least of the first third. A leak raises both values of a whole
# third; buffers do not. What may still differ are names of dropped files, undo steps, keys of an
# edited path and what the libraries of the window system keep.
MOST_ALLOCATED_MIB = 4.0
# Resident memory includes what the allocator keeps. With AddressSanitizer these are 16 MiB of
# freed blocks in quarantine, as much again in the caches of threads, the stacks of all calls that
# ever allocated, and pages that are only partly free.
MOST_RESIDENT_MIB = 48.0
MOST_FILES = MOST_THREADS = 1


class Session(Actions):
    def __init__(self, options, folder, logs):
        super().__init__(random.Random(options.seed))
        self.options = options
        self.files = Files(folder, options.sources)
        self.rests = []  # Usage in the known state, after each cycle.
        self.cleanup = []
        self.logs = logs
        self.folder = folder

    # --- begin and end -------------------------------------------------------------------------

    def open(self):
        options = self.options
        self.screen = Screen(*SCREEN)
        self.cleanup.append(self.screen.close)
        self.files.measure_report(options.diptych,
                                  Guest.environment(self.logs, options.sources))
        self.guest = Guest(options, ["--config", "scene.ini", "--size", "400x300"], self.folder,
                           self.logs, self.screen.display)
        self.cleanup.append(self.guest.close)
        self.input = Input(self.screen.display)
        self.await_true("a window", lambda: self.input.find("Diptych"))
        self.await_true("a control channel", self.guest.socket_file.exists)
        self.control = Control(self.guest.socket_file)
        self.input.focus()
        reply = self.ask({"request": "get", "what": ["steps", "scenes"]})
        self.requests = Requests(reply["steps"], reply["scenes"])

    def close(self):
        for drop in self.drops:
            drop.kill()
        for undo in reversed(self.cleanup):
            undo()

    def await_true(self, what, test):
        end = time.monotonic() + SILENCE_S
        while not test():
            self.guest.check()
            if time.monotonic() > end:
                raise Failure(f"never came: {what}")
            time.sleep(0.05)

    def ask(self, request):
        """Sends a request and waits for its reply."""
        self.control.send(request, True)
        while self.control.waiting:
            self.control.pump(0.02)
            self.check()
        return self.control.last_reply

    def check(self):
        self.guest.check()
        if self.control.silence() > SILENCE_S:
            line = self.control.waiting[0][3]
            raise Failure(f"no reply to {line[:200]} for {SILENCE_S:.0f} s\n{self.guest.stack()}")

    def quit(self):
        """Ends the preview by Escape, from whatever state it is in."""
        self.input.release_all()
        for _ in range(40):
            self.input.focus()
            self.input.press("Escape")
            code = self.guest.wait_for_end(2.0)
            if code is not None:
                break
        found = self.guest.findings()
        if found:
            raise Failure(f"a sanitizer reports at the end:\n{found}")
        if code != 0:
            raise Failure(f"Escape gives exit code {code}, expected 0: {self.guest.last_words()}")

    # --- the known state -----------------------------------------------------------------------

    def state(self):
        return self.ask({"request": "get", "what": "state"})["state"]

    def press(self, name, *modifiers):
        """Presses a key and waits until a picture shows what it does."""
        self.input.focus()
        self.input.press(name, *modifiers)
        time.sleep(0.1)  # The event takes another way than the request.
        return self.state()

    def is_bare(self):
        return self.state()["height"] == self.input.size()[1]

    def close_tools(self):
        """Closes all tools by Escape. Escape would quit if no tool showed, so the mode without
        panels comes first: Escape leaves it last, together with the other tools.
        """
        self.press_until("slash", self.is_bare)
        self.press_until("Escape", lambda: not self.is_bare())

    def press_until(self, name, test, *modifiers):
        for _ in range(20):
            if test():
                return
            self.press(name, *modifiers)
        raise Failure(f"the key {name} does not do what it should")

    def dock_is_open(self):
        return self.state()["height"] < REST_SIZE[1] - BAR_PX

    def takes_rest_size(self, within_s):
        """Asks for the size until the window has it. A slow scene needs seconds to follow, and a
        window that leaves full screen takes its former size at first.
        """
        end = time.monotonic() + within_s
        while time.monotonic() < end:
            self.input.resize(*REST_SIZE)
            time.sleep(0.3)
            state = self.state()
            if self.input.size() == REST_SIZE and state["width"] <= REST_SIZE[0] and \
                    state["height"] <= REST_SIZE[1]:
                return True
        return False

    def rest_window(self):
        """Gives the window its size. SDL keeps the screen's size for a window that is full screen,
        whatever size another program gives it.
        """
        self.input.show(True)
        for _ in range(12):
            self.input.focus()
            if self.takes_rest_size(within_s=4.0):
                return
            self.press("F11")
        raise Failure(f"the window does not get the size {REST_SIZE}")

    def open_first_scene(self):
        """Drops the first ini and waits until it shows. Its notice comes after those of others."""
        self.files.restore()
        self.ask({"request": "scene", "name": "models"})
        self.ask({"request": "subscribe", "to": "notices"})
        shutil.copy(self.files.folder / "scene.ini", self.files.folder / "rest.ini")
        for _ in range(6):
            self.control.notice = ""
            self.drop(self.files.folder / "rest.ini")
            end = time.monotonic() + 20.0
            while time.monotonic() < end:
                self.control.pump(0.05)
                self.state()
                if self.control.notice == "Opened rest.ini":
                    self.ask({"request": "unsubscribe", "to": TOPICS})
                    return
        raise Failure("the first scene does not open")

    def tour(self):
        """Opens every tool once, so that each has the memory that it keeps after it was closed."""
        for name in ["j"] * 7 + ["n"] * 7 + ["z", "z", "r", "k", "y", "y", "u", "u", "F1", "F1"]:
            self.press(name)
        for _ in range(2):
            self.press("p", "Control_L")
        self.close_tools()

    def rest(self):
        """Brings about the known state and notes the memory."""
        self.run_schedule(until_empty=True)
        self.input.release_all()
        for drop in self.drops:
            drop.wait()
        while self.control.waiting:
            self.control.pump(0.05)
            self.check()
        self.rest_window()
        self.open_first_scene()
        for _ in range(14):
            self.input.press("minus", "Control_L")
        self.press("equal", "Control_L")
        self.close_tools()
        self.tour()
        self.press("p", "Control_L")
        self.press_until("p", self.dock_is_open, "Control_L")
        self.open_first_scene()  # Ends what the tools do in the background.
        self.ask({"request": "set", "pane": ["current", "requested"], "settings": "aa=none"})
        self.ask({"request": "pause"})
        self.ask({"request": "seek", "time_s": 0})
        self.input.move(5, 5)
        self.files.tidy()
        self.rests.append(self.quiet_usage())
        print("known state: " + self.usage_text(self.rests[-1]), flush=True)
        self.ask({"request": "play"})

    def quiet_usage(self):
        """The least memory of five seconds, in which nothing happens."""
        time.sleep(3.0)
        usages = []
        for _ in range(10):
            time.sleep(0.5)
            self.state()
            usages.append(self.guest.usage())
        return {key: min(usage[key] for usage in usages) for key in usages[0]}

    # --- the run -------------------------------------------------------------------------------

    @staticmethod
    def usage_text(usage):
        return (f"resident {usage['resident']:.1f} MiB, allocated {usage['allocated']:.2f} MiB, "
                f"{usage['files']} open files, {usage['threads']} threads")

    def report(self, begin):
        kinds = ", ".join(f"{kind} {self.counts[kind]}" for kind in self.WEIGHTS)
        print(f"{time.monotonic() - begin:.0f} s: {kinds}; replies {self.control.replies} "
              f"({self.control.refused} refused), events {self.control.events}; "
              f"{self.usage_text(self.guest.usage())}; "
              f"{len(self.guest.faults_of_assimp)} faults of assimp", flush=True)

    def run_cycle(self, begin, seconds):
        end = time.monotonic() + seconds
        next_act = next_tidy = time.monotonic()
        while time.monotonic() < end:
            self.run_schedule()
            if time.monotonic() >= next_act:
                self.act()
                next_act = max(next_act + 1.0 / ACTIONS_PER_S, time.monotonic() - 0.5)
            if time.monotonic() >= next_tidy:
                self.files.tidy()
                self.input.focus()
                next_tidy = time.monotonic() + 5.0
            if time.monotonic() >= self.next_report:
                self.report(begin)
                self.next_report += 60.0
            self.check()
            self.control.pump(max(0.0, min(0.01, next_act - time.monotonic())))

    def run(self):
        begin = time.monotonic()
        self.next_report = begin + 60.0
        end = begin + self.options.seconds
        while time.monotonic() < end:
            self.run_cycle(begin, min(self.options.cycle, end - time.monotonic()))
            self.rest()
        self.report(begin)
        self.quit()
        self.judge()

    def judge(self):
        """Compares the least usage of the last third of the cycles with that of the first third."""
        third = len(self.rests) // 3
        if third < 2:
            print(f"{len(self.rests)} cycles are too few to judge whether memory is flat")
            return
        limits = {"resident": MOST_RESIDENT_MIB, "allocated": MOST_ALLOCATED_MIB,
                  "files": MOST_FILES, "threads": MOST_THREADS}
        for what, most in limits.items():
            first = min(usage[what] for usage in self.rests[:third])
            last = min(usage[what] for usage in self.rests[-third:])
            print(f"{what}: least {first:.2f} in the first third, {last:.2f} in the last")
            if last - first > most:
                raise Failure(f"{what}: {last - first:.2f} more in the last third of "
                              f"{len(self.rests)} cycles than in the first, accepted {most}")


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("diptych", "drop_file", "counter", "sources"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--prefer", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--cycle", type=float, default=300.0)
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 31))
    options = parser.parse_args()
    if options.prefer and options.prefer.exists():
        options.diptych = options.prefer
    for name in ("diptych", "drop_file", "counter", "sources"):
        setattr(options, name, getattr(options, name).resolve())
    return options


def main():
    options = parse_options()
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(1))  # Ends the children, too.
    print(f"{options.diptych}, seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory() as work, tempfile.TemporaryDirectory() as logs:
        session = Session(options, work, logs)
        try:
            session.open()
            session.run()
        except Failure as failure:
            print(f"FAILED: {failure} (seed {options.seed})", flush=True)
            if hasattr(session, "input"):
                print("keycodes pressed (+) and released (-) last: " +
                      " ".join(session.input.newest), flush=True)
            return 1
        finally:
            session.close()
    print(f"random events: {sum(session.counts.values())} actions and {session.control.replies} "
          f"replies in {options.seconds:.0f} s, done", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
