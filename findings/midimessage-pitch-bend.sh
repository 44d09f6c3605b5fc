#!/usr/bin/env bash
# midimessage 1.0.5 reads a pitch wheel in the middle as fully bent: its values go up to 32639, with gaps, instead of
# 16383.
#
# A pitch bend has two bytes of seven bits each: its value is 128 times the second plus the first, 8192 in the middle
# (MIDI 1.0). The README says the same: "0-16383", "Center (no pitch change) is 8192". midimessage multiplies by 256:
# the middle is 16384, beyond the documented range; 8192 is a wheel half way down; after 127 comes 256. Wheels, ribbons
# and gesture controllers send fine positions as pitch bends, so half of each movement is cut off, or scaled by two.
#
# Needs: npm and node (18 or later). Downloads less than 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts midimessage@1.0.5 > /dev/null
cat > bend.cjs <<'CODE'
const read = require('midimessage');

for (const value of [0, 127, 128, 4096, 8191, 8192, 12288, 16383]) {
  const data = new Uint8Array([0xe0, value & 127, value >> 7]);
  const message = read({ data, receivedTime: 0 });
  console.log(`${message.messageType} of ${value}: ${message.pitchBend}`);
}
CODE
node bend.cjs | tee said

cat > expected <<'SAID'
pitchbendchange of 0: 0
pitchbendchange of 127: 127
pitchbendchange of 128: 256
pitchbendchange of 4096: 8192
pitchbendchange of 8191: 16255
pitchbendchange of 8192: 16384
pitchbendchange of 12288: 24576
pitchbendchange of 16383: 32639
SAID
diff expected said
echo 'As described: pitch bends are twice as large.'
