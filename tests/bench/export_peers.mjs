// One table of export_peers.sh:
//   node export_peers.mjs RELEVO SCENE RAW SIDE RUNS HEADER ERROR...
//
// All errors are measured here, by brute force over all posts. martini's parameter is lowered by bisection until its
// measured error is within the wanted one; delatin's is the wanted one. Timed, after a warm-up run of each, in turns:
//   martini   createTile and getMesh (its constructor, which serves all tiles of a size, is left out)
//   delatin   the constructor and run
//   relevo    errors and mesh as it states them (`seconds`), the same and measuring every post, and the whole program:
//             reading and checking the scene, mesh, measuring, writing binary PLY
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import Martini from '@mapbox/martini';
import Delatin from 'delatin';

const [relevo, scene, raw, sideText, runsText, header, ...errorTexts] = process.argv.slice(2);
const side = Number(sideText);
const runs = Number(runsText);
const bytes = readFileSync(raw);
const heights = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + side * side * 4));

// Largest |triangle - post| over all posts of all triangles; all posts must be covered.
function measuredError(coords, triangles) {
    const covered = new Uint8Array(side * side);
    let worst = 0;
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [2 * triangles[t], 2 * triangles[t + 1], 2 * triangles[t + 2]];
        const [ax, ay, bx, by, cx, cy] =
            [coords[a], coords[a + 1], coords[b], coords[b + 1], coords[c], coords[c + 1]];
        const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
        if (area === 0) continue;
        const ha = heights[ay * side + ax];
        const db = heights[by * side + bx] - ha;
        const dc = heights[cy * side + cx] - ha;
        const top = Math.min(ay, by, cy);
        const bottom = Math.max(ay, by, cy);
        for (let y = top; y <= bottom; y++) {
            let first = Infinity;
            let last = -Infinity;
            for (const [x0, y0, x1, y1] of [[ax, ay, bx, by], [bx, by, cx, cy], [cx, cy, ax, ay]]) {
                if (y < Math.min(y0, y1) || y > Math.max(y0, y1)) continue;
                const ends = y0 === y1 ? [x0, x1] : [x0 + (x1 - x0) * (y - y0) / (y1 - y0)];
                first = Math.min(first, ...ends);
                last = Math.max(last, ...ends);
            }
            for (let x = Math.ceil(first - 1e-9); x <= last + 1e-9; x++) {
                const v = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area;
                const w = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area;
                worst = Math.max(worst, Math.abs(ha + v * db + w * dc - heights[y * side + x]));
                covered[y * side + x] = 1;
            }
        }
    }
    if (covered.includes(0)) throw new Error('a post is not covered');
    return worst;
}

function timed(work) {
    const start = performance.now();
    const result = work();
    return [(performance.now() - start) / 1000, result];
}

const martini = new Martini(side);
const runMartini = parameter => timed(() => martini.createTile(heights).getMesh(parameter));
const runDelatin = error => timed(() => {
    const tin = new Delatin(heights, side);
    tin.run(error);
    return tin;
});
function runRelevo(error) {
    const [seconds, done] = timed(() => spawnSync(relevo, ['export', scene, '-o', 'mesh.ply', '--max-error', String(error),
        '--coordinates', 'geodetic', '--overwrite', '--json', '--quiet'], { encoding: 'utf8' }));
    if (done.status !== 0) throw new Error(done.stderr);
    return [seconds, JSON.parse(done.stdout)];
}

function martiniParameter(error) {
    const tile = martini.createTile(heights);
    const errorOf = parameter => {
        const mesh = tile.getMesh(parameter);
        return measuredError(mesh.vertices, mesh.triangles);
    };
    if (errorOf(error) <= error) return error;
    let [good, bad] = [0, error];
    for (let i = 0; i < 12; i++) {
        const middle = (good + bad) / 2;
        if (errorOf(middle) <= error) good = middle; else bad = middle;
    }
    return good;
}

const median = numbers => [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
const spread = numbers => `${median(numbers).toFixed(1)} (${Math.min(...numbers).toFixed(1)} to ${Math.max(...numbers).toFixed(1)})`;

if (header === 'yes') {
    console.log('| posts | e m | relevo: triangles | max m | s | with measuring s | program s | martini: parameter | triangles | s ' +
                '| delatin: triangles | max m | s | triangles to martini | to delatin | times faster than delatin | with measuring |');
    console.log('|' + ' --- |'.repeat(17));
}
for (const error of errorTexts.map(Number)) {
    const parameter = martiniParameter(error);
    runMartini(parameter);
    if (side <= 1025) runDelatin(error); else runDelatin(20 * error);  // warm-up
    runRelevo(error);
    const times = { martini: [], delatin: [], relevo: [], measured: [], program: [] };
    let mesh, tin, ours;
    for (let run = 0; run < runs; run++) {
        let seconds;
        [seconds, mesh] = runMartini(parameter);
        times.martini.push(seconds);
        [seconds, ours] = runRelevo(error);
        times.relevo.push(ours.seconds);
        times.measured.push(ours.seconds + ours.measure_seconds);
        times.program.push(seconds);
        [seconds, tin] = runDelatin(error);
        times.delatin.push(seconds);
    }
    const martiniError = measuredError(mesh.vertices, mesh.triangles);
    const delatinError = measuredError(tin.coords, tin.triangles);
    if (martiniError > error || ours.max_error_m > error) throw new Error('an error is too large');
    const [martiniTriangles, delatinTriangles] = [mesh.triangles.length / 3, tin.triangles.length / 3];
    const faster = times.delatin.map((seconds, i) => seconds / times.relevo[i]);
    const fasterMeasured = times.delatin.map((seconds, i) => seconds / times.measured[i]);
    const cells = [side, error, ours.triangles, ours.max_error_m.toFixed(3), median(times.relevo).toFixed(3),
        median(times.measured).toFixed(3), median(times.program).toFixed(2), parameter.toFixed(3), martiniTriangles,
        median(times.martini).toFixed(2), delatinTriangles, delatinError.toFixed(3), median(times.delatin).toFixed(2),
        (ours.triangles / martiniTriangles).toFixed(2), (ours.triangles / delatinTriangles).toFixed(2),
        spread(faster), spread(fasterMeasured)];
    console.log(`| ${cells.join(' | ')} |`);
}
