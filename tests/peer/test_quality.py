#!/usr/bin/env python3
"""Tests the figures of quality.py with pictures that were made up. All expected values are closed forms."""
import math
import pathlib
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    sys.exit(77)

import quality

SIZE = 32  # pixels along each side of a picture


def expect(name, found, expected, tolerance=1e-3):
    if not abs(found - expected) <= tolerance:
        sys.exit(f'{name}: found {found}, expected {expected}')


def write_ppm(file, codes):
    height, width, _ = codes.shape
    file.write_bytes(b'P6\n%d %d\n255\n' % (width, height) + codes.astype(np.uint8).tobytes())


def truths_are_means_of_light():
    # Half of each pixel's 64 parts is black, half is white: half of the light has the code 187.52.
    parts = np.zeros((2 * quality.SCALE, 3 * quality.SCALE, 3))
    parts[:, ::2] = 255
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / 'truth.ppm'
        write_ppm(file, parts)
        truth = quality.read_truth(file)
    assert truth.shape == (2, 3, 3)
    expect('least code', truth.min(), 187.516, 0.01)
    expect('greatest code', truth.max(), 187.516, 0.01)


def figures_follow_the_errors():
    columns = np.arange(SIZE, dtype=np.float32)
    # Every second column is brighter by 100, so the Laplacian is 200 or -200 everywhere.
    truth = np.broadcast_to(50 + 100 * (columns % 2)[None, :, None], (SIZE, SIZE, 3))
    mask = np.zeros((SIZE, SIZE), bool)
    mask[:, : SIZE // 2] = True
    # In the masked half, the error is 2 in the first frame of each run of two, and 5 in the second.
    pictures = [truth + np.where(mask, error, 90)[..., None] for error in (2, 5, 2, 5)]
    db, median, sharpness, flicker = quality.figures(pictures, [truth] * 4, [mask] * 4, 2)
    expect('PSNR', db, (20 * math.log10(255 / 2) + 20 * math.log10(255 / 5)) / 2)
    expect('median error', median, 3.5)
    expect('flicker', flicker, 3)
    # A contrast that is twice as great has four times the energy. The mask leaves out its border.
    twice = [50 + 2 * (truth - 50)] * 2
    expect('sharpness', quality.figures(twice, [truth] * 2, [mask] * 2, 2)[2], 4)
    # Between two runs, nothing flickers.
    apart = quality.figures([truth, truth, truth + 9, truth + 9], [truth] * 4, [mask] * 4, 2)[3]
    expect('flicker between runs', apart, 0)


def changed_pixels_are_those_of_either_side():
    flat = np.zeros((SIZE, SIZE, 3))
    changed = {side: flat.copy() for side in quality.SIDES}
    changed['ours'][1, 2, 0] = 4
    changed['peer'][3, 4, 2] = 4
    changed['peer'][5, 6] = 3
    pictures = {(side, row): [changed[side] if row == 'af16' else flat]
                for side in quality.SIDES for row in ('none', 'af16')}
    found = quality.changed_pixels(pictures, 0)
    assert [tuple(at) for at in np.argwhere(found)] == [(1, 2), (3, 4)]


truths_are_means_of_light()
figures_follow_the_errors()
changed_pixels_are_those_of_either_side()
