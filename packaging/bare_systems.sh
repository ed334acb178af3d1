# Sourced by packaging/try-*.sh: minimal Debian systems in the temporary folder $work, which goes when the script ends.
#
# Needs root and debootstrap: without them the script ends with status 77, in CI with 1. A release is debootstrapped
# once and then kept as an archive in the user's cache.

if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
    echo "SKIPPED: a bare Debian needs root, and the packages of packaging/packages/bare.txt" >&2
    [ -z "${CI:-}" ] && exit 77 || exit 1
fi

cache=${XDG_CACHE_HOME:-$HOME/.cache}/aquarama
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Label: Debian" "Created-By: Packages" | head -n 1)
[ -n "$mirror" ] || { echo "$(basename "$0"): apt knows no Debian mirror; run apt-get update" >&2; exit 1; }

# What QEMU emulates where it does: no AVX, since programs that llvmpipe had compiled for that of QEMU 7.2 crashed.
emulated_processor=max,avx=off,avx2=off,f16c=off,fma=off

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
            { tail -n 5 "$log" >&2; echo "$(basename "$0"): no system of release $1 could be made" >&2; exit 1; }
        tar -C "$2" -cf "$cache/bare.$$.part" . && mv "$cache/bare.$$.part" "$kept"
    else
        tar -C "$2" -xf "$kept"
    fi
    packaging/take-over-mirror.sh "$2/etc/apt"
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

# clone_into ROOT: $commit, as /aquarama.
clone_into() {
    git clone --quiet --no-local "$PWD" "$1/aquarama"
    git -C "$1/aquarama" checkout --quiet --detach "$commit"
}

# tell SOCKET TEXT: a line to an emulated machine, or to its monitor.
tell() {
    python3 -c 'import socket, sys, time
line = socket.socket(socket.AF_UNIX)
line.connect(sys.argv[1])
line.sendall(sys.argv[2].encode() + b"\n")
time.sleep(1)' "$work/$1" "$2"
}

fail() { echo "$(basename "$0"): $release: $1" >&2; exit 1; }

# logged WHAT ROOT COMMAND: in the system; shows the end of the log where it fails, and ends with WHAT.
logged() {
    in_system "$2" "$3" >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; fail "$1"; }
}

commit=$(git rev-parse HEAD)  # the same for all, whatever is committed meanwhile
