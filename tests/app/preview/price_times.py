#!/usr/bin/env python3
"""Measures how long the window takes until it knows the prices of a still picture.

    xvfb-run -a price_times.py DIPTYCH [--load N] [--size WxH] [--repeat N] [OPTION OF DIPTYCH]...

It opens the preview, pauses it, subscribes to the prices and prints after how many seconds since the
pause all steps have a time, and all have an error (FLIP). Loads are loops that keep one core busy each.
"""
import argparse
import json
import subprocess
import sys
import time


def known(event, field):
    """Counts the steps with a value of this field, and all steps."""
    steps = [step for setting in event["settings"].values() for step in setting]
    return sum(step.get(field) is not None for step in steps), len(steps)


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


def measure(options):
    preview = Preview([options.diptych, "--control", "-", "--size", options.size, *options.arguments])
    time.sleep(4)  # The window plays for a while, as it does when somebody pauses it.
    preview.send(request="subscribe", to=["prices", "times"])
    preview.send(request="pause")
    begin = time.monotonic()
    done = {}
    for event in preview.lines(options.seconds):
        if event.get("event") != "prices":
            continue
        for field in ("ms", "flip"):
            have, all_steps = known(event, field)
            if field not in done and have >= all_steps - options.missing:
                done[field] = time.monotonic() - begin
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
    parser.add_argument("--missing", type=int, default=1,
                        help="steps without a price; 4x AA cannot have groups of 3 samples")
    options, options.arguments = parser.parse_known_args()
    loads = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(options.load)]
    try:
        for _ in range(options.repeat):
            done = measure(options)
            print("times %.1f s, errors %.1f s" % (done.get("ms", -1), done.get("flip", -1)), flush=True)
    finally:
        for load in loads:
            load.kill()


if __name__ == "__main__":
    main()
