#!/usr/bin/env bash
# music-tempo 1.0.3 takes every piece of music for one of 44100 samples a second: at 48000, 120 beats a minute are 110.
#
# The result has "beat times in seconds" (its README), but no argument holds the sample rate, and README and
# documentation do not say which one is meant. A time is the number of steps of 441 samples, times the argument
# timeStep, 0.01 by default. A browser's decodeAudioData, which README uses, returns the rate of the sound card, often
# 48000. Then all beats are 9 % late: after a minute by more than five seconds. With timeStep 441 / 48000 times and
# tempo are right.
#
# Needs: npm and node (18 or later). Downloads 2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts music-tempo@1.0.3 > /dev/null
cat > clicks.cjs <<'CODE'
const MusicTempo = require('music-tempo');

function clicks(rate) {  // 20 s, a click every half second from 1 s on
  const sound = new Float32Array(rate * 20);
  for (let beat = 1; beat < 20; beat += 0.5) {
    for (let i = 0; i < rate * 0.03; ++i) sound[beat * rate + i] = Math.exp(-i / (rate * 0.005)) * Math.sin(2 * Math.PI * 1500 * i / rate);
  }
  return sound;
}
for (const [rate, options] of [[44100, {}], [48000, {}], [48000, { timeStep: 441 / 48000 }]]) {
  const { tempo, beats } = new MusicTempo(clicks(rate), options);
  console.log(`${rate} samples a second${options.timeStep ? ', timeStep 441 / 48000' : ''}: tempo ${Number(tempo).toFixed(0)}, `
              + `first beats at ${beats.slice(0, 4).map((beat) => beat.toFixed(1)).join(', ')} s`);
}
CODE
node clicks.cjs | tee said

cat > expected <<'SAID'
44100 samples a second: tempo 120, first beats at 1.0, 1.5, 2.0, 2.5 s
48000 samples a second: tempo 110, first beats at 1.1, 1.6, 2.2, 2.7 s
48000 samples a second, timeStep 441 / 48000: tempo 120, first beats at 1.0, 1.5, 2.0, 2.5 s
SAID
diff expected said
grep -qi 'sample rate\|sampleRate\|44100' node_modules/music-tempo/README.md && exit 1
echo 'The behaviour is as described.'
