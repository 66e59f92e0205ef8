"""The street side: iron fence panels (quads with a clip map) between piers, low walls, a gate."""
import math

from geometry import Part

PITCH_M = 4.0  # from pier to pier
PIER_HALF_M, GATE_PIER_HALF_M = 0.30, 0.36
WALL_TOP_M, PANEL_M = 0.50, 2.0
GATE_HALF_M = PITCH_M / 2 - GATE_PIER_HALF_M


def upright(part, x0, x1, z0):
    part.face("fence", [(x0, 0, z0), (x1, 0, z0), (x1, 0, z0 + PANEL_M),
                        (x0, 0, z0 + PANEL_M)], [(0.0, -0.6, 0.8)] * 4, [(0, 0), (x1 - x0, 0),
                                                                         (x1 - x0, PANEL_M),
                                                                         (0, PANEL_M)], -1,
              [(0, 0)] * 4)


def panel():
    """A panel between two piers, whose middles are at x = 0 and PITCH_M and which hide its ends."""
    part = Part("fence_panel")
    inset = PIER_HALF_M - 0.05
    with part.placed(x=inset):
        upright(part, 0.0, PITCH_M - 2 * inset, WALL_TOP_M)
    return part


def gate_leaf():
    """A wing of the gate, with its hinge at x = 0."""
    part = Part("gate_leaf")
    upright(part, 0.0, GATE_HALF_M, 0.10)
    with part.placed(z=0.10):
        for x in (0.0, GATE_HALF_M):
            part.box("iron", (x - 0.02, -0.02, 0.0), (x + 0.02, 0.02, PANEL_M + 0.05), "d")
    return part


def low_wall():
    part = Part("low_wall")
    part.box("ashlar", (0, -0.20, 0), (PITCH_M, 0.20, 0.40), "dtlr")
    part.moulding("carved", 0, PITCH_M, [(-0.20, 0.38), (-0.25, 0.40), (-0.25, 0.49),
                                         (0.0, 0.51)])
    with part.placed(x=PITCH_M, turn_deg=180):
        part.moulding("carved", 0, PITCH_M, [(-0.20, 0.38), (-0.25, 0.40), (-0.25, 0.49),
                                             (0.0, 0.51)])
    return part


def pier(name, half, height, segments):
    part = Part(name)
    part.box("carved", (-half - 0.06, -half - 0.06, 0), (half + 0.06, half + 0.06, 0.30), "d")
    part.box("ashlar", (-half, -half, 0.30), (half, half, height), "dt")
    for grow, z0, z1 in ((0.05, height - 0.30, height - 0.25), (0.05, height, height + 0.05),
                         (0.11, height + 0.05, height + 0.13)):
        part.box("carved", (-half - grow, -half - grow, z0), (half + grow, half + grow, z1), "")
    radius, z = half * 0.72, height + 0.13
    ball = [(radius * math.sin(a), z + 0.10 + radius * (1 - math.cos(a)))
            for a in (math.pi * (0.14 + 0.86 * k / 8) for k in range(9))]
    part.lathe("carved", [(half * 0.75, z), (half * 0.72, z + 0.03)] + ball[:-1] +
               [(0.0, z + 0.10 + 2 * radius)], segments)
    return part
