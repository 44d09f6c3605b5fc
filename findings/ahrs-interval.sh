#!/usr/bin/env bash
# The npm package ahrs 1.3.3 takes its sampleInterval in milliseconds; its README says Hz.
#
# Both filters divide 1000 by it to get a frequency, so the default of 20 means 50 Hz. A sensor of 100 Hz that turns at 30
# degrees a second for one second has turned by 30 degrees. With the README's unit the filter computes 300 degrees, which it
# reports as -60. The deltaTimeSec of an update, in seconds, overrides the interval.
#
# Needs: npm and node (18 or later). Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts ahrs@1.3.3 > /dev/null
cat > turn.cjs <<'CODE'
const AHRS = require('ahrs');

const rate = 100, degree = Math.PI / 180;
for (const algorithm of ['Madgwick', 'Mahony']) {
  for (const [what, sampleInterval] of [['100, Hz as in the README', rate], ['10, milliseconds', 1000 / rate]]) {
    const filter = new AHRS({ algorithm, sampleInterval });
    for (let i = 0; i < rate; ++i) filter.update(0, 0, 30 * degree, 0, 0, 0);  // the gyroscope alone
    console.log(`${algorithm}, sampleInterval ${what}: ${filter.getEulerAnglesDegrees().heading.toFixed(1)} degrees`);
  }
}
CODE
node turn.cjs | tee said

cat > expected <<'SAID'
Madgwick, sampleInterval 100, Hz as in the README: -60.1 degrees
Madgwick, sampleInterval 10, milliseconds: 30.0 degrees
Mahony, sampleInterval 100, Hz as in the README: -60.1 degrees
Mahony, sampleInterval 10, milliseconds: 30.0 degrees
SAID
grep -q 'The sample interval, in Hz' node_modules/ahrs/README.md
diff expected said
echo 'As described: milliseconds are right.'
