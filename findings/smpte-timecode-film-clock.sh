#!/usr/bin/env bash
# smpte-timecode 1.3.6 counts 23.98 frames a second for 23.976 if it reads a clock: at noon it is 7 seconds ahead. One
# frame after 23:59:59:23 is 00:01:12:00.
#
# For a rate near 24, "the fractional 24000/1001" is assumed (its README); a Date gives "the timecode a master clock
# would have with a given framerate". It multiplies the Date by the rate rounded to two decimals, a relative error of
# 0.00017, and toDate() divides by the exact one: the moment does not come back. Devices that label frames by the clock,
# and others that count on from one label, are apart by 14 frames after an hour. A day of labels at 24 a second has
# 2073600 frames; the library starts again after 2071872, the frames in 24 hours at the rounded rate. At 24 and 25 all
# is right, and at 29.97 almost, but non-drop-frame labels start again too early there as well.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts smpte-timecode@1.3.6 > /dev/null
cat > clock.cjs <<'CODE'
const Timecode = require('smpte-timecode');

for (const [rate, exact] of [[23.976, 24000 / 1001], [24, 24], [25, 25], [29.97, 30000 / 1001]]) {
  const rows = [1, 12].map((hours) => {
    const timecode = Timecode(new Date(2026, 0, 5, hours), rate, rate === 29.97);
    const back = timecode.toDate(), midnight = new Date(back.getFullYear(), back.getMonth(), back.getDate());
    return `${hours} h: ${timecode.frameCount} frames for ${Math.round(3600 * hours * exact)}, back as ` +
      `${((back - midnight) / 1000 - 3600 * hours).toFixed(1).replace('-0.0', '0.0')} s more`;
  });
  console.log(`${rate}: ${rows.join('; ')}`);
}
const ends = [['23:59:59:23', 23.976], ['23:59:59:23', 24], ['23:59:59:29', 29.97], ['23:59:59;29', 29.97]];
for (const [label, rate] of ends)
  console.log(`at ${rate}, one frame after ${label}: ${Timecode(label, rate).add(1)}`);
CODE
TZ=UTC node clock.cjs | tee said

cat > expected <<'SAID'
23.976: 1 h: 86328 frames for 86314, back as 0.6 s more; 12 h: 1035936 frames for 1035764, back as 7.2 s more
24: 1 h: 86400 frames for 86400, back as 0.0 s more; 12 h: 1036800 frames for 1036800, back as 0.0 s more
25: 1 h: 90000 frames for 90000, back as 0.0 s more; 12 h: 1080000 frames for 1080000, back as 0.0 s more
29.97: 1 h: 107892 frames for 107892, back as 0.0 s more; 12 h: 1294704 frames for 1294705, back as 0.0 s more
at 23.976, one frame after 23:59:59:23: 00:01:12:00
at 24, one frame after 23:59:59:23: 00:00:00:00
at 29.97, one frame after 23:59:59:29: 00:01:26:12
at 29.97, one frame after 23:59:59;29: 00:00:00;00
SAID
diff expected said
echo 'As described: 23.976 is taken for 23.98.'
