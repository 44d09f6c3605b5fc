#!/usr/bin/env bash
# OGL 1.0.11 moves a glTF joint beyond its keys: it continues the first step backwards before the first key, and
# forwards after the last one.
#
# Before its first key a glTF channel has its first value, after its last key the last one (glTF 2.0, section 3.11).
# The channels of a clip need not start and end together: a joint that stands still needs no keys. OGL looks for the
# first key after the present time. If there is none, or it is the first of all, OGL takes the first two keys and
# extrapolates. So a hand that is lifted by 20 cm in half a second and then rests, while the hips walk on, is 60 cm too
# high 1.5 s later, and its wrist goes on turning. A clip whose channels start and end together hides this.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts ogl@1.0.11 > /dev/null
cat > clip.mjs <<'CODE'
import { GLTFLoader } from 'ogl';

const accessors = [], bufferViews = [], numbers = [];
function accessor(type, rows) {
  const values = Float32Array.from(rows.flat()), width = rows[0].length;
  const extreme = (pick) => rows[0].map((_, i) => pick(...values.filter((_, j) => j % width === i)));
  bufferViews.push({ buffer: 0, byteOffset: 4 * numbers.length, byteLength: values.byteLength });
  numbers.push(...values);
  return accessors.push({ bufferView: bufferViews.length - 1, componentType: 5126, count: rows.length, type,
    min: extreme(Math.min), max: extreme(Math.max) }) - 1;
}
const half = (degrees) => [0, 0, Math.sin(degrees * Math.PI / 360), Math.cos(degrees * Math.PI / 360)];  // about z
const samplers = [
  { input: accessor('SCALAR', [[1], [1.5]]), output: accessor('VEC3', [[0, 1, 0], [0, 1.2, 0]]) },   // the hand
  { input: accessor('SCALAR', [[1], [1.5]]), output: accessor('VEC4', [half(0), half(30)]) },        // the hand
  { input: accessor('SCALAR', [[0], [5]]), output: accessor('VEC3', [[0, 0, 0], [5, 0, 0]]) }];      // the hips
const skin = accessor('VEC3', [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]);
const bytes = Buffer.from(Float32Array.from(numbers).buffer);
const file = {
  asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0, 1] }], nodes: [{ mesh: 0 }, {}],
  meshes: [{ primitives: [{ attributes: { POSITION: skin } }] }],
  buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
  bufferViews, accessors, animations: [{ samplers, channels: [
    { sampler: 0, target: { node: 0, path: 'translation' } }, { sampler: 1, target: { node: 0, path: 'rotation' } },
    { sampler: 2, target: { node: 1, path: 'translation' } }] }] };

// OGL's loader needs a WebGL context. This one draws nothing and reports no errors.
const answers = { [Symbol.toPrimitive]: () => 0, getShaderInfoLog: () => '', getProgramInfoLog: () => '' };
const gl = new Proxy(() => gl, { get: (_, name) => answers[name] ?? gl });
const { nodes: [hand, hips], animations: [{ animation }] } = await GLTFLoader.parse(gl, file, '');
for (const time of [0, 0.5, 1, 1.25, 1.5, 2, 3]) {
  animation.elapsed = time;
  animation.update(1, true);
  const part = Math.min(Math.max((time - 1) / 0.5, 0), 1);  // of the hand's movement
  const turn = 2 * Math.atan2(hand.quaternion.z, hand.quaternion.w) * 180 / Math.PI;
  console.log(`${time} s: hips ${hips.position.x.toFixed(1)}, hand ${hand.position.y.toFixed(2)} for ` +
    `${(1 + 0.2 * part).toFixed(2)}, turned by ${turn.toFixed(0)} for ${(30 * part).toFixed(0)}`);
}
CODE
node clip.mjs | tee said

cat > expected <<'SAID'
0 s: hips 0.0, hand 0.60 for 1.00, turned by -60 for 0
0.5 s: hips 0.5, hand 0.80 for 1.00, turned by -30 for 0
1 s: hips 1.0, hand 1.00 for 1.00, turned by 0 for 0
1.25 s: hips 1.3, hand 1.10 for 1.10, turned by 15 for 15
1.5 s: hips 1.5, hand 1.20 for 1.20, turned by 30 for 30
2 s: hips 2.0, hand 1.40 for 1.20, turned by 60 for 30
3 s: hips 3.0, hand 1.80 for 1.20, turned by 120 for 30
SAID
diff expected said
echo 'As described: the hand does not rest.'
