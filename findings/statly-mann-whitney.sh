#!/usr/bin/env bash
# statly 0.0.1's Mann-Whitney test takes its p from coin tosses: ten values that are below ten others have p = 0.001
# instead of 0.000005.
#
# p is said to be "the probability that both sets of samples could have been randomly selected from the same underlying
# distribution" (its README). uTest() finds the right share of the pairs in which a exceeds b, auc. But then it asks how
# probable so few heads are if a coin is tossed as often as the smaller group has values: p is that of a binomial
# distribution, at auc times that number, rounded. The size of the larger group has no influence, and no p is less than
# that of tails only. U has another distribution (Mann and Whitney, 1947). Below, the exact p, for one direction as that
# of the package, is counted over all arrangements of the ranks.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts statly@0.0.1 > /dev/null
cat > tosses.cjs <<'CODE'
const { uTest } = require('statly');

// The probability of at most u pairs in which one of n values exceeds one of m: all arrangements of their ranks are
// equally probable. ways[i][j] counts, for i and j values placed, the arrangements with each number of pairs.
function exactP(n, m, u) {
  const ways = Array.from({ length: n + 1 }, () => []);
  for (let i = 0; i <= n; ++i)
    for (let j = 0; j <= m; ++j) {
      const all = new Array(i * j + 1).fill(i * j === 0 ? 1 : 0);
      if (i * j > 0) {
        ways[i - 1][j].forEach((count, pairs) => { all[pairs + j] += count; });  // the largest value is one of the i
        ways[i][j - 1].forEach((count, pairs) => { all[pairs] += count; });
      }
      ways[i][j] = all;
    }
  const sum = (counts) => counts.reduce((a, b) => a + b, 0);
  return sum(ways[n][m].slice(0, u + 1)) / sum(ways[n][m]);
}

// n values, and m values of which the first is `later` ranks higher; no ties.
function show(n, m, later) {
  const a = Array.from({ length: n }, (_, i) => i), b = Array.from({ length: m }, (_, i) => i + later - 0.5);
  const { p, auc } = uTest(a, b), u = Math.round(auc * n * m);
  const [found, right] = [p, exactP(n, m, u)].map((x) => x.toPrecision(2));
  console.log(`${n} and ${m} values: ${u} of ${n * m} pairs, p = ${found} for ${right}`);
}
for (const [n, later] of [[3, 3], [5, 5], [10, 10], [10, 3], [20, 8], [20, 4], [40, 8]]) show(n, n, later);
show(5, 100, 5);
CODE
node tosses.cjs | tee said

cat > expected <<'SAID'
3 and 3 values: 0 of 9 pairs, p = 0.13 for 0.050
5 and 5 values: 0 of 25 pairs, p = 0.031 for 0.0040
10 and 10 values: 0 of 100 pairs, p = 0.00098 for 0.0000054
10 and 10 values: 28 of 100 pairs, p = 0.17 for 0.053
20 and 20 values: 78 of 400 pairs, p = 0.0059 for 0.00033
20 and 20 values: 136 of 400 pairs, p = 0.13 for 0.043
40 and 40 values: 528 of 1600 pairs, p = 0.019 for 0.0042
5 and 100 values: 0 of 500 pairs, p = 0.031 for 1.0e-8
SAID
diff expected said
echo 'As described: p is that of tossed coins.'
