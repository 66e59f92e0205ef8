"""Draws glTF models by Diptych as beside.py and hashes.py compare them: 640x480, the fixed light, and
as three.js computes the light of every sample, a picture of twice the size that is averaged.
"""
import pathlib
import subprocess
import sys
import tempfile

SIZE = (640, 480)
BACKGROUND = (41, 45, 52)
SETTINGS = "scale=2,aa=8,af=16,aaf=on"
INI = """XFILE: {model}
RES: {size[0]}x{size[1]}
BACKGROUND: {background}
LIGHT_SCALE: 0
"""


class Model:
    """A file, and its views: lists of x y z qx qy qz qw fov [seconds], or None."""

    def __init__(self, file, folder):
        self.file = file.resolve()
        name = str(file.relative_to(folder).with_suffix(""))
        self.name = name.replace("/", "_").replace(" ", "_")
        poses = file.with_suffix(".pose")
        self.views = None
        if poses.exists():
            self.views = [[float(v) for v in line.split()] for line in
                          poses.read_text().splitlines()]


def find_models(folder):
    files = [f for kind in ("glb", "gltf") for f in pathlib.Path(folder).rglob(f"*.{kind}")]
    return [Model(f, folder) for f in sorted(files)]


def make_models():
    """The models of make_models.py, in a folder that lives as long as the returned object."""
    folder = tempfile.TemporaryDirectory()
    script = pathlib.Path(__file__).with_name("make_models.py")
    subprocess.run([sys.executable, script, folder.name], check=True)
    return folder


def draw(diptych, model, view, options=()):
    """Returns the hash, Diptych's messages, and the bytes of the RGB picture, without them the
    messages say why."""
    with tempfile.TemporaryDirectory() as folder:
        ini, raw = pathlib.Path(folder) / "view.ini", pathlib.Path(folder) / "picture.rgb"
        ini.write_text(INI.format(model=model.file, size=SIZE,
                                  background=",".join(map(str, BACKGROUND))))
        moment = ["--animation", "none"]
        if len(view) > 8:
            moment = ["--animation-time", repr(view[8])]
        done = subprocess.run(
            [diptych, "dump", "--config", ini, "--hash", "--raw", raw, "--pane", "requested",
             "--current", "aa=none", "--requested", SETTINGS, "--fov", repr(view[7]),
             "--pose", " ".join(map(repr, view[:7])), *moment, *options],
            capture_output=True, text=True, check=False)
        found = [line.split()[2] for line in done.stdout.splitlines() if " requested " in line]
        said = "; ".join(line.replace(f"diptych: {model.file}: ", "")
                         for line in done.stderr.splitlines() if "raw video" not in line)
        if done.returncode or not found:
            return None, said, b""
        return found[0], said, raw.read_bytes()
