#!/usr/bin/env bash
# outliers 0.0.3 removes six times as many samples of a normal distribution as the rule on which it is based: it counts
# from the median instead of the quartiles.
#
# Its README refers to Wikipedia's page "Interquartile range", where an outlier lies more than 1.5 interquartile ranges
# below the first quartile or above the third one (Tukey, 1977). The package calls everything an outlier that lies more
# than 1.5 interquartile ranges from the median. For a normal distribution, that is 2.02 standard deviations instead of
# 2.70, so that 4.3 % of all good samples go instead of 0.7 %. Of a skewed distribution, as that of durations, more go.
# The standard deviation of the rest is too small.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts outliers@0.0.3 > /dev/null
cat > fences.cjs <<'CODE'
const outliers = require('outliers');

// Tukey's rule, with the quartiles as the medians of the two halves, as the package takes them.
function tukey(values) {
  const sorted = [...values].sort((a, b) => a - b), half = sorted.length / 2;
  const median = (all) => (all[Math.floor((all.length - 1) / 2)] + all[Math.floor(all.length / 2)]) / 2;
  const [low, high] = [median(sorted.slice(0, Math.floor(half))), median(sorted.slice(Math.ceil(half)))];
  const reach = 1.5 * (high - low);
  return sorted.filter((value) => value < low - reach || value > high + reach);
}

// The normal distribution: its density, summed up in small steps, gives the values at 0.0005, 0.0015, ...
function normal(count) {
  const values = [], step = 1e-4;
  for (let x = -6, share = 0; values.length < count; x += step) {
    share += step * Math.exp(-x * x / 2) / Math.sqrt(2 * Math.PI);
    if (share >= (values.length + 0.5) / count) values.push(x);
  }
  return values;
}
function deviation(values) {
  const mean = values.reduce((a, b) => a + b) / values.length;
  return Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (values.length - 1));
}
const bell = normal(1000);
const sets = {
  'normal distribution': bell,
  'exponential distribution': bell.map((_, i) => -Math.log(1 - (i + 0.5) / 1000)),
  'equal spread': bell.map((_, i) => i),
};
for (const [name, values] of Object.entries(sets)) {
  const rest = values.filter(outliers());
  console.log(`${name}: ${outliers(values).length} of 1000 for ${tukey(values).length}; standard deviation of the rest `
              + `${(deviation(rest) / deviation(values)).toFixed(2)} of that of all`);
}
const times = [61, 64, 66, 67, 68, 69, 70, 71, 72, 73, 74, 79];
const text = (all) => all.join(' and ') || 'none';
console.log(`${times.join(' ')} ms: ${text(outliers(times))} for ${text(tukey(times))}`);
CODE
node fences.cjs | tee said

cat > expected <<'SAID'
normal distribution: 44 of 1000 for 6; standard deviation of the rest 0.88 of that of all
exponential distribution: 96 of 1000 for 48; standard deviation of the rest 0.60 of that of all
equal spread: 0 of 1000 for 0; standard deviation of the rest 1.00 of that of all
61 64 66 67 68 69 70 71 72 73 74 79 ms: 79 for none
SAID
diff expected said
echo 'As described: the package counts from the median.'
