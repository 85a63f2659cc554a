#!/bin/bash
# Imports two adjoining SRTM tiles, warped up to a grid of 16385 x 16385 posts, and compares with GDAL doing the
# same: gdalwarp (same grid, cubic, its default tolerance, 2 threads) and gdal_translate to a COG with the same
# compression. Runs are interleaved; prints seconds, the ratios' medians, sizes and the largest memory.
#   tests/bench/ingest_large.sh RELEVO FOLDER_WITH_TILES [RUNS]
set -euo pipefail
relevo=$1
tiles=("$2"/N41E001.hgt.zip "$2"/N42E001.hgt.zip)
runs=${3:-5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

timed() {  # seconds and MiB of a command
    /usr/bin/time -f "%e %M" -o "$work/time" "$@" >/dev/null 2>&1
    awk '{printf "%.1f %d\n", $1, $2 / 1024}' "$work/time"
}
import() {
    timed "$relevo" ingest "${tiles[@]}" --resolution 0.00006103515625,0.0001220703125 --errors "$1" \
        -o "$work/$1.relevo" --overwrite --quiet
}
with_gdal() {
    timed gdalwarp -q -overwrite -r cubic -multi -wo NUM_THREADS=2 -ot Float32 -dstnodata -9999 \
        -t_srs EPSG:4326 -ts 16385 16385 -te 0.999969482421875 40.99993896484375 2.000030517578125 \
        43.00006103515625 "${tiles[@]}" "$work/warped.tif"
    timed gdal_translate -q -of COG -co COMPRESS=ZSTD -co LEVEL=9 -co PREDICTOR=FLOATING_POINT \
        -co NUM_THREADS=2 "$work/warped.tif" "$work/cog.tif"
}
median() { sort -n | awk '{v[NR] = $1} END {print (NR % 2) ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2}'; }

for ((i = 1; i <= runs; ++i)); do
    read -r gdal _ < <(with_gdal | awk '{s += $1} END {print s, 0}')
    read -r bounded bounded_mib < <(import bounded)
    read -r incremental incremental_mib < <(import incremental)
    awk -v i="$i" -v g="$gdal" -v b="$bounded" -v n="$incremental" -v bm="$bounded_mib" -v nm="$incremental_mib" \
        'BEGIN {printf "run %d: GDAL %.1f s, bounded %.1f s (%.2f), %d MiB, incremental %.1f s (%.2f), %d MiB\n",
                i, g, b, b / g, bm, n, n / g, nm}'
    awk "BEGIN {print $bounded / $gdal}" >>"$work/bounded"
    awk "BEGIN {print $incremental / $gdal}" >>"$work/incremental"
done
echo "median ratio: bounded $(median <"$work/bounded"), incremental $(median <"$work/incremental")"
gdal_translate -q -of COG -co COMPRESS=ZSTD -co LEVEL=9 -co PREDICTOR=FLOATING_POINT -co OVERVIEWS=NONE \
    -co NUM_THREADS=2 "$work/warped.tif" "$work/plain.tif"
echo "bytes: COG $(stat -c %s "$work/cog.tif"), COG without overviews $(stat -c %s "$work/plain.tif")"
"$relevo" info "$work/bounded.relevo" | tail -1
