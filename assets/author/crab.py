"""Makes a crab with three sequences of key frames, as an MD2 model with a skin in PCX.

Coordinates are those of MD2: x is forward, y is left, z is up. Front faces wind clockwise.
"""
import math
import struct

import numpy as np
from PIL import Image

SKIN = 128  # texels along a side of the skin
GOLDEN = (1 + math.sqrt(5)) / 2


def normals_of_md2(table):
    """table: the rows of assets/animation/md2_normals.c, p and q of each coordinate p + q * phi."""
    vectors = np.array(table, float).reshape(-1, 3, 2) @ np.array([1, GOLDEN])
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


# --- parts ------------------------------------------------------------------------------------------


class Part:
    """A surface of revolution around a bent axis: rings of points, closed at both ends.

    points(frame state) returns one position for each point; the first and last ring are single
    points. region: left, top, right, bottom of the part's place on the skin, in texels.
    """

    def __init__(self, sides, rings, region):
        self.sides, self.rings, self.region = sides, rings, region

    def topology(self, first_point, first_coordinate):
        """Returns the coordinates (s, t) and the triangles (points, coordinates)."""
        left, top, right, bottom = self.region
        coordinates = []
        for ring in range(self.rings + 2):
            t = top + (bottom - top) * ring / (self.rings + 1)
            for side in range(self.sides + 1):
                s = left + (right - left) * side / self.sides
                coordinates.append((round(s), round(t)))
        triangles = []

        def corner(ring, side):
            if ring == 0:
                point = first_point
            elif ring == self.rings + 1:
                point = first_point + 1 + self.rings * self.sides
            else:
                point = first_point + 1 + (ring - 1) * self.sides + side % self.sides
            return point, first_coordinate + ring * (self.sides + 1) + side

        for ring in range(self.rings + 1):
            for side in range(self.sides):
                a, b = corner(ring, side), corner(ring, side + 1)
                c, d = corner(ring + 1, side + 1), corner(ring + 1, side)
                if ring > 0:
                    triangles.append((a, b, c))
                if ring < self.rings:
                    triangles.append((a, c, d))
        return coordinates, triangles

    def point_count(self):
        return 2 + self.rings * self.sides


def frame_of(direction, up):
    """Two unit vectors across a direction."""
    across = np.cross(up, direction)
    across /= np.linalg.norm(across)
    return across, np.cross(direction, across)


def tube(sides, axis, widths, heights, up):
    """Points around an axis (n + 2 positions): n rings of ellipses between two tips."""
    axis = np.array(axis, float)
    points = [axis[0]]
    for i in range(1, len(axis) - 1):
        direction = axis[i + 1] - axis[i - 1]
        across, above = frame_of(direction / np.linalg.norm(direction), np.array(up, float))
        for side in range(sides):
            angle = 2 * math.pi * side / sides
            points.append(axis[i] + widths[i - 1] * math.cos(angle) * across +
                          heights[i - 1] * math.sin(angle) * above)
    points.append(axis[-1])
    return np.array(points)


# --- the crab ---------------------------------------------------------------------------------------

BODY_SIDES, BODY_RINGS = 14, 7
PARTS = [Part(BODY_SIDES, BODY_RINGS, (0, 0, 128, 64))]
LEG, CLAW, FINGER, EYE = (6, 4), (7, 4), (6, 3), (6, 3)
for _ in range(6):
    PARTS.append(Part(*LEG, (0, 66, 40, 127)))
for _ in range(2):
    PARTS.append(Part(*CLAW, (42, 66, 84, 127)))
    PARTS.append(Part(*FINGER, (42, 66, 84, 127)))
for _ in range(2):
    PARTS.append(Part(*EYE, (86, 66, 127, 127)))


class State:
    """How the crab stands at one time. All angles are in radians, all lengths in MD2 units."""

    def __init__(self):
        self.lift = 0.0  # of the body
        self.roll = 0.0  # of the body, around x
        self.steps = [(0.0, 0.0)] * 6  # per leg: forward, up
        self.open = [0.25, 0.25]  # per claw
        self.raised = [0.0, 0.0]  # per claw
        self.look = 0.0  # of the eyes, to the left


def body(state):
    axis = [(-13, 0, 0)]
    widths, heights = [], []
    for ring in range(BODY_RINGS):
        angle = math.pi * (ring + 1) / (BODY_RINGS + 1)
        axis.append((-13 * math.cos(angle), 0, 1.5 * math.sin(angle)))
        widths.append(17 * math.sin(angle)**0.8)
        heights.append(7 * math.sin(angle)**0.9)
    axis.append((13, 0, 0))
    return placed(tube(BODY_SIDES, axis, widths, heights, (0, 0, 1)), state)


def placed(points, state):
    """Rolls and lifts what sits on the body."""
    c, s = math.cos(state.roll), math.sin(state.roll)
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return points @ turn.T + np.array([0, 0, 14 + state.lift])


def on_body(point, state):
    return placed(np.array([point], float), state)[0]


def leg(index, state):
    side = 1 if index < 3 else -1
    place = index % 3 - 1
    forward, up = state.steps[index]
    hip = on_body((place * 6, side * 13, 0), state)
    foot = np.array([place * 13 + forward, side * 31, up])
    knee = (hip + foot) / 2 + np.array([0, side * 3, 11])
    axis = [hip - (knee - hip) * 0.15, hip, hip + (knee - hip) * 0.7, knee + (foot - knee) * 0.15,
            knee + (foot - knee) * 0.6, foot]
    return tube(LEG[0], axis, [1.6, 2.1, 1.9, 1.2], [1.6, 2.1, 1.9, 1.2], (1, 0, 0))


def claw(index, state):
    side = 1 if index == 0 else -1
    raised = state.raised[index]
    shoulder = on_body((10, side * 11, 1), state)
    direction = np.array([math.cos(raised), side * 0.35, math.sin(raised)])
    direction /= np.linalg.norm(direction)
    elbow = shoulder + direction * 9
    axis = [shoulder, shoulder + direction * 2, elbow, elbow + direction * 5, elbow + direction * 10,
            elbow + direction * 17]
    hand = tube(CLAW[0], axis, [1.6, 1.8, 4.2, 3.0], [1.6, 1.8, 4.8, 3.2], (0, 0, 1))
    _, above = frame_of(direction, np.array([0, 0, 1.0]))
    opening = state.open[index]
    finger = math.cos(opening) * direction + math.sin(opening) * above
    root = elbow + direction * 5 + above * 3
    axis = [root - finger * 2, root, root + finger * 4, root + finger * 8, root + finger * 12]
    return hand, tube(FINGER[0], axis, [1.2, 1.9, 1.3], [1.2, 1.9, 1.3], (0, 0, 1))


def eye(index, state):
    side = 1 if index == 0 else -1
    root = on_body((10.5, side * 4.5, 3), state)
    tip = root + np.array([2.5, side * 0.8 + state.look, 7])
    axis = [root, root + (tip - root) * 0.2, root + (tip - root) * 0.65, tip - (tip - root) * 0.1,
            tip + (tip - root) * 0.18]
    return tube(EYE[0], axis, [0.8, 0.7, 2.1], [0.8, 0.7, 2.1], (1, 0, 0))


def points_of(state):
    groups = [body(state)]
    groups += [leg(i, state) for i in range(6)]
    for i in range(2):
        groups += claw(i, state)
    groups += [eye(i, state) for i in range(2)]
    points = np.concatenate(groups)
    assert len(points) == sum(part.point_count() for part in PARTS)
    return points


# --- sequences --------------------------------------------------------------------------------------


def stand(phase):
    """Breathes, and snaps its left claw once."""
    state = State()
    state.lift = 0.9 * math.sin(2 * math.pi * phase)
    state.open = [0.15 + 0.5 * max(0.0, math.sin(4 * math.pi * phase)), 0.25]
    state.raised = [0.15, 0.1 * math.sin(2 * math.pi * phase)]
    state.look = 1.2 * math.sin(2 * math.pi * phase)
    return state


def walk(phase):
    """Two groups of three legs take turns."""
    state = State()
    for i in range(6):
        turn = 2 * math.pi * (phase + (0.5 if (i + i // 3) % 2 else 0.0))
        state.steps[i] = (5 * math.cos(turn), 5 * max(0.0, math.sin(turn)))
    state.lift = 0.8 * math.sin(4 * math.pi * phase)
    state.roll = 0.06 * math.sin(2 * math.pi * phase)
    state.raised = [0.25, 0.25]
    return state


def wave(phase):
    """Greets with both claws, one after the other."""
    state = State()
    for i in range(2):
        up = 0.5 - 0.5 * math.cos(2 * math.pi * (phase + 0.5 * i))
        state.raised[i] = 1.2 * up
        state.open[i] = 0.2 + 0.6 * up
    state.lift = 1.5 * math.sin(2 * math.pi * phase)**2
    state.look = 2 * math.cos(2 * math.pi * phase)
    return state


SEQUENCES = [("stand", stand, 10), ("walk", walk, 12), ("wave", wave, 12)]

# --- MD2 --------------------------------------------------------------------------------------------


def smooth_normals(points, triangles):
    """The mean of the triangles' normals at each point, weighted by area; MD2 winds clockwise."""
    normals = np.zeros_like(points)
    for triangle in triangles:
        a, b, c = (points[corner[0]] for corner in triangle)
        normal = np.cross(c - a, b - a)
        for corner in triangle:
            normals[corner[0]] += normal
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.maximum(lengths, 1e-12)


def frame_bytes(name, points, normals, table):
    low, high = points.min(0), points.max(0)
    scale = np.maximum((high - low) / 255, 1e-6).astype(np.float32)
    low = low.astype(np.float32)
    packed = np.clip(np.rint((points - low) / scale), 0, 255).astype(np.uint8)
    numbers = np.argmax(normals @ table.T, axis=1).astype(np.uint8)
    return (scale.astype("<f4").tobytes() + low.astype("<f4").tobytes() +
            struct.pack("16s", name.encode()) +
            np.concatenate([packed, numbers[:, None]], axis=1).tobytes())


def outward(triangles, points):
    """Turns triangles whose normals point to the inside of their part."""
    result = []
    for triangle, centre in triangles:
        a, b, c = (points[corner[0]] for corner in triangle)
        clockwise = np.cross(c - a, b - a) @ ((a + b + c) / 3 - centre) > 0
        result.append(triangle if clockwise else (triangle[0], triangle[2], triangle[1]))
    return result


def topology():
    """Parts are nearly convex, so that the way from the axis decides which side is out."""
    coordinates, triangles, first = [], [], 0
    points = points_of(State())
    for part in PARTS:
        found, faces = part.topology(first, len(coordinates))
        coordinates += found
        for face in faces:
            rings = {(corner[0] - first - 1) // part.sides for corner in face}
            members = [first + 1 + ring * part.sides + side for ring in rings
                       if 0 <= ring < part.rings for side in range(part.sides)]
            triangles.append((face, points[members].mean(0)))
        first += part.point_count()
    return coordinates, outward(triangles, points)


def md2(table, skin_name):
    coordinates, triangles = topology()
    frames = []
    for name, sequence, count in SEQUENCES:
        for i in range(count):
            points = points_of(sequence(i / count))
            frames.append(frame_bytes(f"{name}{i + 1}", points, smooth_normals(points, triangles),
                                      table))
    skins = struct.pack("64s", skin_name.encode())
    packed_coordinates = b"".join(struct.pack("<2h", s, t) for s, t in coordinates)
    packed_triangles = b"".join(
        struct.pack("<6H", *(corner[0] for corner in t), *(corner[1] for corner in t))
        for t in triangles)
    commands = struct.pack("<i", 0)  # an empty list: triangles are enough
    at = [68]
    for section in (skins, packed_coordinates, packed_triangles, b"".join(frames), commands):
        at.append(at[-1] + len(section))
    points = sum(part.point_count() for part in PARTS)
    header = struct.pack("<4s16i", b"IDP2", 8, SKIN, SKIN, len(frames[0]), 1, points,
                         len(coordinates), len(triangles), 1, len(frames), *at[:6])
    return (header + skins + packed_coordinates + packed_triangles + b"".join(frames) + commands)


# --- the skin ---------------------------------------------------------------------------------------


def skin():
    """64 colours: a mottled shell, banded legs, pale claws and dark eyes."""
    rng = np.random.default_rng(7)
    y, x = np.mgrid[0:SKIN, 0:SKIN]
    rgb = np.zeros((SKIN, SKIN, 3))
    spots = np.zeros((SKIN, SKIN))
    for _ in range(60):
        cx, cy, radius = rng.uniform(0, SKIN), rng.uniform(4, 60), rng.uniform(2, 6)
        apart = np.minimum(abs(x - cx), SKIN - abs(x - cx))
        spots = np.maximum(spots, np.clip(1.4 - np.hypot(apart, y - cy) / radius, 0, 1))
    back = 0.5 + 0.5 * np.sin(2 * np.pi * x / SKIN)  # 1 on the back, 0 on the belly
    shell = np.array([206, 72, 40]) * (0.72 + 0.28 * back[..., None])
    rgb[:] = shell * (1 - 0.45 * spots[..., None])
    rgb += np.array([250, 214, 160]) * 0.2 * (1 - back)[..., None]
    bands = 0.75 + 0.25 * np.sign(np.sin(2 * np.pi * (y - 66) / 15))
    legs = (y >= 65) & (x < 41)
    rgb[legs] = (np.array([224, 104, 56]) * bands[..., None])[legs]
    claws = (y >= 65) & (x >= 41) & (x < 85)
    fade = np.clip((y - 66) / 60, 0, 1)[..., None]
    rgb[claws] = (np.array([214, 84, 44]) * (1 - fade) + np.array([255, 236, 214]) * fade)[claws]
    eyes = (y >= 65) & (x >= 85)
    stalk, ball = np.array([226, 150, 96]), np.array([24, 22, 30])
    rgb[eyes] = np.where((y > 96)[..., None], ball, stalk)[eyes]
    image = Image.fromarray(np.clip(rgb, 0, 255).astype(np.uint8), "RGB")
    return image.quantize(64, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
