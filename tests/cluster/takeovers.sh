#!/usr/bin/env bash
# A master, its standby and three nodes, each in a network namespace of its own; etcd on the first three machines. The
# master is killed, alone or together with the machine that leads etcd; cables are cut, packets are lost and late.
# Prints a line of figures a case; ends with status 1 where a claim does not hold. Needs no root: user namespaces do.
#   --takeovers N   that many of each kind instead of five; a third kind is a change of master that is ordered
#   --cut S         cables are out for S seconds instead of three
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
exec unshare --user --map-root-user --net --mount --fork --kill-child python3 "$here/takeovers.py" "$@"
