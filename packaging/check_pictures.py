"""check_pictures.py FOLDER: checks that the pictures of a snapshot of config/desk.txtpb exist, have their size and are
not flat"""

import struct
import sys
import zlib
from pathlib import Path

# Width and height of each picture, as config/desk.txtpb gives them.
SIZES = {"panorama": (1350, 600), "hall": (1600, 900), "channel-left": (480, 360), "channel-middle": (480, 360),
         "channel-right": (480, 360)}
# A flat or a torn picture has few colours, the reef tens of thousands.
LEAST_COLOURS = 1000


# The chunks of a PNG file: kind and content. The signature takes 8 bytes, the length, kind and checksum 12.
def chunks(data):
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + length]
        at += length + 12


# The prediction of a byte by a filter method of PNG, from the bytes to the left, above, and above to the left.
def predicted(method, left, up, corner):
    if method == 4:  # Paeth
        guess = left + up - corner
        return min((left, up, corner), key=lambda near: abs(guess - near))
    return (0, left, up, (left + up) // 2)[method]


def read_png(path):
    """The size, and the colours as bytes: 8 bits of red, green and blue, as our programs write them."""
    parts = list(chunks(path.read_bytes()))
    width, height, bits, kind = struct.unpack(">IIBB", parts[0][1][:10])
    if (bits, kind) != (8, 2):
        raise ValueError(f"{bits} bits of kind {kind}, not 8 of red, green and blue")
    packed = zlib.decompress(b"".join(body for name, body in parts if name == b"IDAT"))
    above, rows = bytearray(3 * width), []
    # Each row is the number of its filter method and its bytes, as differences from their predictions.
    for y in range(height):
        method, *row = packed[y * (3 * width + 1):(y + 1) * (3 * width + 1)]
        for x, value in enumerate(row if method else ()):
            left, corner = (row[x - 3], above[x - 3]) if x >= 3 else (0, 0)
            row[x] = (value + predicted(method, left, above[x], corner)) & 255
        above = bytearray(row)
        rows.append(bytes(above))
    return (width, height), b"".join(rows)


# What is wrong with a picture, or None.
def fault_of(path, expected):
    if not path.is_file():
        return "is missing"
    size, pixels = read_png(path)
    if size != expected:
        return f"is {size[0]} x {size[1]}, not {expected[0]} x {expected[1]}"
    colours = len({pixels[i:i + 3] for i in range(0, len(pixels), 3)})
    return f"is flat: {colours} colours" if colours < LEAST_COLOURS else None


def main():
    # Reports all faults at once; the exit status is 0 without any.
    faults = []
    for name, expected in SIZES.items():
        picture = Path(sys.argv[1]) / f"{name}.png"
        if fault := fault_of(picture, expected):
            faults.append(f"{picture}: {fault}")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()
