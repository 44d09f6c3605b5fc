#!/usr/bin/env bash
# johnny-five 2.1.0 takes every gyroscope for one of 100 readings a second: at the default interval of 19 ms, a turn of
# 90 degrees is one of 48.
#
# Gyro's pitch, roll and yaw have a rate in degrees a second and an angle. Each reading adds a hundredth of the rate to
# the angle, whatever the time since the last reading. Boards send a reading every 19 ms by default (firmata-io, which
# johnny-five uses), and samplingInterval() sets another interval; Gyro neither asks for it nor looks at a clock. At 10
# ms the angle is right, at 5 ms twice as large. The rate is always right. The README names no interval; an example to
# which it links adds up angles of its own, for 10 ms. Below, a simulated board with an MPU6050 is calibrated and then
# turns by 90 degrees in 2 s.
#
# Needs: npm and node (18 or later). Downloads 2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts johnny-five@2.1.0 > /dev/null
cat > turn.cjs <<'CODE'
const { EventEmitter } = require('node:events');
const { Board, Gyro } = require('johnny-five');

// A board that only knows time: it hands the sensor's 14 bytes to the library at the interval that is set.
class Simulated extends EventEmitter {
  constructor() {
    super();
    Object.assign(this, { name: 'simulated', isReady: true, interval: 19, HIGH: 1, LOW: 0, analogPins: [],
      MODES: { INPUT: 0, OUTPUT: 1, ANALOG: 2, PWM: 3, SERVO: 4 }, pins: [{ supportedModes: [], mode: 0, value: 0 }] });
    setImmediate(() => { this.emit('connect'); this.emit('ready'); });
  }
  setSamplingInterval(milliseconds) { this.interval = milliseconds; }
  i2cConfig() {}
  i2cWrite() {}
  i2cRead(address, register, length, handler) { this.handler = handler; }
  turn(rate, seconds) {  // about x; the sensor counts 131 a degree a second
    const count = Math.round(131 * rate) & 0xffff;
    for (let t = 0; t < 1000 * seconds; t += this.interval)
      this.handler([0, 0, 0, 0, 0x40, 0, 0, 0, count >> 8, count & 0xff, 0, 0, 0, 0]);
  }
}

const io = new Simulated(), board = new Board({ io, repl: false, debug: false });
board.on('ready', () => {
  const gyro = new Gyro({ controller: 'MPU6050' });
  io.turn(0, 3);  // still, for the calibration
  for (const interval of [19, 10, 5, 50]) {
    board.samplingInterval(interval);
    const before = gyro.roll.angle;
    io.turn(45, 2);
    const { rate } = gyro.roll;
    io.turn(0, 1);
    const angle = (gyro.roll.angle - before).toFixed(1);
    console.log(`a reading every ${interval} ms: rate ${rate} for 45, angle ${angle} for 90`);
  }
  process.exit();
});
CODE
node turn.cjs | tee said

cat > expected <<'SAID'
a reading every 19 ms: rate 45 for 45, angle 47.7 for 90
a reading every 10 ms: rate 45 for 45, angle 90.0 for 90
a reading every 5 ms: rate 45 for 45, angle 180.0 for 90
a reading every 50 ms: rate 45 for 45, angle 18.0 for 90
SAID
diff expected said
echo 'As described: the angle depends on the interval.'
