"""The sky: one level quad with one tiling picture, far wider than it is high, so that its edge lies
a degree above the horizon, behind walls and trees. The ini's BACKGROUND is its mean colour."""
from geometry import Part

HEIGHT_M, HALF_M = 130.0, 6000.0


def sky():
    part = Part("sky")
    h = HALF_M
    points = [(-h, h, HEIGHT_M), (h, h, HEIGHT_M), (h, -h, HEIGHT_M),
              (-h, -h, HEIGHT_M)]  # seen from below
    part.face("sky", points, [(0, 0, -1)] * 4, [(x, -y) for x, y, _ in points], -1, [(0, 0)] * 4)
    return part
