#!/usr/bin/env bash
# drivers.sh [--soak]: OpenGL drivers of cards that are not there compile and check all that a node draws.
#
# For Debian 13. Its mesa-drm-shim starts AMD's driver without a card: shaders are compiled by the real compiler, and
# all calls are checked, but nothing is executed, so pictures stay black. A desk of one channel shows each scene once
# and each tier on a Radeon RX 6800 (NAVI21). Demanded are: no message of OpenGL, no vector register spilled, shaders
# that Khronos' glslang takes too, and no more storage blocks and textures a stage than other drivers have.
#   --soak       the same with the driver's other compiler, on integrated graphics of two generations, on a Radeon RX
#                7900, on Vulkan by zink with its validation layers, and on llvmpipe; then the processor's time of a
#                frame by stage, for 60 to 250 000 fish (needs the packages of test.txt, and builds the bench)
#   --only NAME  one of these: --help lists them
# Ends with status 1 where a claim does not hold. Where there are no such drivers: with 77, in CI with 1.
set -euo pipefail
cd "$(dirname "$0")/../.."
shim=/usr/lib/x86_64-linux-gnu/libamdgpu_noop_drm_shim.so
if [ ! -e $shim ]; then
    packaging/install-packages.sh packaging/packages/drivers.txt 2>/dev/null || true
fi
if [ ! -e $shim ]; then
    echo "SKIPPED: no drivers without cards here; they need Debian 13, packaging/packages/drivers.txt" >&2
    [ -z "${CI:-}" ] && exit 77 || exit 1
fi
if [ "${1:-}" = --soak ] && [ ! -x "${AQUARAMA_BIN:-build/show/bin}/aquarama_gpu_bench" ]; then
    packaging/install-packages.sh packaging/packages/test.txt
    cmake --preset show-tests >/dev/null
    cmake --build --preset show-tests --target aquarama_gpu_bench >/dev/null
fi
export AQUARAMA_BIN=${AQUARAMA_BIN:-$PWD/build/show/bin}
exec python3 tests/drivers/drivers.py "$@"
