#!/usr/bin/env bash
# three.js r187 moves only one of two USD joints whose paths end in the same word, and gives it a mixture of both
# motions.
#
# A joint of a USD skeleton is named by its path, as hips/left/arm and hips/right/arm (OpenUSD,
# UsdSkelSkeleton::GetJointsAttr): the path must be unique, its last word need not be. USDLoader keeps the last word, so
# both bones and both tracks are called "arm". The mixer applies both tracks to the first such bone, and blends them;
# the second stays at rest. The clip has the right number of tracks with the right values. With other last words the
# same skeleton moves correctly. There is no warning.
#
# Needs: npm and node (18 or later). Downloads 5 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 > /dev/null
cat > names.mjs <<'CODE'
import { AnimationMixer, LoopOnce, REVISION } from 'three';
import { USDLoader } from 'three/examples/jsm/loaders/USDLoader.js';

const at = (x, y) => `( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (${x}, ${y}, 0, 1) )`;
function file(left, right) {  // within a second the left arm turns by 90 degrees about Z, the right one by 60 about X
  const joints = ['hips', 'hips/left', `hips/left/${left}`, 'hips/right', `hips/right/${right}`].map((name) => `"${name}"`).join(', ');
  return `#usda 1.0
(
    defaultPrim = "person"
    metersPerUnit = 1
    timeCodesPerSecond = 10
    upAxis = "Y"
)

def SkelRoot "person"
{
    def Skeleton "skeleton" (
        prepend apiSchemas = ["SkelBindingAPI"]
    )
    {
        uniform matrix4d[] bindTransforms = [${[at(0, 1), at(1, 1), at(2, 1), at(-1, 1), at(-2, 1)].join(', ')}]
        uniform token[] joints = [${joints}]
        uniform matrix4d[] restTransforms = [${[at(0, 1), at(1, 0), at(1, 0), at(-1, 0), at(-1, 0)].join(', ')}]
        rel skel:animationSource = </person/skeleton/motion>

        def SkelAnimation "motion"
        {
            uniform token[] joints = [${joints}]
            quatf[] rotations.timeSamples = {
                0: [(1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)],
                10: [(1, 0, 0, 0), (1, 0, 0, 0), (0.7071068, 0, 0, 0.7071068), (1, 0, 0, 0), (0.8660254, 0.5, 0, 0)],
            }
            half3[] scales = [(1, 1, 1), (1, 1, 1), (1, 1, 1), (1, 1, 1), (1, 1, 1)]
            float3[] translations = [(0, 1, 0), (1, 0, 0), (1, 0, 0), (-1, 0, 0), (-1, 0, 0)]
        }
    }

    def Mesh "mesh" (
        prepend apiSchemas = ["SkelBindingAPI"]
    )
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 1, 0), (2, 1, 0), (-2, 1, 0)]
        int[] primvars:skel:jointIndices = [0, 2, 4] (
            elementSize = 1
            interpolation = "vertex"
        )
        float[] primvars:skel:jointWeights = [1, 1, 1] (
            elementSize = 1
            interpolation = "vertex"
        )
        rel skel:skeleton = </person/skeleton>
    }
}
`;
}

console.log(`three.js r${REVISION}, meant: left 90.0 about 0.00 0.00 1.00, right 60.0 about 1.00 0.00 0.00`);
for (const [left, right] of [['armL', 'armR'], ['arm', 'arm']]) {
  const root = new USDLoader().parse(file(left, right));
  const mixer = new AnimationMixer(root), action = mixer.clipAction(root.animations[0]).setLoop(LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  mixer.setTime(1);
  const bones = [];
  root.traverse((object) => { if (object.isBone) bones.push(object); });
  const turn = ({ quaternion: { x, y, z, w } }) => {
    const length = Math.hypot(x, y, z), axis = [x, y, z].map((part) => (part / (length || 1)).toFixed(2)).join(' ');
    return `${(2 * Math.atan2(length, w) * 180 / Math.PI).toFixed(1)} about ${axis}`;
  };
  const tracks = root.animations[0].tracks.filter(({ name }) => /^arm.*quaternion/.test(name)).length;
  console.log(`${left} and ${right}, ${tracks} tracks: left ${turn(bones[2])}, right ${turn(bones[4])}`);
}
CODE
node names.mjs | tee said

cat > expected <<'SAID'
three.js r187, meant: left 90.0 about 0.00 0.00 1.00, right 60.0 about 1.00 0.00 0.00
armL and armR, 2 tracks: left 90.0 about 0.00 0.00 1.00, right 60.0 about 1.00 0.00 0.00
arm and arm, 2 tracks: left 57.7 about 0.58 0.00 0.82, right 0.0 about 0.00 0.00 0.00
SAID
diff expected said
echo 'The behaviour is as described.'
