#!/usr/bin/env bash
# try-bare.sh RELEASE...: what ./run does on a fresh Debian (bookworm, trixie), one release after the other.
#
# Makes a minimal system in a temporary folder, clones HEAD into it, runs ./run there, and checks the pictures. The first
# release records ten seconds of the reef; every release must replay them to the same world. Prints seconds and the
# world's hash. Needs root and debootstrap: without them it ends with status 77, in CI with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

[ $# -gt 0 ] || { echo "usage: packaging/try-bare.sh RELEASE..., for example bookworm trixie" >&2; exit 2; }
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
    echo "SKIPPED: a bare Debian needs root, and the packages of packaging/packages/bare.txt" >&2
    [ -z "${CI:-}" ] && exit 77 || exit 1
fi

cache=${XDG_CACHE_HOME:-$HOME/.cache}/aquarama
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Label: Debian" "Created-By: Packages" | head -n 1)
[ -n "$mirror" ] || { echo "try-bare.sh: apt knows no Debian mirror; run apt-get update" >&2; exit 1; }

work=$(mktemp -d /var/tmp/aquarama-bare.XXXXXX)
inside=
clean_up() {
    [ -z "$inside" ] || { kill -KILL "$inside" 2>/dev/null || true; wait "$inside" 2>/dev/null || true; }
    rm -f "$cache/bare.$$.part"
    for _ in 1 2 3 4 5; do  # who is being killed may still write
        rm -rf --one-file-system "$work" 2>/dev/null && break
        sleep 0.5
    done
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# apart COMMAND...: with processes and mounts of its own, which end with it; in the background, so that traps are heard.
apart() {
    local status=0
    unshare --mount --pid --fork --kill-child "$@" &
    inside=$!
    wait "$inside" || status=$?
    inside=
    return $status
}

# make_system RELEASE ROOT: a minimal system, debootstrapped once and then kept as an archive.
make_system() {
    local kept=$cache/bare-$1.tar log=$work/debootstrap.log
    mkdir -p "$cache" "$2"
    chmod 755 "$work" "$2"  # apt downloads as a user of its own
    if [ ! -f "$kept" ]; then
        apart debootstrap --variant=minbase --include=ca-certificates "$1" "$2" "$mirror" >"$log" 2>&1 ||
            { tail -n 5 "$log" >&2; echo "try-bare.sh: no system of release $1 could be made" >&2; exit 1; }
        tar -C "$2" -cf "$cache/bare.$$.part" . && mv "$cache/bare.$$.part" "$kept"
    else
        tar -C "$2" -xf "$kept"
    fi
    # How this machine reaches its mirror.
    cp -r /etc/apt/apt.conf.d /etc/apt/auth.conf.d "$2/etc/apt/"
    cp -L /etc/resolv.conf /etc/hosts "$2/etc/"
}

# in_system ROOT COMMAND: as root, in the clone.
in_system() {
    apart bash -c '
        mount -t proc proc "$1/proc"
        mount --rbind /sys "$1/sys"
        mount --rbind /dev "$1/dev"
        exec chroot "$1" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
            bash -o pipefail -c "cd /aquarama && $2"
    ' bash "$@"
}

# The first or last (head, tail) second behind which the log has such a line.
second_of() { grep -E "^[0-9]+ $2" "$1" | "$3" -n 1 | cut -d ' ' -f 1; }

try() {
    local release=$1 root=$work/$1 log=$work/$1.log start installed built pictured
    make_system "$release" "$root"
    git clone --quiet --no-local "$PWD" "$root/aquarama"
    git -C "$root/aquarama" checkout --quiet --detach "$commit"

    start=$(date +%s)
    in_system "$root" './run --frames 3 --snapshot pictures 2>&1 |
        while IFS= read -r line; do printf "%(%s)T %s\n" -1 "$line"; done' >"$log" ||
        { tail -n 30 "$log" >&2; echo "try-bare.sh: ./run failed on $release" >&2; exit 1; }
    installed=$(second_of "$log" configuring head)
    built=$(second_of "$log" '\[[0-9]+/[0-9]+\]' tail)
    pictured=$(stat -c %Y "$root/aquarama/pictures/panorama.png")
    printf '%s: packages %d s, build %d s, first picture %d s\n' "$release" \
        $((installed - start)) $((built - installed)) $((pictured - built))
    python3 packaging/check_pictures.py "$root/aquarama/pictures"

    if [ ! -f "$work/reef.aqrec" ]; then
        in_system "$root" 'build/show/bin/aquarama run --headless --pattern grey --frames 601 --record reef.aqrec' \
            >"$log" 2>&1 || { tail -n 5 "$log" >&2; echo "try-bare.sh: $release cannot record the reef" >&2; exit 1; }
        cp "$root/aquarama/reef.aqrec" "$work/"
    fi
    cp "$work/reef.aqrec" "$root/aquarama/"
    in_system "$root" 'build/show/bin/aquarama replay reef.aqrec --check' >"$log" 2>&1 ||
        { cat "$log" >&2; echo "try-bare.sh: $release replays another world than was recorded" >&2; exit 1; }
    sed "s/^/$release: /" "$log"
    rm -rf --one-file-system "$root"
}

commit=$(git rev-parse HEAD)  # the same for all, whatever is committed meanwhile
for release in "$@"; do try "$release"; done
