#!/usr/bin/env bash
# js-stats 1.0.5's chi-square distribution has the probability 1 everywhere for one degree of freedom, and is wrong for
# all even ones.
#
# The sum that gives the probability begins differently for even and odd degrees of freedom. js-stats finds out which by
# parseInt(2 * (df / 2), 2), where 2 is not a divisor but the base: "1" is 1 as a binary number, so it takes one degree
# for even; "2", "4" and "10" are no binary numbers or others, so it takes them for odd. A table of two rows and two
# columns then has p = 0, whatever it holds; one of three by two has about a third of its p, and larger even degrees
# have too large a p. From 3 on, odd degrees are right. The right values come from integrating the density; for two
# degrees, they are exp(-x / 2).
#
# Needs: npm and node (18 or later). Downloads 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts js-stats@1.0.5 > /dev/null
cat > table.cjs <<'CODE'
const { ChiSquareDistribution } = require('js-stats');

// The probability beyond x. With x = s^2 the density is 2 s^(df - 1) exp(-s^2 / 2), divided by its whole integral.
function beyond(x, df) {
  const steps = 20000, end = 20, at = (s) => s ** (df - 1) * Math.exp(-s * s / 2);
  const integral = (from, width = (end - from) / steps) => {
    let sum = at(from) + at(end);
    for (let i = 1; i < steps; ++i) sum += at(from + i * width) * (i % 2 ? 4 : 2);
    return sum * width / 3;
  };
  return integral(Math.sqrt(x)) / integral(0);
}
const p = (x, df) => 1 - new ChiSquareDistribution(df).cumulativeProbability(x);

// The values beyond which 5 % lie.
const limits = [[1, 3.841], [2, 5.991], [3, 7.815], [4, 9.488], [5, 11.070], [6, 12.592], [9, 16.919], [10, 18.307]];
for (const [df, x] of limits)
  console.log(`${df} degrees of freedom, ${x}: p = ${p(x, df).toFixed(4)} for ${beyond(x, df).toFixed(4)}`);
console.log(`2 degrees of freedom, 3: p = ${p(3, 2).toFixed(4)} for ${Math.exp(-3 / 2).toFixed(4)}`);

// Recognised and missed mistakes of two methods, n of each: how far the counts are from what equal methods would give.
function compare(a, b, n) {
  const mean = (a + b) / 2;
  const x = 2 * ((a - mean) ** 2 / mean + (a - mean) ** 2 / (n - mean));
  console.log(`${a} and ${b} of ${n} recognised: p = ${p(x, 1).toFixed(3)} for ${beyond(x, 1).toFixed(3)}`);
}
compare(30, 31, 50);
compare(30, 40, 50);
CODE
node table.cjs | tee said

cat > expected <<'SAID'
1 degrees of freedom, 3.841: p = 0.0000 for 0.0500
2 degrees of freedom, 5.991: p = 0.0144 for 0.0500
3 degrees of freedom, 7.815: p = 0.0500 for 0.0500
4 degrees of freedom, 9.488: p = 0.0911 for 0.0500
5 degrees of freedom, 11.07: p = 0.0500 for 0.0500
6 degrees of freedom, 12.592: p = 0.0827 for 0.0500
9 degrees of freedom, 16.919: p = 0.0500 for 0.0500
10 degrees of freedom, 18.307: p = 0.0747 for 0.0500
2 degrees of freedom, 3: p = 0.0833 for 0.2231
30 and 31 of 50 recognised: p = 0.000 for 0.838
30 and 40 of 50 recognised: p = 0.000 for 0.029
SAID
diff expected said
echo 'As described: 1 and all even degrees of freedom are wrong.'
