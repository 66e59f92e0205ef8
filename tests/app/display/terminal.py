#!/usr/bin/env python3
"""Tests the preview in a terminal as a user sees it. The program runs under a pseudo terminal with
real keys and real signals. Whatever ends the program, the terminal must get back its settings, its
screen and its cursor.

Usage: terminal.py DIPTYCH
"""
import fcntl
import os
import pty
import re
import select
import signal
import struct
import sys
import tempfile
import termios
import time

PROGRAM = os.path.abspath(sys.argv[1])
ENTER = b"\x1b[?1049h"
LEAVE = (b"\x1b[?2026l", b"\x1b[?1006l", b"\x1b[?1002l", b"\x1b[?1000l", b"\x1b[0m", b"\x1b[?7h",
         b"\x1b[?25h", b"\x1b[?1049l")
# What the terminal gets back does not depend on the scene. This one loads quickly.
MODEL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../assets/data/square.gltf")
SETTINGS = ["--display", "terminal", "--current", "aa=none", "--requested", "aa=4", "--model", MODEL]


PART = re.compile(r"\x1b\[([<-?]?)([0-9;]*)([@-~])|(.)", re.DOTALL)


class Screen:
    """The characters that the terminal shows, without their colours."""

    def __init__(self):
        self.cells = {}
        self.row = self.column = 0
        self.rest = b""

    def show(self, output):
        """Carries out what the program sent; keeps a part that is not complete yet."""
        output = self.rest + output
        end = output.rfind(b"\x1b")
        cut = end if end >= 0 and not re.match(rb"\x1b\[[0-9;?]*[@-~]", output[end:]) else None
        self.rest = output[cut:] if cut is not None else b""
        for marker, numbers, final, character in PART.findall(
                output[:cut].decode("utf-8", "replace")):
            values = [int(n or 1) for n in numbers.split(";")] if not marker else []
            if character:
                self.cells[self.row, self.column] = character
                self.column += 1
            elif final == "H":
                self.row, self.column = (values + [1])[0] - 1, (values + [1])[1] - 1
            elif final == "C":
                self.column += values[0]
            elif final == "J":
                self.cells.clear()

    def text(self):
        rows = 1 + max((row for row, _ in self.cells), default=0)
        columns = 1 + max((column for _, column in self.cells), default=0)
        return "\n".join("".join(self.cells.get((r, c), " ") for c in range(columns))
                         for r in range(rows))


class Terminal:
    """A pseudo terminal with the program in it."""

    def __init__(self, *arguments, columns=100, rows=30, ignored=(), **variables):
        environment = {k: v for k, v in os.environ.items()
                       if k not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "COLORTERM",
                                    "NO_COLOR", "LC_ALL", "LC_CTYPE")}
        environment.update({"TERM": "xterm-256color", "LANG": "C.UTF-8", **variables})
        self.master, self.slave = pty.openpty()
        self.resize(columns, rows)
        self.before = termios.tcgetattr(self.slave)
        self.output = b""
        self.screen = Screen()
        self.pid = os.fork()
        if self.pid == 0:
            os.setsid()
            fcntl.ioctl(self.slave, termios.TIOCSCTTY, 0)
            for fd in (0, 1, 2):
                os.dup2(self.slave, fd)
            os.close(self.slave)
            os.close(self.master)
            for number in ignored:
                signal.signal(number, signal.SIG_IGN)
            os.execve(PROGRAM, [PROGRAM, *arguments], environment)

    def resize(self, columns, rows):
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def read(self, seconds):
        """Reads for a time. Returns what came."""
        came = b""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            if select.select([self.master], [], [], left)[0]:
                try:
                    came += os.read(self.master, 65536)
                except OSError:
                    break
        self.output += came
        self.screen.show(came)
        return came

    def wait_for_text(self, text, description, seconds=30):
        """Reads until the screen shows a text."""
        end = time.monotonic() + seconds
        while text not in self.screen.text():
            assert time.monotonic() < end, \
                f"never happened: {description}; the screen:\n{self.screen.text()}"
            self.read(0.05)

    def wait_for(self, what, description, seconds=30):
        """Reads until the output since the last call holds `what`, a text or a function."""
        end = time.monotonic() + seconds
        came = b""
        holds = what if callable(what) else lambda text: what in text
        while not holds(came):
            assert time.monotonic() < end, f"never happened: {description}; last: {came[-300:]!r}"
            came += self.read(0.05)
        return came

    def keys(self, text):
        os.write(self.master, text)

    def wait_end(self):
        """Waits until the program ends. Returns its status as waitpid does."""
        end = time.monotonic() + 30
        while time.monotonic() < end:
            self.read(0.05)
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                self.read(0.05)
                return status
        raise AssertionError("the program does not end")

    def close(self):
        os.close(self.master)
        os.close(self.slave)

    def assert_restored(self, what):
        """Checks the settings of the terminal, and the sequences that restore its screen."""
        assert termios.tcgetattr(self.slave) == self.before, f"{what}: settings not restored"
        tail = self.output[self.output.rindex(ENTER):]
        at = 0
        for sequence in LEAVE:
            assert sequence in tail[at:], f"{what}: {sequence!r} is missing: {tail[-200:]!r}"
            at = tail.index(sequence, at)


def started(*arguments, **variables):
    terminal = Terminal(*(arguments or SETTINGS), **variables)
    terminal.wait_for_text("Requested", "the preview shows its labels")
    assert termios.tcgetattr(terminal.slave) != terminal.before
    return terminal


def test_keys_and_still_pictures():
    terminal = started()
    terminal.wait_for("▀".encode(), "half blocks show")
    terminal.keys(b" ")
    terminal.wait_for_text("paused", "Space pauses")
    terminal.read(3.5)  # The notice goes away.
    assert terminal.read(1.0) == b"", "bytes were sent while the picture stood still"
    terminal.keys(b"F")
    terminal.wait_for_text("Anisotropic filtering: 16", "Shift+F goes to the step before")
    terminal.keys(b"\x1b[B")
    terminal.wait_for(b"\x1b[", "the down arrow chooses a setting")
    terminal.keys(b"\x1b[C")
    terminal.wait_for_text("Antialiasing: 6", "the right arrow changes the setting")
    terminal.keys(b"\x1bOP")
    terminal.wait_for_text("Free camera", "F1 shows the keys")
    terminal.read(0.3)  # A key that comes again at once counts as held.
    terminal.keys(b"\x1bOP")
    terminal.read(0.5)
    terminal.keys(b"\x1b")  # Leaves the settings, then quits.
    terminal.read(0.5)
    terminal.keys(b"\x1b")
    assert terminal.wait_end() == 0
    terminal.assert_restored("Escape")
    terminal.close()


def test_mouse():
    terminal = started(columns=160, rows=50)
    terminal.keys(b" ")
    terminal.wait_for_text("paused", "Space pauses")
    lines = terminal.screen.text().split("\n")
    row = next(i for i, line in enumerate(lines) if "6x" in line)
    column = lines[row].index("8x")
    for letter in b"Mm":  # Pressed and released.
        terminal.keys(b"\x1b[<0;%d;%d%c" % (column + 1, row + 1, letter))
    terminal.wait_for_text("Antialiasing: 8", "a click chooses a step")
    terminal.keys(b"\x11")
    assert terminal.wait_end() == 0
    terminal.assert_restored("Ctrl+Q")
    terminal.close()


def test_resize():
    terminal = started()
    for columns, rows in ((120, 40), (20, 3), (1, 1), (300, 90), (80, 24)):
        terminal.read(0.3)
        terminal.screen.cells.clear()
        terminal.resize(columns, rows)
        end = time.monotonic() + 30
        while (rows - 1, columns - 1) not in terminal.screen.cells:
            assert time.monotonic() < end, f"the last of {columns}x{rows} cells is not drawn"
            terminal.read(0.05)
    assert "setting" in terminal.screen.text().split("\n")[23]
    os.kill(terminal.pid, signal.SIGTERM)
    assert terminal.wait_end() == 0
    terminal.assert_restored("SIGTERM")
    terminal.close()


def test_endings():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        terminal = started()
        os.kill(terminal.pid, number)
        assert terminal.wait_end() == 0, f"{number.name} must end the preview as Escape does"
        terminal.assert_restored(number.name)
        terminal.close()
    terminal = started()
    terminal.keys(b"\x03")
    assert terminal.wait_end() == 0
    terminal.assert_restored("Ctrl+C")
    terminal.close()


def test_crashes():
    for number in (signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL,
                   signal.SIGQUIT):
        terminal = started()
        os.kill(terminal.pid, number)
        status = terminal.wait_end()
        # A sanitizer turns the signal into an exit code of its own.
        assert status != 0, number.name
        if not os.environ.get("DIP_SANITIZED"):
            assert os.WIFSIGNALED(status) and os.WTERMSIG(status) == number, number.name
        terminal.assert_restored(number.name)
        terminal.close()


def test_an_ignored_signal_changes_nothing():
    """A program that was started with SIGQUIT or SIGHUP ignored keeps its picture."""
    for number in (signal.SIGQUIT, signal.SIGHUP):
        terminal = started(ignored=[number])
        os.kill(terminal.pid, number)
        came = terminal.read(0.5)
        assert b"\x1b[?1049l" not in came, f"{number.name} restores the terminal"
        terminal.keys(b"\x1b")
        assert terminal.wait_end() == 0
        terminal.assert_restored(f"ignored {number.name}")
        terminal.close()


def test_suspending():
    """Ctrl+Z needs a shell's process group; without one, the kernel ignores the stop. The program
    must then show its picture again."""
    terminal = started()
    os.kill(terminal.pid, signal.SIGTSTP)
    terminal.wait_for(b"\x1b[?1049l", "the screen is restored before the program stops")
    os.kill(terminal.pid, signal.SIGCONT)
    terminal.wait_for(ENTER, "the screen is taken again")
    os.kill(terminal.pid, signal.SIGSTOP)
    termios.tcsetattr(terminal.slave, termios.TCSANOW, terminal.before)
    os.kill(terminal.pid, signal.SIGCONT)
    terminal.wait_for(ENTER, "the screen is taken again after SIGSTOP")
    assert termios.tcgetattr(terminal.slave) != terminal.before
    terminal.keys(b"\x1b")
    assert terminal.wait_end() == 0
    terminal.assert_restored("SIGTSTP and SIGCONT")
    terminal.close()


def test_lost_terminal():
    """The terminal hangs up: the program ends."""
    terminal = started()
    os.close(terminal.master)
    end = time.monotonic() + 20
    while os.waitpid(terminal.pid, os.WNOHANG)[0] == 0:
        assert time.monotonic() < end, "the program outlives its terminal"
        time.sleep(0.05)
    os.close(terminal.slave)


def test_colours():
    cases = (({"COLORTERM": "truecolor"}, b"\x1b[38;2;"), ({}, b"\x1b[38;5;"))
    for variables, expected in cases:
        terminal = started(**variables)
        terminal.wait_for(expected, f"colours with {variables}")
        terminal.keys(b"\x1b")
        assert terminal.wait_end() == 0
        terminal.close()
    for arguments, variables in ((SETTINGS, {"NO_COLOR": "1"}),
                                 (SETTINGS + ["--terminal-colours", "none"], {})):
        terminal = started(*arguments, **variables)
        terminal.read(0.5)
        assert b"\x1b[38;" not in terminal.output and b"\x1b[48;" not in terminal.output
        terminal.output.replace(ENTER, b"").decode("ascii")
        terminal.keys(b"\x1b")
        assert terminal.wait_end() == 0
        terminal.close()


def test_choice_without_a_display():
    """Without a window system, the preview shows in the terminal and says so."""
    terminal = started("--current", "aa=none")
    terminal.wait_for_text("no display to open a window on", "a notice says why")
    terminal.keys(b"\x1b")
    assert terminal.wait_end() == 0
    terminal.close()
    for arguments, variables, expected in (
            (["--display", "window"], {}, b"diptych dump"),
            ([], {"TERM": "dumb"}, b"diptych dump"),
            (["--display", "terminal"], {"TERM": "dumb"}, b"TERM"),
            (["--display", "paper"], {}, b"auto|window|terminal")):
        terminal = Terminal(*arguments, **variables)
        status = terminal.wait_end()
        assert os.WEXITSTATUS(status) == (2 if "paper" in arguments else 1), (arguments, status)
        assert expected in terminal.output, terminal.output
        assert ENTER not in terminal.output
        assert termios.tcgetattr(terminal.slave) == terminal.before
        terminal.close()


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, test in list(globals().items()):
            if name.startswith("test_"):
                test()
                print("passed:", name)


main()
