"""Turned stone: the arcade's columns and the balusters."""
from geometry import Part

COLUMN_HEIGHT_M = 2.60


def column():
    """On a plinth, swelling shaft, two-piece capital; the foot at z = 0."""
    part = Part("column")
    part.box("carved", (-0.40, -0.40, -0.15), (0.40, 0.40, 0.14), "d")
    torus = [(0.365, 0.14), (0.392, 0.19), (0.365, 0.235)]
    scotia = [(0.315, 0.25), (0.300, 0.29)]
    ring = [(0.335, 0.325), (0.345, 0.35), (0.335, 0.375), (0.285, 0.385)]
    shaft = [(0.270, 0.43), (0.266, 1.2), (0.232, 2.02), (0.245, 2.05)]
    necking = [(0.274, 2.065), (0.274, 2.11), (0.238, 2.12)]
    echinus = [(0.236, 2.20), (0.262, 2.21), (0.262, 2.235), (0.345, 2.31), (0.372, 2.385)]
    part.lathe("carved", torus + scotia + ring + shaft + necking + echinus, 18)
    part.box("carved", (-0.42, -0.36, 2.385), (0.42, 0.36, 2.47), "")
    part.box("carved", (-0.48, -0.40, 2.47), (0.48, 0.40, COLUMN_HEIGHT_M), "")
    return part


def baluster(height=0.86):
    part = Part("baluster")
    k = height / 0.86
    part.box("carved", (-0.075, -0.075, 0), (0.075, 0.075, 0.07 * k), "d")
    part.lathe("carved",
               [(r, z * k)
                for r, z in ((0.062, 0.07), (0.064, 0.10), (0.040, 0.13), (0.060, 0.19),
                             (0.080, 0.28), (0.070, 0.39), (0.047, 0.52), (0.034, 0.66),
                             (0.052, 0.70), (0.052, 0.73), (0.040, 0.745), (0.052, 0.79))], 8)
    part.box("carved", (-0.07, -0.07, 0.79 * k), (0.07, 0.07, height), "dt")
    return part
