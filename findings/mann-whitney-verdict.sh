#!/usr/bin/env bash
# mann-whitney-utest 1.0.5 calls a difference with p = 0.000007 insignificant, and one of two single values significant.
#
# The test's U counts the pairs in which the value of one group exceeds that of the other (Mann and Whitney, 1947). One
# looks it up in a table, or standardises it to z and compares that with 1.96 for a level of 5 %. The function
# significant() compares U, a number of pairs, with z instead: "tests the U-value against an approximate critical value"
# (its README). So larger groups pass only if almost no pair contradicts the difference, and groups of one to three
# values pass if they do not overlap, although they can never reach 5 %. U and z are right. Below, p is exact: it is
# counted over all arrangements of the ranks.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts mann-whitney-utest@1.0.5 > /dev/null
cat > groups.cjs <<'CODE'
const mannWhitney = require('mann-whitney-utest');

// How many of the arrangements of n and m values without ties have each U: the largest value belongs to the first group
// and exceeds the m values of the other one, or belongs to the other one and exceeds none of it.
const kept = new Map();
function counts(n, m) {
  const key = `${n} ${m}`;
  if (n === 0 || m === 0) return [1];
  if (!kept.has(key)) {
    const all = new Array(n * m + 1).fill(0);
    counts(n - 1, m).forEach((count, u) => { all[u + m] += count; });
    counts(n, m - 1).forEach((count, u) => { all[u] += count; });
    kept.set(key, all);
  }
  return kept.get(key);
}
function exactP(n, m, u) {  // for both directions
  const all = counts(n, m), total = all.reduce((a, b) => a + b);
  return Math.min(1, 2 * all.slice(0, u + 1).reduce((a, b) => a + b) / total);
}

// Groups of n values each without ties; the second one is `later` by so many ranks of its own.
function show(n, later) {
  const samples = [0, later + 0.5].map((first) => Array.from({ length: n }, (_, i) => first + i));
  const u = mannWhitney.test(samples), least = Math.min(...u), p = exactP(n, n, least);
  const verdict = mannWhitney.significant(u, samples);
  console.log(`${n} and ${n} values: U = ${least} of ${n * n} pairs, z = `
              + `${mannWhitney.criticalValue(u, samples).toFixed(2)}, p = ${p.toPrecision(2)}: `
              + `${verdict ? 'significant' : 'not significant'}${verdict === p < 0.05 ? '' : ', which is wrong'}`);
}
for (const [n, later] of [[1, 0], [2, 1], [3, 2], [4, 3], [6, 3], [10, 5], [20, 10], [20, 5], [20, 0], [100, 60]])
  show(n, later);
CODE
node groups.cjs | tee said

cat > expected <<'SAID'
1 and 1 values: U = 0 of 1 pairs, z = 1.00, p = 1.0: significant, which is wrong
2 and 2 values: U = 0 of 4 pairs, z = 1.55, p = 0.33: significant, which is wrong
3 and 3 values: U = 0 of 9 pairs, z = 1.96, p = 0.10: significant, which is wrong
4 and 4 values: U = 0 of 16 pairs, z = 2.31, p = 0.029: significant
6 and 6 values: U = 3 of 36 pairs, z = 2.40, p = 0.015: not significant, which is wrong
10 and 10 values: U = 10 of 100 pairs, z = 3.02, p = 0.0015: not significant, which is wrong
20 and 20 values: U = 45 of 400 pairs, z = 4.19, p = 0.0000069: not significant, which is wrong
20 and 20 values: U = 105 of 400 pairs, z = 2.57, p = 0.0095: not significant, which is wrong
20 and 20 values: U = 190 of 400 pairs, z = 0.27, p = 0.80: not significant
100 and 100 values: U = 780 of 10000 pairs, z = 10.31, p = 7.9e-31: not significant, which is wrong
SAID
diff expected said
echo 'As described: significant() compares the number of pairs with z.'
