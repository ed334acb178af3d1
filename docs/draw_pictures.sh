#!/usr/bin/env bash
# Draws the pictures of the documents: docs/draw_pictures.sh [NAME...], those of docs/pictures that are named
# (chase.webp), or all. Builds what draws them, and prints the seconds that each took; those drawn in one go share them.
set -euo pipefail
cd "$(dirname "$0")/.."
drawn=$(mktemp -d)
trap 'rm -rf "$drawn"' EXIT
bin=build/show/bin

# What draws each picture: a function below, with its arguments.
declare -A way=(
    [panorama.png]="wall desk panorama.png high"
    [stereo.png]="wall desk_stereo stereo.png medium"
    [screen_flat_3.webp]="screen flat_3"
    [screen_wall_2x2.webp]="screen wall_2x2"
    [screen_dome_5.webp]="screen dome_5"
    [screen_measured_3.webp]="screen measured_3"
    [screen_televisions_3.webp]="screen televisions_3"
    [screen_cave_4.webp]="screen cave_4"
    [portraits.png]=portraits
    [portraits_reef.png]=portraits_reef
    [tiers.png]=tiers
    [water_types.png]=water_types
    [colour.webp]=colour
    [faces.webp]=faces
    [shark.png]=shark
    [days.png]=days
    [species.png]=species
    [species_sizes.png]=species
    [submarine.webp]="routine submarine 680 17 medium"
    [submarine.png]="routine submarine 680 17 medium"
    [chase.webp]="routine chase 490 14 medium"
    [chase.png]="routine chase 490 14 medium"
    [eat.webp]="routine eat 700 20 low"
    [mate.webp]="routine mate 880 22 low"
    [hide.webp]="routine hide 1860 46 low"
    [dusk.webp]=dusk
    [controllers.svg]=controllers
    [forward_medium.svg]=report
    [turn_right_sharp.svg]=report
    [midlines_forward_medium.svg]=report
    [forms.svg]=forms
    [fidelity_film.webp]=film
    [fidelity_ways.svg]=fidelity
    [fidelity_segments.svg]=fidelity
    [adaptation.svg]=adaptation
    [calibration_before.webp]=calibration
    [calibration_scan.webp]=calibration
    [calibration_report.webp]=calibration
    [calibration_after.webp]=calibration
    [wall.svg]=visitor
    [modules.svg]=modules
    [console_wall.png]=console
    [console_nodes.png]=console
    [console_black.png]=console
    [console_events.png]=console
    [console_stale.png]=console
    [console_schedule.png]=console
    [console_phone.png]=console
    [console_mind.png]=console
    [console_drawings.png]=console
    [guests_waiting.png]=guests
    [guests_steering.png]=guests
    [drawings_fish.webp]=drawings
    [drawings_wall.webp]=drawings_wall
    [televisions_plan.svg]=televisions
    [televisions_grid.webp]=televisions
    [televisions_reef.webp]=televisions
    [televisions_hall.webp]=televisions
    [console_calibration.png]=console
    [console_tour.png]=console
    [console_waiting.png]=waiting
    [node_card.png]=node_card
)

# Each leaves its pictures in $drawn.
# The unrolled wall of a rig after a second. For a clip that nobody keeps only its own frames are drawn: here the last.
wall() {
    $bin/aquarama run "config/$1.txtpb" --quality "$3" --headless --frames 61 --film-every 60 --clip "$drawn/$1.mp4" \
        --snapshot "$drawn/$1"
    mv "$drawn/$1/panorama.png" "$drawn/$2"
}
# The hall of a rig, and below it the panorama, which is no wider and not higher than the hall.
screen() {
    $bin/aquarama run "config/$1.txtpb" --quality medium --headless --frames 61 --film-every 60 --clip "$drawn/$1.mp4" \
        --snapshot "$drawn/$1"
    /usr/bin/python3 - "$drawn/$1" "$drawn/screen_$1.webp" <<'PYTHON'
import sys
from PIL import Image
hall, panorama = (Image.open(f"{sys.argv[1]}/{name}.png").convert("RGB") for name in ("hall", "panorama"))
hall = hall.resize((1000, 563), Image.LANCZOS)
panorama.thumbnail((1000, 563), Image.LANCZOS)
sheet = Image.new("RGB", (1000, 573 + panorama.height))
sheet.paste(hall, (0, 0))
sheet.paste(panorama, ((1000 - panorama.width) // 2, 573))
sheet.save(sys.argv[2], quality=85, method=6)
PYTHON
}
portraits() {
    $bin/aquarama_draw_still --plate --fov 40 --azimuth 10 --width 1280 --height 720 --quality ultra \
        --out "$drawn/portraits.png"
}
# The species beside the paper's seven, one by one and each as large as the others: name and metres.
portraits_reef() {
    local name length
    local -a pictures=()
    while read -r name length; do
        $bin/aquarama_draw_still --portrait "$name" --length "$length" --away "$(awk "BEGIN { print 1.5 * $length }")" \
            --turn 12 --fov 40 --azimuth 10 --width 400 --height 300 --quality ultra --out "$drawn/$name.png"
        pictures+=("$drawn/$name.png")
    done <<'END'
sea_goldie 0.083
green_chromis 0.075
fusilier 0.26
powder_blue_tang 0.18
butterflyfish 0.17
cleaner_wrasse 0.09
coral_grouper 0.3
sergeant 0.14
lionfish 0.28
bigeye_trevally 0.5
END
    $bin/aquarama_draw_sheet "$drawn/portraits_reef.png" 5 "${pictures[@]}"
}
tiers() {
    local tier
    for tier in low medium high ultra; do
        $bin/aquarama_draw_still --quality $tier --azimuth -14 --elevation 2 --fov 60 --width 640 --height 360 \
            --out "$drawn/$tier.png"
    done
    $bin/aquarama_draw_sheet "$drawn/tiers.png" 2 "$drawn"/{low,medium,high,ultra}.png
}
# NAME.webp of NAME.png, a large sheet.
smaller() {
    /usr/bin/python3 -c 'import sys; from PIL import Image
Image.open(sys.argv[1]).convert("RGB").save(sys.argv[2], quality=88, method=6)' "$drawn/$1.png" "$drawn/$1.webp"
}
# Three views of the reef as in nature, and below them with the colour that the wall gives back.
colour() {
    local share view
    for share in 0 0.9; do
        for view in "-40 -8" "12 -10" "55 -6"; do
            $bin/aquarama_draw_still --quality ultra --azimuth "${view% *}" --elevation "${view#* }" --fov 50 \
                --width 560 --height 315 --colour $share --out "$drawn/colour_$share-${view% *}.png"
        done
    done
    $bin/aquarama_draw_sheet "$drawn/colour.png" 3 "$drawn"/colour_0-{-40,12,55}.png "$drawn"/colour_0.9-{-40,12,55}.png
    smaller colour
}
# Every species 0.6 m away: from the front, three quarters and the side; the large ones at their heads.
faces() {
    local name length turn
    local -a pictures=()
    while read -r name length; do
        for turn in 75 40 0; do
            $bin/aquarama_draw_still --portrait "$name" --length "$length" --away 0.6 --turn $turn --azimuth 10 \
                --fov "$(awk "BEGIN { fov = 100 * $length; print (fov > 42 ? 42 : fov < 12 ? 12 : fov) }")" \
                --width 320 --height 200 --quality ultra --out "$drawn/$name-$turn.png"
            pictures+=("$drawn/$name-$turn.png")
        done
    done <<'END'
blacktip_reef_shark 0.6
trumpetfish 0.5
bigeye_trevally 0.45
parrotfish 0.32
coral_grouper 0.32
lionfish 0.28
fusilier 0.26
bigeye_scad 0.24
blue_tang 0.22
powder_blue_tang 0.18
moorish_idol 0.18
butterflyfish 0.17
sergeant 0.14
cleaner_wrasse 0.09
clownfish 0.09
sea_goldie 0.09
green_chromis 0.08
END
    $bin/aquarama_draw_sheet "$drawn/faces.png" 6 "${pictures[@]}"
    smaller faces
}
# A shark's face as it passes the glass.
shark() {
    $bin/aquarama_draw_still --portrait blacktip_reef_shark --length 1.3 --away 1.0 --turn 60 --azimuth 10 --fov 34 \
        --width 720 --height 450 --quality ultra --mouth 0.35 --out "$drawn/shark.png"
}
# The reef at dawn, sunset, dusk and by night: time of day and the sky's light.
days() {
    local time light
    local -a pictures=()
    while read -r time light; do
        $bin/aquarama_draw_still --azimuth -30 --elevation 4 --fov 62 --width 480 --height 300 --quality ultra \
            --time-of-day "$time" --daylight "$light" --out "$drawn/at_$time.png"
        pictures+=("$drawn/at_$time.png")
    done <<'END'
0.25 0.6
0.74 0.8
0.80 0.4
0.00 0.25
END
    $bin/aquarama_draw_sheet "$drawn/days.png" 2 "${pictures[@]}"
}
# One reef in each of Jerlov's types of water, the clearest first.
water_types() {
    $bin/aquarama_draw_sheet "$drawn/water_types.png" 4 tests/golden/water/{I,IA,IB,II,III,1C,3C}.png
}
species() {
    $bin/aquarama_draw_species "$drawn" \
        config/species/{blacktip_reef_shark,trumpetfish,bigeye_trevally,parrotfish,coral_grouper,lionfish}.txtpb \
        config/species/{fusilier,bigeye_scad,blue_tang,powder_blue_tang,moorish_idol,butterflyfish}.txtpb \
        config/species/{sergeant,cleaner_wrasse,clownfish,sea_goldie,green_chromis}.txtpb
}
# A routine as it is seen on the wall: scene, frames, every how manieth of them, tier.
routine() {
    $bin/aquarama run config/desk.txtpb --scene "config/scenes/routines/$1.txtpb" --quality "$4" --headless \
        --frames "$2" --film-every "$3" --clip "$drawn/$1.webp" --snapshot "$drawn/$1"
    mv "$drawn/$1/panorama.png" "$drawn/$1.png"
}
# The reef from the end of its afternoon to its night: sunset and dusk of a day of four minutes.
dusk() {
    sed -e "s#\"../species/#\"$PWD/config/species/#" \
        -e 's#^day {.*#day { length_s: 240 starts_at: 0.735 night: 0.5 }#' config/scenes/reef.txtpb >"$drawn/dusk.txtpb"
    $bin/aquarama run config/desk.txtpb --scene "$drawn/dusk.txtpb" --quality low --headless --frames 2160 \
        --film-every 54 --clip "$drawn/dusk.webp" --snapshot "$drawn/dusk"
}
controllers() { $bin/aquarama controllers --out "$drawn"; }
report() {
    local figure
    $bin/aquarama capture --species bigeye_scad --out "$drawn" --report "$drawn/report"
    for figure in forward_medium turn_right_sharp midlines_forward_medium; do
        mv "$drawn/report/bigeye_scad_$figure.svg" "$drawn/$figure.svg"
    done
}
# Prints the table of docs/motion.md besides.
forms() { $bin/aquarama forms --out "$drawn"; }
# Fills in the tables of docs/fidelity.md besides.
fidelity() {
    docs/studies.py "aquarama fidelity --seed"
    cp docs/pictures/fidelity_{ways,segments}.svg "$drawn/"
}
# The last picture of the film's first seconds.
film() {
    $bin/aquarama fidelity clownfish --seconds 5.8 --clip "$drawn/film.webp"
    /usr/bin/python3 - "$drawn" <<'PYTHON'
import sys
from PIL import Image
film = Image.open(f"{sys.argv[1]}/film.webp")
film.seek(film.n_frames - 1)
film.convert("RGB").resize((1000, 563), Image.LANCZOS).save(
    f"{sys.argv[1]}/fidelity_film.webp", quality=85, method=6)
PYTHON
}
# Fills in the tables of docs/appendices/adaptation.md besides.
adaptation() {
    docs/studies.py "aquarama study --seeds"
    cp docs/pictures/adaptation.svg "$drawn/"
}

# Fills in the figures of docs/scenes.md besides.
visitor() {
    docs/studies.py "aquarama study wall"
    cp docs/pictures/wall.svg "$drawn/"
}

# A simulated hall, its scan, the page of its calibration (by Debian's chromium), and the reef before and after.
calibration() {
    local rig=$drawn/desk.txtpb when
    sed "s#^scene: \"#&$PWD/config/#" config/desk.txtpb >"$rig"
    $bin/aquarama calibrate --rig "$rig" --simulate random:7 --out "$drawn/hall.mpcdi" --report "$drawn/report" \
        --keep "$drawn/scan"
    chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1120,2480 \
        --screenshot="$drawn/report.png" "file://$drawn/report/index.html" 2>/dev/null
    for when in before after; do
        $bin/aquarama run "$rig" --quality medium --headless --frames 61 --film-every 60 --clip "$drawn/$when.mp4" \
            --snapshot "$drawn/$when"
        $bin/aquarama view config/desk.txtpb --hall random:7 --frame "$drawn/$when" --view hall --out "$drawn/$when.png"
        echo 'calibration: "hall.mpcdi"' >>"$rig"
    done
    /usr/bin/python3 - "$drawn" <<'PYTHON'
import sys
from PIL import Image
drawn = sys.argv[1]
scan = [Image.open(f"{drawn}/scan/{number:04}.png").convert("RGB") for number in (1, 9, 20)]
height = 330 * scan[0].height // scan[0].width
sheet = Image.new("RGB", (1000, height))
for i, picture in enumerate(scan):
    sheet.paste(picture.resize((330, height), Image.LANCZOS), (335 * i, 0))
sheet.save(f"{drawn}/calibration_scan.webp", quality=85, method=6)
page = Image.open(f"{drawn}/report.png").convert("RGB")
page.resize((700, 700 * page.height // page.width), Image.LANCZOS).save(
    f"{drawn}/calibration_report.webp", quality=85, method=6)
for when in ("before", "after"):
    hall = Image.open(f"{drawn}/{when}.png").convert("RGB").resize((1000, 563), Image.LANCZOS)
    hall.save(f"{drawn}/calibration_{when}.webp", quality=85, method=6)
PYTHON
}

# The pages of the console, by chromium, as their test goes through them.
console() {
    cmake --build --preset show-tests --target aquarama-console
    AQUARAMA_BIN=$PWD/$bin AQUARAMA_SHOTS=$drawn /usr/bin/python3 tests/console/pages_test.py
    # Its first steps; below are the paths of the test.
    /usr/bin/python3 -c "from PIL import Image
Image.open('$drawn/console_tour.png').crop((0, 0, 1265, 655)).save('$drawn/console_tour.png')"
}
# Nodes without a key on the console's page, as its test has them.
waiting() {
    cmake --build --preset show-tests --target aquarama-console
    AQUARAMA_BIN=$PWD/$bin AQUARAMA_SHOTS=$drawn /usr/bin/python3 tests/console/waiting_test.py
}
# The screen of such a node, on a display without a screen.
node_card() {
    xvfb-run -a -s "-screen 0 800x450x24" bash -c "$bin/aquarama-node --key '$drawn/none.key' --wait-for-key &
        sleep 5; xwd -root -silent -out '$drawn/node_card.xwd'; kill %1; wait"
    /usr/bin/python3 - "$drawn/node_card.xwd" "$drawn/node_card.png" <<'PYTHON'
import struct
import sys
from PIL import Image
dump = open(sys.argv[1], "rb").read()
header = struct.unpack(">25I", dump[:100])
pixels = dump[header[0] + 12 * header[19]:]
Image.frombuffer("RGB", (header[4], header[5]), pixels, "raw", "BGRX", header[12], 1).save(sys.argv[2])
PYTHON
}
# The page of visitors, by chromium, as its test goes through it.
guests() {
    cmake --build --preset show-tests --target aquarama-console aquarama-guests
    AQUARAMA_BIN=$PWD/$bin AQUARAMA_SHOTS=$drawn /usr/bin/python3 tests/guests/page_test.py
}
# Six sheets that a program has coloured, as a simulated camera sees them, and the fish that wear their drawings.
drawings() {
    local name length number=0
    local -a photos=() fish=()
    cmake --build --preset show-tests --target aquarama-drawings aquarama_draw_photos
    build/show/tests/aquarama_draw_photos "$drawn/photos" 6 clownfish blue_tang butterflyfish parrotfish moorish_idol \
        lionfish >"$drawn/log"
    mkdir "$drawn/skins"
    $bin/aquarama-drawings read "$drawn"/photos/*.jpg --out "$drawn/skins"
    while read -r name length; do
        number=$((number + 1))
        $bin/aquarama_draw_still --portrait "$name" --drawing "$drawn/skins/$number-$name.png" --length "$length" \
            --away "$(awk "BEGIN { print 1.5 * $length }")" --turn 192 --fov 40 --azimuth 10 --width 400 --height 300 \
            --quality ultra --out "$drawn/worn-$name.png"
        /usr/bin/python3 -c 'import sys; from PIL import Image, ImageOps
ImageOps.fit(Image.open(sys.argv[1]), (400, 300)).save(sys.argv[2])' "$drawn/photos/$number.jpg" \
            "$drawn/photo-$name.png"
        photos+=("$drawn/photo-$name.png")
        fish+=("$drawn/worn-$name.png")
    done <<'END'
clownfish 0.09
blue_tang 0.22
butterflyfish 0.17
parrotfish 0.32
moorish_idol 0.18
lionfish 0.28
END
    $bin/aquarama_draw_sheet "$drawn/drawings_fish.png" 3 "${photos[@]:0:3}" "${fish[@]:0:3}" "${photos[@]:3}" \
        "${fish[@]:3}"
    smaller drawings_fish
}
# A running desk, some seconds after ten drawings were let in together.
drawings_wall() {
    local hall=$drawn/hall show
    cmake --build --preset show-tests --target aquarama-drawings aquarama-console aquarama_draw_photos
    mkdir -p "$hall/scanner"
    build/show/tests/aquarama_draw_photos "$drawn/ten" 10 clownfish blue_tang butterflyfish parrotfish moorish_idol \
        >"$drawn/log"
    sed "s|\"scenes/|\"$PWD/config/scenes/|" config/desk.txtpb >"$hall/drawings.txtpb"
    echo 'drawings { let_in: AT_ONCE folder: "scanner" }' >>"$hall/drawings.txtpb"
    export XDG_STATE_HOME=$hall
    # The first show reads them, the second lets them in.
    $bin/aquarama run "$hall/drawings.txtpb" --headless --live --pattern grid >"$hall/log" 2>&1 &
    show=$!
    until grep -q "takes part" "$hall/log"; do sleep 1; done
    cp "$drawn"/ten/*.jpg "$hall/scanner"
    until grep -q "drawing 10:" "$hall/log"; do sleep 1; done
    $bin/aquarama set "$hall/drawings.txtpb" drawings off
    kill -INT "$show"
    wait "$show"
    $bin/aquarama run "$hall/drawings.txtpb" --headless --live --quality medium --snapshot "$drawn/wall" \
        >"$hall/log" 2>&1 &
    show=$!
    until [ "$(grep -c "showing" "$hall/log")" -ge 3 ]; do sleep 1; done
    $bin/aquarama set "$hall/drawings.txtpb" drawings on
    sleep 17
    kill -INT "$show"
    wait "$show"
    $bin/aquarama-compose compose "$hall/drawings.txtpb" "$drawn/wall"
    cp "$drawn/wall/panorama.png" "$drawn/drawings_wall.png"
    smaller drawings_wall
}
# The steps of the guide, as their test goes through them, on three monitors of an X server of its own.
televisions() {
    AQUARAMA_BIN=$PWD/$bin AQUARAMA_SHOTS=$drawn /usr/bin/python3 tests/end_to_end/monitors_test.py ThreeTelevisions
    /usr/bin/python3 docs/draw_televisions.py "$drawn"
}
# The libraries and programs, as CMake knows them.
modules() {
    cmake --preset show-tests --graphviz="$drawn/cmake.dot" >/dev/null
    docs/draw_modules.py "$drawn/cmake.dot" "$drawn/modules.svg"
}

mapfile -t names < <(printf '%s\n' "${!way[@]}" | sort)
if (($# > 0)); then names=("$@"); fi
for name in "${names[@]}"; do
    if [ -z "${way[$name]:-}" ]; then
        echo "docs/draw_pictures.sh draws no $name; it draws: $(printf '%s\n' "${!way[@]}" | sort | xargs)" >&2
        exit 2
    fi
done

cmake --preset show-tests >"$drawn/configure.log" 2>&1 || { cat "$drawn/configure.log" >&2; exit 1; }
if [ "${names[*]}" != modules.svg ]; then
    cmake --build --preset show-tests --target aquarama_programs aquarama-calibrate aquarama_draw_still \
        aquarama_draw_species aquarama_draw_sheet
fi

declare -A seconds=()
for name in "${names[@]}"; do
    drawing=${way[$name]}
    if [ -z "${seconds[$drawing]:-}" ]; then
        start=$SECONDS
        $drawing </dev/null
        seconds[$drawing]=$((SECONDS - start))
    fi
    if [ ! -s "$drawn/$name" ]; then
        echo "docs/draw_pictures.sh: $drawing drew no $name" >&2
        exit 1
    fi
    cp "$drawn/$name" docs/pictures/
    printf '%-44s %4d s\n' "docs/pictures/$name" "${seconds[$drawing]}"
done
