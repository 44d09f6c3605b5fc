#!/usr/bin/env bash
# OGL 1.0.11 moves a joint of a glTF spline to and fro between its keys: it multiplies the tangents by the wrong number.
#
# The tangents of a CUBICSPLINE sampler are speeds: a reader multiplies them by the time between the two keys (glTF 2.0,
# appendix C). OGL multiplies the first tangent by the part of that time which remains, the second by the part which has
# passed. If an exporter writes ten keys a second, both are about ten times too large: hips that walk at a constant
# 1.2 m/s, a straight line, are 10 cm ahead after a quarter of each step and 10 cm behind after three quarters. Between
# keys that are a second apart a straight line is right by chance, but a sway is half as large. At the keys all values
# are right. Rotations have the same fault.
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
const metres = (x) => [x, 0, 0];
// Each spline goes from position 0 at 0 s to the given position at the given time. The last two numbers are its speeds
// there.
const splines = [['hips, keys 0.1 s apart', 0.1, 0.12, 1.2, 1.2], ['hips, keys 1 s apart', 1, 1.2, 1.2, 1.2],
  ['hips, keys 2 s apart', 2, 2.4, 1.2, 1.2], ['a sway, keys 1 s apart', 1, 0, 1, 0]];
const samplers = splines.map(([, end, last, out, into]) => ({ interpolation: 'CUBICSPLINE',
  input: accessor('SCALAR', [[0], [end]]), output: accessor('VEC3', [0, 0, out, into, last, 0].map(metres)) }));
const skin = accessor('VEC3', [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]);
const bytes = Buffer.from(Float32Array.from(numbers).buffer);
const file = {
  asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
  meshes: [{ primitives: [{ attributes: { POSITION: skin } }] }],
  buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
  bufferViews, accessors, animations: samplers.map((sampler) => ({ samplers: [sampler],
    channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }] })) };

// OGL's loader needs a WebGL context. This one draws nothing and reports no errors.
const answers = { [Symbol.toPrimitive]: () => 0, getShaderInfoLog: () => '', getProgramInfoLog: () => '' };
const gl = new Proxy(() => gl, { get: (_, name) => answers[name] ?? gl });
const { nodes: [joint], animations } = await GLTFLoader.parse(gl, file, '');
animations.forEach(({ animation }, i) => {
  const [name, end, last, out, into] = splines[i];
  animation.loop = false;
  const said = [0, 0.25, 0.5, 0.75].map((t) => {
    animation.elapsed = t * end;
    animation.update(1, true);
    const right = (t ** 3 - 2 * t ** 2 + t) * end * out + (3 * t ** 2 - 2 * t ** 3) * last +
      (t ** 3 - t ** 2) * end * into;
    return `${joint.position.x.toFixed(3)} for ${right.toFixed(3)}`;
  });
  console.log(`${name}: ${said.join(', ')}`);
});
CODE
node clip.mjs | tee said

cat > expected <<'SAID'
hips, keys 0.1 s apart: 0.000 for 0.000, 0.131 for 0.030, 0.060 for 0.060, -0.011 for 0.090
hips, keys 1 s apart: 0.000 for 0.000, 0.300 for 0.300, 0.600 for 0.600, 0.900 for 0.900
hips, keys 2 s apart: 0.000 for 0.000, 0.488 for 0.600, 1.200 for 1.200, 1.913 for 1.800
a sway, keys 1 s apart: 0.000 for 0.000, 0.105 for 0.141, 0.063 for 0.125, 0.012 for 0.047
SAID
diff expected said
echo 'As described: the hips move to and fro.'
