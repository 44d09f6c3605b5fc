#!/usr/bin/env bash
# @geckos.io/snapshot-interpolation 1.1.1 interpolates an angle only if its name is one letter and not the first: others
# go the long way, or jump.
#
# The library interpolates poses that arrive over a network. Its README marks angles and quaternions, as in
# 'direction(rad) rotationInDeg(deg) q(quat)'; a marked angle should take the shortest way, so that halfway from 350 to
# 10 degrees is 0. The first name loses its mark, since the library replaces the first bracket or space by a space: its
# angle is interpolated as a number, halfway is 180, and the head turns the other way round. Of every later name with a
# mark it keeps the last letter only, finds no such value, and returns the newer pose's angle as it is. Only q is right
# in the README's example. There is no error.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @geckos.io/snapshot-interpolation@1.1.1 > /dev/null
cat > turn.mjs <<'CODE'
import library from '@geckos.io/snapshot-interpolation';

const radians = Math.PI / 180;
const about = (degrees) => ({ x: 0, y: 0, z: Math.sin(degrees / 2 * radians), w: Math.cos(degrees / 2 * radians) });
const pose = (id, time, x, degrees) => ({ id, time, state: [{ id: 'head', x, r: degrees, rotationInDeg: degrees,
  direction: degrees * radians, q: about(degrees) }] });
const before = pose('1', 1000, 0, 350), after = pose('2', 1100, 1, 10);
const interpolator = new library.SnapshotInterpolation(10);
const degrees = { r: (r) => r, rotationInDeg: (angle) => angle, direction: (angle) => angle / radians,
  q: (q) => 2 * Math.atan2(q.z, q.w) / radians };

console.log('a quarter of the way from 350 to 10 degrees, which is 355:');
for (const names of ['x r(deg)', 'r(deg) x', 'r(deg)', 'x rotationInDeg(deg)', 'x direction(rad)',
  'direction(rad) rotationInDeg(deg) q(quat)']) {
  const { state: [head] } = interpolator.interpolate(before, after, 1025, names);
  const values = Object.keys(degrees).filter((name) => names.includes(`${name}(`))
    .map((name) => `${name} ${((degrees[name](head[name]) + 360) % 360).toFixed(1)}`);
  console.log(`  '${names}': ${values.join(', ')}`);
}
CODE
node turn.mjs | tee said

cat > expected <<'SAID'
a quarter of the way from 350 to 10 degrees, which is 355:
  'x r(deg)': r 355.0
  'r(deg) x': r 265.0
  'r(deg)': r 265.0
  'x rotationInDeg(deg)': rotationInDeg 10.0
  'x direction(rad)': direction 10.0
  'direction(rad) rotationInDeg(deg) q(quat)': rotationInDeg 10.0, direction 265.0, q 355.0
SAID
diff expected said
echo 'As described: most marked angles are wrong.'
