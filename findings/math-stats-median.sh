#!/usr/bin/env bash
# math-stats 0.3.1's median takes numbers in the order of their text: the median of 9, 10 and 11 is 11.
#
# As text, 10 is before 9, and -1 before -2. The median is right by chance, or if all numbers have the same sign and the
# same number of digits before the point. Of 101 times from 0 to 100 ms, it is 53 instead of 50; of errors on both sides
# of zero, one far from the middle. The README calls it the median, and its example is 1, 2, 3. The caller's array is
# put into the same order, so that a series of samples is no longer one. The geometric mean has six significant digits
# only; the README's example prints 17.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts math-stats@0.3.1 > /dev/null
cat > median.cjs <<'CODE'
const stats = require('math-stats');

function right(values) {
  const sorted = [...values].sort((a, b) => a - b), half = sorted.length / 2;
  return sorted.length % 2 ? sorted[Math.floor(half)] : (sorted[half - 1] + sorted[half]) / 2;
}
const show = (name, values) => console.log(`${name}: ${stats.median([...values])} for ${right(values)}`);
show('9, 10, 11', [9, 10, 11]);
show('8, 9, 10, 11', [8, 9, 10, 11]);
show('-3, -2, -1, 1, 2', [-3, -2, -1, 1, 2]);
show('0 to 100', Array.from({ length: 101 }, (_, i) => i));
show('10 to 99', Array.from({ length: 90 }, (_, i) => i + 10));
show('1e-7, 0.002, 0.5', [1e-7, 0.002, 0.5]);

const heights = [8, 9, 10, 11, 12];
stats.median(heights);
console.log(`a rising series, after its median was asked for: ${heights.join(' ')}`);
console.log(`geometric mean of 1, 2, 3: ${stats.geometricMean([1, 2, 3])} for ${Math.cbrt(6).toFixed(12)}`);
CODE
node median.cjs | tee said

cat > expected <<'SAID'
9, 10, 11: 11 for 10
8, 9, 10, 11: 9.5 for 9.5
-3, -2, -1, 1, 2: -3 for -1
0 to 100: 53 for 50
10 to 99: 54.5 for 54.5
1e-7, 0.002, 0.5: 0.5 for 0.002
a rising series, after its median was asked for: 10 11 12 8 9
geometric mean of 1, 2, 3: 1.81712 for 1.817120592832
SAID
diff expected said
echo 'As described: numbers are sorted as text.'
