#!/usr/bin/env bash
# try-bare.sh [--soak] RELEASE...: what ./run does on a fresh Debian (bookworm, trixie), one release after the other.
#
# Makes a minimal system in a temporary folder, clones HEAD into it, runs ./run there, and checks the pictures. The
# first release records ten seconds of the reef; every release must replay them to the same world. On trixie the driver
# of a card that is not there then draws each scene (tests/drivers/drivers.sh; with --soak all drivers do). Prints
# seconds and the world's hash. Needs root and debootstrap: without them it ends with status 77, in CI with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

drivers=
[ "${1:-}" != --soak ] || { drivers=--soak; shift; }
[ $# -gt 0 ] || { echo "usage: packaging/try-bare.sh [--soak] RELEASE..., for example bookworm trixie" >&2; exit 2; }
source packaging/bare_systems.sh

# The first or last (head, tail) second behind which the log has such a line.
second_of() { grep -E "^[0-9]+ $2" "$1" | "$3" -n 1 | cut -d ' ' -f 1; }

try() {
    local release=$1 root=$work/$1 log=$work/$1.log start installed built pictured
    make_system "$release" "$root"
    clone_into "$root"

    start=$(date +%s)
    in_system "$root" './run --frames 3 --snapshot pictures 2>&1 |
        while IFS= read -r line; do printf "%(%s)T %s\n" -1 "$line"; done' >"$log" ||
        { tail -n 30 "$log" >&2; echo "try-bare.sh: ./run failed on $release" >&2; exit 1; }
    installed=$(second_of "$log" configuring head)
    built=$(second_of "$log" 'no display' head)
    pictured=$(stat -c %Y "$root/aquarama/pictures/panorama.png")
    printf '%s: packages %d s, build %d s, first picture %d s\n' "$release" \
        $((installed - start)) $((built - installed)) $((pictured - built))
    python3 packaging/check_pictures.py "$root/aquarama/pictures"
    ! grep -q "species: once on this machine" "$log" ||
        { echo "try-bare.sh: fish are captured on $release although the build has captured them" >&2; exit 1; }

    if [ ! -f "$work/reef.aqrec" ]; then
        in_system "$root" 'build/show/bin/aquarama run --headless --pattern grey --frames 601 --record reef.aqrec' \
            >"$log" 2>&1 || { tail -n 5 "$log" >&2; echo "try-bare.sh: $release cannot record the reef" >&2; exit 1; }
        cp "$root/aquarama/reef.aqrec" "$work/"
    fi
    cp "$work/reef.aqrec" "$root/aquarama/"
    in_system "$root" 'build/show/bin/aquarama replay reef.aqrec --check' >"$log" 2>&1 ||
        { cat "$log" >&2; echo "try-bare.sh: $release replays another world than was recorded" >&2; exit 1; }
    sed "s/^/$release: /" "$log"
    if [ "$release" = trixie ]; then
        in_system "$root" "tests/drivers/drivers.sh $drivers" ||
            { echo "try-bare.sh: a driver does not take what is drawn; see above" >&2; exit 1; }
    fi
    rm -rf --one-file-system "$root"
}

for release in "$@"; do try "$release"; done
