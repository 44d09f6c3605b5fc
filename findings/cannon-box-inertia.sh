#!/usr/bin/env bash
# cannon-es 0.20.0 gives every body the inertia of a box: of the box that encloses the body, along the world's axes, at
# the moment when its shape is added.
#
# Body.updateMassProperties computes the box and its inertia; each shape's own calculateLocalInertia, which is right for
# spheres and boxes, is not asked. A ball has 5/3 of its inertia, so it needs 5/3 of the torque. A box that is turned
# before its shape is added keeps the inertia of the larger box around it: a forearm of 1 m by 10 cm that was created at
# 45 degrees needs 31 times its torque to turn about its own long axis. The same forearm, turned after its shape was
# added, is right. Only a comment in the source mentions the box.
#
# Needs: npm and node (18 or later). Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts cannon-es@0.20.0 > /dev/null
cat > spin.mjs <<'CODE'
import { Body, Box, Quaternion, Sphere, Vec3, World } from 'cannon-es';

function speed(shape, turn, turnFirst) {  // rad/s about the body's X axis, after 1 N m about it for 0.1 s
  const body = new Body({ mass: 2, angularDamping: 0 });
  if (turnFirst) body.quaternion.copy(turn);
  body.addShape(shape);
  if (!turnFirst) body.quaternion.copy(turn);
  body.updateInertiaWorld(true);
  const world = new World();
  world.addBody(body);
  const axis = turn.vmult(new Vec3(1, 0, 0));
  for (let step = 0; step < 10; ++step) {
    body.torque.copy(axis);
    world.step(0.01);
  }
  return body.angularVelocity.dot(axis);
}

const none = new Quaternion(), about = new Quaternion();
about.setFromAxisAngle(new Vec3(0, 0, 1), Math.PI / 4);
const forearm = () => new Box(new Vec3(0.5, 0.05, 0.05)), box = (1 / 12) * 2 * (0.1 ** 2 + 0.1 ** 2);
for (const [what, shape, turn, turnFirst, inertia] of [
  ['ball of radius 0.5', new Sphere(0.5), none, false, 0.4 * 2 * 0.5 ** 2], ['forearm along X', forearm(), none, false, box],
  ['forearm, added, then turned by 45 degrees', forearm(), about, false, box],
  ['forearm, turned by 45 degrees, then added', forearm(), about, true, box],
]) {
  const local = shape.calculateLocalInertia(2, new Vec3()).x, found = speed(shape, turn, turnFirst);
  console.log(`${what}: ${found.toFixed(2)} rad/s, closed form ${(0.1 / inertia).toFixed(2)}, the shape's own inertia ${(0.1 / local).toFixed(2)}`);
}
CODE
node spin.mjs | tee said

cat > expected <<'SAID'
ball of radius 0.5: 0.30 rad/s, closed form 0.50, the shape's own inertia 0.50
forearm along X: 30.00 rad/s, closed form 30.00, the shape's own inertia 30.00
forearm, added, then turned by 45 degrees: 30.00 rad/s, closed form 30.00, the shape's own inertia 30.00
forearm, turned by 45 degrees, then added: 0.98 rad/s, closed form 30.00, the shape's own inertia 30.00
SAID
diff expected said
echo 'The behaviour is as described.'
