#!/usr/bin/env bash
# spline-interpolator 1.0.0 smooths all samples but the last one: its curve jumps to the raw value there.
#
# It is a "library for smoothing spline interpolation" (its README); the third argument, lambda, makes the curve
# smoother, the less it is. A smoothing spline is continuous, and for a lambda near 0 it is the line of least squares
# (Reinsch, 1967). At the time of the last sample the package returns the sample itself, as if it interpolated; just
# before and behind, it returns the curve. So the last point of curve() is noise, and a speed from the last two points
# is noise divided by the step: below, a walker at 1 m/s with errors of 2 cm ends at -6 m/s. Only for lambda 1, the
# default, which interpolates, the two agree.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts spline-interpolator@1.0.0 > /dev/null
cat > walker.cjs <<'CODE'
const SplineInterpolator = require('spline-interpolator');

// Positions of a walker at 1 m/s, in metres, that are 2 cm too far and too near by turns.
const times = Array.from({ length: 11 }, (_, i) => i), last = 10;
const walker = times.map((time) => time + (time % 2 ? 0.02 : -0.02));

function line(x, y) {  // least squares
  const mean = (all) => all.reduce((a, b) => a + b) / all.length, [mx, my] = [mean(x), mean(y)];
  const slope = mean(x.map((value, i) => (value - mx) * (y[i] - my))) / mean(x.map((value) => (value - mx) ** 2));
  return (at) => my + slope * (at - mx);
}
const text = (value) => value.toFixed(4);
const right = line(times, walker);
console.log(`sample 5 is ${text(walker[5])}, the last one ${text(walker[last])}; `
            + `least squares: ${text(right(5))} and ${text(right(last))}`);
for (const lambda of [1, 0.5, 0.01, 1e-6]) {
  const spline = new SplineInterpolator(times, walker, lambda);
  const at = [5, last - 1e-6, last, last + 1e-6].map((time) => text(spline.interpolate(time)));
  const [before, end] = spline.curve(4001).slice(-2);
  const speed = (end[1] - before[1]) / (end[0] - before[0]);
  console.log(`lambda ${lambda}: ${at[0]} at sample 5; ${at[1]} before, ${at[2]} at and ${at[3]} behind the last one; `
              + `last speed ${speed.toFixed(1)} m/s`);
}
CODE
node walker.cjs | tee said

cat > expected <<'SAID'
sample 5 is 5.0200, the last one 9.9800; least squares: 4.9982 and 9.9982
lambda 1: 5.0200 at sample 5; 9.9800 before, 9.9800 at and 9.9800 behind the last one; last speed 0.9 m/s
lambda 0.5: 5.0008 at sample 5; 9.9898 before, 9.9800 at and 9.9898 behind the last one; last speed -2.9 m/s
lambda 0.01: 4.9992 at sample 5; 9.9968 before, 9.9800 at and 9.9968 behind the last one; last speed -5.7 m/s
lambda 0.000001: 4.9982 at sample 5; 9.9982 before, 9.9800 at and 9.9982 behind the last one; last speed -6.3 m/s
SAID
diff expected said
echo 'As described: the last sample is not smoothed.'
