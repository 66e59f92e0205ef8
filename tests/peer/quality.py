#!/usr/bin/env python3
"""Compares the anisotropic filters (AF) of Diptych and of the peer with the truth.

Usage: quality.py [OPTION]...
  --scenes LIST    courtyard, or models of scenes.py such as atrium (courtyard,atrium)
  --starts LIST    frames of the scene's path, of 60 a second, where a run of frames starts
                   (0,400,800)
  --run N          neighbouring frames of each run, at least 2 (3)
  --size WxH       size of the pictures (640x480)
  --newest DIR     the folder that newest.sh has made; without it, this machine's Mesa is the peer
  --build DIR      the build (build/release)
  --folder DIR     where pictures are written; they are used again (build/quality)

A truth is the same frame with AF 16, drawn 8 times as wide and as high, whose 64 pixels for each
pixel are averaged in linear light. Each side has a truth of its own. All figures consider only the
pixels that AF changes: those in which some channel differs by more than 3 codes between no AF and
AF 16, on either side.

  PSNR       of the picture and the truth, in dB, the mean of all frames
  error      the median difference from the truth, in codes of 8 bits
  sharpness  energy of the Laplacian, relative to the truth: above 1, the picture has detail that the
             truth does not have (aliasing)
  flicker    how much the error changes from a frame to the next: root of the mean square, in codes
"""
import argparse
import json
import pathlib
import subprocess
import sys

import numpy as np

MISSING = 77  # the exit code of dip_peer where this machine has no peer; this script has it, too
SCALE = 8  # the truth has this many pixels along each side of a pixel
ROWS = ['none', 'af4', 'af16']
SIDES = {'ours': 'Diptych', 'peer': 'Mesa'}
ROOT = pathlib.Path(__file__).resolve().parents[2]


def frame_numbers(text):
    numbers = [int(number) for number in text.split(',')]
    if min(numbers) < 0:
        raise ValueError
    return numbers


def parse_arguments():
    parser = argparse.ArgumentParser(usage='quality.py [OPTION]... (--help lists the options)',
                                     add_help=False)
    parser.add_argument('--scenes', default='courtyard,atrium')
    parser.add_argument('--starts', type=frame_numbers, default=[0, 400, 800])
    parser.add_argument('--run', type=int, default=3)
    parser.add_argument('--size', default='640x480')
    parser.add_argument('--newest', type=pathlib.Path)
    parser.add_argument('--build', type=pathlib.Path, default=ROOT / 'build/release')
    parser.add_argument('--folder', type=pathlib.Path, default=ROOT / 'build/quality')
    parser.add_argument('--help', action='store_true')
    arguments = parser.parse_args()
    if arguments.help:
        print(__doc__)
        sys.exit(0)
    if arguments.run < 2:
        parser.error(f'argument --run: found {arguments.run}, accepted is 2 or more')
    return arguments


def run(command, accepted=(0,)):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if result.returncode == MISSING:
        print(result.stdout + result.stderr, end='', file=sys.stderr)
        sys.exit(MISSING)
    if result.returncode not in accepted:
        sys.exit(f'quality.py: {command[0]} failed:\n{result.stdout}{result.stderr}')
    return result.stdout


# --- drawing -------------------------------------------------------------------------------------


def model_arguments(scene):
    if scene == 'courtyard':
        return []
    scenes = ROOT / 'build/scenes'
    if not (scenes / f'{scene}.pth').exists():
        run([sys.executable, ROOT / 'tests/peer/scenes.py', scenes, scene])
    return ['--model', scenes / f'{scene}.glb']


def write_path(arguments, scene, file):
    """Writes a camera path whose keys are the poses of all frames."""
    own = [] if scene == 'courtyard' else ['--path', ROOT / f'build/scenes/{scene}.pth']
    lines = ['diptych-path 1', 'period 0.016666667']
    for start in arguments.starts:
        record = file.with_suffix('.json')
        frames = f'{start}:{start + arguments.run}:1'
        run([arguments.build / 'diptych', 'dump', '--json', record, '--frames', frames, '--size',
             '64x48', *model_arguments(scene), *own])
        for frame in json.loads(record.read_text())['frames']:
            pose = frame['pose']
            lines.append(' '.join(str(v) for v in pose['position'] + pose['orientation']))
    file.write_text('\n'.join(lines) + '\n')
    return len(lines) - 2


def draw(arguments, scene, name, rows, size):
    """Draws the rows on both sides, and returns the folder of the pictures and how many there are."""
    folder = arguments.folder / f'{scene}-{name}'
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / 'frames.pth'
    count = write_path(arguments, scene, path)
    last = folder / f'{rows[-1]}_{count - 1:04d}_peer.ppm'
    if not last.exists():
        print(f'quality.py: {scene}, {name} ...', file=sys.stderr)
        newest = [ROOT / 'tests/peer/newest.sh', '--folder', arguments.newest]
        run([*(newest if arguments.newest else []), arguments.build / 'tests/peer/dip_peer',
             '--check', '--pictures', folder, '--rows', ','.join(rows), '--frames', count, '--size',
             size, '--path', path, *model_arguments(scene)], accepted=(0, 1))
    return folder, count


# --- figures -------------------------------------------------------------------------------------


def read_picture(file):
    """Returns the codes of a PPM file, as floats."""
    data = file.read_bytes()
    magic, size, most, codes = data.split(b'\n', 3)
    assert magic == b'P6' and most == b'255'
    width, height = (int(v) for v in size.split())
    return np.frombuffer(codes, np.uint8).reshape(height, width, 3).astype(np.float32)


def to_light(codes):
    v = codes / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def to_codes(light):
    v = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    return 255 * v


def read_truth(file):
    light = to_light(read_picture(file))
    height, width = light.shape[0] // SCALE, light.shape[1] // SCALE
    return to_codes(light.reshape(height, SCALE, width, SCALE, 3).mean((1, 3)))


def laplacian(picture):
    inner = picture[1:-1, 1:-1]
    return (4 * inner - picture[:-2, 1:-1] - picture[2:, 1:-1] - picture[1:-1, :-2] -
            picture[1:-1, 2:])


def psnr(error):
    square = np.mean(error**2)
    return 10 * np.log10(255**2 / square) if square else np.inf


def changed_pixels(pictures, frame):
    """Returns the pixels of a frame that AF changes, on either side."""
    changed = [np.abs(pictures[side, 'af16'][frame] - pictures[side, 'none'][frame]).max(2) > 3
               for side in SIDES]
    return changed[0] | changed[1]


def figures(pictures, truths, masks, run_length):
    """Returns PSNR, median error, sharpness and flicker of a list of frames."""
    errors = [picture - truth for picture, truth in zip(pictures, truths)]
    dbs = [psnr(error[mask]) for error, mask in zip(errors, masks)]
    medians = [np.median(np.abs(error[mask])) for error, mask in zip(errors, masks)]
    sharpness = [np.sum(laplacian(picture)[mask[1:-1, 1:-1]]**2) /
                 np.sum(laplacian(truth)[mask[1:-1, 1:-1]]**2)
                 for picture, truth, mask in zip(pictures, truths, masks)]
    flicker = [np.mean((errors[i + 1] - errors[i])[masks[i] & masks[i + 1]]**2)
               for i in range(len(errors) - 1) if (i + 1) % run_length]
    return np.mean(dbs), np.mean(medians), np.mean(sharpness), np.sqrt(np.mean(flicker))


def print_scene(arguments, scene):
    width, height = (int(v) for v in arguments.size.split('x'))
    folder, count = draw(arguments, scene, arguments.size, ROWS, arguments.size)
    wide, _ = draw(arguments, scene, 'truth', ['af16'], f'{SCALE * width}x{SCALE * height}')
    pictures = {(side, row): [read_picture(folder / f'{row}_{i:04d}_{side}.ppm')
                              for i in range(count)] for side in SIDES for row in ROWS}
    truths = {side: [read_truth(wide / f'af16_{i:04d}_{side}.ppm') for i in range(count)]
              for side in SIDES}
    masks = [changed_pixels(pictures, i) for i in range(count)]
    agreement = np.mean([psnr(a - b) for a, b in zip(truths['ours'], truths['peer'])])
    share = np.mean([mask.mean() for mask in masks])
    print(f'{scene}: {count} frames, {100 * share:.0f} % of the pixels, the truths of both sides '
          f'agree to {agreement:.0f} dB')
    print('side     AF     PSNR   error  sharpness  flicker')
    for row in ROWS:
        for side, name in SIDES.items():
            db, error, sharpness, flicker = figures(pictures[side, row], truths[side], masks,
                                                    arguments.run)
            print(f'{name:8} {row[2:] if row != "none" else "none":5}{db:6.1f} {error:7.2f} '
                  f'{sharpness:10.2f} {flicker:8.2f}')


def main():
    arguments = parse_arguments()
    for scene in arguments.scenes.split(','):
        print_scene(arguments, scene)


if __name__ == '__main__':
    main()
