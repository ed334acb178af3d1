#!/usr/bin/env bash
# try-packages.sh [--built] RELEASE...: Aquarama's packages on a fresh Debian (bookworm, trixie), one release after the
# other.
#
# In one minimal system it builds the packages of HEAD, and once more as version 0.2.0, and asks lintian. In another it
# installs, upgrades, downgrades, removes and purges them, and looks each time at what is kept; asks systemd-analyze
# about the units; and has a normal user make the desk's panorama. The packages are left in build/debs/RELEASE; --built
# takes those that an earlier run left there. Needs root and debootstrap: without them it ends with status 77, in CI
# with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

built=false
[ "${1:-}" = --built ] && { built=true; shift; }
if [ $# -eq 0 ]; then
    echo "usage: packaging/try-packages.sh [--built] RELEASE..., for example bookworm trixie" >&2
    exit 2
fi
source packaging/bare_systems.sh

version_before=0.2.0  # the same files under a lower version
most_exposed=2.5  # by systemd-analyze security, of 10
packages=(aquarama aquarama-master aquarama-node aquarama-calibrate aquarama-console aquarama-drawings aquarama-guests
    aquarama-kiosk aquarama-doc)

say() { printf '%s: %s\n' "$release" "$1"; }

# The packages of HEAD in build/debs/RELEASE/now, those of the version before in before.
build() {
    local root=$work/$release-build debs=build/debs/$release start=$SECONDS
    make_system "$release" "$root"
    clone_into "$root"
    local lists=(packaging/packages/{run,calibrate,console,drawings,guests,debs}.txt)
    logged "packages cannot be installed" "$root" "packaging/install-packages.sh ${lists[*]}"
    local installed=$SECONDS
    logged "build-debs failed" "$root" "packaging/build-debs /debs/now"
    say "packages for the build $((installed - start)) s, build $((SECONDS - installed)) s"
    logged "build-debs --version failed" "$root" "packaging/build-debs --version $version_before /debs/before"
    rm -rf "$debs"
    mkdir -p "$debs"
    cp -rt "$debs" "$root"/debs/{now,before}
    logged "lintian found something" "$root" \
        "useradd reader && runuser -u reader -- lintian --fail-on error,warning /debs/now/*.changes"
    say "lintian is content"
    rm -rf --one-file-system "$root"
}

# install FOLDER: all packages of /debs/FOLDER, with what they need.
install() {
    logged "the packages of $1 cannot be installed" "$root" \
        "DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends --allow-downgrades /debs/$1/*.deb"
    local version expected=$version_before
    [ "$1" = before ] || expected=$(sed -n '1s/.*(\(.*\)).*/\1/p' packaging/debian/changelog)
    version=$(in_system "$root" "dpkg-query -W -f '\${Version}' aquarama-master")
    [ "$version" = "$expected" ] || fail "version $version is installed, not $expected"
    say "installed $version"
}

# What a hall has after some weeks: a rig, keys, a calibration, what was set, a changed file of configuration.
live_in() {
    logged "no hall can be set up" "$root" "set -e
        sed 's#\"scenes/#\"/usr/share/aquarama/config/scenes/#; s#//127.0.0.1#//192.168.7.1#' \
            /usr/share/aquarama/config/theatre.txtpb >/etc/aquarama/rigs/hall.txtpb
        aquarama-hall check hall.txtpb
        aquarama-hall keys new hall.txtpb
        aquarama-hall convert hall.txtpb hall.mpcdi
        runuser -u aquarama -- mkdir /var/lib/aquarama/shows /var/cache/aquarama/derived
        echo 'black: true' >/var/lib/aquarama/shows/hall.txtpb
        echo 'NODE=--key /etc/aquarama/keys/hall/left.key' >/etc/aquarama/nodes/left.conf
        echo 'MASTER_ARGUMENTS=--quality low' >>/etc/aquarama/hall.conf
        systemctl enable aquarama-node@left.service"
    kept=$(kept_files)
    enabled=$(enabled_units)
}

# Names, owners, permissions and content of what must outlive the packages.
kept_files() {
    in_system "$root" "cd / && find etc/aquarama/rigs etc/aquarama/keys etc/aquarama/nodes var/lib/aquarama \
        -printf '%M %u %p\n' -type f -exec sha256sum {} + | sort"
}

enabled_units() { in_system "$root" "cd /etc/systemd/system && find . -name '*aquarama*' | sort"; }

# require_same WANTED FOUND MESSAGE: fails with the difference and the message where the two differ.
require_same() { [ "$2" = "$1" ] || { diff <(echo "$1") <(echo "$2") >&2; fail "$3"; }; }

require_kept() { require_same "$kept" "$(kept_files)" "$1 changes the hall's own files"; }

require_hall_conf() {
    in_system "$root" "grep -q '^MASTER_ARGUMENTS=--quality low' /etc/aquarama/hall.conf" || fail "$1"
}

require_unchanged() {
    require_kept "$1"
    require_same "$enabled" "$(enabled_units)" "$1 changes what is enabled"
    require_hall_conf "$1 takes hall.conf back"
}

# systemd-analyze verify and security, of every unit.
ask_systemd() {
    local units
    units=$(in_system "$root" "cd /usr/lib/systemd/system && ls -d aquarama*.target aquarama*.service aquarama*.path |
        sed 's/@/@left/'" | tr '\n' ' ')
    logged "systemd-analyze verify found something" "$root" "systemd-analyze verify --man=yes $units"
    ! grep -i aquarama "$work/log" || fail "systemd-analyze verify found something"
    say "systemd-analyze verify is content with $units"
    for unit in $units; do
        case $unit in *.service) ;; *) continue ;; esac
        logged "$unit is exposed" "$root" \
            "systemd-analyze security --offline=true --no-pager --threshold=$(tr -d . <<<$most_exposed) $unit"
        say "$(tail -n 1 "$work/log" | sed 's/^[^O]*//; s/ [^ ]*$//')"
    done
}

# The user whom strangers speak to reads the rig and the files that it names, which aquarama-hall has written for itself
# alone, and no key.
try_guests() {
    logged "aquarama-guests cannot read the rig" "$root" "id aquarama-guests &&
        cd /etc/aquarama/rigs && runuser -u aquarama-guests -- sh -c 'cat hall.txtpb hall.mpcdi >/dev/null'"
    ! in_system "$root" "id -nG aquarama-guests | tr ' ' '\n' | grep -qx aquarama" ||
        fail "aquarama-guests is in the others' group"
    logged "no key is bundled" "$root" "aquarama-hall keys bundle hall.txtpb left &&
        test -s /etc/aquarama/rigs/left.key"
    local found
    found=$(in_system "$root" "runuser -u aquarama-guests -- find /etc/aquarama -name '*.key' -readable" 2>/dev/null ||
        true)
    in_system "$root" "rm /etc/aquarama/rigs/left.key"
    require_same "" "$found" "aquarama-guests can read keys"
    say "aquarama-guests reads the rig, and no key"
}

# The desk's panorama, by somebody who has an account and no more.
try_desk() {
    logged "the installed desk makes no panorama" "$root" "useradd --create-home visitor && cd /home/visitor &&
        runuser -u visitor -- aquarama run /usr/share/aquarama/config/desk.txtpb --headless --frames 3 --snapshot show"
    python3 packaging/check_pictures.py "$root/home/visitor/show"
    local version
    version=$(in_system "$root" 'aquarama --version' | head -n 2 | tr -s '\n ' ' ')
    say "the desk's panorama is drawn by the installed programs: $version"
    logged "a manual page cannot be read" "$root" \
        'for page in aquarama aquarama-calibrate aquarama-compose aquarama-console aquarama-drawings aquarama-guests \
             aquarama-hall \
             aquarama-node aquarama-outputs; do
             test -s /usr/share/man/man1/$page.1.gz || exit 1
         done'
}

require_left() {
    local left
    left=$(in_system "$root" "find / -xdev \( -path /aquarama -o -path /debs -o -path /proc -o -path /sys \
        -o -path /dev -o -path /run -o -path /home -o -path /var/cache/man \) -prune -o -path '*aquarama*' -print" |
        grep -Ev '^/(etc/aquarama(/(rigs|keys|nodes)(/.*)?)?|var/lib/aquarama(/.*)?)$' || true)
    require_same "$1" "$left" "purged packages leave other files than are the hall's own"
}

try() {
    release=$1
    $built || build
    root=$work/$release
    make_system "$release" "$root"
    clone_into "$root"
    cp -r "build/debs/$release" "$root/debs"
    # Documents and manual pages are left out by some images of Debian; here they are looked at.
    rm -f "$root"/etc/dpkg/dpkg.cfg.d/*exclude*
    logged "systemd cannot be installed" "$root" \
        "apt-get update -qq &&
         DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends systemd systemd-sysv man-db"

    install before
    live_in
    install now
    require_unchanged "the upgrade"
    install before
    require_unchanged "the downgrade"
    install now
    require_unchanged "the upgrade"
    say "upgrade, downgrade and upgrade keep rigs, keys, calibration, what was set, hall.conf, and what is enabled"
    ask_systemd
    try_guests
    try_desk

    logged "the packages cannot be removed" "$root" "DEBIAN_FRONTEND=noninteractive apt-get remove -y ${packages[*]}"
    require_kept "the removal"
    ! in_system "$root" "ls /usr/bin/aquarama* /usr/share/aquarama /usr/lib/systemd/system/aquarama*" >/dev/null 2>&1 ||
        fail "removed packages leave programs or units"
    require_hall_conf "the removal takes hall.conf"
    [[ $(enabled_units) = *aquarama-node@left.service* ]] || fail "the removal forgets which channels were enabled"
    say "removal keeps rigs, keys, calibration, what was set, and hall.conf"
    logged "the packages cannot be purged" "$root" "DEBIAN_FRONTEND=noninteractive apt-get purge -y ${packages[*]}"
    require_kept "the purge"
    require_left ""
    say "purge keeps rigs, keys, calibration and what was set; hall.conf, cache, enabled channels and all else are gone"
    install now
    require_kept "an installation anew"
    say "an installation anew finds them"
    rm -rf --one-file-system "$root"
}

for one in "$@"; do try "$one"; done
