#!/usr/bin/env bash
# @thi.ng/matrices 3.0.26 interpolates between two rotations that are less than 0.115 degrees apart by the one half-way,
# at any time: a slow turn moves in steps.
#
# mixQ() interpolates by slerp, and its documentation says that for a very small difference (eps, 0.001 by default) it
# changes to linear interpolation. It weighs both quaternions by a half then and ignores t: even at t = 0 and t = 1 it
# returns their middle. So a turn of 10 degrees/s, known at 120 Hz and resampled to 480, stands still and jumps at 40.
# If one of the two is written with the opposite signs, which is the same rotation, the sum nearly cancels, and a vector
# that is turned by it vanishes.
#
# Needs: npm and node (18 or later). Downloads 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @thi.ng/matrices@3.0.26 > /dev/null
cat > turn.mjs <<'CODE'
import { mixQ, mulVQ, quatFromAxisAngle } from '@thi.ng/matrices';

const turn = (degrees) => quatFromAxisAngle([0, 0, 1], degrees * Math.PI / 180);
const angle = (q) => 2 * Math.atan2(q[2], q[3]) * 180 / Math.PI;

for (const end of [0.2, 0.1]) {
  const angles = [0, 0.25, 0.5, 0.75, 1].map((t) => angle(mixQ([], turn(0), turn(end), t)).toFixed(3));
  console.log(`from 0 to ${end} degrees: ${angles.join(' ')}`);
}
console.log(`from 0 to 10 degrees, eps 0.2: ${[0, 0.5, 1].map((t) => angle(mixQ([], turn(0), turn(10), t, 0.2)).toFixed(3)).join(' ')}`);

for (const speed of [30, 10]) {
  const angles = [];
  for (let i = 0; i < 3; ++i) {  // frames of 120 Hz, four samples each
    for (const t of [0, 0.25, 0.5, 0.75]) angles.push(angle(mixQ([], turn(speed * i / 120), turn(speed * (i + 1) / 120), t)));
  }
  const speeds = angles.slice(1).map((x, i) => Math.round((x - angles[i]) * 480) + 0);
  console.log(`${speed} degrees/s at 480 Hz: ${speeds.join(' ')}`);
}

const opposite = mixQ([], turn(0), turn(0.1).map((x) => -x), 0.25);
console.log(`length if one has the opposite signs: ${Math.hypot(...opposite).toFixed(4)}`);
console.log(`length of a unit vector turned by that: ${Math.hypot(...mulVQ([], opposite, [1, 0, 0])).toFixed(4)}`);
CODE
node turn.mjs | tee said

cat > expected <<'SAID'
from 0 to 0.2 degrees: 0.000 0.050 0.100 0.150 0.200
from 0 to 0.1 degrees: 0.050 0.050 0.050 0.050 0.050
from 0 to 10 degrees, eps 0.2: 5.000 5.000 5.000
30 degrees/s at 480 Hz: 30 30 30 30 30 30 30 30 30 30 30
10 degrees/s at 480 Hz: 0 0 0 40 0 0 0 40 0 0 0
length if one has the opposite signs: 0.0004
length of a unit vector turned by that: 0.0000
SAID
diff expected said
echo 'As described: the middle, whatever the time.'
