#!/usr/bin/env bash
# try-image.sh [RELEASE]: the image for a stick shows a wall of three channels, installs itself on an empty disk, starts
# from there, and returns from a broken release to the one before, in an emulated machine. Before that, the boot loader
# alone obeys the entries of the image (tests/packaging/boot_loader.py). After it, a small machine loses its power at
# twenty random moments of an update (tests/packaging/power_cuts.py); then a second machine waits for its channel, and
# both take releases (tests/packaging/two_machines.py).
#
# Takes the packages that packaging/try-packages.sh RELEASE has left in build/debs/RELEASE (trixie by default), and
# makes an image with a hall of three windows of 160 x 120 pixels with a test pattern. QEMU starts it with UEFI,
# without KVM and with software OpenGL. The screen must show what the programs draw of those channels without a
# display. Leaves the screens as build/image/try-*.ppm. Needs root, and the packages of
# packaging/packages/{bare,boot,image}.txt: without them it ends with status 77, in CI with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

release=${1:-trixie}
source packaging/bare_systems.sh
most_seconds=1800  # until a picture is there
firmware=/usr/share/OVMF/OVMF_CODE.fd
if ! command -v qemu-system-x86_64 >/dev/null || [ ! -f $firmware ]; then
    echo "SKIPPED: no QEMU with UEFI; install what packaging/packages/{boot,image}.txt name" >&2
    [ -z "${CI:-}" ] && exit 77 || exit 1
fi

python3 tests/packaging/boot_loader.py

# A hall of three small windows side by side, and what an emulated machine needs: more time.
make_hall() {
    local hall=$work/hall channel x=0
    local units=$hall/etc/systemd/system
    mkdir -p "$hall"/etc/aquarama/{rigs,nodes,network} "$units"/{aquarama,multi-user}.target.wants
    cat >"$hall/etc/aquarama/rigs/hall.txtpb" <<'RIG'
name: "hall"
panorama { width_px: 480 height_px: 120 }
network { control: "tcp://192.168.7.1:7400" state: "tcp://192.168.7.1:7401" depot: "tcp://192.168.7.1:7403" }
timing { refresh_hz: 60 present_deadline_s: 60 membership_s: 120 }
scene: "/usr/share/aquarama/config/scenes/empty_sea.txtpb"
RIG
    for channel in left middle right; do
        cat >>"$hall/etc/aquarama/rigs/hall.txtpb" <<RIG
channels {
  id: $((x / 160))
  name: "$channel"
  width_px: 160
  height_px: 120
  panel { position { x_m: $((x / 160 - 1)) y_m: 0 z_m: -1.2 } width_m: 1 height_m: 0.75 }
  display { mode: WINDOW window_x_px: $x window_y_px: 0 }
  $([ $channel != right ] || echo 'machine: "spare"')
}
RIG
        echo "NODE=--key /etc/aquarama/keys/hall/$channel.key" >"$hall/etc/aquarama/nodes/$channel.conf"
        x=$((x + 160))
    done
    local unit
    for unit in aquarama-master.service aquarama-node@.service; do
        mkdir -p "$units/$unit.d"
        printf '[Service]\nWatchdogSec=10min\n' >"$units/$unit.d/emulated.conf"
    done
    cat >"$hall/etc/aquarama/network/10-show.network" <<'NETWORK'
[Match]
Type=ether

[Network]
Address=192.168.7.1/24
ConfigureWithoutCarrier=yes
DHCPServer=yes

[DHCPServer]
PoolOffset=100
EmitDNS=no
EmitRouter=no
NETWORK
    # A shell of root at the second serial line.
    cat >"$units/shell.service" <<'UNIT'
[Service]
ExecStart=/bin/bash --norc
Environment=HOME=/root TERM=dumb
StandardInput=tty
StandardOutput=tty
StandardError=tty
TTYPath=/dev/ttyS1
Restart=always
UNIT
    ln -s ../shell.service "$units/multi-user.target.wants"
    echo 'MASTER_ARGUMENTS="--pattern grid --quality low"' >"$hall/etc/aquarama/hall.conf"
    printf 'FRAMES=20\nSECONDS_TO_SHOW=1500\n' >"$hall/etc/aquarama/release.conf"
}

# power_on DRIVE...: an emulated machine with these disks, the first of them a stick.
power_on() {
    local drives=() drive
    for drive in "$@"; do drives+=(-drive "file=$drive,format=raw,if=virtio"); done
    rm -f "$work/screen.ppm" "$work/serial.log"
    cp /usr/share/OVMF/OVMF_VARS.fd "$work/vars.fd"
    qemu-system-x86_64 -accel tcg,thread=multi -cpu "$emulated_processor" -smp 2 -m 2500 \
        -display none -vga std -nic user,restrict=on \
        -drive "if=pflash,format=raw,unit=0,readonly=on,file=$firmware" \
        -drive "if=pflash,format=raw,unit=1,file=$work/vars.fd" "${drives[@]}" \
        -serial "file:$work/serial.log" -monitor "unix:$work/monitor,server,nowait" &
    inside=$!
    began=$SECONDS
}
power_off() { kill -KILL $inside; wait $inside 2>/dev/null || true; inside=; }

# await_wall NAME: until the screen shows the wall; leaves it as try-NAME.ppm.
await_wall() {
    until [ -f "$work/screen.ppm" ] &&
        python3 packaging/check_screen.py "$work/screen.ppm" build/image/hall/channel-{left,middle,right}.png; do
        kill -0 $inside 2>/dev/null || fail "the machine has ended"
        if [ $((SECONDS - began)) -ge $most_seconds ]; then
            tail -n 20 "$work/serial.log" >&2
            fail "$1: no wall after $most_seconds s"
        fi
        sleep 10
        tell monitor "screendump $work/screen.ppm"
    done
    keep_screen "$1"
    ! grep -a "Failed with result" "$work/serial.log" >&2 || fail "$1: a service fails"
    echo "$release: $1: the wall is on the screen $((SECONDS - began)) s after the power"
}
keep_screen() {
    tell monitor "screendump $work/screen.ppm"
    cp "$work/screen.ppm" "build/image/try-$1.ppm"
}

make_hall
openssl genpkey -algorithm ed25519 -out "$work/show.key"
packaging/build-image --hall "$work/hall" --key "$work/show.key" \
    --words "console=ttyS0 systemd.journald.forward_to_console=1" "$release"

# On the stick, as it is.
image=$(ls build/image/aquarama-*.img)
version=$(basename "${image#*aquarama-}" .img)
cp --sparse=always "$image" "$work/stick.img"
power_on "$work/stick.img"
await_wall stick
power_off

# The entries of the disk's boot loader.
entries() { mdir -b -i "$work/disk.img@@$((start * 512))" ::loader/entries | sed 's#.*/##'; }

# keys TEXT: types on the keyboard of the machine, then Enter.
keys() {
    local i
    for ((i = 0; i < ${#1}; ++i)); do tell monitor "sendkey ${1:i:1}"; done
    tell monitor "sendkey ret"
}

# A small machine with the same kernel, boot loader and programs of releases.
python3 tests/packaging/power_cuts.py "$image" "$work/show.key"

# Two machines and a cable: one shows the hall, the other waits for its channel; then both take releases.
python3 tests/packaging/two_machines.py "$image" build/image/hall build/image "$work/show.key"

# From the stick to a disk: the entry "install", a name that is not there, then the disk's own.
printf 'timeout 0\ndefault aquarama-install.conf\n' >"$work/loader.conf"
start=$(sfdisk -J "$work/stick.img" | sed -n 's/.*"start": *\([0-9]*\).*/\1/p' | head -n 1)
mcopy -o -i "$work/stick.img@@$((start * 512))" "$work/loader.conf" ::loader/loader.conf
truncate -s 6G "$work/disk.img"
power_on "$work/stick.img" "$work/disk.img"
until grep -qs "waits for the name of a disk" "$work/serial.log"; do
    kill -0 $inside 2>/dev/null || fail "the machine has ended"
    [ $((SECONDS - began)) -lt $most_seconds ] || fail "the installer has not asked for a disk"
    sleep 2
done
keep_screen asks
keys vdz
sleep 5
[ "$(tr -d '\0' <"$work/disk.img" | head -c 1 | wc -c)" -eq 0 ] ||
    fail "the installer writes to a disk that was not named"
keys vdb
until grep -qs "is installed on" "$work/serial.log"; do
    kill -0 $inside 2>/dev/null || fail "the machine has ended"
    [ $((SECONDS - began)) -lt $most_seconds ] || { keep_screen failed; fail "the installer has not ended"; }
    sleep 5
done
keep_screen installed
echo "$release: installed $((SECONDS - began)) s after the power"
power_off

power_on "$work/disk.img"
await_wall disk
until entries | grep -qx "aquarama-$version.conf"; do
    [ $((SECONDS - began)) -lt $most_seconds ] || { entries >&2; fail "the release is not counted as good"; }
    sleep 5
done
echo "$release: the release is good $((SECONDS - began)) s after the power"
power_off

# A release of which half is missing comes to the disk: two tries, then the one before, by itself.
release_folder=$work/next
mkdir "$release_folder"
for file in vmlinuz initrd.img filesystem.squashfs; do
    mcopy -n -i "$work/disk.img@@$((start * 512))" "::aquarama/$version/$file" "$release_folder"
done
truncate -s 1M "$release_folder/filesystem.squashfs"
mmd -i "$work/disk.img@@$((start * 512))" ::aquarama/9.9
mcopy -i "$work/disk.img@@$((start * 512))" "$release_folder"/* ::aquarama/9.9
mcopy -n -i "$work/disk.img@@$((start * 512))" "::loader/entries/aquarama-$version.conf" "$work/entry"
sed "s#$version#9.9#g" "$work/entry" >"$work/next.conf"
mcopy -i "$work/disk.img@@$((start * 512))" "$work/next.conf" "::loader/entries/aquarama-9.9+2.conf"
power_on "$work/disk.img"
await_wall back
power_off
entries | grep -qx "aquarama-9.9+0-2.conf" || { entries >&2; fail "the broken release was not tried twice"; }
echo "$release: a broken release was tried twice, then left"
