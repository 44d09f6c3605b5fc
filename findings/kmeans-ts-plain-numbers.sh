#!/usr/bin/env bash
# kmeans-ts 1.0.4 puts all values into one cluster if they are plain numbers instead of rows; the other centres are NaN.
#
# Its README gives "Array<number>" as one of the two types of the input. The code has a branch for it, but reads each
# number as a row there, so that every distance is NaN and no distance is the least. All indices are 0, and the only
# centre is the mean of everything. The same numbers as rows of one number are clustered correctly. There is no error.
# The run also goes on until the greatest number of iterations, since arrays are compared by identity.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts kmeans-ts@1.0.4 > /dev/null
cat > joints.cjs <<'CODE'
const kmeans = require('kmeans-ts').default;

// The angles of a knee, straight or bent.
const angles = [2, 3, 5, 6, 88, 90, 91, 93];
const show = (name, { indexes, centroids, iterations }) =>
  console.log(`${name}: indices ${indexes.join(' ')}, centres ${centroids.map(([x]) => x).join(' ')}, ` +
    `${iterations} iterations`);
show('as plain numbers', kmeans(angles, 2, [[0], [100]], 50));
show('as rows', kmeans(angles.map((angle) => [angle]), 2, [[0], [100]], 50));
let seed = 1;
Math.random = () => (seed = 16807 * seed % 2147483647) / 2147483647;  // for the library's random starts
for (const name of ['kmeans', 'kmeans++']) {
  const clusters = (data) => new Set(kmeans(data, 2, name, 50).indexes).size;
  const ofRows = clusters(angles.map((angle) => [angle]));
  console.log(`${name}: ${clusters(angles)} cluster of plain numbers, ${ofRows} of rows`);
}
CODE
node joints.cjs | tee said

cat > expected <<'SAID'
as plain numbers: indices 0 0 0 0 0 0 0 0, centres 47.25 NaN, 50 iterations
as rows: indices 0 0 0 0 1 1 1 1, centres 4 90.5, 1 iterations
kmeans: 1 cluster of plain numbers, 2 of rows
kmeans++: 1 cluster of plain numbers, 2 of rows
SAID
diff expected said
echo 'As described: plain numbers are not clustered.'
