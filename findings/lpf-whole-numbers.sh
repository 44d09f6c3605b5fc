#!/usr/bin/env bash
# lpf 1.0.0 rounds everything that it smooths to whole numbers: a walk in metres becomes steps of a metre. For single
# values, the same setting is a filter that is slower by far.
#
# The README calls it an algorithm for smoothing series of values and refers to Wikipedia's page "Low-pass filter",
# where the discrete filter is y += smoothing (x - y). smoothArray() computes that, but then stores Math.round(y), in
# place of the samples themselves; the README says nothing of it. next(), for single values, does not round. But its
# memory of ten values holds its own results, and each call smooths these again, together with the new value.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts lpf@1.0.0 > /dev/null
cat > walk.cjs <<'CODE'
const LPF = require('lpf');

function lowPass(samples, smoothing) {
  let y = samples[0];
  return samples.map((x) => { y += smoothing * (x - y); return y; });
}
const text = (all, digits = 2) => all.map((value) => value.toFixed(digits)).join(' ');
function show(what, samples, smoothing) {
  LPF.smoothing = smoothing;
  console.log(`${what}:\n  lpf   ${text(LPF.smoothArray([...samples]))}\n  right ${text(lowPass(samples, smoothing))}`);
}
show('a walk, in metres', [0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6, 1.8], 0.5);
show('an elbow, in radians', [0.1, 0.3, 0.4, 0.2, 0.5, 0.3, 0.1, 0.2, 0.4, 0.3], 0.5);

for (const smoothing of [0.5, 0.2]) {
  LPF.smoothing = smoothing;
  LPF.init(new Array(10).fill(0));
  const step = new Array(8).fill(1);
  console.log(`a step from 0 to 1, smoothing ${smoothing}:\n  next  ${text(step.map((x) => LPF.next(x)))}\n`
              + `  right ${text(lowPass([0, ...step], smoothing).slice(1))}`);
}
CODE
node walk.cjs | tee said

cat > expected <<'SAID'
a walk, in metres:
  lpf   0.00 0.00 0.00 0.00 1.00 1.00 1.00 1.00 1.00 2.00
  right 0.00 0.10 0.25 0.42 0.61 0.81 1.00 1.20 1.40 1.60
an elbow, in radians:
  lpf   0.10 0.00 0.00 0.00 0.00 0.00 0.00 0.00 0.00 0.00
  right 0.10 0.20 0.30 0.25 0.38 0.34 0.22 0.21 0.30 0.30
a step from 0 to 1, smoothing 0.5:
  next  0.50 0.63 0.72 0.79 0.84 0.88 0.91 0.93
  right 0.50 0.75 0.88 0.94 0.97 0.98 0.99 1.00
a step from 0 to 1, smoothing 0.2:
  next  0.20 0.23 0.26 0.29 0.32 0.35 0.37 0.40
  right 0.20 0.36 0.49 0.59 0.67 0.74 0.79 0.83
SAID
diff expected said
echo 'As described: arrays are rounded, and single values are smoothed again and again.'
