#!/usr/bin/env bash
# A BVH joint's position channels move it from its OFFSET in three.js r187, and replace its OFFSET in Assimp 5.2.5.
#
# The format's usual description (University of Wisconsin, CS 838, 1999) makes a root's translation the sum of its OFFSET and its position
# channels, and gives other joints no position channels. With a zero OFFSET both readers agree. But some recorders repeat the first
# frame's position as the root's OFFSET, and some tools write six channels for every joint; the readers then differ by the whole OFFSET.
# The hips of this file are at 180 in one reader and at 90 in the other, the chest 40 or 20 above them. Neither reader warns, and no line
# of a BVH file states which meaning applies.
#
# Needs: curl, dpkg-deb, npm and node (18 or later), Debian 12 or later, x86-64. Downloads 9 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for path in a/assimp/assimp-utils_5.2.5~ds0-1+b1 a/assimp/libassimp5_5.2.5~ds0-1+b1 d/draco/libdraco7_1.5.5+dfsg-2 \
  m/minizip/libminizip1_1.1-8+deb12u1; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/${path}_amd64.deb"
  dpkg-deb -x package.deb unpacked
done
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 > /dev/null

cat > stand.bvh <<'BVH'
HIERARCHY
ROOT hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT chest
  {
    OFFSET 0 20 0
    CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 30 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.5
0 90 0 0 0 0 0 20 0 0 0 0
0 90 0 0 0 0 0 20 0 0 0 0
BVH
LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) unpacked/usr/bin/assimp export stand.bvh stand.glb -fglb2 > /dev/null

cat > heights.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { AnimationMixer, Vector3 } from 'three';
import { BVHLoader } from 'three/examples/jsm/loaders/BVHLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
function say(reader, root, clip) {
  const mixer = new AnimationMixer(root);
  mixer.clipAction(clip).play();
  mixer.setTime(0.25);
  root.updateMatrixWorld(true);
  const height = (name) => new Vector3().setFromMatrixPosition(root.getObjectByName(name).matrixWorld).y.toFixed(3);
  console.log(`${reader}: hips at ${height('hips')}, chest at ${height('chest')}`);
}

const { skeleton, clip } = new BVHLoader().parse(readFileSync('stand.bvh', 'utf8'));
say('three.js r187', skeleton.bones[0], clip);
const bytes = readFileSync('stand.glb');
const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
say('Assimp 5.2.5', gltf.scene, gltf.animations[0]);
CODE
node heights.mjs | tee said

grep -qxF 'three.js r187: hips at 180.000, chest at 220.000' said
grep -qxF 'Assimp 5.2.5: hips at 90.000, chest at 110.000' said
echo 'The behaviour is as described.'
