#!/usr/bin/env bash
# kmeans-js 0.1.2 overwrites the data that it clusters: groups around 12, 52 and 92 are found around 11, 53 and 91. It
# also stops as soon as one coordinate of one centre stands still.
#
# The algorithm starts with some samples as centres, and moves each centre to the mean of the samples that are nearest
# to it. kmeans-js takes these rows of the caller's data themselves, without a copy, so that the samples move too: the
# means are those of changed data, and the caller's poses are lost. The algorithm ends when no centre moves any more
# (Lloyd, 1982); hasConverged(), which the README's example asks after each step, is true if any coordinate has stopped,
# for instance one that is 0 in all samples, or a group of a single sample. The README mentions neither.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts kmeans-js@0.1.2 > /dev/null
cat > groups.cjs <<'CODE'
const kMeans = require('kmeans-js');

const poses = [[10, 1], [12, 2], [14, 3], [50, 1], [52, 2], [54, 3], [90, 1], [92, 2], [94, 3]];
const show = (groups, centres) =>
  groups.map((group, i) => `${group.join('')} around ${centres[i][0].toFixed(1)}`).join(', ');

// Lloyd's algorithm, on a copy, from the samples `starts`.
function right(data, starts) {
  let centres = starts.map((i) => data[i]), groups, before;
  do {
    before = JSON.stringify(centres);
    groups = centres.map(() => []);
    data.forEach((row, i) => {
      const far = centres.map((centre) => centre.reduce((sum, x, j) => sum + (x - row[j]) ** 2, 0));
      groups[far.indexOf(Math.min(...far))].push(i);
    });
    const mean = (group, j) => group.reduce((sum, i) => sum + data[i][j], 0) / group.length;
    centres = groups.map((group) => data[0].map((_, j) => mean(group, j)));
  } while (before !== JSON.stringify(centres));
  return show(groups, centres);
}
// The README's example, with dice that draw the samples `starts`.
function found(data, starts) {
  const draws = starts.map((i) => (i + 0.5) / data.length);
  Math.random = () => draws.shift();
  const km = new kMeans({ K: starts.length });
  km.cluster(data);
  while (km.step()) {
    km.findClosestCentroids();
    km.moveCentroids();
    if (km.hasConverged()) break;
  }
  return show(km.clusters, km.centroids);
}
const flat = poses.map((pose) => [...pose, 0]);
for (const [name, rows] of [['two coordinates', poses], ['a third coordinate of 0', flat]])
  for (const starts of [[2, 3, 8], [0, 1, 2, 6]]) {
    const data = rows.map((row) => [...row]);
    console.log(`${name}, from samples ${starts.join(' ')}`);
    console.log(`  right: ${right(rows, starts)}`);
    console.log(`  found: ${found(data, starts)}`);
    const changed = starts.filter((i) => JSON.stringify(data[i]) !== JSON.stringify(rows[i]));
    const moves = changed.map((i) => `${i} from ${rows[i][0]} to ${data[i][0].toFixed(1)}`);
    console.log(`  changed samples: ${moves.join(', ')}`);
  }
CODE
node groups.cjs | tee said

cat > expected <<'SAID'
two coordinates, from samples 2 3 8
  right: 012 around 12.0, 345 around 52.0, 678 around 92.0
  found: 012 around 11.0, 345 around 53.0, 678 around 91.0
  changed samples: 2 from 14 to 11.0, 3 from 50 to 53.0, 8 from 94 to 91.0
two coordinates, from samples 0 1 2 6
  right: 0 around 10.0, 12 around 13.0, 345 around 52.0, 678 around 92.0
  found: 0 around 10.0, 1 around 12.0, 234 around 38.7, 5678 around 82.5
  changed samples: 2 from 14 to 38.7, 6 from 90 to 82.5
a third coordinate of 0, from samples 2 3 8
  right: 012 around 12.0, 345 around 52.0, 678 around 92.0
  found: 012 around 12.0, 345 around 52.0, 678 around 92.0
  changed samples: 2 from 14 to 12.0, 3 from 50 to 52.0, 8 from 94 to 92.0
a third coordinate of 0, from samples 0 1 2 6
  right: 0 around 10.0, 12 around 13.0, 345 around 52.0, 678 around 92.0
  found: 0 around 10.0, 1 around 12.0, 234 around 38.7, 5678 around 82.5
  changed samples: 2 from 14 to 38.7, 6 from 90 to 82.5
SAID
diff expected said
echo 'As described: it changes its data and stops early.'
