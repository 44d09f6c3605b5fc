#!/usr/bin/env bash
# timecode-boss 6.2.0 gives frames at the end of a minute the timecodes of the next minute, and reads 40 ms as 0.4 s.
#
# At 29.97 frames a second, timecode leaves out the labels 00 and 01 at the start of each minute, except every tenth; at
# 59.94 the labels 00 to 03 (SMPTE ST 12-1). Each other label belongs to one frame. timecode-boss counts 1798 frames for
# the first of ten minutes too, which has 1800: the last two frames of each minute get the labels of two later frames.
# At 59.94, the last four get labels that do not exist. From a Date it reads the digits of the milliseconds as a decimal
# fraction, so 40 and 400 ms are the same time. A motion that is matched to a video by such timecodes is moved by some
# frames. smpte-timecode 1.3.6 labels the same frames and dates correctly.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts timecode-boss@6.2.0 smpte-timecode@1.3.6 > /dev/null
cat > labels.mjs <<'CODE'
import smpte from 'smpte-timecode';
import boss from 'timecode-boss';

const Timecode = boss.default ?? boss;
const readers = { 'timecode-boss': (time, rate) => new Timecode(time, rate).toString(),
  'smpte-timecode': (time, rate) => smpte(time, rate, rate % 1 > 0).toString() };

// All labels of an hour in their order: the n-th belongs to frame n.
function labels(rate) {
  const perSecond = Math.round(rate), leftOut = rate % 1 ? perSecond / 15 : 0, all = [];
  for (let second = 0; second < 3600; ++second)
    for (let frame = second % 60 === 0 && second % 600 !== 0 ? leftOut : 0; frame < perSecond; ++frame)
      all.push([0, second / 60, second % 60, frame].map((n) => String(Math.floor(n)).padStart(2, '0')).join(':'));
  return all;
}
for (const [name, label] of Object.entries(readers)) {
  for (const rate of [25, 29.97, 59.94]) {
    const right = labels(rate), plain = (n) => label(n, rate).replace(';', ':');
    const wrong = right.flatMap((it, n) => plain(n) === it ? [] : [n]);
    console.log(`${name}, ${right.length} frames at ${rate}: ${wrong.length} wrong`);
    for (const n of wrong.slice(0, 2)) console.log(`  frame ${n}: ${plain(n)} for ${right[n]}`);
  }
  const dates = [5, 40, 50, 400].map((ms) => `${ms} ms: ${label(new Date(2026, 0, 1, 10, 0, 0, ms), 25)}`);
  console.log(`${name}, 10:00 at 25, ${dates.join(', ')}`);
}
CODE
node labels.mjs | tee said

cat > expected <<'SAID'
timecode-boss, 90000 frames at 25: 0 wrong
timecode-boss, 107892 frames at 29.97: 120 wrong
  frame 1798: 00:01:00:02 for 00:00:59:28
  frame 1799: 00:01:00:03 for 00:00:59:29
timecode-boss, 215784 frames at 59.94: 240 wrong
  frame 3596: 00:01:00:02 for 00:00:59:56
  frame 3597: 00:01:00:03 for 00:00:59:57
timecode-boss, 10:00 at 25, 5 ms: 10:00:00:12, 40 ms: 10:00:00:10, 50 ms: 10:00:00:12, 400 ms: 10:00:00:10
smpte-timecode, 90000 frames at 25: 0 wrong
smpte-timecode, 107892 frames at 29.97: 0 wrong
smpte-timecode, 215784 frames at 59.94: 0 wrong
smpte-timecode, 10:00 at 25, 5 ms: 10:00:00:00, 40 ms: 10:00:00:01, 50 ms: 10:00:00:01, 400 ms: 10:00:00:10
SAID
diff expected said
echo 'As described: only timecode-boss labels the frames wrongly.'
