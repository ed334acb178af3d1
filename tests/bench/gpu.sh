#!/usr/bin/env bash
# Builds the measure of graphics cards, makes build/gpu-bench.tar.gz of it, and runs it here; arguments go to it (--help
# lists them). The bundle runs on any x86-64 Linux with a driver, without packages or a network: unpack it and run
# gpu-bench/measure. Figures and pictures are written to build/gpu. Without a graphics card: "no GPU here", status 77.
set -euo pipefail
cd "$(dirname "$0")/../.."

mostBytes=60000000
bundle=build/gpu-bench

mkdir -p build
{ cmake --preset show-tests && cmake --build --preset show-tests --target aquarama_gpu_bench; } >build/gpu.log 2>&1 ||
    { cat build/gpu.log >&2; exit 1; }
program=build/show/bin/aquarama_gpu_bench

# The files of the libraries that these need, but for the C library, which belongs to the machine.
libraries_of() {
    ldd "$@" | awk '$3 ~ /^\// { print $3 }' | sort -u |
        grep -Ev '/(libc|libm|libdl|librt|libpthread|libresolv|libutil|libmvec)\.so\.' || true
}
is_cxx='/(libstdc\+\+|libgcc_s)\.so\.'

rm -rf $bundle
mkdir -p $bundle/{bin,lib/cxx,lib/gl,data/tests/bench/gpu}
strip -o $bundle/bin/aquarama_gpu_bench $program
own=$(libraries_of $program)
cp -L $(grep -Ev "$is_cxx" <<<"$own") $bundle/lib
cp -L $(grep -E "$is_cxx" <<<"$own") $bundle/lib/cxx
dispatch=$(/sbin/ldconfig -p | awk '/lib(EGL|GL|OpenGL)\.so\.[01] .*x86-64/ { print $NF }')
cp -L $dispatch $(libraries_of $dispatch) $bundle/lib/gl
cp -r config $bundle/data
cp -r tests/golden $bundle/data/tests
cp tests/bench/gpu/eight_4k.txtpb $bundle/data/tests/bench/gpu
cp tests/bench/gpu/measure $bundle
echo '{ "file_format_version": "1.0.0", "ICD": { "library_path": "libEGL_nvidia.so.0" } }' >$bundle/10_nvidia.json
tar -C build -czf $bundle.tar.gz gpu-bench

bytes=$(du -sb $bundle | cut -f1)
printf '%s.tar.gz: %d MB, unpacked %d MB\n' $bundle $(($(stat -c %s $bundle.tar.gz) / 1000000)) $((bytes / 1000000))
if [ "$bytes" -gt $mostBytes ]; then
    echo "$bundle: more than $((mostBytes / 1000000)) MB; see what is large in it" >&2
    exit 1
fi

exec $bundle/measure "$@"
