"""check_screen.py SCREEN.ppm PICTURE.png...: whether the screen shows them, side by side from its upper left."""

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


def share_apart(screen, picture, left):
    (width, height), shown = screen
    (across, rows), wanted = picture
    if left + across > width or rows > height:
        return 1.0
    apart = sum(abs(is_ - should) > MOST_APART for y in range(rows) for is_, should in zip(
        shown[3 * (y * width + left):3 * (y * width + left + across)], wanted[3 * y * across:3 * (y + 1) * across]))
    return apart / (3 * across * rows)


def shows(screen, pictures):
    left = 0
    for picture in pictures:
        if share_apart(screen, picture, left) > MOST_SHARE:
            return False
        left += picture[0][0]
    return True


if __name__ == "__main__":
    sys.exit(not shows(read_ppm(Path(sys.argv[1])), [read_png(Path(name)) for name in sys.argv[2:]]))
