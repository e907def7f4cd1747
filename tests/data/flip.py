#!/usr/bin/env python3
"""Writes flip.csv: what stimulus::flip must give, by NVIDIA's own program.

Made with flip-evaluator 1.7 and numpy:
    pip install flip-evaluator==1.7 numpy
    python3 tests/data/flip.py > tests/data/flip.csv

Columns: pair, ppd (pixels a degree), what (mean or pixel), x, y, value. The pairs are those of
src/stimulus/test_pictures.rs, 64x48 pixels of 8-bit sRGB, made by the same whole-number formulas.
"""
import numpy as np

WIDTH, HEIGHT = 64, 48
PIXELS = [(0, 0), (63, 0), (0, 47), (63, 47), (31, 24), (32, 5), (7, 40), (50, 30)]


def mixed(x, y, channel, seed):
    """A byte that looks random: 32-bit arithmetic, wrapping."""
    h = (x * 374761393 + y * 668265263 + channel * 2246822519 + seed * 3266489917) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return (h ^ (h >> 16)) & 255


def picture(colour):
    return np.array([[colour(x, y) for x in range(WIDTH)] for y in range(HEIGHT)], dtype=np.uint8)


def gradient(x, y):
    return x * 255 // 63, y * 255 // 47, (x + y) * 255 // 110


def edge(shift):
    return lambda x, y: (200, 180, 60) if 2 * x + y < 80 + shift else (30, 60, 140)


def noise(seed):
    return lambda x, y: tuple(mixed(x, y, channel, seed) for channel in range(3))


def grey(seed):
    return lambda x, y: (96 + (mixed(x, y, 0, seed) & 63),) * 3


def shaken(x, y):
    return tuple(max(0, min(255, v + (mixed(x, y, c, 7) & 15) - 8)) for c, v in enumerate(gradient(x, y)))


def flat(level):
    return lambda x, y: (level,) * 3


PAIRS = {
    "gradient": (gradient, shaken),
    "edge": (edge(0), edge(4)),
    "noise": (noise(1), noise(2)),
    "grey": (grey(3), grey(4)),
    "unlike": (grey(3), gradient),
    "flat": (flat(0), flat(255)),
}


def main():
    import flip_evaluator

    print("pair,ppd,what,x,y,value")
    for name, colours in PAIRS.items():
        reference, test = (picture(colour).astype(np.float32) / 255 for colour in colours)
        for ppd in [67.02064, 25.0]:
            errors, mean, _ = flip_evaluator.evaluate(
                reference, test, "LDR", applyMagma=False, parameters={"ppd": ppd})
            errors = np.asarray(errors).reshape(HEIGHT, WIDTH, -1)[:, :, 0]
            # Theirs is summed in single precision.
            exact = errors.mean(dtype=np.float64)
            assert abs(exact - mean) < 1e-4, (name, ppd)
            print(f"{name},{ppd},mean,,,{exact:.7f}")
            for x, y in PIXELS:
                print(f"{name},{ppd},pixel,{x},{y},{errors[y, x]:.7f}")


if __name__ == "__main__":
    main()
