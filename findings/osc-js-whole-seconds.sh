#!/usr/bin/env bash
# osc-js 2.4.1 rounds the time of an OSC bundle to whole seconds: 60 frames of a second arrive at two times.
#
# A tracker can send each frame as an OSC bundle with a time tag: 32 bits of seconds, and 32 bits of the fraction of a
# second (Open Sound Control 1.0). osc-js writes both parts correctly. Timetag.timestamp(), which converts a tag to
# milliseconds, rounds the fraction to 0 or 1. osc-js also delivers bundles at that time: a frame for 0.4 s comes 0.4 s
# early, one for 0.6 s comes 0.4 s late, and each half of a second arrives at once. The README promises time-critical
# bundles. osc-min 2.1.2 reads the same bytes to the millisecond.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts osc-js@2.4.1 osc-min@2.1.2 > /dev/null
cat > bundles.mjs <<'CODE'
import OSC from 'osc-js';
import { fromBuffer, timetagToDate } from 'osc-min';

const start = Date.UTC(2026, 0, 1, 10), times = [0, 0.2, 0.4, 0.6, 0.8, 1];
const bytes = times.map((t) => {
  const bundle = new OSC.Bundle([new OSC.Message('/frame', t)]);
  bundle.timestamp(start + 1000 * t);
  return bundle.pack();
});
const seconds = (milliseconds) => ((milliseconds - start) / 1000).toFixed(3);
const table = (name, values) => console.log(`${name.padEnd(18)}${values.join('  ')}`);

table('sent for', times.map((t) => t.toFixed(3)));
table('osc-min reads', bytes.map((it) => seconds(timetagToDate(fromBuffer(it, true).timetag))));
const read = bytes.map((it) => {
  const bundle = new OSC.Bundle();
  bundle.unpack(new DataView(it.buffer, it.byteOffset, it.byteLength));
  return bundle;
});
table('osc-js reads', read.map((bundle) => seconds(bundle.timetag.value.timestamp())));

// The clock stands one second before the first bundle, and keeps the delays that osc-js asks for.
const delays = [];
Date.now = () => start - 1000;
globalThis.setTimeout = (_, delay) => delays.push(delay);
const osc = new OSC({ plugin: null });
for (const bundle of read) osc.eventHandler.notify(bundle);
table('osc-js delivers', delays.map((delay) => (delay / 1000 - 1).toFixed(3)));
CODE
node bundles.mjs | tee said

cat > expected <<'SAID'
sent for          0.000  0.200  0.400  0.600  0.800  1.000
osc-min reads     0.000  0.200  0.400  0.600  0.800  1.000
osc-js reads      0.000  0.000  0.000  1.000  1.000  1.000
osc-js delivers   0.000  0.000  0.000  1.000  1.000  1.000
SAID
diff expected said
echo 'As described: osc-js reads whole seconds only.'
