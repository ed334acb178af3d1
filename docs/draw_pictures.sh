#!/usr/bin/env bash
# Draws the pictures of the documents anew, with what ./run has built.
set -euo pipefail
cd "$(dirname "$0")/.."
drawn=$(mktemp -d)
trap 'rm -rf "$drawn"' EXIT

build/show/bin/aquarama run config/theatre.txtpb --headless --frames 150 --snapshot "$drawn/theatre"
build/show/bin/aquarama capture --species bigeye_scad --out "$drawn" --report "$drawn/report"

mkdir -p docs/pictures
cp "$drawn/theatre/hall.png" docs/pictures/
for figure in forward_medium turn_right_sharp midlines_forward_medium; do
    sed -n "/<figure id=\"$figure\">/,/<\/svg>/p" "$drawn/report/bigeye_scad.html" | sed 1d >"docs/pictures/$figure.svg"
done
