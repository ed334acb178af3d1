#!/usr/bin/env bash
# One world, whoever computes it: its hash after 600 ticks for 51 and 1500 fish must be the same on 1, 2 and 4 threads,
# in the dev (debug) and show (release) builds, and on every instruction set that this machine has.
set -euo pipefail
cd "$(dirname "$0")/../.."

compared=0
for fish in 51 1500; do
    expected=$(build/dev/tests/aquarama_world_hash 1 "$fish" 600 1)
    for preset in dev show; do
        for threads in 1 2 4; do
            for target in SCALAR EMU128 SSSE3 SSE4 AVX2 AVX3; do
                hash=$(build/$preset/tests/aquarama_world_hash 1 "$fish" 600 $threads $target 2>/dev/null) || continue
                compared=$((compared + 1))
                [ "$hash" = "$expected" ] && continue
                echo "$fish fish: $preset, $threads threads, $target have $hash, not $expected" >&2
                exit 1
            done
        done
    done
    echo "$fish fish after 600 ticks: $expected everywhere"
done
[ $compared -ge 24 ] || { echo "only $compared worlds could be compared; are both presets built?" >&2; exit 1; }
echo "$compared worlds compared"
