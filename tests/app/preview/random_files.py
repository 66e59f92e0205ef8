"""Files to drop onto the preview and to write over those it watches, for random_events.py."""
import os
import pathlib
import shutil
import subprocess

WALL = """mtllib wall.mtl
v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
vn 0 0 1
usemtl paint
f 1/1/1 2/2/1 3/3/1 4/4/1
"""
PAINT = "newmtl paint\nKd 1 1 1\nmap_Kd wall.ppm\n"
STILL = "diptych-path 1\nperiod 1\n0 0 3 0 0 0 1\n"
MOVING = "diptych-path 1\nperiod 4\n0 0 3 0 0 0 1\n1 0 3 0 0.1 0 1\n1 1 4 0.1 0 0 1\n"
INI = """RES: 400x300
XFILE: wall.obj
CAMPATH_DEFAULT: moving.pth
CAMPATH_AA: still.pth
CAMPATH_AF: moving.pth
CAMPATH_DEFAULT_FOV: 60
MIPDEBUG512: wall.ppm
THREADS: 2
"""


def picture(red, green, blue, width=8):
    return f"P6\n{width} {width}\n255\n".encode() + bytes([red, green, blue]) * (width * width)


# Files that the preview watches, each with good contents.
WATCHED = {
    "scene.ini": [INI.encode(), INI.replace("FOV: 60", "FOV: 90").encode(),
                  (INI + "REQUESTED: aa=8,af=16\nCURRENT: aa=2\nSKY_OVERCAST: 1\n").encode()],
    "wall.obj": [WALL.encode(), WALL.replace("v 2 2 0", "v 3 3 1").encode()],
    "wall.mtl": [PAINT.encode(), PAINT.replace("Kd 1 1 1", "Kd 1 0 0").encode()],
    "wall.ppm": [picture(200, 40, 40), picture(40, 200, 40), picture(1, 2, 3, 300)],
    "still.pth": [STILL.encode(), STILL.replace("3 0", "5 0").encode()],
    "moving.pth": [MOVING.encode(), STILL.encode()],
}
BAD = {
    "empty.obj": b"", "bad.obj": b"v 0 0 0\nf 1 2 3\n", "bad.pth": b"nonsense\n",
    "nan.pth": b"diptych-path 1\nperiod 1\n0 0 nan 0 0 0 1\n", "bad.bth": b"\x89 no path",
    "bad.ini": b"RES: 0x0\nNONSENSE\n", "cut.json": b'{"header":', "text.txt": b"Dear reader,\n",
    "no_ending": b"\x00\x01", "bad.png": b"\x89PNG\r\n\x1a\n no picture",
}
MISSING = ["none.obj", "none.ini", "none.pth", "none.json", "none.png", "none"]


def damage(random, data):
    """Changes bytes of a file's contents, or cuts it off."""
    data = bytearray(data)
    for _ in range(random.randint(1, 6)):
        if data:
            data[random.randrange(len(data))] = random.choice(
                [random.randrange(256), *b"0123456789.-:\n {}"])
    return bytes(data[:random.randrange(len(data) + 1)] if random.random() < 0.3 else data)


class Files:
    def __init__(self, folder, sources):
        self.folder = pathlib.Path(folder)
        self.sources = pathlib.Path(sources)
        self.restore()
        for name, contents in BAD.items():
            (self.folder / name).write_bytes(contents)
        (self.folder / "noise.glb").write_bytes(os.urandom(65536))
        (self.folder / "folder.obj").mkdir()
        (self.folder / "folder").mkdir()
        os.mkfifo(self.folder / "pipe.obj")
        os.mkfifo(self.folder / "pipe.ini")
        data = self.sources / "tests/assets/data"
        self.models = sorted(path for path in data.iterdir() if path.is_file())
        self.models += sorted((data / "pictures").glob("*"))[:20]
        self.models += [self.sources / "assets/gallery" / name for name in
                        ("pump.glb", "crab.md2", "penguin.md2", "tiles.dds")]
        self.saved_files = set(path.name for path in self.folder.iterdir())

    def measure_report(self, diptych, environment):
        """Writes cost.json, a report of the watched scene."""
        subprocess.run([diptych, "cost", "--config", self.folder / "scene.ini", "--size", "32x24",
                        "--places", "2", "--samples", "4", "--starts", "1", "--rounds", "3", "--timed", "2",
                        "--combine", "aa,af", "--out", self.folder / "report"],
                       check=True, capture_output=True, env=environment)
        shutil.copy(self.folder / "report/cost.json", self.folder / "cost.json")
        shutil.rmtree(self.folder / "report")
        self.saved_files.add("cost.json")

    def restore(self):
        """Gives every watched file its first contents."""
        for name, contents in WATCHED.items():
            self.write(name, contents[0])

    def write(self, name, contents):
        """Replaces a file at once, whatever it is now."""
        path = self.folder / name
        if path.is_dir() and not path.is_symlink():
            path.rmdir()
        new = self.folder / f".{name}.new"
        new.write_bytes(contents)
        new.replace(path)

    def rewrite(self, random):
        """Writes good or bad contents over a watched file, or takes the file away. Returns what is
        to be appended later, as a function, or None.
        """
        name = random.choice(list(WATCHED))
        path = self.folder / name
        contents = random.choice(WATCHED[name])
        kind = random.choice(["good"] * 4 + ["damaged"] * 3 + ["empty", "gone", "folder", "slow"])
        if kind == "damaged":
            contents = damage(random, contents)
        half = {"empty": 0, "slow": len(contents) // 2}.get(kind, len(contents))
        self.write(name, contents[:half])
        if kind in ("gone", "folder"):
            path.unlink()
        if kind == "folder":
            path.mkdir()
        return (lambda: self.append(path, contents[half:])) if kind == "slow" else None

    def append(self, path, contents):
        if path.is_file():
            with path.open("ab") as file:
                file.write(contents)

    def to_drop(self, random):
        """The path of a file to drop; every second one is a scene that is not bad."""
        own = ["scene.ini", "scene.ini", "wall.obj", "still.pth", "moving.pth", "cost.json"]
        choice = random.random()
        if choice < 0.4:
            return self.folder / random.choice(own)
        if choice < 0.5:
            return self.sources / "config/courtyard.ini"
        if choice < 0.75:
            return random.choice(self.models)
        if choice < 0.85:
            path = self.folder / "damaged.gltf"
            source = self.sources / "tests/assets/data/square.gltf"
            path.write_bytes(damage(random, source.read_bytes()))
            return path
        return self.folder / random.choice([*BAD, *MISSING, "noise.glb", "folder.obj", "folder",
                                            "pipe.obj", "pipe.ini", "wall.ppm", "wall.mtl"])

    def tidy(self):
        """Deletes what the preview has saved: screenshots, poses and paths."""
        for path in self.folder.iterdir():
            known = path.name in self.saved_files or path.name in WATCHED
            if not known and path.is_file() and path.name not in ("damaged.gltf", "log.txt"):
                path.unlink(missing_ok=True)
