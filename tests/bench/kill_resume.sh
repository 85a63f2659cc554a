#!/bin/bash
# Kills imports at random moments, resumes them, and compares every byte with an import that nobody killed.
#
#   tests/bench/kill_resume.sh DATA_FOLDER RELEVO
#
# N (200) kills with SIGKILL of living imports, spread over the duration of an import; SEED (1) makes the same
# moments again. Four kinds of import take turns: a mosaic; a tile with voids filled and the sea found; both over a
# scene that exists. Every third time the resumed import is killed, too, before it is resumed again. After each kill
# nothing may have the scene's name but what had it before, or the whole new scene where the kill came after the last
# step; at the end the scene must be byte-equal and nothing else be left. Prints where the kills fell; exit status 1
# where anything differed.
set -u

if [ $# -ne 2 ]; then
    echo "usage: $0 DATA_FOLDER RELEVO" >&2
    exit 2
fi
data=$1 relevo=$2 n=${N:-200} seed=${SEED:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
RANDOM=$seed
place=$work/place/a.relevo
mosaic=("$data"/mosaic/pyrenees/N41E001.hgt.zip "$data"/mosaic/pyrenees/N42E001.hgt.zip "--crop=1.2,41.6,2,42.4")
coast=("$data"/coast/N43E007.hgt.zip --fill 8 --sea auto "--crop=7,43,8,43.8")
declare -A where=()
kills=0 late=0 twice=0 resumed=0 anew=0 whole=0 equal=0 wrong=0

complain() {
    wrong=$((wrong + 1))
    echo "WRONG (kill $kills, ${inputs[*]} ${flags[*]}): $*"
}

# How far the writer that was killed had come, from what it left behind.
stage() {
    local left
    left=$(find "$work/place" -maxdepth 1 -name '.a.relevo.partial-*' | head -n 1)
    if [ -z "$left" ] || [ ! -s "$left/raw-heights.journal" ] && [ ! -s "$left/heights.journal" ]; then
        echo "before the first block"
    elif [ ! -e "$left/job" ] || [ -e "$left/scene.json" ]; then
        echo "in the last steps"
    elif [ -s "$left/metrics.journal" ]; then
        echo "in metrics"
    else
        echo "in posts"
    fi
}

# kill_one FLAGS...: starts an import and kills it; whether it was still alive. Checks what has the scene's name.
kill_one() {
    local moment status
    moment=$(awk "BEGIN { printf \"%.4f\", 2 * $seconds * $((RANDOM * 32768 + RANDOM)) / 2^30 }")
    # exec: the process to kill is the program, not a shell around it.
    (exec "$relevo" ingest "${inputs[@]}" "${flags[@]}" -o "$place" --quiet "$@") >"$work/log" 2>&1 &
    local child=$!
    sleep "$moment"
    kill -9 $child 2>/dev/null
    wait $child 2>/dev/null
    status=$?
    if [ $status -eq 137 ]; then kills=$((kills + 1)); else late=$((late + 1)); fi
    if [ $status -ne 137 ]; then
        [ $status -eq 0 ] || complain "status $status: $(cat "$work/log")"
        whole=1
    elif [ -e "$place" ] && diff -r "$place" "$work/good-$kind" >/dev/null; then
        whole=1
        where["after the names were exchanged"]=$((${where["after the names were exchanged"]:-0} + 1))
    else
        local at
        at=$(stage)
        where[$at]=$((${where[$at]:-0} + 1))
        if [ ${#flags[@]} -eq 0 ]; then
            [ ! -e "$place" ] || complain "something has the scene's name"
        else
            diff -r "$place" "$work/old" >/dev/null || complain "the old scene was touched"
        fi
    fi
}

for kind in 0 1; do
    mkdir -p "$work/place"
    [ $kind = 0 ] && inputs=("${mosaic[@]}") || inputs=("${coast[@]}")
    flags=()
    for _ in 1 2 3 4; do  # the shortest counts: kills come within twice that, and in vain after the end
        rm -rf "$place"
        start=$(date +%s.%N)
        "$relevo" ingest "${inputs[@]}" -o "$place" --quiet >/dev/null || exit 1
        awk "BEGIN { print $(date +%s.%N) - $start }" >>"$work/seconds-$kind"
    done
    seconds_of[kind]=$(sort -n "$work/seconds-$kind" | head -n 1)
    mv "$place" "$work/good-$kind"
done
"$relevo" ingest "$data/mountains/baltoro.tif" -o "$work/old" --quiet >/dev/null || exit 1
echo "seed $seed; uninterrupted: ${seconds_of[0]} s (mosaic), ${seconds_of[1]} s (coast)"

for ((i = 0; kills < n; i++)); do
    kind=$((i % 2)) seconds=${seconds_of[i % 2]} whole=0
    [ $kind = 0 ] && inputs=("${mosaic[@]}") || inputs=("${coast[@]}")
    rm -rf "$work/place"
    mkdir "$work/place"
    flags=()
    if [ $((i / 2 % 2)) = 1 ]; then
        flags=(--overwrite)
        cp -r "$work/old" "$place"
    fi
    kill_one
    if [ $whole = 0 ] && [ $((i % 3)) = 2 ] && [ $kills -lt "$n" ]; then
        twice=$((twice + 1))
        kill_one --resume
    fi
    if [ $whole = 0 ] || [ ${#flags[@]} -gt 0 ]; then
        "$relevo" ingest "${inputs[@]}" "${flags[@]}" -o "$place" --resume >/dev/null 2>"$work/log" ||
            complain "the resumed import failed: $(cat "$work/log")"
        if grep -q 'begun anew' "$work/log"; then anew=$((anew + 1)); else resumed=$((resumed + 1)); fi
    fi
    if diff -r "$place" "$work/good-$kind" >/dev/null; then equal=$((equal + 1)); else complain "not byte-equal"; fi
    rm -f "$work/place/.a.relevo.lock"  # of a writer killed after its last step
    [ "$(ls -A "$work/place")" = a.relevo ] || complain "left behind: $(ls -A "$work/place")"
done
echo "kills: $kills, of which $twice of an import that was being resumed"
for at in "${!where[@]}"; do echo "  $at: ${where[$at]}"; done
echo "not killed, since they had ended: $late"
echo "imports: $i; went on from blocks: $resumed; begun anew, since nothing was left to go on from: $anew"
echo "byte-equal in the end: $equal of $i; wrong: $wrong"
[ $wrong = 0 ]
