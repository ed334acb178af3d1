#!/usr/bin/env bash
# Draws the pictures of the documents anew, with what ./run has built.
set -euo pipefail
cd "$(dirname "$0")/.."
drawn=$(mktemp -d)
trap 'rm -rf "$drawn"' EXIT

build/show/bin/aquarama run config/desk.txtpb --quality medium --headless --frames 60 --snapshot "$drawn/desk"
build/show/bin/aquarama capture --species bigeye_scad --out "$drawn" --report "$drawn/report"

build/show/bin/aquarama run config/desk_stereo.txtpb --headless --frames 150 --snapshot "$drawn/stereo"
cmake --build build/show --target aquarama_draw_species

mkdir -p docs/pictures

cmake --build build/show --target aquarama_draw_still
build/show/bin/aquarama_draw_still --plate --fov 40 --azimuth 10 --width 1280 --height 720 --quality ultra \
    --out docs/pictures/portraits.png

for tier in low medium high ultra; do
    build/show/bin/aquarama_draw_still --quality $tier --azimuth -14 --elevation 2 --fov 60 --width 640 --height 360 \
        --out "$drawn/tier-$tier.png"
done
montage "$drawn"/tier-{low,medium,high,ultra}.png -tile 2x -geometry +3+3 docs/pictures/tiers.png

# The routines as they are seen on the wall.
while read -r scene frames every; do
    build/show/bin/aquarama run config/desk.txtpb --scene "config/scenes/routines/$scene.txtpb" --headless \
        --frames "$frames" --film-every "$every" --clip "docs/pictures/$scene.webp" --snapshot "$drawn/$scene" </dev/null
done <<'SCENES'
submarine 680 17
chase 490 14
eat 700 20
mate 880 22
SCENES
cp "$drawn/submarine/panorama.png" docs/pictures/submarine.png
cp "$drawn/chase/panorama.png" docs/pictures/chase.png

build/show/bin/aquarama-capture controllers --out docs/pictures
cp "$drawn/desk/panorama.png" docs/pictures/
cp "$drawn/stereo/panorama.png" docs/pictures/stereo.png
for figure in forward_medium turn_right_sharp midlines_forward_medium; do
    sed -n "/<figure id=\"$figure\">/,/<\/svg>/p" "$drawn/report/bigeye_scad.html" | sed 1d >"docs/pictures/$figure.svg"
done
cast=(blacktip_reef_shark trumpetfish parrotfish bigeye_scad blue_tang moorish_idol clownfish)
files=("${cast[@]/%/.txtpb}")
build/show/bin/aquarama_draw_species docs/pictures "${files[@]/#/config/species/}"

# One reef in each of Jerlov's types of water, the clearest first.
montage tests/golden/water/{I,IA,IB,II,III,1C,3C}.png -tile 4x -geometry +3+3 docs/pictures/water_types.png

# Prints the tables of docs/fidelity.md besides.
build/show/bin/aquarama-capture fidelity --seed 4 --out "$drawn/fidelity"
cp "$drawn/fidelity/"fidelity_{ways,segments}.svg docs/pictures/

# Prints the tables of docs/adaptation.md besides.
build/show/bin/aquarama-study --seeds 16 --minutes 4 --out "$drawn/study"
cp "$drawn/study/adaptation.svg" docs/pictures/
