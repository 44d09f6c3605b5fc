#!/usr/bin/env bash
# wgpu-matrix 3.4.2's quat.rotationTo gives (0, 0, 0, 0), which is no rotation, for two opposite directions instead of a half turn.
#
# The documentation promises the shortest rotation from one unit vector to another. The library has a branch for opposite vectors, which should
# turn by 180 degrees about a perpendicular axis, but the axis becomes zero. A matrix made from this quaternion is the identity, so the limb
# that should turn round stays in place. gl-matrix 3.4.4, whose function has the same name, is right.
#
# Needs: npm and node (18 or later). Downloads 3 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts wgpu-matrix@3.4.2 gl-matrix@3.4.4 > /dev/null

cat > turn.mjs <<'CODE'
import { quat as gl, vec3 as glVector } from 'gl-matrix';
import { mat4, quat as wgpu, vec3 as wgpuVector } from 'wgpu-matrix';

const show = (values) => Array.from(values, (value) => value.toFixed(2).replace('-0.00', '0.00')).join(' ');
for (const [name, from, to] of [['X to Y', [1, 0, 0], [0, 1, 0]], ['X to -X', [1, 0, 0], [-1, 0, 0]], ['Y to -Y', [0, 1, 0], [0, -1, 0]]]) {
  const ours = wgpu.rotationTo(from, to), theirs = gl.rotationTo(gl.create(), from, to);
  const turned = wgpuVector.transformMat4(from, mat4.fromQuat(ours)), right = glVector.transformQuat([], from, theirs);
  console.log(`${name}: wgpu-matrix ${show(ours)} turns ${show(from)} to ${show(turned)}, gl-matrix to ${show(right)}`);
}
CODE
echo 'Rotations between unit vectors:'
node turn.mjs | tee said

diff - said <<'EXPECTED'
X to Y: wgpu-matrix 0.00 0.00 0.71 0.71 turns 1.00 0.00 0.00 to 0.00 1.00 0.00, gl-matrix to 0.00 1.00 0.00
X to -X: wgpu-matrix 0.00 0.00 0.00 0.00 turns 1.00 0.00 0.00 to 1.00 0.00 0.00, gl-matrix to -1.00 0.00 0.00
Y to -Y: wgpu-matrix 0.00 0.00 0.00 0.00 turns 0.00 1.00 0.00 to 0.00 1.00 0.00, gl-matrix to 0.00 -1.00 0.00
EXPECTED
echo 'As described: opposite directions give the zero quaternion.'
