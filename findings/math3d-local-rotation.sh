#!/usr/bin/env bash
# math3d 0.2.2 leaves the hand where it is if a shoulder turns by its localRotation.
#
# A Transform of a hierarchy has a rotation and a position in the world, and a localRotation and a localPosition
# relative to its parent (README). One may set all four. rotation and position move the children along, as rotate()
# does; localRotation and localPosition change this one joint only. So who poses a skeleton by its joints' local
# rotations, as motion files hold them, gets the rest positions of all joints. The rotations are mixed: a joint that is
# set after its parent has the right one, and one that is not set keeps its rest rotation.
#
# Needs: npm and node (18 or later). Downloads 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts math3d@0.2.2 > /dev/null
cat > arm.cjs <<'CODE'
const { Quaternion, Transform, Vector3 } = require('math3d');

const bend = Quaternion.Euler(0, 0, 90);
const poses = {
  'shoulder.rotation': ({ shoulder }) => { shoulder.rotation = bend; },
  'shoulder.rotate()': ({ shoulder }) => { shoulder.rotate(0, 0, 90); },
  'shoulder.localRotation': ({ shoulder }) => { shoulder.localRotation = bend; },
  'both by rotate()': ({ shoulder, elbow }) => { shoulder.rotate(0, 0, 90); elbow.rotate(0, 0, 90); },
  'both by localRotation': ({ shoulder, elbow }) => { shoulder.localRotation = bend; elbow.localRotation = bend; },
  'shoulder.position': ({ shoulder }) => { shoulder.position = new Vector3(0, 10, 0); },
  'shoulder.localPosition': ({ shoulder }) => { shoulder.localPosition = new Vector3(0, 10, 0); },
};
for (const [what, pose] of Object.entries(poses)) {  // an arm along X; the shoulder has no parent, so its local is its world
  const arm = { shoulder: new Transform(), elbow: new Transform(new Vector3(3, 0, 0)), hand: new Transform(new Vector3(5, 0, 0)) };
  arm.elbow.parent = arm.shoulder;
  arm.hand.parent = arm.elbow;
  pose(arm);
  const where = Object.entries(arm).map(([joint, { position, rotation }]) =>
    `${joint} at ${position.values.slice(0, 2).map((x) => Math.round(x) + 0).join(' ')} turned ${Math.round(rotation.eulerAngles.z)}`);
  console.log(`${what}: ${where.join(', ')}`);
}
CODE
node arm.cjs | tee said

cat > expected <<'SAID'
shoulder.rotation: shoulder at 0 0 turned 90, elbow at 0 3 turned 90, hand at 0 5 turned 90
shoulder.rotate(): shoulder at 0 0 turned 90, elbow at 0 3 turned 90, hand at 0 5 turned 90
shoulder.localRotation: shoulder at 0 0 turned 90, elbow at 3 0 turned 0, hand at 5 0 turned 0
both by rotate(): shoulder at 0 0 turned 90, elbow at 0 3 turned 180, hand at -2 3 turned 180
both by localRotation: shoulder at 0 0 turned 90, elbow at 3 0 turned 180, hand at 5 0 turned 0
shoulder.position: shoulder at 0 10 turned 0, elbow at 3 10 turned 0, hand at 5 10 turned 0
shoulder.localPosition: shoulder at 0 10 turned 0, elbow at 3 0 turned 0, hand at 5 0 turned 0
SAID
diff expected said
echo 'As described: the hand stays.'
