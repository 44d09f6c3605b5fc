#!/usr/bin/env bash
# @galacean/engine-math 1.6.13 gives every turn from 0.115 to 60 degrees a rotation vector of about the length 2: the
# axis that belongs to the angle is too long.
#
# Quaternion.getAxisAngle() divides the vector part of the quaternion by its squared length instead of its length, so
# that the axis is 1 / sin(angle / 2) long; no comment says so. Axis times angle, the rotation vector that angular
# velocities and means of rotations need, then has about 2 radians. A joint whose speed is computed from one frame to
# the next at 60 Hz turns at about 6900 degrees a second, whether it is fast or slow. The angle alone is right, and at
# 180 degrees the axis is, too. Below 0.115 degrees a frame the angle is 0, and the joint stands still.
# rotationAxisAngle() normalizes its axis, so a round trip hides the fault.
#
# Needs: npm and node (18 or later). Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @galacean/engine-math@1.6.13 > /dev/null
cat > speed.cjs <<'CODE'
const { Quaternion, Vector3 } = require('@galacean/engine-math');

const rate = 60, degree = Math.PI / 180, x = new Vector3(1, 0, 0);
const turn = (degrees) => {
  const quaternion = new Quaternion();
  Quaternion.rotationAxisAngle(x, degrees * degree, quaternion);
  return quaternion;
};
const axis = new Vector3();
for (const speed of [6, 60, 300, 600, 1800, 10800]) {  // degrees a second
  const step = new Quaternion();  // from one frame to the next
  Quaternion.multiply(turn(20).invert(), turn(20 + speed / rate), step);
  const angle = step.getAxisAngle(axis) / degree;
  console.log(`${speed} degrees/s: axis ${axis.length().toFixed(1)} long, angle ${angle.toFixed(1)} a frame, ` +
    `both x ${rate} Hz: ${(axis.length() * angle * rate).toFixed(0)} degrees/s`);
}
CODE
node speed.cjs | tee said

cat > expected <<'SAID'
6 degrees/s: axis 1.0 long, angle 0.0 a frame, both x 60 Hz: 0 degrees/s
60 degrees/s: axis 114.6 long, angle 1.0 a frame, both x 60 Hz: 6876 degrees/s
300 degrees/s: axis 22.9 long, angle 5.0 a frame, both x 60 Hz: 6878 degrees/s
600 degrees/s: axis 11.5 long, angle 10.0 a frame, both x 60 Hz: 6884 degrees/s
1800 degrees/s: axis 3.9 long, angle 30.0 a frame, both x 60 Hz: 6955 degrees/s
10800 degrees/s: axis 1.0 long, angle 180.0 a frame, both x 60 Hz: 10800 degrees/s
SAID
diff expected said
echo 'As described: 60 degrees a second and 1800 have nearly the same speed.'
