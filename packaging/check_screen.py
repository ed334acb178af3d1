"""check_screen.py SCREEN.ppm PICTURE.png: whether the screen's upper left corner shows the picture."""

import sys
from pathlib import Path

from check_pictures import read_png

MOST_APART = 8       # of a colour, of 255: drivers round and dither differently
MOST_SHARE = 0.001   # of all colours that may be farther apart


def read_ppm(path):
    """Size and pixels of what QEMU's screendump writes."""
    data = path.read_bytes()
    kind, width, height, _, = data.split(maxsplit=4)[:4]
    if kind != b"P6":
        raise ValueError(f"{path} is no PPM of bytes")
    size = int(width), int(height)
    return size, data[-3 * size[0] * size[1]:]


def share_apart(screen, picture):
    (width, height), shown = read_ppm(screen)
    (across, rows), wanted = read_png(picture)
    if across > width or rows > height:
        return 1.0
    apart = sum(abs(is_ - should) > MOST_APART for y in range(rows) for is_, should in zip(
        shown[3 * y * width:3 * (y * width + across)], wanted[3 * y * across:3 * (y + 1) * across]))
    return apart / (3 * across * rows)


if __name__ == "__main__":
    sys.exit(share_apart(*map(Path, sys.argv[1:])) > MOST_SHARE)
