"""The courtyard: the position of every part. x east, y north, z up, metres; origin: the fountain.

Placements with the same `light` are in the same light and share their part of the light map:
the west wing lies in its own shade, the first bay of the north wing too. Of each group the middle
one in order is baked, so the middle one should be typical.
"""
import numpy as np

import fence
import fountain
import openings
import paving
import planting
import roof
import tower
import wing
from column import column
from furniture import bench, lamp_post, wall_lantern
from geometry import Part, Scene, frame, mirrored
from planting import SHADY, SUNNY
from sky import sky

COURT_M = 10.0
WINGS = {
    "north": frame(-COURT_M, COURT_M, 0, 0),
    "east": frame(COURT_M, COURT_M, 0, -90),
    "west": frame(-COURT_M, -COURT_M, 0, 90),
}

POTS = [  # part, light, turn from one to the next in degrees, positions
    (planting.tree, SUNNY, 0, [(6.3, 6.3), (6.3, -5.4)]),
    (planting.tree, SHADY, 0, [(-6.3, 6.3), (-6.9, -4.2)]),
    (planting.flower_pot, SUNNY, 47,
     [(-2.0, 8.9), (2.0, 8.9), (8.9, 2.0), (8.9, -2.0), (8.9, -6.0), (4.2, 4.2)]),
    (planting.flower_pot, SHADY, 47, [(-8.9, 2.0), (-8.9, -2.0), (-5.6, 8.9)]),
    (planting.topiary, SUNNY, 71, [(5.6, 8.9), (8.9, -4.0), (8.9, 5.8)]),
    (planting.topiary, SHADY, 71, [(-8.9, 6.0), (-8.9, -5.9)]),
]


def bay_light(side, x):
    """The light of a part on a wing's front: in the west wing's shadow or not."""
    return "north_shade" if side == "north" and x < 5.0 else side


def add_wings(scene):
    medallion, beams = wing.medallion(), wing.beams()
    wholes = {seen: wing.wing(seen) for seen in ("near", "far")}
    pillars = {seen: column(seen) for seen in ("near", "far")}
    windows, glass = [openings.window(8.0), openings.window(38.0)], openings.window_glass()
    doorway, lantern = openings.doorway(), wall_lantern()
    boxes = {tint: planting.flower_box(tint) for tint in (SUNNY, SHADY)}
    for side, place in WINGS.items():
        seen = "near" if side == "east" else "far"
        scene.add(wholes[seen], light=side, within=place)
        for b, x in enumerate(wing.centres()):
            light = bay_light(side, x)
            ajar = (2 * b + len(side)) % 3 == 1 and (side, b) != ("north", 2)  # none by the balcony
            scene.add(windows[ajar], x, light=light, within=place)
            scene.add(glass, x, light=light, within=place)
            scene.add(doorway, x, light=side, within=place)
            scene.add(beams, x - wing.BAY_M / 2, light=side, within=place)
            if b in (1, 3):
                tint = SHADY if side == "west" else SUNNY
                scene.add(boxes[tint], x, 0, wing.WINDOW[1], light=light, within=place)
        for b in range(1, wing.BAYS):
            x = wing.BAY_M * b
            light = bay_light(side, x)
            scene.add(pillars[seen], x, wing.WALL_M / 2, wing.FLOOR_M, light=light, within=place)
            scene.add(medallion, x, 0, 3.95, light=light, within=place)
            scene.add(lantern, x, wing.GALLERY_M, 2.5, light=side, within=place)


def add_roofs(scene):
    panel = roof.panel()
    for k in range(-7, 7):
        scene.add(panel, COURT_M + k * roof.PANEL_M, light="north", within=WINGS["north"])
    for k in range(12):
        along = wing.LENGTH_M + 0.2 - (k + 1) * roof.PANEL_M
        scene.add(panel, along, light="east", within=WINGS["east"])
        scene.add(panel, wing.LENGTH_M - along - roof.PANEL_M, light="west", within=WINGS["west"])
    verge = roof.verge()
    scene.add(verge, -0.2, within=WINGS["west"])
    scene.add(mirrored(verge), wing.LENGTH_M + 0.2, within=WINGS["east"])
    scene.add(roof.back_wall(wing.LENGTH_M + 2 * roof.RIDGE_M),
              -roof.RIDGE_M,
              within=WINGS["north"])
    side_wall = roof.back_wall(wing.LENGTH_M + roof.RIDGE_M)
    for side, start in (("east", -roof.RIDGE_M), ("west", 0.0)):
        scene.add(side_wall, start, light=side, within=WINGS[side])


def add_corners(scene):
    pier, gallery = wing.corner_pier(), wing.corner()
    scene.add(pier, COURT_M, COURT_M, light="east")
    scene.add(gallery, COURT_M, COURT_M, light="east")
    scene.add(pier, -COURT_M, COURT_M, turn_deg=90, light="west")
    scene.add(gallery, -COURT_M, COURT_M, turn_deg=90, light="west")
    gable = wing.gable(roof.SLOPE, roof.RIDGE_M)
    scene.add(gable, within=WINGS["west"])
    scene.add(mirrored(gable), wing.LENGTH_M, within=WINGS["east"])


def add_balcony(scene):
    place = WINGS["north"] @ frame(COURT_M)
    scene.add(openings.balcony(), within=place)
    part = openings.balcony_baluster()
    for x, y, z in openings.balcony_balusters():
        scene.add(part, x, y, z, within=place)


def add_ground(scene):
    scene.add(paving.court())
    scene.add(paving.gate_strip(), y=-COURT_M)
    strip = paving.fence_strip()
    for x in (-10.0, -6.0, 2.0):
        scene.add(strip, x, -COURT_M)
    scene.add(paving.street())


def add_fence(scene):
    panel, wall, leaf = fence.panel(), fence.low_wall(), fence.gate_leaf()
    for x in (-6.0, -10.0, 2.0, 6.0):
        scene.add(panel, x, -COURT_M)
        scene.add(wall, x, -COURT_M)
    pier = fence.pier("pier", fence.PIER_HALF_M, 2.40, 16)
    gate_pier = fence.pier("gate_pier", fence.GATE_PIER_HALF_M, 2.85, 20)
    for x in (-9.95, -6.0, 6.0, 9.95):
        scene.add(pier, x, -COURT_M)
    for x in (-2.0, 2.0):
        scene.add(gate_pier, x, -COURT_M)
    hinge = 2.0 - fence.GATE_PIER_HALF_M
    scene.add(leaf, -hinge, -COURT_M, turn_deg=74)
    scene.add(leaf, hinge, -COURT_M, turn_deg=180 - 78)


def add_fountain(scene):
    scene.add(fountain.fountain())
    water = fountain.water()
    scene.add(water)
    scene.add(fountain.pools(water))
    ball = fountain.post_ball()
    for k in range(8):
        a = np.radians(45.0 * k + 22.5)
        scene.add(ball, 3.06 * np.sin(a), -3.06 * np.cos(a), 1.07)


def add_tower(scene):
    x, y = 5.2, 17.4
    scene.add(tower.tower(), x, y)
    part = tower.belfry_baluster()
    for dx, dy, turn in tower.belfry_balusters():
        scene.add(part, x + dx, y + dy, tower.BELFRY_M + 0.08, turn_deg=turn)


def add_planting(scene):
    for make, tint, turn_deg, spots in POTS:
        part = make(tint)
        for k, (x, y) in enumerate(spots):
            scene.add(part, x, y, turn_deg=turn_deg * k)
    scene.add(planting.climber(), COURT_M, COURT_M)
    trees = [planting.cypress(1, 14.0), planting.cypress(2, 11.0)]
    spots = ((-8.2, 17.6, 1.1), (-5.6, 18.6, 0.95), (12.2, 18.4, 1.0), (17.8, -12.5, 0.62),
             (18.6, -16.0, 0.7), (17.9, -9.6, 0.66), (-17.8, -12.6, 0.66), (-17.9, -9.4, 0.6))
    for k, (x, y, scale) in enumerate(spots):
        scene.add(trees[k % 2], x, y, turn_deg=83 * k, scale=scale)


def add_furniture(scene):
    seat, lamp = bench(), lamp_post()
    for x, turn, light in ((7.0, 90, "sun"), (-6.6, -90, "shade")):
        scene.add(seat, x, 0.6, turn_deg=turn, light=light)
    scene.add(seat, 0.0, 7.1, turn_deg=0, light="sun_north")
    for x, y, light in ((5.4, -6.9, "sun"), (-5.0, -6.9, "sun")):
        scene.add(lamp, x, y, light=light)


def street_walls():
    part = Part("street_wall")
    with part.density(0.5):
        part.box("ashlar", (0, -19, 0), (0.6, -COURT_M, 2.5), "d")
        part.box("carved", (-0.1, -19, 2.5), (0.7, -COURT_M, 2.66), "t")
    return part


def courtyard():
    scene = Scene()
    add_ground(scene)
    add_wings(scene)
    add_corners(scene)
    add_roofs(scene)
    add_balcony(scene)
    add_fountain(scene)
    add_fence(scene)
    add_tower(scene)
    add_furniture(scene)
    wall = street_walls()
    scene.add(wall, 15.4, light="east")
    scene.add(wall, -16.0, light="west")
    add_planting(scene)
    scene.add(sky())
    return scene


if __name__ == "__main__":
    placed = courtyard()
    meshes = placed.meshes()
    drawn = 0
    for (name, light), (part, matrices) in meshes.items():
        count = sum(len(s.triangles) for s in part.surfaces.values())
        drawn += count * len(matrices)
        print(f"{name:24} {light:12} {count:6} triangles x {len(matrices)}")
    print(drawn, "triangles drawn")
