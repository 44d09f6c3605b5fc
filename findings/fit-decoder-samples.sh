#!/usr/bin/env bash
# fit-decoder 1.0.5 keeps the first acceleration of each message of a FIT file and moves walkers in steps of two metres.
#
# Watches write FIT files; fit-decoder's README says that no data is removed and that coordinates become degrees. But a
# field may hold many values: an accelerometer_data message has up to 30 samples and a time for each. fit-decoder
# returns the first of each field as a plain number. It divides positions as whole numbers before it multiplies by 180,
# which leaves steps of 0.000018 degrees where the file has 0.00000008. It divides altitudes and ascents by 100, but FIT
# stores an altitude as 5 x (metres + 500) and an ascent in metres. Records whose header holds a compressed time get no
# time at all. fit-file-parser 6.1.2, which writes the file here, reads all of it as FIT's profile says.
#
# Needs: npm and node (20 or later). Downloads 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts fit-decoder@1.0.5 fit-file-parser@6.1.2 > /dev/null
cat > watch.mjs <<'CODE'
import decoder from 'fit-decoder';
import FitParser, { FitBaseType, FitEncoder } from 'fit-file-parser';

const { Enum, Uint8, Uint16, Sint32, Uint32, Float32 } = FitBaseType;
const start = 1100000000;  // a multiple of 32 seconds
const field = (number, baseType, size, value) => ({ number, baseType, size, value });
const many = (number, baseType, values) => field(number, baseType, values.byteLength, new Uint8Array(values.buffer));

const file = new FitEncoder();
file.writeMessage(0, [field(0, Enum, 1, 4)]);  // an activity
file.writeMessage(165, [field(253, Uint32, 4, start), field(0, Uint16, 2, 0),
  many(1, Uint16, Uint16Array.of(0, 10, 20, 30)), many(5, Float32, Float32Array.of(0, 0.5, 1, 1.5))]);
for (let i = 0; i < 8; ++i) {  // walks north at 1.2 m/s, 100 m above the sea
  const latitude = 50 + 1.2 * i / 111195;
  file.writeMessage(20, [field(253, Uint32, 4, start + i), field(0, Sint32, 4, Math.round(latitude / 180 * 2 ** 31)),
    field(2, Uint16, 2, 5 * (100 + 500))]);
}
file.writeMessage(18, [field(253, Uint32, 4, start + 7), field(22, Uint16, 2, 250)]);  // climbed 250 m
for (let i = 8; i < 11; ++i) file.writeMessage(20, [field(3, Uint8, 1, 120)], 2);  // the pulse only
const bytes = file.close();
for (let i = 0; i < 3; ++i) bytes[bytes.length - 8 + 2 * i] = 0x80 | 2 << 5 | 8 + i;  // compressed times for these three
new DataView(bytes.buffer, bytes.byteOffset).setUint16(bytes.length - 2, FitEncoder.calculateCRC(bytes.subarray(0, -2)), true);

function show(name, messages) {
  const [sample] = messages('accelerometer_data'), records = messages('record'), [session] = messages('session');
  const moving = records.slice(0, 8), pulse = records.slice(8);
  const steps = moving.slice(1).map((x, i) => ((x.position_lat - moving[i].position_lat) * 111195).toFixed(1));
  console.log(name);
  console.log(`  milliseconds ${JSON.stringify(sample.sample_time_offset)}, g ${JSON.stringify(sample.calibrated_accel_x)}`);
  console.log(`  metres per second: ${steps.join(' ')}`);
  console.log(`  altitude ${moving[0].altitude}, ascent ${session.total_ascent}`);
  const times = pulse.map(({ timestamp: x }) => (x ? x.getTime() / 1000 - 631065600 - start : 'none'));
  console.log(`  seconds of the last three: ${times.join(' ')}`);
}
const right = await new FitParser({ force: false }).parseAsync(bytes);  // with its checks
show('fit-file-parser', (type) => right.messages[type]);
const { buffer } = Uint8Array.from(bytes);
const { records } = decoder.parseRecords(decoder.fit2json(buffer));
show('fit-decoder', (type) => records.filter((x) => x.type === type).map((x) => x.data));
CODE
node watch.mjs | tee said

cat > expected <<'SAID'
fit-file-parser
  milliseconds [0,10,20,30], g [0,0.5,1,1.5]
  metres per second: 1.2 1.2 1.2 1.2 1.2 1.2 1.2
  altitude 100, ascent 250
  seconds of the last three: 8 9 10
fit-decoder
  milliseconds 0, g 0
  metres per second: 2.0 0.0 2.0 2.0 0.0 2.0 0.0
  altitude 30, ascent 2.5
  seconds of the last three: none none none
SAID
diff expected said
echo 'As described: one sample of four, steps of two metres.'
