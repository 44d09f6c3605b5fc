// The segmenter as a seat of an outside method in a run (docs/outside-methods.md):
//   - {name: blazepose, recovery: silhouettes, seat: segmenter, exec: [node, examples/segmenter/method.mjs], time_s: 60}
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';

import {Segmenter} from './segmenter.mjs';

const PROTOCOL = 1;
const say = (message) => process.stdout.write(JSON.stringify(message) + '\n');

function readPpm(file) {
  const bytes = fs.readFileSync(file);
  const [head, width, height] = /^P6\s+(\d+)\s+(\d+)\s+\d+\s/.exec(bytes.subarray(0, 64).toString('latin1'));
  return {width: Number(width), height: Number(height), channels: 3, data: bytes.subarray(head.length)};
}

/** Returns COCO's uncompressed run lengths, down the columns, background first. */
function runsOf(mask, {width, height}) {
  const counts = [];
  let value = false, run = 0;
  for (let u = 0; u < width; ++u) {
    for (let v = 0; v < height; ++v) {
      if ((mask[v * width + u] >= 128) !== value) {
        counts.push(run);
        value = !value;
        run = 0;
      }
      ++run;
    }
  }
  return {size: [height, width], counts: [...counts, run]};
}

const segmenter = await Segmenter.load();
for await (const line of readline.createInterface({input: process.stdin})) {
  const message = JSON.parse(line);
  if (message.type === 'hello') {
    say({type: 'hello', protocol: PROTOCOL, name: 'blazepose-full', version: '1.0'});
  } else if (message.type === 'setting' || message.type === 'begin') {
    say({type: 'ready'});
  } else if (message.type === 'step') {
    const picture = readPpm(path.join(message.files, message.step.picture));
    say({type: 'answer', id: message.id, number: message.number, answer: {mask: runsOf(segmenter.mask(picture), picture)}});
  }
}
