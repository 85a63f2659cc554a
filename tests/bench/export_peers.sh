#!/bin/sh
# Compares `relevo export` with two offline triangulators of npm on the same heights, at equal measured error, and
# prints a table in Markdown:
#
#   tests/bench/export_peers.sh RELEVO DEM...
#
# RELEVO is the program; a DEM is any file that GDAL reads with one band of 2^n + 1 posts a side and no voids. Its
# georeference is not used: the posts are put on a geographic grid as they are. Needs gdal-bin, node and npm, which
# installs @mapbox/martini and delatin into a folder that is deleted at the end. ERRORS ("20 5 1", metres) and RUNS (5)
# can be set. What is timed is said in export_peers.mjs.
set -eu

if [ $# -lt 2 ]; then
    echo "usage: $0 RELEVO DEM..." >&2
    exit 2
fi
relevo=$(realpath "$1")
shift
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp "$here/export_peers.mjs" "$work"
(cd "$work" && npm init --yes >/dev/null && npm install --silent --no-audit --no-fund @mapbox/martini delatin >&2)

first=yes
for dem in "$@"; do
    side=$(gdalinfo "$dem" | sed -n 's/^Size is \([0-9]*\), .*/\1/p')
    # Posts about 31 m apart, at 35 degrees north: pixels are half a step larger on each side than their posts.
    corners=$(awk "BEGIN { step = 0.35 / ($side - 1); west = 138.5 - step / 2; north = 35.5 + step / 2
                           printf \"%.15g %.15g %.15g %.15g\", west, north, west + $side * step, north - $side * step }")
    # shellcheck disable=SC2086  # four numbers
    gdal_translate -q -ot Float32 -a_srs EPSG:4326 -a_ullr $corners "$dem" "$work/dem.tif"
    gdal_translate -q -ot Float32 -of ENVI "$dem" "$work/dem.raw"
    "$relevo" ingest "$work/dem.tif" -o "$work/dem.relevo" --overwrite --quiet --sea none --errors incremental >&2
    (cd "$work" && node --max-old-space-size=8192 export_peers.mjs "$relevo" dem.relevo dem.raw "$side" "${RUNS:-5}" \
        "$first" ${ERRORS:-20 5 1})
    first=no
done
