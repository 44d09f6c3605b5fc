#!/usr/bin/env bash
# @tonejs/midi 2.0.28 moves all beats after a MIDI file's first tempo if that tempo is not at the start.
#
# Where a MIDI file gives no tempo, it plays at 120 beats a minute (Standard MIDI Files 1.0). @tonejs/midi gives the
# notes before the first tempo these times. But it computes the time of the first tempo as if that tempo had applied
# from the start. If the fifth beat sets 60 beats a minute, it is at 4 s instead of 2 s; if it sets 240, it is at 1 s,
# before the third and fourth beat. Files that set a tempo at the start are read correctly. midi-player-js reads all
# files correctly.
#
# Needs: npm and node (18 or later). Downloads less than 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @tonejs/midi@2.0.28 midi-file@1.2.4 \
  midi-player-js@2.0.17 > /dev/null
cat > beats.mjs <<'CODE'
import tone from '@tonejs/midi';
import { writeMidi } from 'midi-file';
import player from 'midi-player-js';

const ticksPerBeat = 480, beats = 8;
function file(tempos) {  // a note on each beat
  const events = [];
  for (let beat = 0; beat < beats; ++beat) {
    const microsecondsPerBeat = 60e6 / tempos[beat];
    if (tempos[beat]) events.push({ deltaTime: 0, meta: true, type: 'setTempo', microsecondsPerBeat });
    events.push({ deltaTime: 0, type: 'noteOn', channel: 0, noteNumber: 60, velocity: 90 });
    events.push({ deltaTime: ticksPerBeat, type: 'noteOff', channel: 0, noteNumber: 60, velocity: 0 });
  }
  events.push({ deltaTime: 0, meta: true, type: 'endOfTrack' });
  return Uint8Array.from(writeMidi({ header: { format: 0, numTracks: 1, ticksPerBeat }, tracks: [events] }));
}
function right(tempos) {
  let time = 0, tempo = 120;
  return Array.from({ length: beats }, (_, beat) => {
    if (beat > 0) time += 60 / tempo;
    tempo = tempos[beat] ?? tempo;
    return time;
  });
}
const table = (name, times) => console.log(`  ${name.padEnd(16)}${times.map((time) => time.toFixed(2)).join(' ')}`);
for (const tempos of [{ 0: 120, 4: 60 }, { 4: 60 }, { 4: 240 }]) {
  console.log(Object.entries(tempos).map(([beat, tempo]) => `${tempo} from beat ${Number(beat) + 1}`).join(', '));
  const bytes = file(tempos);
  table('right', right(tempos));
  const other = new player.Player().loadArrayBuffer(bytes.buffer);
  table('midi-player-js', right(tempos).map((_, beat) => other.ticksToSeconds(0, beat * ticksPerBeat)));
  table('@tonejs/midi', new tone.Midi(bytes).tracks[0].notes.map((note) => note.time));
}
CODE
node beats.mjs | tee said

cat > expected <<'SAID'
120 from beat 1, 60 from beat 5
  right           0.00 0.50 1.00 1.50 2.00 3.00 4.00 5.00
  midi-player-js  0.00 0.50 1.00 1.50 2.00 3.00 4.00 5.00
  @tonejs/midi    0.00 0.50 1.00 1.50 2.00 3.00 4.00 5.00
60 from beat 5
  right           0.00 0.50 1.00 1.50 2.00 3.00 4.00 5.00
  midi-player-js  0.00 0.50 1.00 1.50 2.00 3.00 4.00 5.00
  @tonejs/midi    0.00 0.50 1.00 1.50 4.00 5.00 6.00 7.00
240 from beat 5
  right           0.00 0.50 1.00 1.50 2.00 2.25 2.50 2.75
  midi-player-js  0.00 0.50 1.00 1.50 2.00 2.25 2.50 2.75
  @tonejs/midi    0.00 0.50 1.00 1.50 1.00 1.25 1.50 1.75
SAID
diff expected said
echo 'As described: the beats after a late first tempo are moved.'
