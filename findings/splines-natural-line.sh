#!/usr/bin/env bash
# The natural cubic spline of @adaskothebeast/splines 4.0.0 is a broken line; its last piece is NaN, and its first piece
# is flat if the keys start at 0.
#
# A natural spline bends: its second derivatives at the keys follow from the keys' values. NaturalSpline computes them
# from the keys' times instead, so they are all zero, and straight lines join the keys. The last key has no second
# derivative at all, so that everything after the last but one is NaN, the last key included. The search for the piece
# starts with 0 and looks for greater times: a piece that starts at 0 is not found, and the first value is returned. The
# README promises a twice differentiable curve. commons-math-interpolation 2.2.4 computes the right spline.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @adaskothebeast/splines@4.0.0 \
  commons-math-interpolation@2.2.4 > /dev/null
cat > bend.cjs <<'CODE'
const { NaturalSpline } = require('@adaskothebeast/splines');
const { createCubicSplineInterpolator } = require('commons-math-interpolation');

// A hand that goes up and down: the spline through these keys, one second apart, is known.
const heights = [0, 1, 0, -1, 0], seconds = heights.map((_, i) => i);
const bends = [0, -3, 0, 3, 0];  // its second derivatives at the keys
function right(time) {
  const i = Math.min(Math.floor(time), 3), after = time - i, before = 1 - after;
  const part = (height, bend, t) => height * t + bend * (t ** 3 - t) / 6;
  return part(heights[i], bends[i], before) + part(heights[i + 1], bends[i + 1], after);
}
const show = (name, values) =>
  console.log(`  ${name.padEnd(28)}${values.map((it) => (it + 1e-9).toFixed(2).padStart(6)).join('')}`);

for (const start of [0, 10]) {
  const times = seconds.map((time) => start + time), asked = Array.from({ length: 9 }, (_, i) => i / 2);
  const line = new NaturalSpline(times.map((time, i) => [time, heights[i]]));
  const spline = createCubicSplineInterpolator(times, heights);
  console.log(`keys from ${start} to ${start + 4} s`);
  show('right', asked.map(right));
  show('commons-math-interpolation', asked.map((time) => spline(start + time)));
  show('@adaskothebeast/splines', asked.map((time) => line.interpolate(start + time)));
}
CODE
node bend.cjs | tee said

cat > expected <<'SAID'
keys from 0 to 4 s
  right                         0.00  0.69  1.00  0.69  0.00 -0.69 -1.00 -0.69  0.00
  commons-math-interpolation    0.00  0.69  1.00  0.69  0.00 -0.69 -1.00 -0.69  0.00
  @adaskothebeast/splines       0.00  0.00  0.00  0.50  0.00 -0.50 -1.00   NaN   NaN
keys from 10 to 14 s
  right                         0.00  0.69  1.00  0.69  0.00 -0.69 -1.00 -0.69  0.00
  commons-math-interpolation    0.00  0.69  1.00  0.69  0.00 -0.69 -1.00 -0.69  0.00
  @adaskothebeast/splines       0.00  0.50  1.00  0.50  0.00 -0.50 -1.00   NaN   NaN
SAID
diff expected said
echo 'As described: straight lines, and no value at the end.'
