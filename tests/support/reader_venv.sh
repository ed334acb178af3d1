#!/usr/bin/env bash
# Gets programs of others that read what `aquarama export` writes, into build/readers: the tests of the export use them
# where they are there. Soft: without pip or a network those tests are skipped, and say so.
set -uo pipefail
cd "$(dirname "$0")/../.."

readers=build/readers
[ -d "$readers/ezc3d" ] && [ -d "$readers/c3d" ] && exit 0
if ! python3 -m pip install --quiet --disable-pip-version-check --no-input --root-user-action=ignore --target "$readers" ezc3d==1.7.2 c3d==0.6.0; then
    echo "NOTE: no ezc3d and c3d (pip or the network is missing): C3D files are not checked with readers of others" >&2
fi
exit 0
