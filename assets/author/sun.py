"""The light: the direction of the sun, and the strength of sun and sky.

The direction is that of the renderer's fixed light on surfaces without a light map.
"""
import math

DIRECTION = (-0.42, -0.61, 0.67)  # to the sun; x east, y north, z up
_length = math.sqrt(sum(v * v for v in DIRECTION))
DIRECTION = tuple(v / _length for v in DIRECTION)
SHADOW_X_PER_Y = (DIRECTION[0] / DIRECTION[1]
                  )  # metres that a shadow on the ground goes east per metre north

SUN_COLOUR, SUN_STRENGTH = (1.0, 0.84, 0.62), 5.0
SUN_ANGLE_DEG = 0.8
SKY_ZENITH, SKY_HORIZON, SKY_STRENGTH = (0.22, 0.42, 0.86), (0.72, 0.78, 0.84), 0.88
LIGHT_MAP_SCALE = 2.0  # the light map holds light / 2
