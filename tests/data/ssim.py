#!/usr/bin/env python3
"""Writes ssim.csv: what stimulus::ssim must give, by scikit-image.

Made with scikit-image 0.26.0 and numpy:
    pip install scikit-image==0.26.0 numpy
    python3 tests/data/ssim.py > tests/data/ssim.csv

Columns: pair, what (mean or pixel), x, y, value. The pairs are those of flip.py. Luma is 0.299 R +
0.587 G + 0.114 B of the displayed values, not rounded. The mean leaves out 5 pixels all round,
whose windows reach over the edge; the map of pixels does not.
"""
import numpy as np
from skimage.metrics import structural_similarity

from flip import PAIRS, PIXELS, picture


def main():
    print("pair,what,x,y,value")
    for name, colours in PAIRS.items():
        first, second = (picture(c).astype(np.float64) @ [0.299, 0.587, 0.114] for c in colours)
        mean, values = structural_similarity(
            first, second, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
            data_range=255, full=True)
        print(f"{name},mean,,,{mean:.7f}")
        for x, y in PIXELS:
            print(f"{name},pixel,{x},{y},{values[y, x]:.7f}")


if __name__ == "__main__":
    main()
