#!/usr/bin/env bash
# Kalidokit 1.1.5 straightens a finger or an elbow again as soon as it is bent by more than 90 degrees.
#
# It turns the landmarks of MediaPipe into "joint rotations in radians" (its README). A finger's angle comes from three
# landmarks: 180 degrees for a straight finger, less for a bent one. Kalidokit subtracts angles of 90 degrees and more
# from 180, which gives the bend, but returns smaller angles as they are: a bend of 120 degrees becomes 60. A fist
# needs about 100 degrees in the middle joints. The bend of an elbow is scaled as well, but 60 and 120 degrees are
# equal there, too: an arm that bends by 150 degrees seems to bend by 90 and to stretch again. The landmarks below are
# exact and bend in one plane, so the right values are known. There is no warning.
#
# Needs: npm and node (18 or later). Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts kalidokit@1.1.5 > /dev/null
cat > bend.cjs <<'CODE'
const { Hand, Pose } = require('kalidokit/dist/kalidokit.umd.js');

// A point that is one unit from another one, in a direction that is turned by so many degrees from y towards z.
const next = ({ x, y, z }, turned) =>
  ({ x, y: y + Math.cos(turned * Math.PI / 180), z: z + Math.sin(turned * Math.PI / 180) });

// A hand: its wrist and five fingers of four points each. Only the middle joint of the index finger is bent by `bend`.
function hand(bend) {
  const points = [{ x: 0, y: 0, z: 0 }];
  for (let finger = 0; finger < 5; ++finger) {
    const index = finger === 1;
    points.push({ x: finger - 1, y: 2, z: 0 });
    for (const turned of [5, 5 + (index ? bend : 5), 10 + (index ? bend : 5)]) points.push(next(points.at(-1), turned));
  }
  return points;
}

// An arm: landmarks 11 and 12 are the shoulders, 13 is an elbow, 15 a wrist, 17 and 19 are fingers.
function elbow(bend) {
  const body = Array.from({ length: 33 }, () => ({ x: 1, y: 1, z: 1 }));
  body[12] = { x: -1, y: 0, z: 0 };
  body[11] = { x: 0, y: 0, z: 0 };
  body[13] = next(body[11], 0);
  body[15] = next(body[13], bend);
  body[17] = body[19] = next(body[15], bend);
  return Pose.calcArms(body).LowerArm.r.y;
}

const degrees = (radians) => (radians * 180 / Math.PI).toFixed(0);
for (const bend of [30, 60, 80, 89, 91, 100, 120, 150]) {
  const finger = ['Right', 'Left'].map((side) => degrees(Hand.solve(hand(bend), side)[`${side}IndexIntermediate`].z));
  console.log(`bent by ${bend}: finger ${finger.join(', ')}; elbow ${degrees(elbow(bend))}`);
}
CODE
node bend.cjs | tee said

cat > expected <<'SAID'
bent by 30: finger -30, 30; elbow 20
bent by 60: finger -60, 60; elbow 41
bent by 80: finger -80, 80; elbow 54
bent by 89: finger -89, 89; elbow 61
bent by 91: finger -89, 89; elbow 61
bent by 100: finger -80, 80; elbow 54
bent by 120: finger -60, 60; elbow 41
bent by 150: finger -30, 30; elbow 20
SAID
diff expected said
grep -q 'Joint rotations in radians' node_modules/kalidokit/README.md
echo 'As described: beyond 90 degrees the joint straightens again.'
