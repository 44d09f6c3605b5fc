#!/usr/bin/env bash
# leapjs 1.1.1 finds a wrong axis of a hand's rotation unless the hand was level before: if it was turned to the side by
# 90 degrees, the axis is perpendicular to the right one.
#
# rotationAxis(frame) is documented as the axis of "the rotational change of the hand" since another frame. The axis of
# a rotation follows from differences of entries of its matrix, which rotationMatrix(frame) returns. But rotationAxis
# subtracts an entry of the earlier orientation from one of the present orientation; that is right only while a hand
# turns about one axis from a level start. Below, a hand turned to the side by 0 to 90 degrees tilts by 20 degrees. The
# angle between the axis found and the right one, the vector that rotationMatrix does not move, grows to 90 degrees;
# rotationAngle(frame, axis), which uses that axis, finds less and less of the tilt. rotationAngle(frame) is right.
# Frames, which stand for all hands, have the same fault.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts leapjs@1.1.1 > /dev/null
cat > tilt.cjs <<'CODE'
const { Frame } = require('leapjs');

const degree = Math.PI / 180;
const cos = (angle) => Math.cos(angle * degree), sin = (angle) => Math.sin(angle * degree);
const aboutX = (a) => [[1, 0, 0], [0, cos(a), -sin(a)], [0, sin(a), cos(a)]];
const aboutY = (a) => [[cos(a), 0, sin(a)], [0, 1, 0], [-sin(a), 0, cos(a)]];
const times = (a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

// A frame of the tracker with one hand; r is the orientation of the hand, and of the frame.
function frame(id, r) {
  const zero = [0, 0, 0];
  const hand = { id: 7, r, t: zero, s: 1, direction: [0, 0, -1], palmNormal: [0, -1, 0], palmPosition: [0, 200, 0],
    palmVelocity: zero, stabilizedPalmPosition: [0, 200, 0], sphereCenter: zero, sphereRadius: 50, timeVisible: 1,
    type: 'right', grabStrength: 0, pinchStrength: 0, confidence: 1 };
  return new Frame({ id, timestamp: 10000 * id, hands: [hand], pointables: [], r, t: zero, s: 1 });
}

// The vector that a rotation by the library's matrix (a column after the other) leaves where it is.
function fixed(m) {
  const axis = [m[7] - m[5], m[2] - m[6], m[3] - m[1]], length = Math.hypot(...axis);
  const unit = axis.map((x) => x / length);
  const moved = [0, 1, 2].map((i) => dot([m[i], m[i + 3], m[i + 6]], unit));
  if (Math.hypot(...moved.map((x, i) => x - unit[i])) > 1e-6) throw new Error('this vector moves');
  return unit;
}
const between = (a, b) => Math.acos(Math.min(1, Math.abs(dot(a, b)))) / degree;  // of two lines

for (const side of [0, 5, 10, 30, 60, 90]) {
  const before = frame(1, aboutY(side)), after = frame(2, times(aboutY(side), aboutX(20)));
  const hand = after.hand(7), right = fixed(hand.rotationMatrix(before));
  const all = between(Array.from(after.rotationAxis(before)), right);
  const one = between(Array.from(hand.rotationAxis(before)), right);
  const found = Math.abs(hand.rotationAngle(before, right)) / degree;
  console.log(`turned by ${side}, then tilted by ${(hand.rotationAngle(before) / degree).toFixed(0)}: axis off by ` +
    `${one.toFixed(0)} (frame ${all.toFixed(0)}), ${found.toFixed(1)} about the right axis`);
}
CODE
node tilt.cjs | tee said

cat > expected <<'SAID'
turned by 0, then tilted by 20: axis off by 0 (frame 0), 20.0 about the right axis
turned by 5, then tilted by 20: axis off by 26 (frame 26), 17.9 about the right axis
turned by 10, then tilted by 20: axis off by 45 (frame 45), 14.1 about the right axis
turned by 30, then tilted by 20: axis off by 73 (frame 73), 5.8 about the right axis
turned by 60, then tilted by 20: axis off by 84 (frame 84), 2.0 about the right axis
turned by 90, then tilted by 20: axis off by 90 (frame 90), 0.0 about the right axis
SAID
diff expected said
echo 'As described: the axis is wrong.'
