#!/usr/bin/env bash
# urdf-loader 0.13.1 moves floating and planar joints in the parent's axes and turns them about the parent's origin.
#
# In a URDF a joint's <origin> leads from the parent to the joint, and the axis is given in the joint's frame (ROS wiki,
# urdf/XML/joint); the joint's values move the child from there. urdf-loader does so for revolute, continuous and
# prismatic joints. For floating and planar ones it applies the values first and the origin after them: a pelvis whose
# origin is at x = 1 and that turns on the spot by 90 degrees goes to y = 1, and a walk along the x of a turned origin
# follows the parent's x. A planar joint, which should stay in the plane perpendicular to its axis, moves along x and y
# whatever its axis. A floating joint's roll, pitch and yaw act in the reverse of the order of an <origin>'s rpy.
#
# Needs: npm and node (18 or later). Downloads 7 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts urdf-loader@0.13.1 three@0.187.0 linkedom@0.18.15 > /dev/null
cat > move.mjs <<'CODE'
import { DOMParser } from 'linkedom';
import { Vector3 } from 'three';

Object.assign(globalThis, { DOMParser, Document: class {}, Element: class {} });  // as a browser has them
const { default: URDFLoader } = await import('urdf-loader');
const quarter = Math.PI / 2, there = 'xyz="1 0 0"', turned = `xyz="1 0 0" rpy="0 0 ${quarter}"`;

function show(what, origin, axis, joints, see) {
  console.log(what);
  for (const [type, ...values] of joints) {
    const robot = new URDFLoader().parse(`<robot name="person"><link name="floor"/><link name="pelvis"/>
      <joint name="base" type="${type}"><parent link="floor"/><child link="pelvis"/><origin ${origin}/><axis xyz="${axis}"/>
      <limit lower="-9" upper="9" effort="1" velocity="1"/></joint></robot>`);
    robot.setJointValue('base', ...values);
    robot.updateMatrixWorld(true);
    console.log(`  ${type}: ${see(robot.links.pelvis).toArray().map((x) => Math.round(x) + 0).join(' ')}`);
  }
}
const place = (link) => link.getWorldPosition(new Vector3());
const right = (link) => new Vector3(1, 0, 0).transformDirection(link.matrixWorld);
show('at 1 0 0, turns about z by 90 degrees, is then at', there, '0 0 1',
  [['revolute', quarter], ['floating', 0, 0, 0, 0, 0, quarter], ['planar', 0, 0, quarter]], place);
show('at 1 0 0, turned by 90 degrees about z, walks by 2 along its x, is then at', turned, '1 0 0',
  [['prismatic', 2], ['floating', 2, 0, 0, 0, 0, 0]], place);
show('the same on a plane perpendicular to z', turned, '0 0 1', [['planar', 2, 0, 0]], place);
show('at 1 0 0, walks by 2 on the plane perpendicular to x, is then at', there, '1 0 0', [['planar', 2, 0, 0]], place);
show('roll and yaw of 90 degrees from the origin, its x is then', `rpy="${quarter} 0 ${quarter}"`, '1 0 0', [['fixed']], right);
show('roll and yaw of 90 degrees from the values, its x is then', 'xyz="0 0 0"', '1 0 0',
  [['floating', 0, 0, 0, quarter, 0, quarter]], right);
CODE
node move.mjs | tee said

cat > expected <<'SAID'
at 1 0 0, turns about z by 90 degrees, is then at
  revolute: 1 0 0
  floating: 0 1 0
  planar: 0 1 0
at 1 0 0, turned by 90 degrees about z, walks by 2 along its x, is then at
  prismatic: 1 2 0
  floating: 3 0 0
the same on a plane perpendicular to z
  planar: 3 0 0
at 1 0 0, walks by 2 on the plane perpendicular to x, is then at
  planar: 3 0 0
roll and yaw of 90 degrees from the origin, its x is then
  fixed: 0 1 0
roll and yaw of 90 degrees from the values, its x is then
  floating: 0 0 1
SAID
diff expected said
echo 'As described: floating and planar joints differ.'
