#!/usr/bin/env bash
# The robust fit of loess 1.3.5 keeps an outlier below the curve almost whole; it removes only those above the curve.
#
# Robust local regression fits, weighs each sample by its distance from the fit, and fits again: the weight is
# (1 - (r / 6m)^2)^2 at a distance r below 6m, where m is the median distance, and 0 beyond (Cleveland, 1979). loess
# takes the difference with its sign for r. A difference of -30m is below 6m, so its weight is not 0 but 576. A marker
# that jumps up for one of 61 frames is ignored; one that falls down pulls the curve with it, much more than in the fit
# that is not robust. The README recommends robust for "estimates that have non-Gaussian errors". A motion and its
# mirror image should have mirrored fits. There is no warning.
#
# Needs: npm and node (18 or later). Downloads 3 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts loess@1.3.5 mathjs@3.20.2 gaussian@1.3.0 > /dev/null
cat > outlier.cjs <<'CODE'
const Loess = require('loess').default;

// A marker rises by 1 cm a frame and trembles by up to 1 cm; in frame 30 it jumps by so many centimetres.
const x = Array.from({ length: 61 }, (_, i) => i);
function error(jump, robust) {  // the greatest error of the fit, frames 10 to 50
  const y = x.map((i) => i + Math.sin(7 * i) + (i === 30 ? jump : 0));
  const { fitted } = new Loess({ x, y }, { span: 0.3, degree: 1, robust }).predict();
  const errors = x.slice(10, 51).map((i) => fitted[i] - i);
  return errors.reduce((a, b) => Math.abs(a) > Math.abs(b) ? a : b).toFixed(2);
}
for (const jump of [0, 10, -10, 30, -30, 100, -100])
  console.log(`jump of ${jump} cm: error ${error(jump, false)} cm; robust ${error(jump, true)} cm`);

const { weightFunc } = require('loess/dist/helpers.js');
const weights = [5, 7, 30, -5, -7, -30].map((r) => `${r}: ${weightFunc(r, 6, 2).toFixed(2)}`);
console.log(`weights at a median distance of 1, of ${weights.join(', of ')}`);
CODE
node outlier.cjs | tee said

cat > expected <<'SAID'
jump of 0 cm: error -0.08 cm; robust 0.09 cm
jump of 10 cm: error 0.99 cm; robust 0.44 cm
jump of -10 cm: error -1.03 cm; robust -7.13 cm
jump of 30 cm: error 2.89 cm; robust 0.96 cm
jump of -30 cm: error -2.94 cm; robust -29.14 cm
jump of 100 cm: error 9.58 cm; robust 3.97 cm
jump of -100 cm: error -9.64 cm; robust -98.44 cm
weights at a median distance of 1, of 5: 0.09, of 7: 0.00, of 30: 0.00, of -5: 0.09, of -7: 0.13, of -30: 576.00
SAID
diff expected said
echo 'As described: only outliers above the curve are removed.'
