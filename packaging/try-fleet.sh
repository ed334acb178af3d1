#!/usr/bin/env bash
# try-fleet.sh RELEASE...: the roles of packaging/ansible on three fresh systems of a release, one after the other, with
# the packages that packaging/try-packages.sh has left in build/debs/RELEASE/now. A second run must change nothing.
# Needs root and debootstrap: without them it ends with status 77, in CI with 1.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ $# -eq 0 ]; then
    echo "usage: packaging/try-fleet.sh RELEASE..., for example bookworm trixie" >&2
    exit 2
fi
source packaging/bare_systems.sh

declare -A channels=([192.168.7.1]=middle [left-pc]=left [right-pc]=right)
playbook=/aquarama/packaging/ansible/site.yml

# roll_out MACHINE: the playbook for this machine, in its own system.
roll_out() {
    logged "the roles fail on $1" "$work/$release-$1" \
        "cd /fleet && ansible-playbook -i hall.json -c local --limit $1 -e ansible_become=false $playbook"
}

for release in "$@"; do
    debs=build/debs/$release/now
    [ -d "$debs" ] || fail "no packages in $debs; run packaging/try-packages.sh $release first"
    first=$work/$release-192.168.7.1
    make_system "$release" "$first"
    clone_into "$first"
    mkdir -p "$first"/fleet/{debs,keys}
    cp "$debs"/*.deb "$first/fleet/debs"
    touch "$first"/fleet/keys/{left,right}.key
    logged "Ansible cannot be installed" "$first" \
        "apt-get update -q && apt-get install -y -q --no-install-recommends ansible-core python3-apt systemd &&
        apt-get install -y -q --no-install-recommends /fleet/debs/aquarama_*.deb"
    logged "the rig has no inventory" "$first" "cd /fleet &&
        sed 's#//127.0.0.1#//192.168.7.1#; s#name: \"\(left\|right\)\"#& machine: \"\1-pc\"#' \
            /usr/share/aquarama/config/theatre.txtpb >hall.txtpb && aquarama rig inventory hall.txtpb >hall.json"
    for machine in left-pc right-pc; do cp -a "$first" "$work/$release-$machine"; done
    for machine in 192.168.7.1 left-pc right-pc; do
        roll_out "$machine"
        systemd=$work/$release-$machine/etc/systemd/system
        find "$systemd" -name "aquarama-node@${channels[$machine]}.service" | grep -q . ||
            fail "$machine does not start its node"
        roll_out "$machine"
        grep -q "^$machine .* changed=0 " "$work/log" || { cat "$work/log" >&2; fail "a second run changes $machine"; }
        echo "$release: $machine is set up, and a second run changes nothing"
    done
    rm -rf --one-file-system "$work/$release"-*
done
