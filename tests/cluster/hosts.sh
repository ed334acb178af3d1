#!/usr/bin/env bash
# A wall of four machines, each a network namespace of its own with a cable to one switch: starts, cuts, losses, delays,
# other addresses, keys. Prints a line of figures a case; ends with status 1 where a claim does not hold. Needs no root:
# user namespaces do.
#   --long       cuts of ten seconds instead of two, nodes hurt for an hour instead of half a minute, 1000 starts
#                instead of 50
#   --starts N   that many starts
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
exec unshare --user --map-root-user --net --mount --fork --kill-child python3 "$here/hosts.py" "$@"
