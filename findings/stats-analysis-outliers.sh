#!/usr/bin/env bash
# stats-analysis 2.0.0's outliers of a time series depend on the unit: it finds a glitch of 40 cm in millimetres and in
# centimetres, but not in metres. It also takes the good sample behind each glitch for an outlier, and if the glitch is
# behind a zero, only that one.
#
# The default method, "best for time series data" as the README says, compares each difference of two neighbours with
# three times the median difference. But it first rounds the differences to whole numbers and adds 1. In metres, all
# steps of a motion below half a metre are then 1, and nothing exceeds three times that. The sample behind a glitch
# differs from the glitch as much as the glitch from the sample before it, so both count as outliers. A 0 is taken for a
# missing neighbour, so that the sample behind it is never an outlier. A change of the unit must not change a ratio of
# differences. The other method, MAD, ignores the order, but has none of these faults.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts stats-analysis@2.0.0 > /dev/null
cat > glitches.cjs <<'CODE'
const { indexOfOutliers, outlierMethod } = require('stats-analysis');

// A hand moves by 2 cm each sample; sample 5 is off by 40 cm.
const centimetres = [100, 102, 104, 106, 108, 150, 112, 114, 116, 118, 120];
const units = { millimetres: 10, centimetres: 1, metres: 0.01 };
const text = (found) => found.length ? found.join(' and ') : 'none';

for (const [unit, factor] of Object.entries(units)) {
  const hand = centimetres.map((value) => value * factor);
  const [differences, mad] = ['medianDiff', 'MAD'].map((method) => indexOfOutliers(hand, outlierMethod[method]));
  console.log(`a glitch of 40 cm at sample 5, in ${unit}: ${text(differences)}; MAD: ${text(mad)}`);
}
for (const zero of [100, 101]) {
  const shifted = [100, 99, 101, 100, 900, 101, 100, 99, 101].map((value) => value - zero);
  console.log(`a jump by ${shifted[4] - shifted[3]} from ${shifted[3]} at sample 4: ${text(indexOfOutliers(shifted))}`);
}
CODE
node glitches.cjs | tee said

cat > expected <<'SAID'
a glitch of 40 cm at sample 5, in millimetres: 5 and 6; MAD: 5
a glitch of 40 cm at sample 5, in centimetres: 5 and 6; MAD: 5
a glitch of 40 cm at sample 5, in metres: none; MAD: 5
a jump by 800 from 0 at sample 4: 5
a jump by 800 from -1 at sample 4: 4 and 5
SAID
diff expected said
echo 'As described: the outliers depend on the unit.'
