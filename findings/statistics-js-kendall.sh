#!/usr/bin/env bash
# statistics.js 1.0.0 gives two equal columns with ties a Kendall's tau b of less than 1, and columns of more than two
# values a tau c of almost 2.
#
# Both are "defined over a range of [-1, 1]", as its documentation says, with 1 "for total agreement". Tau b divides by
# the number of pairs that are not tied in one column, and in the other (Kendall, 1945). The package adds the number of
# values that have ties, not the number of tied pairs; if all ties are ties of both columns, it divides by all pairs.
# Tau c is 2 m (C - D) / (n^2 (m - 1)), where C - D is the number of concordant pairs less that of discordant ones, and
# m the smaller number of different values in a column (Stuart, 1953); the package sets m to 2, whatever the data. The
# example in the documentation itself has a tau c of 1.24.
#
# Needs: npm and node (18 or later). Downloads 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts statistics.js@1.0.0 > /dev/null
cat > raters.cjs <<'CODE'
const Statistics = require('statistics.js');

function taus(x, y) {
  const n = x.length;
  let difference = 0, untiedX = 0, untiedY = 0;
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < i; ++j) {
      const [sx, sy] = [Math.sign(x[i] - x[j]), Math.sign(y[i] - y[j])];
      difference += sx * sy;
      untiedX += sx * sx;
      untiedY += sy * sy;
    }
  const m = Math.min(new Set(x).size, new Set(y).size);
  return [difference / Math.sqrt(untiedX * untiedY), 2 * m * difference / (n * n * (m - 1))];
}
function show(what, x, y) {
  const rows = x.map((value, i) => ({ x: value, y: y[i] }));
  const { b, c } = new Statistics(rows, { x: 'ordinal', y: 'ordinal' }).kendallsTau('x', 'y');
  const [right_b, right_c] = taus(x, y);
  console.log(`${what}: tau b ${b.tauB.toFixed(3)} for ${right_b.toFixed(3)}, tau c ${c.tauC.toFixed(3)} for `
              + `${right_c.toFixed(3)}`);
}
const passed = [0, 0, 0, 0, 0, 1, 1, 1, 1, 1], grades = [1, 1, 2, 2, 3, 3, 4, 4, 5, 5];
const ranks = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
show('two raters, equal grades', grades, grades);
show('two raters, pass or fail', passed, passed);
show('two raters, five grades', grades, [1, 2, 2, 3, 3, 3, 3, 4, 5, 4]);
show('grades and ranks', grades, ranks);
show('equal ranks', ranks, ranks);
CODE
node raters.cjs | tee said

cat > expected <<'SAID'
two raters, equal grades: tau b 0.889 for 1.000, tau c 1.600 for 1.000
two raters, pass or fail: tau b 0.556 for 1.000, tau c 1.000 for 1.000
two raters, five grades: tau b 0.904 for 0.858, tau c 1.320 for 0.825
grades and ranks: tau b 0.943 for 0.943, tau c 1.600 for 1.000
equal ranks: tau b 1.000 for 1.000, tau c 1.800 for 1.000
SAID
diff expected said
echo 'As described: tau b is wrong with ties, and tau c with more than two values.'
