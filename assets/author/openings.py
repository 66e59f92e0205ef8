"""Windows with shutters, gallery doors, the balcony, in the wing's frame: their middle is at x = 0
and the wall's face at y = 0."""
from column import baluster
from geometry import Part
from wing import DOOR, FLOOR_M, GALLERY_M, WINDOW

REVEAL_M = 0.28


def reveal(part, half, foot, head, front, head_front, depth):
    """The inner faces of a hole in a wall, except the lower one: sides from y = front on, the head
    from head_front on."""
    part.polygon("carved", [(-half, depth, head), (half, depth, head), (half, head_front, head),
                            (-half, head_front, head)])
    part.polygon("carved", [(-half, front, foot), (-half, depth, foot), (-half, depth, head),
                            (-half, front, head)])
    part.polygon("carved", [(half, depth, foot), (half, front, foot), (half, front, head),
                            (half, depth, head)])


def sash(part, half, foot, head, y):
    """The fronts of a wooden frame with a middle post and glazing bars; the glass lies behind."""
    for x in (-half + 0.04, 0.0, half - 0.04):
        part.box("door", (x - 0.045, y, foot), (x + 0.045, y + 0.06, head), "blrtd")
    bars = [foot + 0.04] + [foot + (head - foot) * k / 3 for k in (1, 2)] + [head - 0.04]
    for z in bars:
        thick = 0.045 if z in (bars[0], bars[-1]) else 0.02
        part.box("door", (-half, y + 0.012, z - thick), (half, y + 0.06, z + thick), "blrtd")


def shutters(part, half, foot, head, opened_deg):
    """Two leaves hinged at the surround, turned out of the wall by opened_deg."""
    width = half + 0.01
    for side in (-1, 1):
        turn = -opened_deg if side > 0 else opened_deg
        with part.placed(x=side * (half + 0.14), y=-0.10, turn_deg=turn):
            x0, x1 = (0.0, width) if side > 0 else (-width, 0.0)
            hinge = "l" if side > 0 else "r"
            part.box("shutter", (x0, -0.045, foot), (x1, 0, head), "td" + hinge, uv_fit=True)


def window(opened_deg=8.0):
    half, sill, head = WINDOW
    part = Part(f"window_{opened_deg:.0f}")
    reveal(part, half, sill, head, -0.06, -0.06, REVEAL_M)
    sash(part, half, sill, head, REVEAL_M - 0.06)
    for side in (-1, 1):
        x0, x1 = sorted((side * half, side * (half + 0.15)))
        part.box("carved", (x0, -0.06, sill), (x1, 0, head), "btdr" if side < 0 else "btdl")
    part.moulding("carved",
                  -half - 0.15,
                  half + 0.15, [(-0.06, head), (-0.06, head + 0.15),
                                (-0.16, head + 0.21), (-0.16, head + 0.28)],
                  caps=True)
    part.box("carved", (-half - 0.24, -0.18, sill - 0.13), (half + 0.24, 0, sill), "bt")
    for x in (-half - 0.06, half - 0.06):
        part.box("carved", (x, -0.13, sill - 0.30), (x + 0.12, 0, sill - 0.13), "bt")
    shutters(part, half, sill + 0.02, head - 0.02, opened_deg)
    return part


def window_glass():
    half, sill, head = WINDOW
    part = Part("window_glass")
    width, height = 1.0, 1.7
    part.polygon("glass", [(-half, REVEAL_M, sill), (half, REVEAL_M, sill), (half, REVEAL_M, head),
                           (-half, REVEAL_M, head)], [(0, 0), (width, 0), (width, height),
                                                      (0, height)])
    return part


def doorway():
    half, height = DOOR
    part = Part("doorway")
    y, foot, head = GALLERY_M, FLOOR_M, FLOOR_M + height
    with part.placed(y=y):
        reveal(part, half, foot, head, -0.06, 0.0, 0.14)
        part.polygon("carved", [(-half, 0, foot), (half, 0, foot), (half, 0.14, foot),
                                (-half, 0.14, foot)])
        for side in (-1, 1):
            x0, x1 = sorted((side * half, side * (half + 0.17)))
            part.box("carved", (x0, -0.06, foot), (x1, 0, head), "btdr" if side < 0 else "btdl")
        part.box("carved", (-half - 0.20, -0.08, head), (half + 0.20, 0, head + 0.20), "bt")
        part.box("carved", (-half - 0.26, -0.14, head + 0.20), (half + 0.26, 0, head + 0.27), "bt")
        part.polygon("door", [(-half, 0.14, foot), (half, 0.14, foot), (half, 0.14, head),
                              (-half, 0.14, head)], [(0, 0), (1.24, 0), (1.24, 2.45), (0, 2.45)])
    return part


BALCONY_FLOOR_M, BALCONY_HALF_M, BALCONY_DEPTH_M = 5.20, 1.45, 0.95


def balcony():
    """A slab on four scrolled brackets, with rails and posts; the balusters are placed apart."""
    part = Part("balcony")
    half, depth, z = BALCONY_HALF_M, BALCONY_DEPTH_M, BALCONY_FLOOR_M
    part.box("carved", (-half - 0.06, -depth - 0.06, z - 0.07), (half + 0.06, 0, z), "bt")
    part.box("carved", (-half, -depth, z - 0.16), (half, 0, z - 0.07), "bt")
    for x in (-1.25, -0.42, 0.42, 1.25):
        with part.placed(x=x):
            outline = [(-0.85, z - 0.16), (-0.80, z - 0.30), (-0.52, z - 0.43), (-0.36, z - 0.64),
                       (0.0, z - 0.84)]
            for (ya, za), (yb, zb) in zip(outline, outline[1:]):
                part.polygon("carved", [(-0.09, yb, zb), (0.09, yb, zb), (0.09, ya, za),
                                        (-0.09, ya, za)])
                for side in (-1, 1):
                    quad = [(side * 0.09, ya, z - 0.16), (side * 0.09, yb, z - 0.16),
                            (side * 0.09, yb, zb), (side * 0.09, ya, za)]
                    quad = [p for k, p in enumerate(quad) if p != quad[k - 1]]
                    part.polygon("carved", quad if side < 0 else quad[::-1])
    top = z + 0.16 + 0.80
    for low, high in (((-half, -depth, z), (half, -depth + 0.2, z + 0.12)),
                      ((-half - 0.03, -depth - 0.03, top), (half + 0.03, -depth + 0.23,
                                                            top + 0.1))):
        part.box("carved", low, high, "t")
    for side in (-1, 1):
        x0, x1 = sorted((side * half, side * (half - 0.2)))
        part.box("carved", (x0, -depth + 0.2, z), (x1, 0, z + 0.12), "fbt")
        part.box("carved", (x0 - 0.03, -depth + 0.23, top), (x1 + 0.03, 0, top + 0.1), "fbt")
        part.box("carved", (x0, -depth, z + 0.12), (x1, -depth + 0.2, top), "td")
    return part


def balcony_balusters():
    """Positions of the balusters on the balcony: (x, y, z)."""
    half, depth = BALCONY_HALF_M - 0.1, BALCONY_DEPTH_M - 0.1
    z = BALCONY_FLOOR_M + 0.12
    front = [(-half + 2 * half * k / 10, -depth, z) for k in range(1, 10)]
    sides = [(side * half, -depth * k / 4 - 0.02, z) for side in (-1, 1) for k in (1, 2, 3)]
    return front + sides


def balcony_baluster():
    part = baluster(0.84)
    part.name = "balcony_baluster"
    return part
