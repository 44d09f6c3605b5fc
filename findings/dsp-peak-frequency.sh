#!/usr/bin/env bash
# dsp.js 1.0.1 finds every frequency half a band too high, and keeps the peak of a louder window for ever.
#
# FFT and DFT name the strongest band of a spectrum, peakBand, and getBandFrequency() gives "the *middle* frequency of
# an FFT band". The band k of N samples is the frequency k / N times the sample rate (the definition of the transform),
# so that this is its middle; dsp.js adds half a band. With a window of 64 samples at 100 Hz, a tremor of 6.25 Hz is
# reported as 7.03 Hz. peakBand and peak are not reset between windows: after a strong tremor, weaker ones of other
# frequencies are never reported. The constant part of a signal counts twice, so that an offset of 0.6 beats an
# amplitude of 1. The README mentions none of this; the packages @neurosity/dsp 1.0.1 and digitalsignals 1.0.0 have the
# same code.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts dsp.js@1.0.1 @neurosity/dsp@1.0.1 digitalsignals@1.0.0 \
  > /dev/null
cat > tremor.cjs <<'CODE'
const libraries = { 'dsp.js': require('dsp.js'), '@neurosity/dsp': require('@neurosity/dsp'),
  digitalsignals: require('digitalsignals') };

const samples = 64, rate = 100;
const tremor = (amplitude, frequency, offset = 0) => Array.from({ length: samples },
  (_, i) => offset + amplitude * Math.sin(2 * Math.PI * frequency * i / rate));
for (const [name, library] of Object.entries(libraries)) {
  console.log(name);
  const peak = (fft) => fft.getBandFrequency(fft.peakBand).toFixed(2);
  for (const kind of ['FFT', 'DFT']) {
    const all = new library[kind](samples, rate);
    const found = [[2, 6.25], [1, 12.5], [1, 3.125]].map(([amplitude, frequency]) => {
      const one = new library[kind](samples, rate);
      for (const fft of [one, all]) fft.forward(tremor(amplitude, frequency));
      return `${frequency} Hz as ${peak(one)}, or ${peak(all)}`;
    });
    console.log(`  ${kind} of one window, or of all so far: ${found.join('; ')}`);
  }
  const fft = new library.FFT(samples, rate);
  fft.forward(tremor(1, 6.25, 0.6));
  const [offset, , , , peakOfTremor] = fft.spectrum;
  console.log(`  an offset of 0.6 has ${offset.toFixed(2)}, a tremor of 1 has ${peakOfTremor.toFixed(2)}; ` +
    `the peak is band ${fft.peakBand}`);
}
CODE
node tremor.cjs | tee said

cat > expected <<'SAID'
dsp.js
  FFT of one window, or of all so far: 6.25 Hz as 7.03, or 7.03; 12.5 Hz as 13.28, or 7.03; 3.125 Hz as 3.91, or 7.03
  DFT of one window, or of all so far: 6.25 Hz as 7.03, or 7.03; 12.5 Hz as 13.28, or 7.03; 3.125 Hz as 3.91, or 7.03
  an offset of 0.6 has 1.20, a tremor of 1 has 1.00; the peak is band 0
@neurosity/dsp
  FFT of one window, or of all so far: 6.25 Hz as 7.03, or 7.03; 12.5 Hz as 13.28, or 7.03; 3.125 Hz as 3.91, or 7.03
  DFT of one window, or of all so far: 6.25 Hz as 7.03, or 7.03; 12.5 Hz as 13.28, or 7.03; 3.125 Hz as 3.91, or 7.03
  an offset of 0.6 has 1.20, a tremor of 1 has 1.00; the peak is band 0
digitalsignals
  FFT of one window, or of all so far: 6.25 Hz as 7.03, or 7.03; 12.5 Hz as 13.28, or 7.03; 3.125 Hz as 3.91, or 7.03
  DFT of one window, or of all so far: 6.25 Hz as 7.03, or 7.03; 12.5 Hz as 13.28, or 7.03; 3.125 Hz as 3.91, or 7.03
  an offset of 0.6 has 1.20, a tremor of 1 has 1.00; the peak is band 0
SAID
diff expected said
echo 'As described: frequencies are too high, and peaks stay.'
