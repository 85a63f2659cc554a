#!/bin/sh
# Imports real elevation files and prints two tables in Markdown: what each import costs and how far it is from its
# source, and which files are refused and with what message. Next to each import runs plain GDAL with the same target
# grid: gdalwarp with the same resampling at its default tolerance, or gdal_translate where own posts are kept.
#
#   tests/bench/ingest_table.sh DATA_FOLDER RELEVO
#
# Needs gdal-bin, proj-bin and GNU time (package `time`). Times are medians of RUNS (3) interleaved runs of the whole
# programs, start-up included.
set -eu

if [ $# -ne 2 ]; then
    echo "usage: $0 DATA_FOLDER RELEVO" >&2
    exit 2
fi
data=$1
relevo=$2
runs=${RUNS:-3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
refused=$work/refused.md

# timed OUTPUT COMMAND...: runs it; prints seconds and peak KiB.
timed() {
    output=$1
    shift
    /usr/bin/time -f '%e %M' -o "$work/time" "$@" >"$output" 2>"$work/stderr" || return $?
    tail -n 1 "$work/time"
}

median() { sort -n "$1" | awk '{ a[NR] = $1 } END { print a[int((NR + 1) / 2)] }'; }

# field NAME FILE: the value of a number or text in pretty-printed JSON.
field() { sed -n "s/^ *\"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}\$/\1/p" "$2" | head -n 1; }

# table_row NAME INPUT GDAL_INPUT GDAL_FLAGS RELEVO_FLAGS
table_row() {
    name=$1 input=$2 gdal_input=$3 gdal_flags=$4 flags=$5
    [ -e "$input" ] || return 0
    rm -f "$work"/*.times
    run=0
    while [ $run -lt "$runs" ]; do
        status=0
        # shellcheck disable=SC2086  # flags are several words
        cost=$(timed "$work/json" "$relevo" ingest "$input" $flags -o "$work/scene.relevo" --overwrite --json) || status=$?
        if [ $status -ne 0 ]; then
            printf '| %s | %s | %s | %s |\n' "$name" "${flags:--}" $status \
                "$(sed 's/^relevo: //; /^note/d' "$work/stderr" | tr '\n' ' ')" >>"$refused"
            return 0
        fi
        echo "$cost" >>"$work/relevo.times"
        west=$(field west "$work/json") south=$(field south "$work/json")
        east=$(field east "$work/json") north=$(field north "$work/json")
        step_x=$(field step_x "$work/json") step_y=$(field step_y "$work/json")
        columns=$(field columns "$work/json") rows=$(field rows "$work/json")
        method=$(field method "$work/json")
        rm -f "$work/gdal.tif"
        if [ "$method" = none ]; then
            # shellcheck disable=SC2086
            timed /dev/null gdal_translate -q "$gdal_input" "$work/gdal.tif" >>"$work/gdal.times"
        else
            edges=$(awk "BEGIN { printf \"%.15g %.15g %.15g %.15g\", $west - $step_x / 2, $south - $step_y / 2,
                                                                    $east + $step_x / 2, $north + $step_y / 2 }")
            # shellcheck disable=SC2086
            timed /dev/null gdalwarp -q -r "$method" $gdal_flags -t_srs EPSG:4326 -te $edges -ts "$columns" "$rows" \
                -ot Float32 "$gdal_input" "$work/gdal.tif" >>"$work/gdal.times"
        fi
        run=$((run + 1))
    done
    seconds=$(median "$work/relevo.times")
    gdal_seconds=$(median "$work/gdal.times")
    memory=$(awk '{ if ($2 > m) m = $2 } END { printf "%.0f", m / 1024 }' "$work/relevo.times")
    ratio=$(awk "BEGIN { printf \"%.1f\", $seconds / ($gdal_seconds > 0 ? $gdal_seconds : 0.01) }")
    printf '| %s | %s | %s x %s | %.2f | %.2f | %s | %s | %.2f | %s | %.3f | %.3f | %s |\n' "$name" \
        "$(awk "BEGIN { printf \"%.2f\", $(wc -c <"$input") / 1048576 }")" "$columns" "$rows" "$seconds" "$gdal_seconds" \
        "$ratio" "$memory" "$(field bytes_per_post "$work/json")" "$method" "$(field rms_m "$work/json")" \
        "$(field max_m "$work/json")" "$(field lost_posts "$work/json")"
}

row() { table_row "$1" "$data/$1" "$data/$1" "" "${2:-}"; }

echo '| file | MiB | posts | s | GDAL s | ratio | peak MiB | bytes/post | resampling | RMS m | max m | lost posts |'
echo '| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |'
row coast/N48W125.hgt.zip
row coast/N43E007.hgt.zip
row coast/netherlands_30s.nc
row coast/netherlands_30s.nc '--crs EPSG:4326'
table_row coast/cairns.zip "$data/coast/cairns.zip" "/vsizip/$data/coast/cairns.zip/cairns.asc" '-s_srs EPSG:32755' ''
row coast/france_italy_etopo2.nc
row coast/france_italy_etopo2.nc '--crs EPSG:4326'
row coast/columbia.tif
row coast/nz_elev.tif
row mountains/mt_everest_90m.tif
row mountains/mt_rainier_90m.tif
row mountains/baltoro.tif
row mountains/bigtujunga.tif
row mosaic/pyrenees/N41E001.hgt.zip
row mosaic/pyrenees/N42E001.hgt.zip
row mosaic/gabon/N00E010.hgt
row mosaic/gabon/N00E011.hgt.zip
row mosaic/california/w122_n38.dt0
row mosaic/logan/loganvrt_0.tif
row mosaic/logan/logan.vrt
row odd/SainteHelens.dem
row odd/BEDMAP_elevation.nc
row odd/BEDMAP_elevation.nc '--crs EPSG:3031'
table_row odd/BEDMAP_elevation.nc "$data/odd/BEDMAP_elevation.nc" "$data/odd/BEDMAP_elevation.nc" '-s_srs EPSG:3031' \
    '--crs EPSG:3031 --crop -75,-82,-50,-65'
row odd/N00E010_utm.tif
row odd/fuji_terrainrgb.png
row odd/st_helens_point.tif
row odd/st_helens_area.tif
row odd/netherlands_cog_egm96.tif
row odd/fuji_dm_u16.png
table_row odd/fuji_dm_u16.png "$data/odd/fuji_dm_u16.png" "$data/odd/fuji_dm_u16.png" '-s_srs EPSG:3857' \
    '--crs EPSG:3857 --height-scale 0.1'
row odd/santa_barbara_airport.tif
row odd/santa_barbara_airport.tif '--crs EPSG:4326'
row imagery/everest_landsat_rgb.tif
row imagery/ww_sba_rgb.tif
table_row 'trinidad.nc (libncarg-data)' /usr/share/ncarg/data/cdf/trinidad.nc /usr/share/ncarg/data/cdf/trinidad.nc '' \
    '--crs EPSG:4326 --height-scale 0.30487804878'

echo
echo '| refused file | flags | exit status | message |'
echo '| --- | --- | --- | --- |'
[ ! -e "$refused" ] || cat "$refused"
