"""What drivers.sh runs: a live desk of one channel by each driver, and what its logs and shaders must be."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))

from show import BIN, ROOT, aquarama, end, wait_until  # noqa: E402

SHIM = "/usr/lib/x86_64-linux-gnu/libamdgpu_noop_drm_shim.so"
PATIENCE = 300  # seconds: only a hang meets it


def card(name, compiler):
    """What the node's log must say of it, and the environment that brings it, with statistics of each shader."""
    return f"radeonsi, {name}, {compiler}", {"LD_PRELOAD": SHIM, "AMDGPU_GPU_ID": name, "AMD_DEBUG":
                                             "vs,gs,ps,cs,stats" + (",useaco" if compiler == "ACO" else "")}


# AMD's driver has two compilers: which is the usual one depends on the card and on Mesa's release.
CARDS = {"navi21": card("navi21", "ACO"), "navi21-llvm": card("navi21", "LLVM"), "navi31": card("navi31", "LLVM"),
         "renoir": card("renoir", "ACO"), "gfx1150": card("gfx1150", "LLVM")}
DRIVERS = CARDS | {
    "zink": ("zink Vulkan", {"LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": "zink", "ZINK_DEBUG": "validation"}),
    "llvmpipe": ("llvmpipe", {"LIBGL_ALWAYS_SOFTWARE": "1"}),
}
# Each scene once and each tier, in one show that begins at the smallest tier; large scenes at small tiers.
CHANGES = [("scene", "reef_full"), ("scene", "reef"), ("scene", "bait_ball"), ("quality", "medium"),
           ("quality", "high"), ("scene", "empty_sea"), ("quality", "ultra"), ("scene", "reef_1998")]
LEAST_PROGRAMS = 80  # that a show links; fewer, and it was not drawn
# What the drivers of Intel and NVIDIA have for a stage; AMD's has more. OpenGL 4.5 promises 16 textures as well, but
# only 8 storage blocks, in fragment and compute shaders alone.
MOST_STORAGE_BLOCKS, MOST_TEXTURES = 16, 16
STAGES = {"vertex": "vert", "tessellation control": "tesc", "tessellation evaluation": "tese", "geometry": "geom",
          "fragment": "frag", "compute": "comp"}


def complaints(log, renderer, is_card):
    """What is wrong with the log of a show, a line each."""
    found = [] if renderer in log else [f"the node did not draw with {renderer}"]
    found += [line for line in log.splitlines() if re.search(r"OpenGL: |\[error\]|VUID-|MESA: error", line)]
    spilled = [int(registers) for registers in re.findall(r"Spilled VGPRs: (\d+)", log)]
    if is_card and len(spilled) < LEAST_PROGRAMS:
        found.append(f"shaders that were compiled: {len(spilled)}; the show was not drawn")
    if any(spilled):
        found.append(f"{sum(map(bool, spilled))} shaders spill vector registers, {max(spilled)} at most")
    return found


def shaders_in(captured):
    """(stage, text) of each shader in a program that Mesa has captured."""
    parts = re.split(r"^\[([a-z ]+) shader\]\n", captured, flags=re.M)
    return list(zip(parts[1::2], parts[2::2]))


def uses_of(shader):
    """How many storage blocks and textures it declares; an array counts as its elements."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", shader, flags=re.S)
    blocks = len(re.findall(r"\bbuffer\s+\w+\s*\{", text))
    textures = sum(int(size or 1) for size in
                   re.findall(r"\buniform\s+(?:\w+\s+)?[iu]?(?:sampler|image)\w+\s+\w+\s*(?:\[(\d+)\])?\s*;", text))
    return blocks, textures


def check_shaders(folder):
    """Prints how many there are; returns what is wrong with them."""
    shaders = {pair for program in folder.glob("*.shader_test") for pair in shaders_in(program.read_text())}
    found, most = [], (0, 0)
    with tempfile.TemporaryDirectory() as split:
        for number, (stage, text) in enumerate(sorted(shaders)):
            Path(split, f"{number}.{STAGES[stage]}").write_text(text)
            uses = uses_of(text)
            most = tuple(map(max, most, uses))
            if uses[0] > MOST_STORAGE_BLOCKS or uses[1] > MOST_TEXTURES:
                found.append(f"a {stage} shader uses {uses[0]} storage blocks and {uses[1]} textures")
        files = sorted(map(str, Path(split).iterdir()))
        said = subprocess.run(["glslangValidator", *files], capture_output=True, text=True) if files else None
    if said and said.returncode:
        found += [line for line in said.stdout.splitlines() if "ERROR" in line][:20] or [f"glslangValidator: {said}"]
    programs = len(list(folder.glob("*.shader_test")))
    if programs < LEAST_PROGRAMS:
        found.append(f"programs that were linked: {programs}; the show was not drawn")
    counts = Counter(stage for stage, _ in shaders)
    print("  " + ", ".join(f"{count} {stage}" for stage, count in sorted(counts.items())) + " shaders in "
          f"{programs} programs; at most {most[0]} storage blocks and {most[1]} textures a stage")
    return found


class Desk:
    """A live show of one channel."""

    def __init__(self, folder, environment, scene):
        self.rig, self.log, self.shown = folder / "one.txtpb", folder / "log", {"scene": scene, "quality": "low"}
        shutil.copytree(ROOT / "config/scenes", folder / "scenes")
        shutil.copytree(ROOT / "config/species", folder / "species")
        wall = "--screen flat --count 1 --windows --width 4 --height 3 --distance 3 --throw 1".split()
        aquarama("new-rig", *wall, "--scene", f"scenes/{scene}.txtpb", self.rig)
        with self.log.open("w") as log:
            self.process = subprocess.Popen([BIN / "aquarama", "run", self.rig, "--headless", "--live", "--quality",
                                             "low"], stdout=log, stderr=subprocess.STDOUT,
                                            env=os.environ | environment, cwd=ROOT)

    def is_shown(self):
        """The node is in step with what was set."""
        if self.process.poll() is not None or "ended with status" in self.log.read_text():
            raise AssertionError("the show, or its node, has ended:\n" + self.log.read_text()[-1000:])
        status = aquarama("status", self.rig).stdout
        return (re.search("scene {scene} +quality {quality} ".format(**self.shown), status) and " in step" in status
                and "to come " not in status)

    def await_shown(self):
        wait_until(self.is_shown, PATIENCE, f"{self.shown} to be shown")

    def show(self, what, value):
        self.shown[what] = value
        said = aquarama("set", self.rig, what, value)
        if said.returncode:
            raise AssertionError(said.stdout + said.stderr)
        self.await_shown()


def try_driver(name):
    """Shows all scenes and tiers; returns what is wrong."""
    renderer, environment = DRIVERS[name]
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        captured = folder / "captured"
        captured.mkdir()
        first, *changes = CHANGES
        desk = Desk(folder, environment | {"MESA_SHADER_CAPTURE_PATH": str(captured),
                                           "MESA_SHADER_CACHE_DIR": str(folder / "cache"),
                                           "XDG_STATE_HOME": str(folder)}, first[1])
        found = []
        try:
            desk.await_shown()
            for what, value in changes:
                desk.show(what, value)
        except AssertionError as problem:
            found.append(str(problem))
        finally:
            end([desk.process], 30)
        log = desk.log.read_text()
        found += complaints(log, renderer, name in CARDS)
        scenes = 1 + sum(what == "scene" for what, _ in changes)
        print(f"{name}: {scenes} scenes, 4 tiers in {time.monotonic() - begun:.0f} s", flush=True)
        if name in CARDS:
            scalar = [int(registers) for registers in re.findall(r"Spilled SGPRs: (\d+)", log)]
            print(f"  {len(scalar)} compiled; {sum(map(bool, scalar))} spill scalar registers, "
                  f"{max(scalar, default=0)} at most")
        found += check_shaders(captured)
    for problem in found:
        print(f"  WRONG: {problem}", flush=True)
    return found


# 60, 380, 2400, 100 000 and 250 000 fish. The driver without a card has memory for the three channels of a theatre
# and not for eight of 4K, and gives none back: one call for each.
TIMED = [f"theatre/{sea}/high"
         for sea in ("reef_1998", "reef", "bait_ball_2400", "bait_ball_100000", "bait_ball_250000")]


def print_time(wall):
    """The processor's time of a frame by stage, with a card that takes none; returns what is wrong."""
    with tempfile.TemporaryDirectory() as temporary:
        said = subprocess.run([BIN / "aquarama_gpu_bench", "--out", temporary, "--only", wall], capture_output=True,
                              text=True, cwd=ROOT, env=os.environ | DRIVERS["navi21"][1])
    shown = False
    for line in said.stdout.splitlines():
        if frame := re.match(r"(gpu/\S+) +frame .*cpu +(\S+) ms", line):
            print(f"{frame[1]}: {frame[2]} ms of the processor a frame", flush=True)
            shown = True
        elif stage := re.match(r" +(.+?) +\S+ ms, without pixels .*; cpu +(\S+);", line):
            print(f"    {stage[1]:<14} {stage[2]} ms")
    return [] if shown and said.returncode == 0 else [f"{wall} was not timed: {said.stderr[-500:]}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--soak", action="store_true", help="all drivers, not the first alone, and times")
    parser.add_argument("--only", nargs="+", choices=DRIVERS, help="these drivers")
    options = parser.parse_args()
    names = options.only or (list(DRIVERS) if options.soak else ["navi21"])
    found = sum((try_driver(name) for name in names), [])
    if options.soak:
        times = sum((print_time(wall) for wall in TIMED), [])
        for problem in times:
            print(f"WRONG: {problem}")
        found += times
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
