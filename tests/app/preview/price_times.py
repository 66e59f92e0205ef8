#!/usr/bin/env python3
"""Measures how long the window takes until it knows the prices of a still picture.

    xvfb-run -a price_times.py DIPTYCH [--load N] [--size WxH] [--repeat N] [OPTION OF DIPTYCH]...

It opens the preview, pauses it, subscribes to the prices and prints after how many seconds since the
pause all steps have a time, and all have an error (FLIP), and how much processor time the preview has
used for that. Loads are loops that keep one core busy each. On a machine with other loads, the processor
time tells more than the seconds. With --hidden, it prints instead what share of a processor the preview
uses while its window is hidden.
"""
import argparse
import json
import os
import subprocess
import sys
import time


def known(event, field):
    """Counts the steps with a value of this field, and all steps."""
    steps = [step for setting in event["settings"].values() for step in setting]
    return sum(step.get(field) is not None for step in steps), len(steps)


def processor_seconds(pid):
    """Processor time that a process has used so far."""
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Preview:
    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def send(self, **request):
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()

    def lines(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            line = self.process.stdout.readline()
            if not line:
                sys.exit("the preview ended")
            yield json.loads(line)


def start(options):
    preview = Preview([options.diptych, "--control", "-", "--size", options.size, *options.arguments])
    preview.send(request="get", what="state")  # Is answered when the first picture shows.
    next(line for line in preview.lines(options.seconds) if "ok" in line)
    time.sleep(4)  # The window plays for a while, as it does when somebody pauses or hides it.
    return preview


def measure_hidden(options):
    """The share of a processor that the preview uses while its window is hidden."""
    preview = start(options)
    window = subprocess.check_output(["xdotool", "search", "--onlyvisible", "--name", "^Diptych"], text=True)
    subprocess.check_call(["xdotool", "windowunmap", window.split()[0]])
    time.sleep(2)
    before, begin = processor_seconds(preview.process.pid), time.monotonic()
    time.sleep(20)
    used = processor_seconds(preview.process.pid) - before
    share = used / (time.monotonic() - begin)
    preview.process.kill()
    preview.process.wait()
    return share


def measure(options):
    preview = start(options)
    pid = preview.process.pid
    preview.send(request="subscribe", to=["prices", "times"])
    preview.send(request="pause")
    begin, used = time.monotonic(), processor_seconds(pid)
    done = {}
    for event in preview.lines(options.seconds):
        if event.get("event") != "prices":
            continue
        for field in ("ms", "flip"):
            have, all_steps = known(event, field)
            if field not in done and have >= all_steps - options.missing:
                done[field] = time.monotonic() - begin, processor_seconds(pid) - used
        if len(done) == 2:
            break
    else:
        print({field: known(event, field) for field in ("ms", "flip")}, event.get("progress"))
    preview.send(request="quit")
    preview.process.wait()
    return done


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("diptych")
    parser.add_argument("--load", type=int, default=0)
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=90)
    parser.add_argument("--hidden", action="store_true")
    parser.add_argument("--missing", type=int, default=1,
                        help="steps without a price; 4x AA cannot have groups of 3 samples")
    options, options.arguments = parser.parse_known_args()
    loads = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(options.load)]
    try:
        for _ in range(options.repeat):
            if options.hidden:
                print("hidden: %.2f %% of a processor" % (100 * measure_hidden(options)), flush=True)
                continue
            done = measure(options)
            for field, name in (("ms", "times"), ("flip", "errors")):
                if field in done:
                    print("%s: all known after %.1f s, processor time %.1f s" % (name, *done[field]), flush=True)
                else:
                    print("%s: not all known after %.0f s" % (name, options.seconds), flush=True)
    finally:
        for load in loads:
            load.kill()


if __name__ == "__main__":
    main()
