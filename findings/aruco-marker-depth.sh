#!/usr/bin/env bash
# js-aruco2 2.0.0's posit2 returns a marker's centre with the distance of its first corner: a marker that turns on the
# spot moves to and fro.
#
# The origin of posit's model is the marker's centre, so bestTranslation should be where the centre is. posit2 finds the
# first corner, and takes the way from the centre to that corner off x and y, but not off z. A marker of 50 mm that is
# turned by 60 degrees has its corners 22 mm before and behind its centre. The pictures below are exact, so the true
# pose is known. The rotation is right. The README says that one may take posit1 or posit2; posit1 returns the centre.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts js-aruco2@2.0.0 > /dev/null
cat > marker.cjs <<'CODE'
const readers = ['posit1', 'posit2'].map((name) => [name, require(`js-aruco2/src/${name}.js`).POS]);
const size = 50, half = size / 2, focalLength = 800, centre = [20, 10, 600];
const model = [[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]];  // its corners, as in posit

console.log(`a marker of ${size} mm at ${centre.join(' ')}`);
for (const degrees of [-60, -30, 0, 30, 60]) {  // about the vertical
  const cos = Math.cos(degrees * Math.PI / 180), sin = Math.sin(degrees * Math.PI / 180);
  const corners = model.map(([x, y]) => [centre[0] + cos * x, centre[1] + y, centre[2] - sin * x]);
  const picture = corners.map(([x, y, z]) => ({ x: focalLength * x / z, y: focalLength * y / z }));
  const said = readers.map(([name, POS]) => {
    const { bestRotation: r, bestTranslation: t } = new POS.Posit(size, focalLength).pose(picture);
    const turn = Math.atan2(-r[2][0], r[0][0]) * 180 / Math.PI;
    return `${name} ${t.map((x) => x.toFixed(0)).join(' ')}, turned by ${turn.toFixed(0)}`;
  });
  console.log(`turned by ${degrees}, first corner at z ${corners[0][2].toFixed(0)}: ${said.join('; ')}`);
}
CODE
node marker.cjs | tee said

cat > expected <<'SAID'
a marker of 50 mm at 20 10 600
turned by -60, first corner at z 578: posit1 20 10 600, turned by -60; posit2 20 10 579, turned by -60
turned by -30, first corner at z 588: posit1 20 10 600, turned by -30; posit2 20 10 587, turned by -30
turned by 0, first corner at z 600: posit1 20 10 600, turned by 0; posit2 20 10 600, turned by 0
turned by 30, first corner at z 613: posit1 20 10 600, turned by 30; posit2 20 10 612, turned by 30
turned by 60, first corner at z 622: posit1 20 10 600, turned by 60; posit2 20 10 622, turned by 60
SAID
diff expected said
echo 'As described: posit2 says how far the first corner is.'
