"""The ground: flags around a ring of setts, a border, the strips of setts behind the fence."""
import math

from fence import PITCH_M
from geometry import Part
from sun import SHADOW_X_PER_Y

COURT_M = 10.0
FIELD_M, BORDER_M = 7.4, 9.0  # half widths of the square and of the border's inside
RING_IN_M, RING_OUT_M = 3.2, 4.75
STRIP_M = 2.6  # from the fence to the field
SECTORS = 24


def on_circle(k, r):
    a = 2 * math.pi * k / SECTORS
    return (r * math.cos(a), r * math.sin(a), 0.0)


def on_square(k, half):
    a = 2 * math.pi * k / SECTORS
    c, s = math.cos(a), math.sin(a)
    m = max(abs(c), abs(s))
    return (half * c / m, half * s / m, 0.0)


def ring_uv(k, r):
    return (r - RING_IN_M, k * 25 / SECTORS)  # 25 m of setts along the ring's middle


def moved_out(point, side, to):
    """A point on a side (0 east, 1 north, 2 west) of the square, moved away from the middle."""
    x, y, z = point
    return (x, to, z) if side == 1 else (to if side == 0 else -to, y, z)


def ring_and_field(part):
    """The ring, and the flags between it and the border of setts or, in the south, the strips."""
    for k in range(SECTORS):
        corners = [(k, RING_IN_M), (k, RING_OUT_M), (k + 1, RING_OUT_M), (k + 1, RING_IN_M)]
        part.polygon("setts", [on_circle(*c) for c in corners], [ring_uv(*c) for c in corners])
        side = side_of(k)
        edge = [on_square(j, FIELD_M) for j in (k, k + 1)]
        if side != 3:
            edge = [moved_out(p, side, BORDER_M) for p in edge]
        part.polygon("paving", [on_circle(k, RING_OUT_M), *edge, on_circle(k + 1, RING_OUT_M)])
    for side in (-1, 1):  # the rest of the corners
        kite = [on_circle(SECTORS // 8, RING_OUT_M), (BORDER_M, FIELD_M, 0),
                (BORDER_M, BORDER_M, 0), (FIELD_M, BORDER_M, 0)]
        if side < 0:
            kite = [(-x, y, z) for x, y, z in kite][::-1]
        part.polygon("paving", kite)
        x, y, _ = on_circle(SECTORS // 8, RING_OUT_M)
        rest = [(x, -y, 0), (FIELD_M, -FIELD_M, 0), (BORDER_M, -FIELD_M, 0)]
        if side < 0:
            rest = [(-x, y, z) for x, y, z in rest][::-1]
        part.polygon("paving", rest)


def side_of(k):
    """The side of the square that sector k meets: 0 east, 1 north, 2 west, 3 south."""
    return (k + SECTORS // 8) // (SECTORS // 4) % 4


def border(part):
    """Setts around the flags on all sides except the south."""
    for k in range(SECTORS):
        side = side_of(k)
        if side != 3:
            a, b = on_square(k, FIELD_M), on_square(k + 1, FIELD_M)
            part.polygon("setts", [
                moved_out(a, side, BORDER_M),
                moved_out(a, side, COURT_M),
                moved_out(b, side, COURT_M),
                moved_out(b, side, BORDER_M)
            ])
    f, b, c = FIELD_M, BORDER_M, COURT_M
    for x0, x1, y0, y1 in ((b, c, f, b), (b, c, b, c), (f, b, b, c)):
        quad = [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
        part.polygon("setts", quad)
        part.polygon("setts", [(-x, y, z) for x, y, z in quad][::-1])


def court():
    """One chart without holes; every vertex of one face's edge is a vertex of its neighbour's."""
    part = Part("court")
    with part.sheet("xy", 1.4):
        ring_and_field(part)
        border(part)
    return part


def slanted(x0, x1):
    """A piece of the strip between two lines along the shadow, from the fence to the field."""
    shift = SHADOW_X_PER_Y * STRIP_M
    return [(x0, 0, 0), (x1, 0, 0), (min(x1 + shift, COURT_M), STRIP_M, 0),
            (min(x0 + shift, COURT_M), STRIP_M, 0)]


def fence_strip():
    """The ground in the shadow of one panel of the fence: from the middle of one pier's shadow to
    the next one's, so that every panel's strip is alike and they share a fine chart. x = 0 and
    y = 0 in the first pier's middle."""
    part = Part("fence_strip")
    shift = SHADOW_X_PER_Y * STRIP_M
    points = [(0, 0, 0), (PITCH_M, 0, 0), (PITCH_M + shift, STRIP_M, 0), (shift, STRIP_M, 0)]
    part.face("setts", points, [(0, 0, 1)] * 4, [(x, y) for x, y, _ in points], part.chart(3.4),
              [(x - SHADOW_X_PER_Y * y, y) for x, y, _ in points])
    return part


def gate_strip():
    """The rest of the strip; x = 0 is the middle of the gate."""
    part = Part("gate_strip")
    shift = SHADOW_X_PER_Y * STRIP_M
    half, c = PITCH_M / 2, COURT_M
    with part.sheet("xy", 2.0):
        part.polygon("setts", slanted(-half, half))
    with part.sheet("xy", 0.8):
        part.polygon("setts", [(-c, 0, 0), (-c + shift, STRIP_M, 0), (-c, STRIP_M, 0)])
    # Lies under the seams to the street and the field, which do not share vertices with the strips.
    part.polygon("soil", [(-c, -0.3, -0.02), (c, -0.3, -0.02), (c, STRIP_M + 0.3, -0.02),
                          (-c, STRIP_M + 0.3, -0.02)])
    with part.sheet("xy", 1.6):  # the last panel's shadow, as far as the east wing
        part.polygon("setts", [(half + PITCH_M, 0, 0), (c, 0, 0), (c, STRIP_M, 0),
                               (half + PITCH_M + shift, STRIP_M, 0)])
    return part


def street():
    part = Part("street")
    with part.sheet("xy", 0.75):
        xs = [-16.0, -10, 0, 10, 16.0]
        for x0, x1 in zip(xs, xs[1:]):
            part.polygon("paving", [(x0, -19, 0), (x1, -19, 0), (x1, -COURT_M, 0),
                                    (x0, -COURT_M, 0)])
    return part
