# Writes a scene of metallic-roughness balls (balls.gltf), a picture of a studio (studio.hdr), and HDR
# files that cannot be environments. With a third argument, compares instead the border of a picture of
# 96x72 pixels (RGB24) with the studio as a camera with a vertical field of view of 50 degrees that looks
# along -z sees it. Usage: environment.py FOLDER [PICTURE.rgb]
import base64, json, math, os, struct, sys

folder = sys.argv[1]
WIDTH, HEIGHT = 256, 128


def rgbe(rgb):
    greatest = max(rgb)
    if greatest < 1e-32:
        return bytes(4)
    mantissa, exponent = math.frexp(greatest)
    return bytes(int(c * mantissa * 256 / greatest) for c in rgb) + bytes([exponent + 128])


def write_hdr(name, width, height, light):
    with open(os.path.join(folder, name), "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            for x in range(width):
                polar, azimuth = math.pi * (y + .5) / height, 2 * math.pi * (x + .5) / width - math.pi
                out.write(rgbe(light((math.sin(polar) * math.cos(azimuth), math.cos(polar), math.sin(polar) * math.sin(azimuth)))))


def studio(d):
    """A grey room with a wooden floor, two soft boxes and a blue window behind the eye."""
    x, y, z = d
    if y < -.25:
        tile = (math.floor(4 * x / -y) + math.floor(4 * z / -y)) % 2
        return (.28, .17, .09) if tile else (.16, .09, .05)
    rgb = [.12 + .1 * y] * 3
    if .45 < y < .85 and abs(math.atan2(x, z) - 2.2) < .5:
        return (6, 5.6, 5)
    if -.1 < y < .5 and abs(math.atan2(x, z) + 2.4) < .12:
        return (4, 4.2, 4.5)
    if -.05 < y < .55 and z > .5 and abs(x) < .6 * z:
        return (.3, .6, 1.3)
    return rgb


def codes_at(x, y, width, height):
    half = math.tan(math.radians(25))
    ray = ((2 * x / width - 1) * half * width / height, (1 - 2 * y / height) * half, -1)
    length = math.sqrt(sum(c * c for c in ray))
    lin = [min(c, 1) for c in studio([c / length for c in ray])]
    return [255 * (12.92 * c if c <= .0031308 else 1.055 * c**(1 / 2.4) - .055) for c in lin]


def check_border(name):
    width, height = 96, 72
    close = total = 0
    with open(os.path.join(folder, name), "rb") as picture:
        pixels = picture.read()
    for y in range(height):
        for x in range(width) if y in (0, 1, height - 1) else (0, width - 1):
            codes = codes_at(x + .5, y + .5, width, height)
            around = [codes_at(x + i, y + j, width, height) for i in (-3, 4) for j in (-3, 4)]
            if max(abs(a - b) for other in around for a, b in zip(codes, other)) <= 6:  # no border of tiles and lights
                close += max(abs(a - b) for a, b in zip(codes, pixels[3 * (y * width + x):][:3])) <= 3
                total += 1
    print(close, "of", total, "pixels show the environment")
    sys.exit(total < 100 or close < total)


if len(sys.argv) > 2:
    check_border(sys.argv[2])

# --- balls
positions, normals, indices = [], [], []
ACROSS, DOWN = 48, 24
for j in range(DOWN + 1):
    for i in range(ACROSS + 1):
        a, b = 2 * math.pi * i / ACROSS, math.pi * j / DOWN
        positions.append((-math.cos(a) * math.sin(b), math.cos(b), math.sin(a) * math.sin(b)))
for j in range(DOWN):
    for i in range(ACROSS):
        k = j * (ACROSS + 1) + i
        indices += [k, k + ACROSS + 1, k + ACROSS + 2, k, k + ACROSS + 2, k + 1]
vertices = b"".join(struct.pack("<3f", *p) for p in positions)
data = vertices + struct.pack("<%dH" % len(indices), *indices)
gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(18))}], "nodes": [], "meshes": [], "materials": [],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(vertices)},
                        {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(data) - len(vertices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3", "min": [-1] * 3, "max": [1] * 3},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}]}
for row in range(3):
    for column in range(6):
        gltf["materials"].append({"pbrMetallicRoughness": {"baseColorFactor": [1, .71, .29, 1], "metallicFactor": 1 - row / 2,
                                                           "roughnessFactor": column / 5}})
        gltf["meshes"].append({"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "material": 6 * row + column}]})
        gltf["nodes"].append({"mesh": 6 * row + column, "translation": [column - 2.5, 1 - row, 0], "scale": [.45] * 3})
with open(os.path.join(folder, "balls.gltf"), "w") as out:
    json.dump(gltf, out)

write_hdr("studio.hdr", WIDTH, HEIGHT, studio)
write_hdr("square.hdr", 64, 64, studio)
with open(os.path.join(folder, "studio.hdr"), "rb") as whole, open(os.path.join(folder, "short.hdr"), "wb") as short:
    short.write(whole.read()[:-5])
with open(os.path.join(folder, "text.hdr"), "w") as out:
    out.write("not a picture\n")
