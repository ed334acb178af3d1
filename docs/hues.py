#!/usr/bin/python3
"""docs/hues.py PICTURE...: how much of the lower half of a panorama is not the water's turquoise, and how much is warm.

Each picture of a clip (.webp) counts as one. HSV of the codes: outside is a hue beyond 165 to 230 degrees or a
saturation below 0.2; warm is a hue below 70 or above 320 with a saturation of at least 0.12. Per cent of the pixels
that are lit.
"""
import statistics
import sys

import numpy as np
from PIL import Image, ImageSequence


def hues(picture):
    """(outside, warm) of an RGB picture, per cent."""
    codes = np.asarray(picture.convert("RGB"), float)
    codes = codes[codes.shape[0] // 2:].reshape(-1, 3)
    codes = codes[codes.max(axis=1) > 0]
    red, green, blue = codes.T
    most, spread = codes.max(axis=1), np.ptp(codes, axis=1)
    hue = np.degrees(np.arctan2(np.sqrt(3) * (green - blue), 2 * red - green - blue)) % 360
    saturation = spread / most
    outside = (hue < 165) | (hue > 230) | (saturation < 0.2)
    warm = ((hue < 70) | (hue > 320)) & (saturation >= 0.12)
    return 100 * outside.mean(), 100 * warm.mean()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    found = []
    for path in sys.argv[1:]:
        try:
            with Image.open(path) as pictures:
                for number, picture in enumerate(ImageSequence.Iterator(pictures)):
                    found.append(hues(picture))
                    print(f"{path} {number:3d}   outside {found[-1][0]:5.1f}   warm {found[-1][1]:5.1f}")
        except OSError as problem:
            sys.exit(f"docs/hues.py: {path}: {problem.strerror or 'is no picture'}; name PNG or WebP files")
    outside, warm = zip(*found)
    print(f"median of {len(found)}: outside {statistics.median(outside):.1f}, least {min(outside):.1f}; "
          f"warm {statistics.median(warm):.1f}, least {min(warm):.1f}")
