#!/usr/bin/env bash
# The principal components of @josh-brown/vector 4.2.0 have arbitrary lengths, so that the coordinates of a motion along
# them vary up to a million times as much as they should.
#
# pca() returns variances, "in the directions of the corresponding principal components" (its documentation), and
# coordinates, "the original data in a basis formed by the principal component vectors". The components are eigenvectors
# as elimination leaves them: the last entry is about 1, and the others are as large as they happen to be. The data are
# multiplied by them, which gives coordinates only if their lengths are 1. So the spread of a component says nothing,
# two poses are at another distance than before, and so are the results of reduceDimensions(), which cuts these
# coordinates. In coordinates on unit vectors, all is as documented. The documentation mentions no lengths.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @josh-brown/vector@4.2.0 > /dev/null
cat > components.cjs <<'CODE'
const { NumberMatrix, pca, reduceDimensions } = require('@josh-brown/vector');

// Angles of hip, knee and ankle in 200 frames: they move together, plus a smaller movement of each.
const frames = Array.from({ length: 200 }, (_, i) => {
  const together = Math.sin(0.7 * i);
  return [3 * together, 3 * together + 2 * Math.cos(0.91 * i), 0.5 * Math.sin(1.47 * i)];
});
const columns = (rows) => rows[0].map((_, j) => rows.map((row) => row[j]));
function variance(values) {
  const mean = values.reduce((a, b) => a + b) / values.length;
  return values.reduce((sum, x) => sum + (x - mean) ** 2, 0) / values.length;
}
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const number = (x) => x.toPrecision(3);

const data = NumberMatrix.builder().fromArray(frames), { principalComponents, variances, coordinates } = pca(data);
const components = principalComponents.map((component) => component.toArray());
const units = components.map((component) => component.map((x) => x / Math.hypot(...component)));
const own = columns(coordinates.toArray()), right = units.map((unit) => frames.map((frame) => dot(frame, unit)));
components.forEach((component, k) => {
  console.log(`component ${k + 1}, of length ${number(Math.hypot(...component))}: variance ${number(variances[k])}; ` +
    `of its coordinates ${number(variance(own[k]))}, on a unit vector ${number(variance(right[k]))}`);
});
const apart = (tracks) => number(Math.hypot(...tracks.map((track) => track[0] - track[9])));
console.log(`distance of two poses: ${apart(columns(frames))}; in coordinates ${apart(own)}, ` +
  `on unit vectors ${apart(right)}`);
const kept = columns(reduceDimensions(data, { keep: 2 }).toArray());
console.log(`variances that reduceDimensions keeps: ${kept.map(variance).map(number).join(', ')}`);
CODE
node components.cjs | tee said

cat > expected <<'SAID'
component 1, of length 1.22e+3: variance 9.84; of its coordinates 1.47e+7, on a unit vector 9.84
component 2, of length 271: variance 0.909; of its coordinates 6.67e+4, on a unit vector 0.909
component 3, of length 1.00: variance 0.124; of its coordinates 0.124, on a unit vector 0.124
distance of two poses: 2.63; in coordinates 2.47e+3, on unit vectors 2.63
variances that reduceDimensions keeps: 1.47e+7, 6.67e+4
SAID
diff expected said
echo 'As described: coordinates have arbitrary scales.'
