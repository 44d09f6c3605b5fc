#!/usr/bin/env bash
# @equinor/videx-linear-algebra 1.0.20's triple product overwrites its second vector, so that a second call has another
# result.
#
# triple(a, b, c) is a . (b x c): 1 for the axes of a right-handed frame, -1 for those of a left-handed one. Its
# documentation names three operands, and no target. It calls cross(b, c), which writes into its first argument unless a
# target is given (documented at cross), so that b becomes b x c. If the axes of a segment come from markers, the test
# of their handedness changes the y axis: of a right-handed frame into x, of a left-handed one into its opposite. The
# determinant of the frame is then 0, and every vector loses its part along y. There is no error.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @equinor/videx-linear-algebra@1.0.20 > /dev/null
cat > frame.cjs <<'CODE'
const { triple, dot } = require('@equinor/videx-linear-algebra');

const text = (vector) => `(${vector.map((x) => x.toFixed(1).replace('-0.0', '0.0')).join(', ')})`;
for (const [name, z] of [['right-handed', [0, -0.8, 0.6]], ['left-handed', [0, 0.8, -0.6]]]) {
  const x = [1, 0, 0], y = [0, 0.6, 0.8], marker = [3, 4, 0];
  console.log(`${name}: x ${text(x)}, y ${text(y)}, z ${text(z)}; a marker is at ${dot(marker, y).toFixed(1)} along y`);
  const first = triple(x, y, z);
  console.log(`  triple product ${first.toFixed(1)}; then y ${text(y)}, the marker at ${dot(marker, y).toFixed(1)}, ` +
    `triple product ${triple(x, y, z).toFixed(1)}`);
}
CODE
node frame.cjs | tee said

cat > expected <<'SAID'
right-handed: x (1.0, 0.0, 0.0), y (0.0, 0.6, 0.8), z (0.0, -0.8, 0.6); a marker is at 2.4 along y
  triple product 1.0; then y (1.0, 0.0, 0.0), the marker at 3.0, triple product 0.0
left-handed: x (1.0, 0.0, 0.0), y (0.0, 0.6, 0.8), z (0.0, 0.8, -0.6); a marker is at 2.4 along y
  triple product -1.0; then y (-1.0, 0.0, 0.0), the marker at -3.0, triple product 0.0
SAID
diff expected said
echo 'As described: the second vector is lost.'
