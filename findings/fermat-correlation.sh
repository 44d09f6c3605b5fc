#!/usr/bin/env bash
# The correlation of @mathigon/fermat 1.1.24 is too small, so that it depends on the number of samples: two equal series
# of five samples correlate by 0.8.
#
# Pearson's coefficient is the covariance divided by both standard deviations, all three with the same divisor: 1 for
# values on a rising line. correlation() divides the covariance by n and the variances by n - 1, so each result is
# (n - 1) / n of the right one. Two raters who agree about four dancers seem to agree by 0.75. variance() and stdDev()
# are those of a sample, covariance() is that of a population; the comments, the only documentation, do not say so. The
# slope as covariance by variance is too small by the same factor; Regression.linear() is right.
#
# Needs: npm and node (18 or later). Downloads 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @mathigon/fermat@1.1.24 > /dev/null
cat > correlate.cjs <<'CODE'
const { correlation, covariance, variance, Regression } = require('@mathigon/fermat');

// Pearson's coefficient: the cosine of the angle between the two series of differences from their means.
function pearson(x, y) {
  const mean = (all) => all.reduce((sum, value) => sum + value, 0) / all.length;
  const differences = [x, y].map((all) => all.map((value) => value - mean(all)));
  const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
  const [a, b] = differences;
  return dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b));
}
function show(what, x, y) {
  console.log(`${what}: ${correlation(x, y).toFixed(3)} for ${pearson(x, y).toFixed(3)}`);
}
for (const n of [2, 3, 5, 10, 100]) {
  const line = Array.from({ length: n }, (_, i) => i);
  show(`${n} samples on a line`, line, line.map((i) => 3 * i + 1));
}
show('4 dancers, two raters', [6, 7, 8, 9], [6, 7, 8, 9]);
show('6 dancers, two raters', [3, 5, 6, 7, 8, 9], [4, 4, 7, 6, 9, 8]);

const x = [0, 1, 2, 3, 4], y = [1, 4, 7, 10, 13];
const slope = covariance(x, y) / variance(x), [, regressed] = Regression.linear(x.map((value, i) => [value, y[i]]));
console.log(`slope of y = 3 x + 1: ${slope.toFixed(2)} from the covariance, ${regressed.toFixed(2)} from Regression`);
CODE
node correlate.cjs | tee said

cat > expected <<'SAID'
2 samples on a line: 0.500 for 1.000
3 samples on a line: 0.667 for 1.000
5 samples on a line: 0.800 for 1.000
10 samples on a line: 0.900 for 1.000
100 samples on a line: 0.990 for 1.000
4 dancers, two raters: 0.750 for 1.000
6 dancers, two raters: 0.722 for 0.867
slope of y = 3 x + 1: 2.40 from the covariance, 3.00 from Regression
SAID
diff expected said
echo 'As described: each correlation is (n - 1) / n of the right one.'
