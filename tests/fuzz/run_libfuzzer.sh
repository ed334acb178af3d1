#!/usr/bin/env bash
# run_libfuzzer.sh SECONDS: clang's libFuzzer looks for inputs that break a reader, for so long each, from the files of
# config/ and tests/fuzz/seeds, and what it has found in earlier runs (build/fuzz/corpus). Ends with 1 where one breaks;
# the input lies in build/fuzz.
set -euo pipefail
cd "$(dirname "$0")/../.."
packaging/install-packages.sh packaging/packages/run.txt packaging/packages/test.txt packaging/packages/fuzz.txt
mkdir -p build/fuzz/corpus
cmake -B build/fuzz -G Ninja -DAQUARAMA_TESTS=ON -DAQUARAMA_FUZZ=ON -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS="-g1 -O1 -w -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=vptr" \
    >build/fuzz.log 2>&1 ||
    { cat build/fuzz.log >&2; exit 1; }
cmake --build build/fuzz --target aquarama_fuzzers

seeds() {
    case $1 in
        rig) echo config ;;
        scene) echo config/scenes ;;
        species) echo config/species ;;
        photo | decoder) echo "tests/fuzz/seeds/$1" ;;
    esac
}
for fuzzer in build/fuzz/fuzz/fuzz_*; do
    reader=${fuzzer##*/fuzz_}
    mkdir -p "build/fuzz/corpus/$reader"
    echo "$reader"
    # shellcheck disable=SC2046
    $fuzzer -max_total_time="$1" -artifact_prefix="build/fuzz/$reader-" -print_final_stats=1 -verbosity=0 \
        "build/fuzz/corpus/$reader" $(seeds "$reader") 2>&1 |
        grep -E "ERROR|SUMMARY|number_of_executed_units|new_units_added"
done
