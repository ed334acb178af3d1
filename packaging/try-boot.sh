#!/usr/bin/env bash
# try-boot.sh RELEASE: a hall of Aquarama's packages boots in an emulated machine, to a test pattern on its screen.
#
# Takes the packages that packaging/try-packages.sh has left in build/debs/RELEASE. Installs them on a minimal system
# with a kernel, gives it a rig of one panel of 320 x 240 pixels, and starts it in QEMU, without KVM and with software
# OpenGL. The screen must show what the programs draw of that channel without a display. Then the word "poweroff" must
# switch the machine off. Leaves build/boot-RELEASE.ppm. Needs root and debootstrap, and the packages of
# packaging/packages/boot.txt: without them it ends with status 77, in CI with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

[ $# -eq 1 ] || { echo "usage: packaging/try-boot.sh RELEASE, for example bookworm" >&2; exit 2; }
source packaging/bare_systems.sh
release=$1
most_seconds=1200  # until the pattern is there
debs=build/debs/$release/now
root=$work/$release

if ! command -v qemu-system-x86_64 >/dev/null; then
    echo "SKIPPED: no QEMU; install what packaging/packages/boot.txt names" >&2
    [ -z "${CI:-}" ] && exit 77 || exit 1
fi
[ -d "$debs" ] || fail "no packages in $debs; packaging/try-packages.sh $release makes them"

# The rig, and what an emulated machine needs: more time, and somebody who says the word.
set_up() {
    cat >"$root/etc/aquarama/rigs/hall.txtpb" <<'RIG'
name: "hall"
panorama { width_px: 320 height_px: 240 }
network { control: "tcp://127.0.0.1:7400" state: "tcp://127.0.0.1:7401" }
timing { refresh_hz: 60 present_deadline_s: 60 membership_s: 120 }
scene: "/usr/share/aquarama/config/scenes/empty_sea.txtpb"
channels {
  id: 0
  name: "only"
  width_px: 320
  height_px: 240
  panel { position { x_m: 0 y_m: 0 z_m: -1.2 } width_m: 1.2 height_m: 0.9 }
  display { mode: WINDOW window_x_px: 0 window_y_px: 0 }
}
RIG
    cat >"$root/usr/local/sbin/pass-word-on" <<'SCRIPT'
#!/bin/sh
read -r word </dev/ttyS1
exec runuser -u aquarama -- sh -c "echo $word >/run/aquarama/power/word"
SCRIPT
    cat >"$root/etc/systemd/system/pass-word-on.service" <<'UNIT'
[Service]
ExecStart=/usr/local/sbin/pass-word-on
[Install]
WantedBy=multi-user.target
UNIT
    local unit
    for unit in aquarama-master.service aquarama-node@.service; do
        mkdir -p "$root/etc/systemd/system/$unit.d"
        printf '[Service]\nWatchdogSec=10min\n' >"$root/etc/systemd/system/$unit.d/emulated.conf"
    done
    echo 'MASTER_ARGUMENTS=--pattern grid --quality low' >>"$root/etc/aquarama/hall.conf"
    echo '/dev/vda / ext4 defaults 0 1' >"$root/etc/fstab"
    logged "the hall cannot be set up" "$root" "chmod +x /usr/local/sbin/pass-word-on &&
        systemctl enable aquarama-node@only.service pass-word-on.service &&
        aquarama-hall run hall.txtpb --headless --frames 2 --pattern grid --quality low --snapshot /tmp/show"
}

make_system "$release" "$root"
mkdir "$root/aquarama"
cp -r "$debs" "$root/debs"
logged "the packages cannot be installed" "$root" "apt-get update -qq &&
    DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
    systemd-sysv udev linux-image-amd64 initramfs-tools zstd /debs/*.deb"
set_up
rm -rf "$root/debs" "$root"/var/cache/apt/archives/*.deb
mke2fs -q -t ext4 -d "$root" "$work/hall.img" 2G >/dev/null

began=$SECONDS
kernel_options="quiet loglevel=0 vt.global_cursor_default=0 consoleblank=0 systemd.show_status=false console=ttyS0"
qemu-system-x86_64 -accel tcg,thread=multi -cpu "$emulated_processor" -smp 2 -m 1500 -no-reboot \
    -display none -vga std -nic none \
    -kernel "$root"/boot/vmlinuz-* -initrd "$root"/boot/initrd.img-* -drive "file=$work/hall.img,format=raw,if=virtio" \
    -append "root=/dev/vda rw $kernel_options" -serial "file:$work/serial.log" \
    -serial "unix:$work/word,server,nowait" -monitor "unix:$work/monitor,server,nowait" &
inside=$!
until [ -f "$work/screen.ppm" ] &&
    python3 packaging/check_screen.py "$work/screen.ppm" "$root/tmp/show/channel-only.png"; do
    kill -0 $inside 2>/dev/null || fail "the machine has ended"
    if [ $((SECONDS - began)) -ge $most_seconds ]; then
        tail -n 20 "$work/serial.log" >&2
        fail "no pattern after $most_seconds s"
    fi
    sleep 10
    tell monitor "screendump $work/screen.ppm"
done
cp "$work/screen.ppm" "build/boot-$release.ppm"
echo "$release: the pattern is on the screen $((SECONDS - began)) s after the power; build/boot-$release.ppm"

began=$SECONDS
tell word poweroff
while kill -0 $inside 2>/dev/null; do
    [ $((SECONDS - began)) -lt 300 ] || fail "the word does not switch the machine off"
    sleep 1
done
echo "$release: the word has switched the machine off after $((SECONDS - began)) s"
