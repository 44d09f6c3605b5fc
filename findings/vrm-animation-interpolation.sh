#!/usr/bin/env bash
# three-vrm 3.5.5 plays a VRM Animation's STEP rotations as a gradual turn and its CUBICSPLINE rotations as the quaternion (0, 0, 0,
# 0).
#
# VRMC_vrm_animation takes "the animations of the glTF core" as they are (its section "Animations"), and a glTF sampler is STEP,
# LINEAR or CUBICSPLINE (glTF 2.0, appendix C). createVRMAnimationClip makes a new track of the times and values without their
# interpolation: STEP becomes LINEAR, and of a spline's triples (in-tangent, value, out-tangent) the in-tangent is taken for the
# rotation. three.js itself plays the same file correctly. There is no warning.
#
# Needs: npm and node (18 or later). Downloads 6 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts three@0.180.0 @pixiv/three-vrm@3.5.5 @pixiv/three-vrm-animation@3.5.5 \
  gltf-validator@2.0.0-dev.3.10 > /dev/null
cat > play.mjs <<'CODE'
import validator from 'gltf-validator';
import { AnimationMixer, LoopOnce, REVISION } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { VRMHumanoid } from '@pixiv/three-vrm';
import { createVRMAnimationClip, VRMAnimationLoaderPlugin } from '@pixiv/three-vrm-animation';

globalThis.self = globalThis;  // what three.js expects of a browser
globalThis.ProgressEvent = class {};
const parents = { hips: null, spine: 'hips', head: 'spine' };  // and limbs, since the specification asks for them
for (const side of ['left', 'right']) {
  for (const [upper, lower, end, root] of [['UpperLeg', 'LowerLeg', 'Foot', 'hips'], ['UpperArm', 'LowerArm', 'Hand', 'spine']]) {
    Object.assign(parents, { [side + upper]: root, [side + lower]: side + upper, [side + end]: side + lower });
  }
}
const bones = Object.keys(parents);

function file(interpolation) {  // the spine turns by 90 degrees about X within a second
  const half = Math.SQRT1_2, zero = [0, 0, 0, 0], spline = interpolation === 'CUBICSPLINE';
  const values = [[0, 0, 0, 1], [half, 0, 0, half]].flatMap((key) => (spline ? [zero, key, zero] : [key]));
  const bytes = Buffer.from(new Float32Array([0, 1, ...values.flat()]).buffer);
  return {
    asset: { version: '2.0' }, extensionsUsed: ['VRMC_vrm_animation'], scene: 0, scenes: [{ nodes: [0] }],
    nodes: bones.map((name) => {
      const children = bones.flatMap((child, index) => (parents[child] === name ? [index] : []));
      const side = name.startsWith('left') ? 1 : -1;
      const translation = /Arm|Hand/.test(name) ? [0.2 * side, 0, 0] : /Leg|Foot/.test(name) ? [0, -0.4, 0] : [0, 0.3, 0];
      return { name, translation, ...(children.length ? { children } : {}) };
    }),
    extensions: { VRMC_vrm_animation: { specVersion: '1.0',
      humanoid: { humanBones: Object.fromEntries(bones.map((name, node) => [name, { node }])) } } },
    buffers: [{ byteLength: bytes.length, uri: 'data:application/octet-stream;base64,' + bytes.toString('base64') }],
    bufferViews: [{ buffer: 0, byteLength: 8 }, { buffer: 0, byteOffset: 8, byteLength: bytes.length - 8 }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 2, type: 'SCALAR', min: [0], max: [1] },
                { bufferView: 1, componentType: 5126, count: values.length, type: 'VEC4' }],
    animations: [{ channels: [{ sampler: 0, target: { node: 1, path: 'rotation' } }], samplers: [{ input: 0, output: 1, interpolation }] }],
  };
}

function at(seconds, root, clip, joint) {
  const mixer = new AnimationMixer(root);
  mixer.clipAction(clip).setLoop(LoopOnce).play();
  mixer.setTime(seconds);
  return `(${joint.quaternion.toArray().map((value) => value.toFixed(3)).join(', ')})`;
}

console.log(`three.js r${REVISION}, three-vrm 3.5.5: the spine's rotation after a quarter of the time`);
for (const interpolation of ['LINEAR', 'STEP', 'CUBICSPLINE']) {
  const text = JSON.stringify(file(interpolation));
  const report = await validator.validateString(text);
  const load = () => {
    const loader = new GLTFLoader();
    loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
    return loader.parseAsync(text, '');
  };
  const motion = await load(), character = await load();
  const humanoid = new VRMHumanoid(Object.fromEntries(bones.map((name) => [name, { node: character.scene.getObjectByName(name) }])));
  const vrm = { humanoid, meta: { metaVersion: '1' }, scene: character.scene };
  const clip = createVRMAnimationClip(motion.userData.vrmAnimations[0], vrm);
  const plain = at(0.25, motion.scene, motion.animations[0], motion.scene.getObjectByName('spine'));
  const played = at(0.25, humanoid.normalizedHumanBonesRoot, clip, humanoid.getNormalizedBoneNode('spine'));
  console.log(`${interpolation} (errors of the file: ${report.issues.numErrors}): three.js ${plain}, three-vrm ${played}`);
}
CODE
node play.mjs | tee said
cat > expected <<'SAID'
three.js r180, three-vrm 3.5.5: the spine's rotation after a quarter of the time
LINEAR (errors of the file: 0): three.js (0.195, 0.000, 0.000, 0.981), three-vrm (0.195, 0.000, 0.000, 0.981)
STEP (errors of the file: 0): three.js (0.000, 0.000, 0.000, 1.000), three-vrm (0.195, 0.000, 0.000, 0.981)
CUBICSPLINE (errors of the file: 0): three.js (0.115, 0.000, 0.000, 0.993), three-vrm (0.000, 0.000, 0.000, 0.000)
SAID
diff expected said
echo 'The behaviour is as described.'
