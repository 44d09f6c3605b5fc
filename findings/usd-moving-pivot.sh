#!/usr/bin/env bash
# three.js r187 forgets the pivot of a USD object as soon as the object turns: it then turns about another point.
#
# The transformation of a USD object is the product of all operations in its xformOpOrder (OpenUSD, UsdGeomXformable). A
# turn about a point p is translate:pivot p, a rotation, and the inverse of translate:pivot. USDLoader multiplies all
# operations at rest. But it makes a track of each operation that moves, and the track replaces the position, rotation
# or scale of the product: the track of the rotation leaves the position as it was, and the track of a translation
# replaces all other translations. A door turns about its middle instead of its hinge, and a moving translate cancels
# the pivot's part of the position. There is no warning.
#
# Needs: npm and node (18 or later). Downloads 5 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 > /dev/null
cat > pivot.mjs <<'CODE'
import { AnimationMixer, LoopOnce, REVISION, Vector3 } from 'three';
import { USDLoader } from 'three/examples/jsm/loaders/USDLoader.js';

// A door of width 2 whose middle is at the origin and whose hinge is at x = -1; "edge" is its other edge.
const file = (translate, rotate) => `#usda 1.0
(
    defaultPrim = "root"
    metersPerUnit = 1
    timeCodesPerSecond = 10
    upAxis = "Y"
)

def Xform "root"
{
    def Xform "door"
    {
        double3 xformOp:translate${translate}
        float3 xformOp:translate:pivot = (-1, 0, 0)
        float3 xformOp:rotateXYZ${rotate}
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:translate:pivot", "xformOp:rotateXYZ", "!invert!xformOp:translate:pivot"]

        def Xform "hinge"
        {
            double3 xformOp:translate = (-1, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }

        def Xform "edge"
        {
            double3 xformOp:translate = (1, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
}
`;

function read(text) {  // after a second if the file has a motion
  const root = new USDLoader().parse(text);
  for (const clip of root.animations) {
    const mixer = new AnimationMixer(root), action = mixer.clipAction(clip).setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    mixer.setTime(1);
  }
  root.updateMatrixWorld(true);
  const place = (name) => new Vector3().setFromMatrixPosition(root.getObjectByName(name).matrixWorld);
  const show = (point) => point.toArray().map((x) => (Math.round(x * 100) / 100 + 0).toFixed(2)).join(' ');
  return ['hinge', 'edge'].map((name) => `${name} at ${show(place(name))}`).join(', ');
}

const still = (value) => ` = ${value}`, moving = (value) => `.timeSamples = {\n            0: (0, 0, 0),\n            10: ${value},\n        }`;
console.log(`three.js r${REVISION}, meant: hinge at -1.00 3.00 0.00, edge at -1.00 5.00 0.00`);
for (const [what, translate, rotate] of [['both at rest', still, still], ['the rotation moves', still, moving],
                                         ['the translation moves', moving, still], ['both move', moving, moving]]) {
  console.log(`${what}: ${read(file(translate('(0, 3, 0)'), rotate('(0, 0, 90)')))}`);
}
CODE
node pivot.mjs | tee said

cat > expected <<'SAID'
three.js r187, meant: hinge at -1.00 3.00 0.00, edge at -1.00 5.00 0.00
both at rest: hinge at -1.00 3.00 0.00, edge at -1.00 5.00 0.00
the rotation moves: hinge at 0.00 2.00 0.00, edge at 0.00 4.00 0.00
the translation moves: hinge at 0.00 2.00 0.00, edge at 0.00 4.00 0.00
both move: hinge at 0.00 2.00 0.00, edge at 0.00 4.00 0.00
SAID
diff expected said
echo 'The behaviour is as described.'
