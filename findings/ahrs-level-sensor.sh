#!/usr/bin/env bash
# The npm package ahrs 1.3.3 fails at zeros: Madgwick's filter turns to NaN, Mahony's stops correcting.
#
# A gravity of (0, 0, 1), which an ideal or coarse accelerometer measures when it lies level, fits the start attitude exactly.
# Madgwick's filter then divides its correction, which is zero, by the correction's length, and every later attitude is NaN.
# Mahony's filter corrects nothing while a component of the acceleration is zero: a sensor that is turned about one axis alone
# measures (0, 0.5, 0.87), and its angle stays at 0 degrees. Adding a thousandth to the zero avoids both faults. The README
# asks for unfiltered accelerations in g, and allows leaving the magnetometer out.
#
# Needs: npm and node (18 or later). Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts ahrs@1.3.3 > /dev/null
cat > still.cjs <<'CODE'
const AHRS = require('ahrs');

const tilted = (x) => [x, Math.sin(Math.PI / 6), Math.cos(Math.PI / 6)];
const settle = (filter, gravity) => {  // 100 s at 100 Hz
  for (let i = 0; i < 10000; ++i) filter.update(0, 0, 0, ...gravity);
  return `${filter.getEulerAnglesDegrees().roll.toFixed(0)}`;
};
for (const algorithm of ['Madgwick', 'Mahony']) {
  const filter = () => new AHRS({ algorithm, sampleInterval: 10, beta: 0.05, kp: 0.5 });
  const level = filter();
  console.log(`${algorithm}: roll of a level sensor ${settle(level, [0, 0, 1])}, then rolled by 30 degrees ${settle(level, tilted(0.001))}`);
  const [exact, nearly] = [0, 0.001].map((x) => settle(filter(), tilted(x)));
  console.log(`${algorithm}: roll of a sensor rolled by 30 degrees, x = 0: ${exact}, x = 0.001: ${nearly}`);
}
CODE
node still.cjs | tee said

cat > expected <<'SAID'
Madgwick: roll of a level sensor NaN, then rolled by 30 degrees NaN
Madgwick: roll of a sensor rolled by 30 degrees, x = 0: 30, x = 0.001: 30
Mahony: roll of a level sensor 0, then rolled by 30 degrees 30
Mahony: roll of a sensor rolled by 30 degrees, x = 0: 0, x = 0.001: 30
SAID
diff expected said
echo 'As described: a thousandth more or less makes the difference.'
