#!/usr/bin/env bash
# three.js r187 reads the three angles of a USD object if the file calls them rotateXYZ, and drops the other five orders:
# the object is not turned.
#
# USD has six operations for three angles, rotateXYZ to rotateZYX, named after the order in which the axes apply, and
# three for one angle, rotateX, rotateY and rotateZ (OpenUSD, UsdGeomXformOp::Type). Animators choose the order for each
# object. USDLoader knows rotateXYZ and, at rest, the three single axes. A rotateZYX is dropped, with or without a
# motion, and so is every motion of a single axis, which a hinge has. The clip is then missing. There is no
# warning. Translations and rotateXYZ of the same file are right.
#
# Needs: npm and node (18 or later). Downloads 5 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 > /dev/null
cat > orders.mjs <<'CODE'
import { AnimationMixer, LoopOnce, REVISION, Vector3 } from 'three';
import { USDLoader } from 'three/examples/jsm/loaders/USDLoader.js';

const file = (operation, value) => `#usda 1.0
(
    defaultPrim = "root"
    metersPerUnit = 1
    timeCodesPerSecond = 10
    upAxis = "Y"
)

def Xform "root"
{
    def Xform "joint"
    {
        ${operation.length > 1 ? 'float3' : 'float'} xformOp:rotate${operation}${value}
        double3 xformOp:translate = (0, 1, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotate${operation}"]

        def Xform "end"
        {
            double3 xformOp:translate = (1, 2, 3)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
}
`;

const show = (point) => point.toArray().map((x) => (x + 0).toFixed(3)).join(' ');
function read(text) {  // the end of the joint, after a second if the file has a motion
  const root = new USDLoader().parse(text);
  for (const clip of root.animations) {
    const mixer = new AnimationMixer(root), action = mixer.clipAction(clip).setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    mixer.setTime(1);
  }
  root.updateMatrixWorld(true);
  return show(new Vector3().setFromMatrixPosition(root.getObjectByName('end').matrixWorld));
}
const angles = { X: 30, Y: 40, Z: 50 }, axes = { X: [1, 0, 0], Y: [0, 1, 0], Z: [0, 0, 1] };
function meant(operation) {  // turns about the fixed axes, one after the other
  const point = new Vector3(1, 2, 3);
  for (const axis of operation) point.applyAxisAngle(new Vector3(...axes[axis]), angles[axis] * Math.PI / 180);
  return show(point.add(new Vector3(0, 1, 0)));
}

console.log(`three.js r${REVISION}`);
for (const operation of ['XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX', 'X', 'Y', 'Z']) {
  const three = operation.length > 1, value = three ? '(30, 40, 50)' : angles[operation], zero = three ? '(0, 0, 0)' : 0;
  const still = read(file(operation, ` = ${value}`));
  const moving = read(file(operation, `.timeSamples = {\n            0: ${zero},\n            10: ${value},\n        }`));
  console.log(`rotate${operation}: meant ${meant(operation)}, at rest ${still}, after its motion ${moving}`);
}
CODE
node orders.mjs | tee said

cat > expected <<'SAID'
three.js r187
rotateXYZ: meant 1.801 3.508 2.113, at rest 1.801 3.508 2.113, after its motion 1.801 3.508 2.113
rotateXZY: meant 2.669 1.915 2.457, at rest 1.000 3.000 3.000, after its motion 1.000 3.000 3.000
rotateYXZ: meant 1.039 3.645 2.434, at rest 1.000 3.000 3.000, after its motion 1.000 3.000 3.000
rotateYZX: meant 0.200 3.073 3.108, at rest 1.000 3.000 3.000, after its motion 1.000 3.000 3.000
rotateZXY: meant 1.648 1.277 3.348, at rest 1.000 3.000 3.000, after its motion 1.000 3.000 3.000
rotateZYX: meant 1.247 1.342 3.511, at rest 1.000 3.000 3.000, after its motion 1.000 3.000 3.000
rotateX: meant 1.000 1.232 3.598, at rest 1.000 1.232 3.598, after its motion 1.000 3.000 3.000
rotateY: meant 2.694 3.000 1.655, at rest 2.694 3.000 1.655, after its motion 1.000 3.000 3.000
rotateZ: meant -0.889 3.052 3.000, at rest -0.889 3.052 3.000, after its motion 1.000 3.000 3.000
SAID
diff expected said
echo 'The behaviour is as described.'
