#!/usr/bin/env bash
# gl-matrix 3.4.4 finds another rotation than the one that a matrix was made of, if its three scales differ.
#
# mat4.decompose "decomposes a transformation matrix into its rotation, translation and scale components", which
# fromRotationTranslationScale composes. To remove the scales, decompose and getRotation divide the three numbers of one
# axis by three different scales, instead of dividing all three by the scale of this axis. With equal scales this makes
# no difference. With scales 1, 1, 2 a turn of 30 degrees about X becomes one of 37, and about another axis the axis
# changes, too; the quaternion's length is no longer 1. Translation and scales are right. A bone that is stretched along
# its length is such a matrix. three.js r187's Matrix4.decompose is right.
#
# Needs: npm and node (18 or later). Downloads 6 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts gl-matrix@3.4.4 three@0.187.0 > /dev/null
cat > parts.mjs <<'CODE'
import { mat4, quat, vec3 } from 'gl-matrix';
import { Matrix4, Quaternion, Vector3 } from 'three';

function show([x, y, z, w]) {
  const length = Math.hypot(x, y, z);
  return `${(2 * Math.atan2(length, w) * 180 / Math.PI).toFixed(1)} about ${[x, y, z].map((part) => (part / length).toFixed(2)).join(' ')}`;
}
const slanted = [1, 2, 3].map((part) => part / Math.sqrt(14));
for (const [scales, axis, degrees] of [[[2, 2, 2], [1, 0, 0], 30], [[1, 1, 2], [1, 0, 0], 30], [[1, 1, 2], slanted, 60],
                                       [[1, 3, 1], slanted, 60]]) {
  const turn = quat.setAxisAngle(quat.create(), axis, degrees * Math.PI / 180);
  const matrix = mat4.fromRotationTranslationScale(mat4.create(), turn, [4, 5, 6], scales);
  const rotation = quat.create(), translation = vec3.create(), found = vec3.create(), other = new Quaternion();
  mat4.decompose(rotation, translation, found, matrix);
  new Matrix4().fromArray(matrix).decompose(new Vector3(), other, new Vector3());
  const same = quat.exactEquals(rotation, mat4.getRotation(quat.create(), matrix)) ? 'getRotation agrees' : 'getRotation differs';
  console.log(`scales ${scales}, turn ${show(turn)}`);
  const length = quat.length(rotation).toFixed(2);
  console.log(`  gl-matrix: scales ${Array.from(found, (x) => +x.toFixed(4))}, turn ${show(rotation)}, of length ${length}; ${same}`);
  console.log(`  three.js:  turn ${show(other.toArray())}`);
}
CODE
node parts.mjs | tee said

cat > expected <<'SAID'
scales 2,2,2, turn 30.0 about 1.00 0.00 0.00
  gl-matrix: scales 2,2,2, turn 30.0 about 1.00 0.00 0.00, of length 1.00; getRotation agrees
  three.js:  turn 30.0 about 1.00 0.00 0.00
scales 1,1,2, turn 30.0 about 1.00 0.00 0.00
  gl-matrix: scales 1,1,2, turn 37.0 about 1.00 0.00 0.00, of length 1.02; getRotation agrees
  three.js:  turn 30.0 about 1.00 0.00 0.00
scales 1,1,2, turn 60.0 about 0.27 0.53 0.80
  gl-matrix: scales 1,1,2, turn 65.6 about 0.13 0.68 0.72, of length 1.03; getRotation agrees
  three.js:  turn 60.0 about 0.27 0.53 0.80
scales 1,3,1, turn 60.0 about 0.27 0.53 0.80
  gl-matrix: scales 1,3,1, turn 83.5 about 0.50 0.35 0.79, of length 1.16; getRotation agrees
  three.js:  turn 60.0 about 0.27 0.53 0.80
SAID
diff expected said
echo 'The behaviour is as described.'
