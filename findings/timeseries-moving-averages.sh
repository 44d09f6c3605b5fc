#!/usr/bin/env bash
# timeseries-analysis 1.0.12's weighted moving average weighs the oldest sample most, and its exponential one keeps two
# samples only.
#
# A linear weighted average of N samples gives the newest the weight N and the oldest 1; lwma() does the reverse. It
# lags (2N + 1) / 3 samples behind a steady movement instead of (N - 1) / 3: with N = 12 at 100 Hz, 83 ms instead of 37.
# ma() averages the N samples before the present one, which lags a sample more. An exponential average mixes each sample
# into the last average; ema() mixes it into the last sample, so that 69 % of a tremor that alternates from sample to
# sample remain instead of 8 %. The README has a picture of ma and lwma, and no words on what they average.
#
# Needs: npm and node (18 or later). Downloads 9 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts timeseries-analysis@1.0.12 > /dev/null
cat > lag.cjs <<'CODE'
const { main: Series } = require('timeseries-analysis');

const period = 12, length = 400, last = length - 1;
function smooth(method, signal) {
  const data = Array.from({ length }, (_, i) => [i, signal(i)]);
  return new Series(data)[method]({ period }).data.map(([, value]) => value);
}
// By definition, each average of a long signal has this lag, in samples, and keeps this share of the tremor.
const m = 2 / (period + 1);
const right = { ma: [(period - 1) / 2, 0], lwma: [(period - 1) / 3, 1 / (period + 1)], ema: [1 / m - 1, m / (2 - m)] };
for (const method of ['ma', 'lwma', 'ema']) {
  const lag = last - smooth(method, (i) => i)[last];
  const tremor = Math.abs(smooth(method, (i) => (-1) ** i)[last]);
  const [itsLag, itsTremor] = right[method];
  console.log(`${method} of ${period}: lags ${lag.toFixed(2)} samples for ${itsLag.toFixed(2)}, keeps ` +
    `${(100 * tremor).toFixed(0)} % of a tremor for ${(100 * itsTremor).toFixed(0)} %`);
}
const sum = period * (period + 1) / 2;  // of the weights
const weights = smooth('lwma', (i) => (i === 100 ? sum : 0)).slice(100, 101 + period).map(Math.round);
console.log(`lwma's weights of a sample that is 0, 1, 2... samples old: ${weights.join(' ')}`);
CODE
node lag.cjs | tee said

cat > expected <<'SAID'
ma of 12: lags 6.50 samples for 5.50, keeps 0 % of a tremor for 0 %
lwma of 12: lags 8.33 samples for 3.67, keeps 8 % of a tremor for 8 %
ema of 12: lags 0.85 samples for 5.50, keeps 69 % of a tremor for 8 %
lwma's weights of a sample that is 0, 1, 2... samples old: 0 1 2 3 4 5 6 7 8 9 10 11 12
SAID
diff expected said
echo 'As described: old samples weigh most.'
