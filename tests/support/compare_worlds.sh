#!/usr/bin/env bash
# One world, whoever computes it: the hash of the reef of 1998 with 51 and 1500 scad, and of reef_full with all its
# species, on their captured repertoires, must be the same on 1, 2 and 4 threads, in the dev (debug) and show (release)
# builds, and on every instruction set that this machine has. A program that crashes or ends with an error ends this
# one.
set -euo pipefail
cd "$(dirname "$0")/../.."
export XDG_CACHE_HOME=$PWD/build/dev/cache  # one capture for all

# same EXPECTED SCENE SCAD TICKS PRESET THREADS TARGET: prints a line where the hash is the expected one, and none where
# this machine lacks the instruction set. Anything else ends all.
same() {
    local world=("${@:2:3}") hash status=0 log=build/compare.$$.log
    hash=$("build/$5/tests/aquarama_world_hash" "${world[@]}" "$6" "$7" 2>"$log") || status=$?
    if [ $status -ne 3 ] && [ "$status $hash" != "0 $1" ]; then
        cat "$log" >&2
        echo "${world[*]}: $5, $6 threads, $7: exit status $status, hash \"$hash\", not $1" >&2
        return 255
    fi
    rm "$log"
    [ $status -eq 3 ] || echo "$hash"
}
export -f same

compared=0
for what in "reef_1998 51 4200" "reef_1998 1500 1200" "reef_full 290 600"; do  # scene, scad, ticks
    read -ra world <<<"$what"
    expected=$(build/dev/tests/aquarama_world_hash "${world[@]}" 1)
    hashes=$(printf "$expected $what %s\n" {dev,show}\ {1,2,4}\ {SCALAR,EMU128,SSSE3,SSE4,AVX2,AVX3} |
        xargs -P "$(nproc)" -L 1 bash -c 'same "$@"' same)
    compared=$((compared + $(wc -l <<<"$hashes")))
    echo "${world[0]} with ${world[1]} scad after ${world[2]} ticks: $expected everywhere"
done
[ $compared -ge 36 ] || { echo "only $compared worlds could be compared; are both presets built?" >&2; exit 1; }
echo "$compared worlds compared"
