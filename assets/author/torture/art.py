"""Makes the pictures of the torture scene. All others are the courtyard's.

text.png    departures, a chart of letters and a sign, for text that is far away
paint.png   letters for the ground, with a clip map
net.png     a wire netting with a clip map
plate_n.png the normal map of a chequered plate
grass.jpg   grass that tiles
"""
import math

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from noise import mix, noise, normal_map, palette, save_jpeg, to_bytes

SANS = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
BOLD = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"

# The parts of text.png in texels: left, upper, right and lower edge.
TEXT_SIZE = (1024, 512)
BOARD, CHART, SIGN = (0, 0, 512, 512), (512, 0, 768, 512), (768, 0, 1024, 256)
COLUMN = (768, 256, 1024, 512)


def part_uvs(part):
    """Texture coordinates of a part's corners, from the lower left one on, counter-clockwise."""
    left, upper, right, lower = (v / s for v, s in zip(part, TEXT_SIZE * 2))
    return [(left, lower), (right, lower), (right, upper), (left, upper)]


def centred(draw, box, y, text, font, fill):
    width = draw.textlength(text, font=font)
    draw.text(((box[0] + box[2] - width) / 2, y), text, font=font, fill=fill)


def board(draw):
    """Departures: six lines, with a heading."""
    draw.rectangle(BOARD, fill="#0d1b33")
    draw.rectangle((0, 0, 511, 83), fill="#e0a526")
    draw.text((20, 14), "Departures", font=ImageFont.truetype(BOLD, 46), fill="#10151f")
    draw.text((352, 14), "12:04", font=ImageFont.truetype(BOLD, 46), fill="#10151f")
    rows = [("3", "Old Harbour", "12:06"), ("7", "Steelworks", "12:09"),
            ("3", "University", "12:13"), ("11", "Museum Park", "12:17"),
            ("7", "Northern Lock", "12:21"), ("15", "Lighthouse", "12:30")]
    font, bold = ImageFont.truetype(SANS, 38), ImageFont.truetype(BOLD, 38)
    for i, (line, place, time) in enumerate(rows):
        y = 96 + 68 * i
        draw.rectangle((16, y + 2, 80, y + 54), fill="#2f6fb5")
        centred(draw, (16, 0, 80, 0), y + 5, line, bold, "#ffffff")
        draw.text((98, y + 5), place, font=font, fill="#f2f4f8")
        draw.text((394, y + 5), time, font=font, fill="#f5c64a")
        draw.line((16, y + 61, 496, y + 61), fill="#24385c", width=2)


def chart(draw):
    """A chart of letters whose size falls from line to line."""
    draw.rectangle(CHART, fill="#f4f2ea")
    y = 16
    for size, text in ((110, "D"), (78, "I P"), (58, "T Y C"), (44, "H N E Z"), (32, "R O K A S"),
                       (24, "V L U D F B"), (18, "N C T H Z E P"), (14, "A S O K R D I Y"),
                       (11, "E H V T U C Z P L")):
        centred(draw, CHART, y, text, ImageFont.truetype(BOLD, size), "#16181c")
        y += int(size * 1.12) + 8


def sign(draw):
    """A sign with directions."""
    draw.rectangle(SIGN, fill="#1d5a9c")
    draw.rounded_rectangle((774, 6, 1017, 249), 16, outline="#f4f6f8", width=5)
    font = ImageFont.truetype(BOLD, 36)
    for i, (text, arrow) in enumerate((("Harbour", 0), ("Dock 7", 90), ("Centre", 180))):
        y = 26 + 74 * i
        draw.text((844, y), text, font=font, fill="#ffffff")
        middle = (808, y + 22)
        a = math.radians(arrow)
        ahead, side = (math.sin(a), -math.cos(a)), (math.cos(a), math.sin(a))
        tip = [(0.9, 0), (0.1, 0.62), (0.1, 0.22), (-0.8, 0.22), (-0.8, -0.22), (0.1, -0.22),
               (0.1, -0.62)]
        draw.polygon([tuple(m + 25 * (f * u + s * v) for m, u, v in zip(middle, ahead, side))
                      for f, s in tip], fill="#ffffff")


def column(draw):
    """Small print, as in a newspaper."""
    draw.rectangle(COLUMN, fill="#ece7da")
    centred(draw, COLUMN, 264, "The Canal", ImageFont.truetype(BOLD, 34), "#1a1a1e")
    words = ("Edges, wires and leaves are smaller than a pixel here. A sample either meets them or "
             "misses them, and the next frame decides anew. More samples, a better filter or a "
             "blur: each setting answers one of these questions and no other. This wall asks "
             "whether letters that are three pixels high can still be read.").split()
    font, x, y = ImageFont.truetype(SANS, 16), 780, 312
    for word in words:
        width = draw.textlength(word + " ", font=font)
        if x + width > 1016:
            x, y = 780, y + 20
        draw.text((x, y), word, font=font, fill="#26262a")
        x += width


def text(file):
    picture = Image.new("RGB", TEXT_SIZE)
    draw = ImageDraw.Draw(picture)
    for paint in (board, chart, sign, column):
        paint(draw)
    picture.quantize(32, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(
        file, optimize=True)


def clipped(file, colours, alpha):
    """A palette picture of eight steps of alpha. `colours` are those of alpha 0 and alpha 1."""
    steps = np.rint(np.clip(alpha, 0.0, 1.0) * 7).astype(np.uint8)
    picture = Image.fromarray(steps, "P")
    entries = [mix(colours[0], colours[1], np.float32(k / 7.0)) for k in range(8)]
    picture.putpalette([int(v) for entry in entries for v in to_bytes(entry).ravel()])
    picture.save(file, transparency=bytes(round(255 * k / 7) for k in range(8)), optimize=True)


def paint(file):
    """Two words for the ground, stretched upwards as on roads."""
    picture = Image.new("L", (256, 512))
    draw = ImageDraw.Draw(picture)
    for y, word in ((0, "TRAM"), (256, "ONLY")):
        letters = Image.new("L", (256, 90))
        centred(ImageDraw.Draw(letters), (0, 0, 256, 0), -2, word, ImageFont.truetype(BOLD, 82),
                255)
        picture.paste(letters.resize((256, 236), Image.Resampling.BICUBIC), (0, y + 10))
    del draw
    white = np.array([0.92, 0.92, 0.90], np.float32)
    clipped(file, (white, white), np.asarray(picture, np.float32) / 255.0)


def net(file):
    """Two by two meshes of a wire netting. Alpha falls over about a texel at the wires' edges."""
    n = 128
    y, x = np.mgrid[0:n, 0:n].astype(np.float32) / n
    distance = np.minimum(*(np.abs((2 * (x + s * y) + 0.5) % 1.0 - 0.5) for s in (1, -1)))
    # A step of 1 in the sum is n / 2 / sqrt(2) texels across a wire.
    texels = distance * n / 2 / math.sqrt(2)
    grey = np.array([0.40, 0.43, 0.44], np.float32)
    clipped(file, (grey, grey), 3.2 - texels + 0.5)


def plate(file):
    """Raised bars in a pattern that turns by a quarter from bar to bar."""
    n, size_m = 256, 0.5
    y, x = np.mgrid[0:n, 0:n].astype(np.float32) / n
    height = np.zeros((n, n), np.float32)
    for i in range(4):
        for j in range(4):
            dx = (x - (i + 0.5) / 4 + 0.5) % 1.0 - 0.5
            dy = (y - (j + 0.5) / 4 + 0.5) % 1.0 - 0.5
            turn = math.radians(45 if (i + j) % 2 else -45)
            along = dx * math.cos(turn) + dy * math.sin(turn)
            across = dy * math.cos(turn) - dx * math.sin(turn)
            inside = 1.0 - np.square(along / 0.13) - np.square(across / 0.036)
            height = np.maximum(height, 0.004 * np.sqrt(np.clip(inside, 0.0, 1.0)))
    picture = to_bytes(normal_map(height + 0.00004 * noise((n, n), 20, 120, 0.6, 301), n / size_m))
    Image.fromarray(picture).quantize(64, method=Image.Quantize.MEDIANCUT,
                                      dither=Image.Dither.NONE).save(file, optimize=True)


def grass(file):
    shape = (128, 128)
    fine, mid = noise(shape, 16, 64, 0.3, 311), noise(shape, 2, 16, 0.9, 312)
    save_jpeg(file, palette(["4c5f2a", "66793a", "7f8f4c"], 0.5 + 0.17 * fine + 0.16 * mid), 82)


def make(folder):
    text(folder / "text.png")
    paint(folder / "paint.png")
    net(folder / "net.png")
    plate(folder / "plate_n.png")
    grass(folder / "grass.jpg")
