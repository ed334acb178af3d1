#!/usr/bin/env bash
# Gets into build/tools, by pip, what must not differ from release to release: the formatter, the meter of functions,
# and programs of others that read what `aquarama export` writes. Without pip or a network what needs them is skipped,
# and says so; in CI that fails.
set -uo pipefail
cd "$(dirname "$0")/../.."

tools=build/tools
[ -d "$tools/ezc3d" ] && [ -d "$tools/c3d" ] && [ -d "$tools/clang_format" ] && [ -f "$tools/lizard.py" ] && exit 0
python3 -m pip install --quiet --disable-pip-version-check --no-input --root-user-action=ignore --upgrade \
    --target "$tools" clang-format==14.0.6 ezc3d==1.7.2 c3d==0.6.0 lizard==1.24.3 && exit 0
echo "SKIPPED: no clang-format, lizard, ezc3d and c3d (pip or the network is missing):" \
    "layout, sizes of functions and C3D files are not checked" >&2
[ -z "${CI:-}" ]
