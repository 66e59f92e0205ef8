"""Compiles what a build has not built, without making code: check_warnings.py BUILD_FOLDER.

The build's options make warnings errors. Files that the build would generate are left out.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys


def output_of(entry):
    words = shlex.split(entry["command"])
    return pathlib.Path(entry["directory"], words[words.index("-o") + 1])


def check(entry):
    """Returns the compiler's messages; none if the file has no fault."""
    words = shlex.split(entry["command"])
    at = words.index("-o")
    del words[at:at + 2]
    words[words.index("-c")] = "-fsyntax-only"
    done = subprocess.run(words, cwd=entry["directory"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    return done.stdout.decode("utf-8", "replace") or ("failed" if done.returncode else "")


def main():
    build = pathlib.Path(sys.argv[1])
    entries = json.loads((build / "compile_commands.json").read_text("utf-8"))
    rest = [entry for entry in entries
            if os.path.exists(entry["file"]) and not output_of(entry).exists()]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        messages = [message for message in pool.map(check, rest) if message]
    print("".join(messages), end="")
    print(f"{len(rest)} of {len(entries)} files checked, the others are built; "
          f"{len(messages)} with messages")
    sys.exit(bool(messages))


main()
