#!/usr/bin/env bash
# cubic-hermite-spline 1.0.1 multiplies velocities by the time between two keys: at 100 frames a second, 10 m/s are 0.1
# m/s. At the end of a curve without times, the position is NaN.
#
# Its README recommends the argument knots "to enforce time at control points when used for position / velocity
# interpolation", and says of derivative: "if true return the tangeant at t instead of the position". At a key, that is
# the tangent which the caller gave (the definition of the Hermite form). The library multiplies tangents by the time
# between the keys, as it must for positions, but does not divide the derivative by this time, so that the velocity
# jumps at a key between two intervals of different lengths. Without knots, t is "in the [0, 1] range"; 1 gives NaN.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts cubic-hermite-spline@1.0.1 > /dev/null
cat > velocity.cjs <<'CODE'
const hermite = require('cubic-hermite-spline');

// A marker at 10 t^2 metres: its velocity is 20 t, and the Hermite form gives both exactly.
function show(times) {
  const points = times.map((t) => [10 * t * t]), tangents = times.map((t) => [20 * t]);
  console.log(`keys at ${times.join(', ')} s`);
  const x = (t) => hermite(t, points, tangents, times)[0];
  for (const t of [times[1] / 2, times[1], (times[1] + times[2]) / 2]) {
    const [v] = hermite(t, points, tangents, times, true), slope = (x(t + 1e-6) - x(t - 1e-6)) / 2e-6;
    console.log(`  t = ${t}: x ${x(t).toFixed(5)} for ${(10 * t * t).toFixed(5)}, v ${v.toFixed(3)} for ` +
      `${(20 * t).toFixed(3)}; slope of x ${slope.toFixed(3)}`);
  }
}
show([0, 1, 2]);
show([0, 0.01, 0.02]);
show([0, 0.5, 0.6]);
for (const t of [0, 0.5, 0.999, 1]) console.log(`no times, ${t}: ${hermite(t, [[0], [1], [4]], [[0], [2], [4]])[0]}`);
CODE
node velocity.cjs | tee said

cat > expected <<'SAID'
keys at 0, 1, 2 s
  t = 0.5: x 2.50000 for 2.50000, v 10.000 for 10.000; slope of x 10.000
  t = 1: x 10.00000 for 10.00000, v 20.000 for 20.000; slope of x 20.000
  t = 1.5: x 22.50000 for 22.50000, v 30.000 for 30.000; slope of x 30.000
keys at 0, 0.01, 0.02 s
  t = 0.005: x 0.00025 for 0.00025, v 0.001 for 0.100; slope of x 0.100
  t = 0.01: x 0.00100 for 0.00100, v 0.002 for 0.200; slope of x 0.200
  t = 0.015: x 0.00225 for 0.00225, v 0.003 for 0.300; slope of x 0.300
keys at 0, 0.5, 0.6 s
  t = 0.25: x 0.62500 for 0.62500, v 2.500 for 5.000; slope of x 5.000
  t = 0.5: x 2.50000 for 2.50000, v 5.000 for 10.000; slope of x 10.000
  t = 0.55: x 3.02500 for 3.02500, v 1.100 for 11.000; slope of x 11.000
no times, 0: 0
no times, 0.5: 1
no times, 0.999: 3.992004
no times, 1: NaN
SAID
diff expected said
echo 'As described: velocities are wrong.'
