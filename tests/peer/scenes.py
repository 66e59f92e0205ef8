#!/usr/bin/env python3
"""Writes the scenes of the peer bench: forest, city, million and atrium, each as NAME.glb and its
camera path NAME.pth. The files are the same on every run. All of them take half a minute.

Usage: scenes.py FOLDER [NAME]...   (all scenes without NAME)
"""
import array
import json
import math
import pathlib
import random
import struct
import sys
import zlib

FLOAT, UINT32 = 5126, 5125
TAU = 2 * math.pi

# --- textures ------------------------------------------------------------------------------------


def png(width, height, channels, rows):
    """rows: bytes of each row, without a filter."""

    def chunk(kind, data):
        return (struct.pack('>I', len(data)) + kind + data +
                struct.pack('>I', zlib.crc32(kind + data)))

    colour = {3: 2, 4: 6}[channels]
    header = struct.pack('>IIBBBBB', width, height, 8, colour, 0, 0, 0)
    data = zlib.compress(b''.join(b'\0' + row for row in rows), 1)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', data) +
            chunk(b'IEND', b''))


def noise(size, rng):
    """Rows of tileable value noise, 0..1: octaves with cells of size / 4 down to 2 texels."""
    rows = [[0.0] * size for _ in range(size)]
    weight, total = 1.0, 0.0
    cells = 4
    while cells <= size // 2:
        grid = [[rng.random() for _ in range(cells)] for _ in range(cells)]
        step = size // cells
        ramp = [i / step for i in range(step)]
        for y in range(size):
            fy = y % step / step
            above, below = grid[y // step], grid[(y // step + 1) % cells]
            line = [(a + (b - a) * fy) * weight for a, b in zip(above, below)]
            line.append(line[0])
            values = [a + (b - a) * f for a, b in zip(line, line[1:]) for f in ramp]
            rows[y] = [v + w for v, w in zip(rows[y], values)]
        total += weight
        weight *= 0.6
        cells *= 2
    return [[v / total for v in row] for row in rows]


def stone(size, colour, seed, joint=None):
    """A picture of noise around a colour. joint: width and height of slabs with dark joints."""
    rng = random.Random(seed)
    table = [bytes(min(255, int(c * (0.45 + 1.1 * k / 255))) for c in colour) for k in range(256)]
    dark = bytes(c // 4 for c in colour)
    rows = []
    for y, values in enumerate(noise(size, rng)):
        texels = [table[int(255 * v)] for v in values]
        if joint:
            shift = y // joint[1] % 2 * joint[0] // 2
            for x in range(size):
                if (x + shift) % joint[0] < 5 or y % joint[1] < 5:
                    texels[x] = dark
        rows.append(b''.join(texels))
    return png(size, size, 3, rows)


def leaves(size, count, seed):
    """Rhombic leaves on a transparent ground, within a circle."""
    rng = random.Random(seed)
    rows = [bytearray(bytes((40, 70, 25, 0)) * size) for _ in range(size)]
    for _ in range(count):
        reach = 0.46 * size * math.sqrt(rng.random())
        angle, turn = TAU * rng.random(), TAU * rng.random()
        x = size / 2 + reach * math.cos(angle)
        y = size / 2 + reach * math.sin(angle)
        length = size * rng.uniform(0.012, 0.032)
        green = rng.randrange(60, 150)
        texel = bytes((green // 2, green, green // 3, 255))
        corners = [(x + length * k * math.cos(turn + q * TAU / 4),
                    y + length * k * math.sin(turn + q * TAU / 4))
                   for q, k in enumerate((1.0, 0.4, 1.0, 0.4))]
        for row in range(max(0, math.ceil(min(c[1] for c in corners))),
                         min(size, math.ceil(max(c[1] for c in corners)))):
            crossed = []
            for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]):
                if (y0 <= row) != (y1 <= row):
                    crossed.append(x0 + (x1 - x0) * (row - y0) / (y1 - y0))
            if len(crossed) == 2:
                low = max(0, math.ceil(min(crossed)))
                high = min(size, math.ceil(max(crossed)))
                if high > low:
                    rows[row][4 * low:4 * high] = texel * (high - low)
    return png(size, size, 4, [bytes(row) for row in rows])


# --- meshes --------------------------------------------------------------------------------------


class Mesh:
    """Indexed triangles of one material."""

    def __init__(self, material):
        self.material = material
        self.positions = array.array('f')
        self.normals = array.array('f')
        self.uv = array.array('f')
        self.indices = array.array('I')

    def vertex_count(self):
        return len(self.positions) // 3

    def sheet(self, columns, rows, at, repeat=(1, 1)):
        """Adds a curved surface. at(s, t), with s and t in 0..1, returns a point. The front is the
        side from which the turn from s to t is counter-clockwise."""
        first = self.vertex_count()
        points = [at(i / columns, k / rows) for k in range(rows + 1) for i in range(columns + 1)]
        for k in range(rows + 1):
            for i in range(columns + 1):
                near = k * (columns + 1) + i
                left, right = near - (i > 0), near + (i < columns)
                down = near - (columns + 1) * (k > 0)
                up = near + (columns + 1) * (k < rows)
                a = [q - p for p, q in zip(points[left], points[right])]
                b = [q - p for p, q in zip(points[down], points[up])]
                n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0])
                length = math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) or 1.0
                self.positions.extend(points[near])
                self.normals.extend(c / length for c in n)
                self.uv.extend((i / columns * repeat[0], k / rows * repeat[1]))
        for k in range(rows):
            for i in range(columns):
                corner = first + k * (columns + 1) + i
                above = corner + columns + 1
                self.indices.extend((corner, corner + 1, above + 1, corner, above + 1, above))

    def lathe(self, sides, rings, radius, height, repeat=(1, 1)):
        """Adds a surface of revolution: radius(t, angle) at a share t of the height."""

        def at(s, t):
            angle = -TAU * s
            r = radius(t, angle)
            return (r * math.cos(angle), height * t, r * math.sin(angle))

        self.sheet(sides, rings, at, repeat)

    def box(self, low, high, repeat=1.0):
        """Adds a box. The texture repeats `repeat` times per metre."""
        size = [h - l for l, h in zip(low, high)]
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for side in range(2):

                def at(s, t, axis=axis, u=u, v=v, side=side):
                    point = [0.0] * 3
                    point[axis] = high[axis] if side else low[axis]
                    point[u] = low[u] + (s if side else 1 - s) * size[u]
                    point[v] = low[v] + t * size[v]
                    return point

                self.sheet(1, 1, at, (size[u] * repeat, size[v] * repeat))

    def card(self, centre, along, up):
        """Adds a rectangle around its centre, whose normal points up so that light falls on it."""
        first = self.vertex_count()
        for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            self.positions.extend(c + s * a + t * u for c, a, u in zip(centre, along, up))
            self.normals.extend((0, 1, 0))
            self.uv.extend(((s + 1) / 2, (t + 1) / 2))
        self.indices.extend(first + i for i in (0, 1, 2, 0, 2, 3))

    def cards(self, count, size, centre_of, rng):
        for _ in range(count):
            turn, tilt = TAU * rng.random(), rng.uniform(-0.6, 0.6)
            half = size * rng.uniform(0.7, 1.2)
            self.card(centre_of(), (half * math.cos(turn), 0, half * math.sin(turn)),
                      (-half * math.sin(turn) * math.sin(tilt), half * math.cos(tilt),
                       half * math.cos(turn) * math.sin(tilt)))


# --- files ---------------------------------------------------------------------------------------


class Scene:

    def __init__(self):
        self.blob = bytearray()
        self.triangles = []  # of each mesh
        self.json = {
            'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': []}], 'nodes': [],
            'meshes': [], 'materials': [], 'textures': [], 'images': [],
            'samplers': [{'magFilter': 9729, 'minFilter': 9987}],
            'accessors': [], 'bufferViews': [], 'buffers': [{}],
        }

    def add(self, kind, entry):
        self.json[kind].append(entry)
        return len(self.json[kind]) - 1

    def view(self, data):
        self.blob += bytes(-len(self.blob) % 4)
        offset = len(self.blob)
        self.blob += data
        return self.add('bufferViews',
                        {'buffer': 0, 'byteOffset': offset, 'byteLength': len(data)})

    def accessor(self, values, kind, per_item):
        entry = {'bufferView': self.view(values.tobytes()), 'type': kind,
                 'componentType': UINT32 if values.typecode == 'I' else FLOAT,
                 'count': len(values) // per_item}
        if kind == 'VEC3':
            entry['min'] = [min(values[c::3]) for c in range(3)]
            entry['max'] = [max(values[c::3]) for c in range(3)]
        return self.add('accessors', entry)

    def material(self, picture, leafy=False, double_sided=False):
        image = self.add('images', {'bufferView': self.view(picture), 'mimeType': 'image/png'})
        texture = self.add('textures', {'source': image, 'sampler': 0})
        entry = {'pbrMetallicRoughness': {'baseColorTexture': {'index': texture}}}
        entry['doubleSided'] = leafy or double_sided
        if leafy:
            entry.update(alphaMode='MASK', alphaCutoff=0.5)
        return self.add('materials', entry)

    def mesh(self, *parts):
        self.triangles.append(sum(len(part.indices) // 3 for part in parts))
        return self.add('meshes', {'primitives': [{
            'attributes': {'POSITION': self.accessor(part.positions, 'VEC3', 3),
                           'NORMAL': self.accessor(part.normals, 'VEC3', 3),
                           'TEXCOORD_0': self.accessor(part.uv, 'VEC2', 2)},
            'indices': self.accessor(part.indices, 'SCALAR', 1),
            'material': part.material} for part in parts]})

    def place(self, mesh, at=(0, 0, 0), turn=0.0, scale=(1, 1, 1)):
        node = self.add('nodes', {
            'mesh': mesh, 'translation': list(at), 'scale': list(scale),
            'rotation': [0, math.sin(turn / 2), 0, math.cos(turn / 2)]})
        self.json['scenes'][0]['nodes'].append(node)

    def save(self, folder, name, keys):
        """keys: camera positions with the heading and the pitch in degrees."""
        self.blob += bytes(-len(self.blob) % 4)
        self.json['buffers'][0]['byteLength'] = len(self.blob)
        text = json.dumps(self.json).encode()
        text += b' ' * (-len(text) % 4)
        with open(folder / f'{name}.glb', 'wb') as out:
            out.write(struct.pack('<4sII', b'glTF', 2, 28 + len(text) + len(self.blob)))
            out.write(struct.pack('<I4s', len(text), b'JSON') + text)
            out.write(struct.pack('<I4s', len(self.blob), b'BIN\0') + self.blob)
        lines = ['diptych-path 1', 'period 2']
        for x, y, z, heading, pitch in keys:
            a, p = math.radians(heading) / 2, math.radians(pitch) / 2
            q = (math.cos(a) * math.sin(p), math.sin(a) * math.cos(p),
                 -math.sin(a) * math.sin(p), math.cos(a) * math.cos(p))
            lines.append(f'{x:g} {y:g} {z:g} ' + ' '.join(f'{c:.9f}' for c in q))
        (folder / f'{name}.pth').write_text('\n'.join(lines) + '\n')
        count = sum(self.triangles[node['mesh']] for node in self.json['nodes'])
        print(f'{name}: {count} triangles, {len(self.json["nodes"])} objects', file=sys.stderr)


# --- the scenes ----------------------------------------------------------------------------------


def forest(folder):
    """2500 trees of crossed cards whose leaves hide each other many times, on a hilly ground."""
    rng = random.Random(5)
    scene = Scene()
    leaf = scene.material(leaves(512, 900, 1), leafy=True)
    bark = scene.material(stone(512, (90, 60, 40), 2))
    soil = scene.material(stone(1024, (90, 100, 50), 3))

    def height(x, z):
        return (1.2 * math.sin(0.11 * x) * math.cos(0.13 * z) +
                0.3 * math.sin(0.7 * x + 0.5 * z))

    trees = []
    for _ in range(6):
        crown, trunk = Mesh(leaf), Mesh(bark)

        def centre():
            y = 2 + 3 * rng.random()
            reach = 1.6 * math.sqrt(rng.random()) * (5.4 - y) / 3
            angle = TAU * rng.random()
            return (reach * math.cos(angle), y, reach * math.sin(angle))

        crown.cards(60, 0.7, centre, rng)
        trunk.box((-0.12, 0, -0.12), (0.12, 3, 0.12))
        trees.append(scene.mesh(crown, trunk))
    ground = Mesh(soil)
    ground.sheet(160, 160, lambda s, t: (120 * s - 60, height(120 * s - 60, 60 - 120 * t),
                                         60 - 120 * t), (40, 40))
    scene.place(scene.mesh(ground))
    for i in range(2500):
        x, z = rng.uniform(-58, 58), rng.uniform(-58, 58)
        scene.place(trees[i % 6], (x, height(x, z) - 0.1, z), TAU * rng.random(),
                    [rng.uniform(0.7, 1.4)] * 3)
    scene.save(folder, 'forest', [(-40, 3, 0, -90, -2), (-15, 4, 5, -100, -5), (10, 3, 0, -60, 0),
                                  (30, 9, -5, 30, -15), (20, 6, -30, 100, -5),
                                  (-20, 3, -25, 150, 0)])


def city(folder):
    """4000 boxes, each an object of its own."""
    rng = random.Random(6)
    scene = Scene()
    colours = ((140, 130, 120), (120, 60, 50), (90, 110, 130), (150, 140, 90))
    boxes = []
    for i, colour in enumerate(colours):
        house = Mesh(scene.material(stone(512, colour, 10 + i, (128, 64))))
        house.box((-0.5, 0, -0.5), (0.5, 1, 0.5), 4)
        boxes.append(scene.mesh(house))
    road = Mesh(scene.material(stone(1024, (80, 80, 85), 20)))
    road.sheet(40, 40, lambda s, t: (260 * s - 130, 0, 130 - 260 * t), (60, 60))
    scene.place(scene.mesh(road))
    for i in range(-15, 16):
        for k in range(-15, 16):
            if i % 4 == 0 or k % 4 == 0:
                continue
            kind, height = rng.randrange(4), rng.uniform(4, 22)
            scene.place(boxes[kind], (7 * i, 0, 7 * k), 0, (5, height, 5))
            for q in range(7):
                at = (7 * i + rng.uniform(-2.4, 2.4), height * q / 7,
                      7 * k + (2.55 if q % 2 else -2.55))
                scene.place(boxes[(kind + 1) % 4], at, 0, (0.9, 0.7, 0.3))
    scene.save(folder, 'city', [(-80, 3, 0, -90, 8), (-30, 3, 0, -80, 5), (0, 25, 28, -30, -20),
                                (28, 6, 28, 60, 5), (0, 2, 0, 90, 10), (-28, 12, -28, -120, -8)])


def million(folder):
    """Hills of a million triangles in one mesh, seen from low above them."""
    scene = Scene()

    def at(s, t):
        x, z = 120 * s - 60, 60 - 120 * t
        return (x, 3 * math.sin(0.2 * x) * math.cos(0.17 * z) +
                0.4 * math.sin(1.3 * x + z) * math.cos(1.7 * z) +
                0.05 * math.sin(9 * x) * math.sin(8 * z), z)

    hills = Mesh(scene.material(stone(1024, (120, 110, 80), 30)))
    hills.sheet(710, 710, at, (30, 30))
    scene.place(scene.mesh(hills))
    scene.save(folder, 'million', [(-40, 6, 0, -90, -8), (0, 5, 10, -100, -5), (40, 9, 0, 60, -15),
                                   (0, 25, -30, 170, -40)])


def atrium(folder):
    """A hall with two storeys of arcades around a court: fluted columns, arches, balustrades,
    curtains, pots, and ivy of alpha-masked cards. All textures have 1024x1024 texels."""
    rng = random.Random(7)
    scene = Scene()
    lime = scene.material(stone(1024, (190, 175, 150), 40))
    floor = scene.material(stone(1024, (150, 130, 115), 41, (256, 256)))
    brick = scene.material(stone(1024, (150, 95, 75), 42, (128, 64)))
    plaster = scene.material(stone(1024, (200, 190, 170), 43))
    red = scene.material(stone(1024, (150, 35, 30), 44), double_sided=True)
    blue = scene.material(stone(1024, (40, 60, 140), 45), double_sided=True)
    clay = scene.material(stone(1024, (170, 100, 60), 46))
    leaf = scene.material(leaves(1024, 700, 47), leafy=True)
    pitch, storey, long, short = 3.0, 5.0, 7, 3  # columns stand at -long..long and -short..short

    def column_radius(t, angle):
        foot = 0.16 * max(0.0, 1 - 12 * t) + 0.2 * max(0.0, 12 * t - 11)
        flute = 0.018 * abs(math.sin(10 * angle)) if 1 / 12 < t < 11 / 12 else 0.0
        return 0.32 - 0.04 * t + foot - flute

    shaft, band, rail, cloth = Mesh(lime), Mesh(plaster), Mesh(lime), [Mesh(red), Mesh(blue)]
    shaft.lathe(60, 24, column_radius, 3.4, (2, 3))

    def arch(s, t):
        # A closed band around half a circle: t walks around its rectangular profile.
        corner = [(1.15, 0.35), (1.15, -0.35), (1.5, -0.35), (1.5, 0.35)]
        side, share = int(4 * t) % 4, 4 * t - int(4 * t)
        (r0, z0), (r1, z1) = corner[side], corner[(side + 1) % 4]
        radius, z = r0 + (r1 - r0) * share, z0 + (z1 - z0) * share
        return (-radius * math.cos(math.pi * s), radius * math.sin(math.pi * s), z)

    band.sheet(24, 8, arch, (3, 2))
    rail.lathe(12, 12, lambda t, a: 0.05 + 0.035 * math.sin(math.pi * t) * math.sin(7 * t) ** 2,
               0.9)
    for mesh in cloth:
        mesh.sheet(36, 36, lambda s, t: (2.2 * s - 1.1, 2.6 * t,
                                         0.12 * math.sin(9 * TAU * s / 2) * (1.3 - t)), (2, 2))
    column, ring, baluster = scene.mesh(shaft), scene.mesh(band), scene.mesh(rail)
    curtains = [scene.mesh(mesh) for mesh in cloth]
    pot, bush = Mesh(clay), Mesh(leaf)
    pot.lathe(40, 16, lambda t, a: 0.35 + 0.25 * math.sin(2.4 * t), 0.9, (2, 1))
    bush.cards(90, 0.4, lambda: (rng.uniform(-0.6, 0.6), rng.uniform(0.9, 2.2),
                                 rng.uniform(-0.6, 0.6)), rng)
    ivy = Mesh(leaf)
    ivy.cards(260, 0.22, lambda: (rng.gauss(0, 0.5), -abs(rng.gauss(0, 1.1)), rng.gauss(0, 0.12)),
              rng)
    potted, hanging = scene.mesh(pot, bush), scene.mesh(ivy)

    width, depth = pitch * (long + 2), pitch * (short + 2)  # half the hall's size
    shell, ground = Mesh(brick), Mesh(floor)
    ground.sheet(48, 24, lambda s, t: (width * (2 * s - 1), 0, depth * (1 - 2 * t)), (27, 15))
    for side in (-1, 1):
        shell.box((-width, 0, side * depth - 0.3), (width, 2.4 * storey, side * depth + 0.3), 0.5)
        shell.box((side * width - 0.3, 0, -depth), (side * width + 0.3, 2.4 * storey, depth), 0.5)
    decks = Mesh(plaster)
    for level in (1, 2):
        y = level * storey
        for side in (-1, 1):
            near, far = sorted((side * (pitch * short + 0.4), side * depth))
            decks.box((-width, y - 0.4, near), (width, y, far), 0.5)
            near, far = sorted((side * (pitch * long + 0.4), side * width))
            decks.box((near, y - 0.4, -depth), (far, y, depth), 0.5)
    scene.place(scene.mesh(shell, ground, decks))

    # Each bay of the arcade: where its column stands, which way its arch goes, whether it has one.
    bays = [((pitch * i, pitch * short * side), 0.0, i < long)
            for side in (-1, 1) for i in range(-long, long + 1)]
    bays += [((pitch * long * side, pitch * k), -TAU / 4, k < short)
             for side in (-1, 1) for k in range(-short, short + 1)]
    for level in (0, 1):
        y = level * storey
        for n, ((x, z), turn, spans) in enumerate(bays):
            scene.place(column, (x, y, z), turn)
            if not spans:
                continue
            along = (math.cos(turn), -math.sin(turn))
            mx, mz = x + pitch / 2 * along[0], z + pitch / 2 * along[1]
            scene.place(ring, (mx, y + 3.2, mz), turn)
            if level == 1:
                for q in range(6):
                    share = pitch * (q + 0.5) / 6
                    scene.place(baluster, (x + share * along[0], y, z + share * along[1]))
                scene.place(hanging, (mx, y + 0.6, mz), turn)
            if n % 3 == 0:
                scene.place(curtains[n // 3 % 2], (mx, y + 0.9, mz), turn + TAU / 2 * (n % 2))
            if n % 2 == level:
                scene.place(potted, (mx * 0.93, y, mz * 0.8 if level == 0 else mz * 1.2), n)
    scene.save(folder, 'atrium', [(-18, 1.7, 0, -90, 4), (-4, 2.2, 3, -120, 8), (8, 3, -2, 60, 5),
                                  (16, 6.7, 8, 40, -8), (0, 8, 10.5, 10, -15),
                                  (-16, 6.5, -5, 220, -10)])


SCENES = {f.__name__: f for f in (forest, city, million, atrium)}


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith('-'):
        sys.exit(__doc__)
    names = sys.argv[2:] or list(SCENES)
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        sys.exit(f'scenes.py: no scene is called {unknown[0]}; give {", ".join(SCENES)}')
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        SCENES[name](folder)


if __name__ == '__main__':
    main()
