#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads repertoires (.aqrep) and recordings (.aqrec) of Aquarama with numpy alone: docs/files.md says what is in them.

    python3 read_files.py FILE                        says what it holds
    from read_files import read_recording, read_repertoire
"""
import hashlib
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

REPERTOIRE_VERSION = 6
RECORDING_VERSIONS = (2, 3)
PHASES, NODES, FINS, CONTROL_POINTS = 64, 23, 2, 426
POSE_UNIT = 1 / 32767  # body lengths
FIN_UNIT = 1e-4  # radians
GAITS = ("slow", "medium", "fast")
CURVES = [f"curve_{side}_{width}" for side in ("left", "right") for width in ("wide", "tight")]
IN_PLACE = ["hover", "pivot_left", "pivot_right", "pitch_up", "pitch_down"]
TURNS = [f"turn_{side}_{kind}" for side in ("left", "right") for kind in ("gradual", "sharp")]
STARTS = [f"start_{side}_{angle}" for side in ("left", "right") for angle in ("small", "middle", "large")]
SEGMENTS = [f"{motion}_{gait}" for motion in ("forward", *CURVES, "climb", "dive")
            for gait in GAITS] + ["retreat", *IN_PLACE, *TURNS, *STARTS]
ENTRIES = dict.fromkeys(TURNS, 40) | dict.fromkeys(STARTS, 17)
HAS_CONTROL_POINTS, HAS_ENTRIES = 1, 2


class Bytes:
    """Little-endian numbers, one after another."""

    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, count):
        if self.at + count > len(self.content):
            raise ValueError("the file ends too early")
        self.at += count
        return self.content[self.at - count:self.at]

    def number(self, code):
        return struct.unpack("<" + code, self.take(struct.calcsize(code)))[0]

    def array(self, code, *shape):
        return np.frombuffer(self.take(np.dtype(code).itemsize * int(np.prod(shape))), "<" + code).reshape(shape)


def read_repertoire(content):
    """The bytes or the path of a repertoire, as a dictionary; lengths in body lengths."""
    if not isinstance(content, bytes):
        content = Path(content).read_bytes()
    file = Bytes(content)
    if file.take(5) != b"AQREP":
        raise ValueError("this is no repertoire")
    version, length = file.number("H"), file.number("I")
    if version != REPERTOIRE_VERSION:
        raise ValueError(f"a repertoire of version {version}; this reader knows version {REPERTOIRE_VERSION}")
    if length != len(content) or hashlib.sha256(content[:-32]).digest() != content[-32:]:
        raise ValueError("this repertoire is altered or cut off")
    repertoire = {"species": file.take(file.number("B")).decode(), "length_m": file.number("f")}
    drags = ("swim_drag_slow", "swim_drag_medium", "swim_drag_fast", "retreat_drag", "glide_drag", "brake_rate")
    repertoire["response"] = {name: file.number("f") for name in drags}
    contents = file.take(len(SEGMENTS))
    repertoire["segments"] = {}
    for name, has in zip(SEGMENTS, contents):
        segment = {"period_s": file.number("f"), "plays_to_end": bool(file.number("B")),
                   "increments": file.array("f4", PHASES, 7)}  # a rotation w x y z, a translation x y z
        if has & HAS_ENTRIES:
            # Course before x y z, speed before, course after x y z, speed after; then the increments.
            paths = file.array("f4", ENTRIES[name], 8 + PHASES * 7)
            segment["entries"], segment["entered"] = paths[:, :8], paths[:, 8:].reshape(-1, PHASES, 7)
        segment["nodes"] = POSE_UNIT * file.array("i2", PHASES, NODES, 3)
        segment["fins"] = FIN_UNIT * file.array("i2", PHASES, FINS, 3)  # left, right: opened, stroke, twist
        if has & HAS_CONTROL_POINTS:
            segment["control_points"] = POSE_UNIT * file.array("i2", PHASES, CONTROL_POINTS, 3)
        repertoire["segments"][name] = segment
    return repertoire


def rotated(q, v):
    """A vector by a quaternion w x y z."""
    return v + 2 * np.cross(q[1:], np.cross(q[1:], v) + q[0] * v)


def path_of(increments):
    """Where the body frame is at each phase and at the end of a cycle, from the origin along +x: 65 places."""
    place, turn = np.zeros(3), np.array([1.0, 0, 0, 0])
    places = [place]
    for step in increments.astype(float):
        place = place + rotated(turn, step[4:])
        w, x = turn[0], turn[1:]
        turn = np.concatenate(([w * step[0] - x @ step[1:4]], w * step[1:4] + step[0] * x + np.cross(x, step[1:4])))
        places.append(place)
    return np.array(places)


def fields(message):
    """The fields of a protobuf message, as (number, value): whole numbers, or the bytes of everything else."""
    file = Bytes(message)

    def varint():
        value = shift = 0
        while True:
            byte = file.number("B")
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while file.at < len(message):
        key = varint()
        kind = key & 7
        yield key >> 3, varint() if kind == 0 else file.take({1: 8, 5: 4}.get(kind) or varint())


def entries(content):
    """The messages of a recording, each behind its length, and whether each is whole: from version 3 on it has a
    checksum in its last five bytes. One that was being written at the end is left out."""
    at = 0
    while at < len(content):
        length = shift = 0
        while at < len(content):
            byte = content[at]
            at, length, shift = at + 1, length | (byte & 0x7F) << shift, shift + 7
            if byte < 0x80:
                break
        message = content[at:at + length]
        if len(message) < length:
            return
        yield message, message[-4:] == struct.pack("<I", zlib.crc32(message[:-5]))
        at += length


def signed(value):
    """Of a whole number that may be negative (sint32: zigzag)."""
    return value >> 1 ^ -(value & 1)


def floats(message, count):
    """The first `count` fields as numbers; those left out are 0."""
    found = dict(fields(message))
    return np.array([struct.unpack("<f", found.get(i + 1, bytes(4)))[0] for i in range(count)])


def input_of(message):
    """A tick, a name, and what goes with it."""
    found = dict(fields(message))
    tick = found.get(1, 0)
    if 2 in found:
        return tick, "food", {"place_m": floats(found[2], 3), "pellets": dict(fields(found[2])).get(4, 0)}
    if 3 in found:
        numbers = floats(found[3], 6)
        return tick, "submarine", {"place_m": numbers[:3], "velocity_m_s": numbers[3:]}
    axes = dict(fields(found.get(4, b"")))
    return tick, "steering", {name: signed(axes.get(i + 1, 0))
                              for i, name in enumerate(("ahead", "aside", "up", "turn", "tilt"))}


def read_recording(content):
    """The bytes or the path of a recording, as a dictionary. Repertoires stay bytes, for read_repertoire()."""
    if not isinstance(content, bytes):
        content = Path(content).read_bytes()
    messages = entries(content)
    header = dict(fields(dict(fields(next(messages, (b"",))[0])).get(1, b"")))
    if header.get(1) != b"AQREC":
        raise ValueError("this is no recording")
    if header.get(2) not in RECORDING_VERSIONS:
        raise ValueError(f"a recording of version {header.get(2)}; this reader knows {RECORDING_VERSIONS}")
    recording = {"protocol": header[3], "build": header[4].decode(), "seed": header[5], "scene": header[6].decode(),
                 "species": [], "inputs": [], "hashes": [], "is_whole": False}
    for message, is_whole in messages:
        if not is_whole and header[2] > 2:
            break
        kind, part = next(fields(message))
        if kind == 2:
            species = dict(fields(part))
            recording["species"].append({"file": species[1].decode(), "text": species[2].decode(),
                                         "repertoire": species[3], "fish": species.get(4, 0)})
        elif kind == 3:
            recording["inputs"].append(input_of(part))
        elif kind in (4, 5):
            found = dict(fields(part))
            digest = found[2] if isinstance(found[2], int) else struct.unpack("<Q", found[2])[0]
            recording["hashes"].append((found.get(1, 0), digest))
            recording["is_whole"] = kind == 5
    return recording


def describe_repertoire(repertoire):
    print(f"repertoire of {repertoire['species']}, recorded at {repertoire['length_m']:.3f} m")
    for name, segment in repertoire["segments"].items():
        places = path_of(segment["increments"])
        stride = np.linalg.norm(places[-1] - places[0])
        print(f"  {name:<24} {segment['period_s']:.4f} s  {stride / segment['period_s']:.3f} BL/s  {stride:.3f} BL")


def describe_recording(recording):
    print(
        f"recording by {recording['build']}, seed {recording['seed']}, "
        f"{'whole' if recording['is_whole'] else 'cut short'}")
    for species in recording["species"]:
        print(f"  {species['fish']} of {read_repertoire(species['repertoire'])['species']}")
    for tick, what, values in recording["inputs"][:20]:
        print(f"  tick {tick}: {what} {values}")
    print(f"  {len(recording['inputs'])} inputs")
    for tick, digest in recording["hashes"]:
        print(f"  tick {tick}: hash {digest:016x}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    file_content = Path(sys.argv[1]).read_bytes()
    try:
        if file_content.startswith(b"AQREP"):
            describe_repertoire(read_repertoire(file_content))
        else:
            describe_recording(read_recording(file_content))
    except ValueError as problem:
        sys.exit(f"{sys.argv[1]}: {problem}")
