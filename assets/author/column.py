"""Turned stone: the arcade's columns and the balusters."""
from geometry import Part

COLUMN_HEIGHT_M = 2.60


def column(seen):
    """Plinth, swelling shaft, capital of two pieces; z = 0 is the foot. seen: "near" or "far"."""
    part = Part(f"column_{seen}")
    part.box("carved", (-0.40, -0.40, -0.15), (0.40, 0.40, 0.14), "d")
    if seen == "near":
        torus = [(0.365, 0.14), (0.392, 0.19), (0.365, 0.235)]
        scotia = [(0.305, 0.26)]
        ring = [(0.343, 0.335), (0.335, 0.375), (0.275, 0.39)]
        shaft = [(0.266, 0.60), (0.232, 2.03)]
        necking = [(0.272, 2.06), (0.272, 2.11), (0.237, 2.12)]
        echinus = [(0.237, 2.215), (0.345, 2.31), (0.372, 2.385)]
        part.lathe("carved", torus + scotia + ring + shaft + necking + echinus, 15)
    else:
        base = [(0.375, 0.14), (0.385, 0.225), (0.31, 0.26), (0.345, 0.34), (0.272, 0.41)]
        top = [(0.235, 2.04), (0.272, 2.07), (0.238, 2.12), (0.237, 2.215), (0.372, 2.385)]
        part.lathe("carved", base + top, 10)
    part.box("carved", (-0.42, -0.36, 2.385), (0.42, 0.36, 2.47), "t")
    part.box("carved", (-0.48, -0.40, 2.47), (0.48, 0.40, COLUMN_HEIGHT_M), "t")
    return part


def baluster(height=0.86):
    part = Part("baluster")
    k = height / 0.86
    part.box("carved", (-0.075, -0.075, 0), (0.075, 0.075, 0.07 * k), "dtb")
    part.lathe("carved", [(r, z * k) for r, z in ((0.062, 0.07), (0.042, 0.13), (0.079, 0.28),
                                                  (0.036, 0.65), (0.052, 0.71), (0.050, 0.79))], 6)
    part.box("carved", (-0.07, -0.07, 0.79 * k), (0.07, 0.07, height), "dtb")
    return part
