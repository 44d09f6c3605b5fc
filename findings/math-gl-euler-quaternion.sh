#!/usr/bin/env bash
# math.gl 4.1.0's Euler.getQuaternion applies roll about Z and yaw about X; Euler.getRotationMatrix applies roll about
# X, yaw about Z.
#
# The documentation calls an Euler's angles roll, pitch and yaw; the default order is RollPitchYaw. The matrix, class
# Pose and fromQuaternion turn by the first angle about X, whatever the order. getQuaternion turns by each angle about
# the axis that has the same place in the order, so it agrees for XYZ only: in the default order, ZYX, a roll of 30
# degrees becomes a yaw. A quaternion that is read into an Euler and converted back becomes another rotation.
#
# Needs: npm and node (18 or later). Downloads 0.5 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @math.gl/core@4.1.0 > /dev/null
cat > angles.mjs <<'CODE'
import { Euler, Matrix4, Pose, Quaternion } from '@math.gl/core';

const degree = Math.PI / 180;
const say = (what, matrix) => console.log(`  ${what}: ${[...matrix.transformAsVector([1, 2, 3])].map((x) => x.toFixed(3)).join(' ')}`);
const ofQuaternion = (quaternion) => new Matrix4().fromQuaternion(quaternion);

console.log('roll 30 degrees, (1, 2, 3) becomes');
const roll = new Euler().fromRollPitchYaw(30 * degree, 0, 0);
say('getRotationMatrix', new Matrix4(roll.getRotationMatrix()));
say('Pose             ', new Pose({ roll: 30 * degree }).getTransformationMatrix());
say('getQuaternion    ', ofQuaternion(roll.getQuaternion()));

console.log('30 degrees about X as a quaternion');
const about = new Quaternion().fromAxisRotation([1, 0, 0], 30 * degree);
say('itself                ', ofQuaternion(about));
say('through fromQuaternion', ofQuaternion(new Euler().fromQuaternion(about).getQuaternion()));

for (const order of ['XYZ', 'YXZ', 'ZXY', 'ZYX', 'YZX', 'XZY']) {
  const euler = new Euler(10 * degree, 20 * degree, 30 * degree, Euler[order]);
  const same = new Matrix4(euler.getRotationMatrix()).equals(ofQuaternion(euler.getQuaternion()));
  console.log(`order ${order}: matrix and quaternion are ${same ? 'one rotation' : 'two rotations'}`);
}
CODE
node angles.mjs | tee said

cat > expected <<'SAID'
roll 30 degrees, (1, 2, 3) becomes
  getRotationMatrix: 1.000 0.232 3.598
  Pose             : 1.000 0.232 3.598
  getQuaternion    : -0.134 2.232 3.000
30 degrees about X as a quaternion
  itself                : 1.000 0.232 3.598
  through fromQuaternion: -0.134 2.232 3.000
order XYZ: matrix and quaternion are one rotation
order YXZ: matrix and quaternion are two rotations
order ZXY: matrix and quaternion are two rotations
order ZYX: matrix and quaternion are two rotations
order YZX: matrix and quaternion are two rotations
order XZY: matrix and quaternion are two rotations
SAID
diff expected said
echo 'As described: the quaternion turns about other axes.'
