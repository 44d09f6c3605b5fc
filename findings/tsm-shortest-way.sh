#!/usr/bin/env bash
# @tlaukkan/tsm 0.8.5's shortMix, which should take the shortest way between two rotations, goes to the inverse of the
# second one if the signs of the quaternions differ.
#
# q and -q are one rotation. An interpolation on the shortest way negates one of two quaternions whose dot product is
# negative; shortMix inverts it instead (x, y and z change signs, w does not). Halfway from 10 to 50 degrees is then 160
# instead of 30, and shortly before the end, where it should be almost 50, it is -50; at 1 it jumps to 50. Exporters and
# sensors write either sign, so a joint that turns steadily makes a wrong turn where the sign changes. gl-matrix, which
# the README names as a model, is right. There is no error. tsm has no documentation of shortMix besides its name.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @tlaukkan/tsm@0.8.5 gl-matrix@3.4.4 > /dev/null
cat > mix.cjs <<'CODE'
const { quat } = require('@tlaukkan/tsm');
const glMatrix = require('gl-matrix');

const degree = Math.PI / 180;
const about = (angle, sign) => [0, 0, sign * Math.sin(angle / 2 * degree), sign * Math.cos(angle / 2 * degree)];
const angle = ([, , z, w]) => {
  const whole = 2 * Math.atan2(z, w) / degree;
  return (whole - 360 * Math.round(whole / 360)).toFixed(1);
};
for (const sign of [1, -1])
  for (const t of [0, 0.25, 0.5, 0.75, 0.99, 1]) {
    const a = about(10, 1), b = about(50, sign);
    const mixed = quat.shortMix(new quat(a), new quat(b), t).xyzw;
    const right = glMatrix.quat.slerp(glMatrix.quat.create(), a, b, t);
    console.log(`10 to ${sign < 0 ? 'minus the quaternion of ' : ''}50 degrees, ${t}: shortMix ${angle(mixed)}, ` +
      `gl-matrix ${angle(right)}`);
  }
CODE
node mix.cjs | tee said

cat > expected <<'SAID'
10 to 50 degrees, 0: shortMix 10.0, gl-matrix 10.0
10 to 50 degrees, 0.25: shortMix 20.0, gl-matrix 20.0
10 to 50 degrees, 0.5: shortMix 30.0, gl-matrix 30.0
10 to 50 degrees, 0.75: shortMix 40.0, gl-matrix 40.0
10 to 50 degrees, 0.99: shortMix 49.6, gl-matrix 49.6
10 to 50 degrees, 1: shortMix 50.0, gl-matrix 50.0
10 to minus the quaternion of 50 degrees, 0: shortMix 10.0, gl-matrix 10.0
10 to minus the quaternion of 50 degrees, 0.25: shortMix 36.7, gl-matrix 20.0
10 to minus the quaternion of 50 degrees, 0.5: shortMix 160.0, gl-matrix 30.0
10 to minus the quaternion of 50 degrees, 0.75: shortMix -76.7, gl-matrix 40.0
10 to minus the quaternion of 50 degrees, 0.99: shortMix -50.6, gl-matrix 49.6
10 to minus the quaternion of 50 degrees, 1: shortMix 50.0, gl-matrix 50.0
SAID
diff expected said
echo 'As described: shortMix goes to the inverse rotation.'
