#!/usr/bin/env bash
# angle-between-landmarks 1.1.4 gives NaN for a third of all straight limbs, and whole degrees even if round is false.
#
# It computes the angle at the middle one of three landmarks by the law of cosines. If the three lie on one line, as
# those of a straight arm, rounding makes the cosine slightly less than -1 in a third of all cases, and the arc cosine
# is NaN. A comparison with NaN is false: a coach that waits for an arm of more than 170 degrees misses the straightest
# ones. The option round is true by default; if it is false, the angle is rounded all the same, so a slow movement goes
# in steps of a degree. atan2 of the same landmarks gives all angles. As the README demands, the arms below are
# normalised, here by a picture of 640 x 480 pixels.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts angle-between-landmarks@1.1.4 > /dev/null
cat > limbs.cjs <<'CODE'
const findAngle = require('angle-between-landmarks');

function direct(a, b, c) {
  const [x1, y1, x2, y2] = [a.x - b.x, a.y - b.y, c.x - b.x, c.y - b.y];
  return Math.abs(Math.atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)) * 180 / Math.PI;
}
const at = (x, y) => ({ x: x / 640, y: y / 480 });
const options = { small: true, round: false };

// Straight arms: the elbow in the middle, the shoulder up to 100 pixels away, the forearm shorter or longer.
const readers = { 'angle-between-landmarks': (...limb) => findAngle(...limb, options), atan2: direct };
for (const [name, angle] of Object.entries(readers)) {
  const angles = [];
  for (let dx = 10; dx <= 100; dx += 10)
    for (let dy = 10; dy <= 100; dy += 10)
      for (const part of [0.5, 0.6, 0.8, 1, 1.2])
        angles.push(angle(at(300 - dx, 200 - dy), at(300, 200), at(300 + part * dx, 200 + part * dy)));
  const missing = angles.filter(Number.isNaN).length / angles.length;
  console.log(`${name}: ${missing > 0.25 ? 'over a quarter' : missing} of ${angles.length} straight arms are NaN`);

  const slow = [0, 1, 2, 3, 4, 5].map((i) => 0.4 * i * Math.PI / 180);
  const bent = slow.map((turn) => angle(at(300, 100), at(300, 200),
    at(300 + 64 * Math.cos(turn), 200 + 48 * Math.sin(turn))));
  console.log(`  bending from 90 degrees by 0.4 each time: ${bent.map((it) => it.toFixed(1)).join(' ')}`);
}
CODE
node limbs.cjs | tee said

cat > expected <<'SAID'
angle-between-landmarks: over a quarter of 500 straight arms are NaN
  bending from 90 degrees by 0.4 each time: 90.0 90.0 91.0 91.0 92.0 92.0
atan2: 0 of 500 straight arms are NaN
  bending from 90 degrees by 0.4 each time: 90.0 90.4 90.8 91.2 91.6 92.0
SAID
diff expected said
echo 'As described: straight arms have no angle.'
