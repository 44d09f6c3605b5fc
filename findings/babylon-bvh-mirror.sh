#!/usr/bin/env bash
# Babylon.js 9.28.0 shows a BVH file as in a mirror: the performer's left hand is the right one.
#
# The world of a BVH file is right-handed with Y up (University of Wisconsin, CS 838, 1999), a Babylon scene is
# left-handed by default. Its glTF loader converts: it puts a mirrored root above the model. Its BVH loader copies all
# numbers. A person who faces the camera then has the left hand on the left of the picture, and a turn to the left goes
# to the right, as in a mirror; a symmetric skeleton does not show that. With useRightHandedSystem both loaders are
# right. Neither warns.
#
# Needs: npm and node (18 or later). Downloads 15 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @babylonjs/core@9.28.0 @babylonjs/loaders@9.28.0 > /dev/null
cat > side.mjs <<'CODE'
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { NullEngine } from '@babylonjs/core/Engines/nullEngine.js';
import { ImportMeshAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Logger } from '@babylonjs/core/Misc/logger.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/loaders/BVH/bvhFileLoader.js';
import '@babylonjs/loaders/glTF/2.0/glTFLoader.js';
import '@babylonjs/loaders/glTF/glTFFileLoader.js';

Logger.LogLevels = Logger.WarningLogLevel | Logger.ErrorLogLevel;
globalThis.XMLHttpRequest ??= class {};  // what Babylon.js expects of a browser

// A person who looks along Z, with the toe before the hips and the left hand on the side of X.
const bvh = `HIERARCHY
ROOT hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT leftHand
  {
    OFFSET 60 40 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 10 0 0
    }
  }
  JOINT toe
  {
    OFFSET 0 -90 20
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0 10
    }
  }
}
MOTION
Frames: 1
Frame Time: 0.5
0 90 0 0 0 0 0 0 0 0 0 0
`;
const gltf = { asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }],
               nodes: [{ name: 'hips', translation: [0, 90, 0], children: [1, 2] }, { name: 'leftHand', translation: [60, 40, 0] },
                       { name: 'toe', translation: [0, -90, 20] }] };

for (const useRightHandedSystem of [false, true]) {
  for (const [format, text] of [['glTF', JSON.stringify(gltf)], ['BVH', bvh]]) {
    const engine = new NullEngine(), scene = new Scene(engine);
    scene.useRightHandedSystem = useRightHandedSystem;
    const { skeletons, transformNodes } = await ImportMeshAsync(`data:${text}`, scene, { pluginExtension: `.${format.toLowerCase()}` });
    const place = (name) => {
      if (format === 'BVH') return skeletons[0].bones.find((bone) => bone.name === name).getAbsolutePosition();
      const node = transformNodes.find((one) => one.name === name);
      node.computeWorldMatrix(true);
      return node.getAbsolutePosition();
    };
    const front = Math.sign(place('toe').z);  // the camera looks at the person from the front
    const camera = new FreeCamera('camera', new Vector3(0, 100, 300 * front), scene);
    camera.setTarget(new Vector3(0, 100, 0));
    scene.updateTransformMatrix(true);
    const viewport = camera.viewport.toGlobal(engine.getRenderWidth(), engine.getRenderHeight());
    const { x } = Vector3.Project(place('leftHand'), Matrix.Identity(), scene.getTransformMatrix(), viewport);
    const side = x > engine.getRenderWidth() / 2 ? 'right' : 'left';
    const system = useRightHandedSystem ? 'right-handed' : 'left-handed, the default';
    console.log(`${system}, ${format}: the left hand of a person who faces the camera is on the ${side} of the picture`);
  }
}
CODE
node side.mjs | tee said

cat > expected <<'SAID'
left-handed, the default, glTF: the left hand of a person who faces the camera is on the right of the picture
left-handed, the default, BVH: the left hand of a person who faces the camera is on the left of the picture
right-handed, glTF: the left hand of a person who faces the camera is on the right of the picture
right-handed, BVH: the left hand of a person who faces the camera is on the right of the picture
SAID
diff expected said
echo 'The behaviour is as described.'
