#!/usr/bin/env bash
# fili 2.0.3's FIR band-stop doubles the band that it should remove, and its band-pass reverses the sign.
#
# Both take the edges of the band as F1 and F2. The README does not say which is the lower; fili's demo and tests pass
# it as F1. The band-stop then adds the low-pass of F2 to the high-pass of F1, so that the hum of 50 Hz in a muscle's
# signal grows to twice its size and the rest stays. The band-pass, which is the signal less the band-stop, passes the
# right band upside down: a peak becomes a trough. With the higher edge as F1 both are right. A high-pass of an odd
# order, which nothing forbids or reports, is a low-pass with the opposite sign.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts fili@2.0.3 > /dev/null
cat > bands.cjs <<'CODE'
const { FirCoeffs, FirFilter } = require('fili');

const Fs = 1000, delay = 100;  // samples by which a filter of order 200 delays
const design = (kind, options) => new FirFilter(new FirCoeffs()[kind]({ order: 2 * delay, Fs, ...options }));

function gain(kind, options, frequency) {  // negative if the output is the input upside down
  const wave = Array.from({ length: 2000 }, (_, i) => Math.sin(2 * Math.PI * frequency * i / Fs));
  const out = design(kind, options).multiStep(wave);
  let product = 0, square = 0;
  for (let i = 1000; i < 2000; ++i) {
    product += out[i] * wave[i - delay];
    square += wave[i - delay] ** 2;
  }
  return (Math.round(product / square * 10) / 10 + 0).toFixed(1);
}
function show(title, kind, options, frequencies = [10, 50, 100, 200]) {
  console.log(`${title}: ${frequencies.map((x) => gain(kind, options, x)).join(' ')}`);
}
console.log('gains at 10, 50, 100 and 200 Hz');
show('band-stop, F1 40, F2 60', 'bandstop', { F1: 40, F2: 60 });
show('band-stop, F1 60, F2 40', 'bandstop', { F1: 60, F2: 40 });
show('band-pass, F1 40, F2 60', 'bandpass', { F1: 40, F2: 60 });
show('band-pass, F1 60, F2 40', 'bandpass', { F1: 60, F2: 40 });
const said = design('bandstop', { F1: 40, F2: 60 }).responsePoint({ Fs, Fr: 50 });
console.log(`fili's own answer for the first at 50 Hz: ${said.magnitude.toFixed(1)}`);

for (const order of [200, 201]) {
  const filter = design('highpass', { order, Fc: 30 });
  const ends = [0, 100].map((Fr) => filter.responsePoint({ Fs, Fr }).magnitude.toFixed(1));
  const rest = Math.round(filter.multiStep(Array(1000).fill(1))[999] * 10) / 10 + 0;
  console.log(`high-pass of 30 Hz, order ${order}: 0 Hz ${ends[0]}, 100 Hz ${ends[1]}, a constant 1 becomes ${rest.toFixed(1)}`);
}
CODE
node bands.cjs | tee said

cat > expected <<'SAID'
gains at 10, 50, 100 and 200 Hz
band-stop, F1 40, F2 60: 1.0 2.0 1.0 1.0
band-stop, F1 60, F2 40: 1.0 0.0 1.0 1.0
band-pass, F1 40, F2 60: 0.0 -1.0 0.0 0.0
band-pass, F1 60, F2 40: 0.0 1.0 0.0 0.0
fili's own answer for the first at 50 Hz: 2.0
high-pass of 30 Hz, order 200: 0 Hz 0.0, 100 Hz 1.0, a constant 1 becomes 0.0
high-pass of 30 Hz, order 201: 0 Hz 1.0, 100 Hz 0.0, a constant 1 becomes -1.0
SAID
diff expected said
echo 'As described: the band doubles, or turns over.'
