#!/usr/bin/env bash
# One world, whoever computes it: the hash of the reef after 600 ticks with 51 and 1500 scad, all seven species on their
# captured repertoires, must be the same on 1, 2 and 4 threads, in the dev (debug) and show (release) builds, and on
# every instruction set that this machine has. A program that crashes or ends with an error ends this one.
set -euo pipefail
cd "$(dirname "$0")/../.."
export XDG_CACHE_HOME=$PWD/build/dev/cache  # one capture for all

compared=0
for fish in 51 1500; do
    expected=$(build/dev/tests/aquarama_world_hash 1 "$fish" 600 1)
    for preset in dev show; do
        for threads in 1 2 4; do
            for target in SCALAR EMU128 SSSE3 SSE4 AVX2 AVX3; do
                status=0
                hash=$(build/$preset/tests/aquarama_world_hash 1 "$fish" 600 $threads $target 2>build/compare.log) ||
                    status=$?
                [ $status -eq 3 ] && continue  # this machine lacks it
                compared=$((compared + 1))
                [ $status -eq 0 ] && [ "$hash" = "$expected" ] && continue
                cat build/compare.log >&2
                echo "$fish fish: $preset, $threads threads, $target: exit status $status," \
                    "hash \"$hash\", not $expected" >&2
                exit 1
            done
        done
    done
    echo "$fish fish after 600 ticks: $expected everywhere"
done
[ $compared -ge 24 ] || { echo "only $compared worlds could be compared; are both presets built?" >&2; exit 1; }
echo "$compared worlds compared"
