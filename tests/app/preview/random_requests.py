"""Random lines for the preview's control channel, for random_events.py."""
import json

TOPICS = ["times", "errors", "settings", "picks", "notices", "polls", "prices"]
PARTS = ["state", "settings", "times", "errors", "paths", "animations", "scenes", "steps", "prices",
         "warnings"]

# Requests without their id; each breaks one rule.
BAD = [
    b"", b"nonsense", b"{}", b"[]", b"null", b'{"request":"set"}', b'{"request":"fly"}',
    b'{"request":null}', b'{"request":"apply","request":"apply"}', b'{"request":"apply"}}',
    b'{"request":"set","pane":"left","change":"aa=4"}', b'{"request":"set","pane":"current"}',
    b'{"request":"set","pane":[],"change":"aa=4"}', b'{"request":"apply","id":1.5}',
    b'{"request":"set","pane":"current","settings":"aa=5"}', b'{"request":"seek","time_s":-1}',
    b'{"request":"seek","time_s":1e999}', b'{"request":"size","width":100}',
    b'{"request":"size","width":1e9,"height":100}', b'{"request":"subscribe","to":"costs"}',
    b'{"request":"get","what":{}}', b'{"request":"path","category":"NONE"}',
    b'{"request":"scene","name":"tour"}', b'{"request":"scene","name":"nowhere"}',
    b'{"request":"screenshot","file":"/nowhere/shot.png"}', b'{"request":"quit","now":true}',
    b'{"request":"\xc3\x28"}', b'{"request":"\\ud800"}', b'{"request":"pause\\u0000"}',
    b'{"request":' + b"[" * 200 + b"]" * 200 + b"}", b'{"request":"' + b"x" * 70000 + b'"}',
    b'{"id":"' + b"y" * 100 + b'","request":"play"}', b'{"request":"pick","x":-1,"y":0}',
]


def list_of(random, names):
    return random.sample(names, random.randint(1, len(names)))


class Requests:
    """Makes requests. steps: the reply to `get` for `steps`; scenes: the scenes' names."""

    def __init__(self, steps, scenes):
        self.steps = {row["key"]: row["steps"] for row in steps}
        self.scenes = scenes
        self.shots = 0

    def settings(self, random):
        keys = random.sample(list(self.steps), random.randint(1, 4))
        return ",".join(f"{key}={random.choice(self.steps[key])}" for key in keys)

    def good(self, random):
        """Returns a request, and True if the preview must accept it, else None."""
        kind = random.choice(["set"] * 6 + ["get"] * 3 + ["pick"] * 3 + ["seek"] * 2 +
                             ["topics"] * 2 + ["play"] * 2 +
                             ["pause", "apply", "path", "animation", "scene", "size", "shot"])
        if kind in ("play", "pause", "apply"):
            return {"request": kind}, True
        return getattr(self, f"make_{kind}")(random)

    def make_set(self, random):
        pane = random.choice(["current", "requested", ["current", "requested"]])
        field = random.choice(["settings", "change"])
        return {"request": "set", "pane": pane, field: self.settings(random)}, None

    def make_get(self, random):
        return random.choice([{"request": "get"},
                              {"request": "get", "what": list_of(random, PARTS)}]), True

    def make_pick(self, random):
        return {"request": "pick", "x": random.randrange(700), "y": random.randrange(600)}, None

    def make_seek(self, random):
        time_s = random.choice([0, random.uniform(0, 10), random.uniform(0, 86400)])
        return {"request": "seek", "time_s": time_s}, True

    def make_topics(self, random):
        request = random.choice(["subscribe", "unsubscribe"])
        return {"request": request, "to": list_of(random, TOPICS)}, True

    def make_path(self, random):
        category = random.choice(["DEFAULT", "AA", "AF", "WATER"])
        return {"request": "path", "category": category}, None

    def make_animation(self, random):
        return {"request": "animation", "name": random.choice(["none", "run"])}, None

    def make_scene(self, random):
        # The models more often than one of twelve scenes: the files belong to them.
        name = random.choice([random.choice(self.scenes), "models"])
        return {"request": "scene", "name": name}, None

    def make_size(self, random):
        # Larger panes, up to 8192 pixels, take minutes to draw under AddressSanitizer.
        largest = random.choice([10, 200, 700, 1200])
        return {"request": "size", "width": random.randint(1, largest),
                "height": random.randint(1, largest)}, True

    def make_shot(self, random):
        self.shots += 1
        return {"request": "screenshot", "file": f"shot-{self.shots}.png"}, None

    def damaged(self, random):
        """A line that was a request. Screenshots would go to files with any name."""
        request = self.good(random)[0]
        if request["request"] == "screenshot":
            request = {"request": "apply"}
        line = bytearray(json.dumps(request).encode())
        for _ in range(random.randint(1, 4)):
            line[random.randrange(len(line))] = random.choice(
                [random.randrange(11, 256), *b"{}[]\",:\\0129eu-"])
        return bytes(line[:random.randrange(len(line) + 1)] if random.random() < 0.25 else line)

    def send(self, control, random):
        kind = random.random()
        if kind < 0.6:
            control.send(*self.good(random))
        elif kind < 0.8:
            control.send_line(random.choice(BAD), None, False)
        else:
            control.send_line(self.damaged(random), None, None)
