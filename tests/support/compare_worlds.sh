#!/usr/bin/env bash
# One world, whoever computes it: the hash of the reef of 1998 with 51 and 1500 scad, and of reef_full with all its
# species, on their captured repertoires, must be the same on 1, 2 and 4 threads, in the dev (debug) and show (release)
# builds, and on every instruction set that this machine has. A program that crashes or ends with an error ends this
# one.
set -euo pipefail
cd "$(dirname "$0")/../.."
export XDG_CACHE_HOME=$PWD/build/dev/cache  # one capture for all

compared=0
for what in "reef_1998 51 4200" "reef_1998 1500 1200" "reef_full 290 600"; do  # scene, scad, ticks
    read -ra world <<<"$what"
    expected=$(build/dev/tests/aquarama_world_hash "${world[@]}" 1)
    for preset in dev show; do
        for threads in 1 2 4; do
            for target in SCALAR EMU128 SSSE3 SSE4 AVX2 AVX3; do
                status=0
                hash=$(build/$preset/tests/aquarama_world_hash "${world[@]}" $threads $target 2>build/compare.log) ||
                    status=$?
                [ $status -eq 3 ] && continue  # this machine lacks it
                compared=$((compared + 1))
                [ $status -eq 0 ] && [ "$hash" = "$expected" ] && continue
                cat build/compare.log >&2
                echo "${world[*]}: $preset, $threads threads, $target: exit status $status," \
                    "hash \"$hash\", not $expected" >&2
                exit 1
            done
        done
    done
    echo "${world[0]} with ${world[1]} scad after ${world[2]} ticks: $expected everywhere"
done
[ $compared -ge 36 ] || { echo "only $compared worlds could be compared; are both presets built?" >&2; exit 1; }
echo "$compared worlds compared"
