"""The preview under an X server of its own, and its control channel, for random_events.py."""
import collections
import json
import os
import pathlib
import re
import select
import signal
import socket
import subprocess
import time

ASAN_OPTIONS = ("exitcode=99:detect_leaks=1:quarantine_size_mb=16:verify_asan_link_order=0:"
                "handle_abort=1:allocator_release_to_os_interval_ms=1000")
# SDL opens a connection to D-Bus, and that library never frees its list of connections.
FOREIGN_LEAKS = "leak:libdbus-1.so\n"
ASSIMP_LEAKS = "tests/assets/assimp_leaks.txt"
MIB = 1 << 20


FRAME = re.compile(r"^\s*#\d+ 0x[0-9a-f]+ .*$", re.MULTILINE)
OF_SANITIZER = re.compile(r"__interceptor_|libsanitizer|libasan|operator new")


def fault_is_in_assimp(report):
    """Tells whether the code that a report accuses is assimp's."""
    for frame in FRAME.findall(report):
        if not OF_SANITIZER.search(frame):
            return "libassimp.so" in frame
    return False


class Failure(Exception):
    """Ends the test with one line."""


class Screen:
    """An X server without a window manager."""

    def __init__(self, width, height):
        read, write = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-nolisten",
             "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n") and select.select([read], [], [], 60)[0]:
            part = os.read(read, 16)
            if not part:
                break
            number += part
        os.close(read)
        if not number:
            raise Failure("Xvfb does not start")
        self.display = f":{int(number)}"

    def close(self):
        self.process.terminate()
        self.process.wait()


class Guest:
    """The preview. Its reports of sanitizers go into the folder `logs`."""

    def __init__(self, options, arguments, folder, logs, display):
        self.logs = pathlib.Path(logs)
        self.allocated_file = self.logs / "allocated"
        self.socket_file = self.logs / "control"
        self.log = (self.logs / "stderr").open("w")
        self.faults_of_assimp = set()  # Reports about the importing process that are put up with.
        environment = self.environment(self.logs, options.sources)
        environment |= {"DISPLAY": display, "COUNT_ALLOCATED_FILE": str(self.allocated_file),
                        "LD_PRELOAD": str(options.counter)}
        self.process = subprocess.Popen(
            [options.diptych, "preview", "--watch", "--control", self.socket_file, *arguments],
            cwd=folder, env=environment, stderr=self.log, stdout=self.log)

    @staticmethod
    def environment(logs, sources):
        """The environment of programs that may be built with sanitizers."""
        hidden = ("WAYLAND_DISPLAY", "SDL_VIDEODRIVER")
        result = {key: value for key, value in os.environ.items() if key not in hidden}
        report = f"log_path={logs}/sanitizer"
        suppressions = pathlib.Path(logs) / "foreign_leaks"
        suppressions.write_text(FOREIGN_LEAKS + (sources / ASSIMP_LEAKS).read_text())
        return result | {"ASAN_OPTIONS": f"{report}:{ASAN_OPTIONS}",
                         "LSAN_OPTIONS": f"suppressions={suppressions}:print_suppressions=0",
                         "UBSAN_OPTIONS": f"{report}:halt_on_error=1:print_stacktrace=1"}

    def findings(self):
        """Returns the reports of sanitizers. Damaged models make assimp write and read where it
        should not. It therefore works in a process of its own, whose end the preview survives with
        a message. So reports of that process count only if assimp is not to blame.
        """
        found = ""
        for path in sorted(self.logs.glob("sanitizer*")):
            if path in self.faults_of_assimp:
                continue
            process = path.suffix[1:]
            text = path.read_text(errors="replace")
            if process != str(self.process.pid) and fault_is_in_assimp(text):
                self.faults_of_assimp.add(path)
            elif process == str(self.process.pid) or not self.runs(process):
                found += text  # While another process runs, its report may not be whole.
        return found

    @staticmethod
    def runs(process):
        try:
            state = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            return False
        return state != "Z"

    def check(self):
        """Fails if the preview has ended or a sanitizer has reported something."""
        code = self.process.poll()
        if self.findings():
            self.wait_for_end(60)  # The report is whole when the preview has ended.
            raise Failure(f"a sanitizer reports:\n{self.findings()}")
        if code is not None:
            raise Failure(f"the preview has ended with exit code {code}: {self.last_words()}")

    def stack(self):
        """Ends a preview that hangs. Returns where it was, if it has AddressSanitizer."""
        self.process.send_signal(signal.SIGABRT)
        self.wait_for_end(60)
        return self.findings()

    def last_words(self):
        lines = (self.logs / "stderr").read_text(errors="replace").splitlines()
        return " | ".join(lines[-3:])

    def wait_for_end(self, seconds):
        """Returns the exit code, or None if the preview goes on."""
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def usage(self):
        """Returns resident and allocated memory in MiB, open files, and threads."""
        proc = pathlib.Path(f"/proc/{self.process.pid}")
        try:
            status = dict(line.split(":", 1) for line in (proc / "status").read_text().splitlines())
            return {"resident": int(status["VmRSS"].split()[0]) / 1024,
                    "allocated": int(self.allocated_file.read_text()) / MIB,
                    "files": len(list((proc / "fd").iterdir())), "threads": int(status["Threads"])}
        except (OSError, KeyError, ValueError):
            return {"resident": 0.0, "allocated": 0.0, "files": 0, "threads": 0}

    def close(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGKILL)
            self.process.wait()
        self.log.close()


class Control:
    """A client of the control channel that counts and checks replies."""

    def __init__(self, file):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(str(file))
        self.socket.setblocking(False)
        self.unread = b""
        self.unsent = b""
        self.waiting = collections.deque()  # (id, expected, when sent, line) of each request
        self.next_id = 1
        self.replies = self.events = self.refused = 0
        self.replied = 0.0  # When the last reply came.
        self.last_reply = {}
        self.notice = ""

    def send(self, request, expected=None):
        """Sends a request. expected: whether it is to be accepted; None: either will do."""
        line = json.dumps({"id": self.next_id, **request}).encode()
        self.send_line(line, self.next_id, expected)
        self.next_id += 1

    def send_line(self, line, number, expected):
        """Sends a line of any bytes. number: the id that the reply must have; None: any."""
        self.waiting.append((number, expected, time.monotonic(), line))
        self.unsent += line + b"\n"
        self.pump(0.0)

    def pump(self, seconds):
        """Sends and receives for some time."""
        end = time.monotonic() + seconds
        while True:
            left = max(0.0, end - time.monotonic())
            outputs = [self.socket] if self.unsent else []
            readable, writable, _ = select.select([self.socket], outputs, [], left)
            if writable:
                self.unsent = self.unsent[self.write():]
            if readable and not self.read():
                time.sleep(left)  # The preview has closed the connection; Guest.check tells why.
                return
            if time.monotonic() >= end:
                return

    def write(self):
        try:
            return self.socket.send(self.unsent)
        except OSError:
            return 0

    def read(self):
        try:
            data = self.socket.recv(1 << 16)
        except BlockingIOError:
            return True
        except OSError:
            return False
        *lines, self.unread = (self.unread + data).split(b"\n")
        for line in lines:
            self.take(json.loads(line))
        return data != b""

    def take(self, line):
        if "event" in line:
            self.events += 1
            if line["event"] == "notices":
                self.notice = line["text"]
        elif "ok" in line:
            self.take_reply(line)

    def take_reply(self, reply):
        if not self.waiting:
            raise Failure(f"a reply without a request: {reply}")
        number, expected, _, line = self.waiting.popleft()
        self.replies += 1
        self.replied = time.monotonic()
        self.refused += not reply["ok"]
        self.last_reply = reply
        if number is not None and reply["id"] != number:
            raise Failure(f"the reply {reply} answers another line than {line}")
        if expected is not None and reply["ok"] != expected:
            raise Failure(f"the reply to {line} is {reply}")

    def silence(self):
        """Returns for how many seconds requests have waited and no reply has come."""
        if not self.waiting:
            return 0.0
        return time.monotonic() - max(self.waiting[0][2], self.replied)

    def close(self):
        self.socket.close()
