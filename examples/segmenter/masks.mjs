// node masks.mjs [--size SIZE] FILM… MASKS: MASKS/FILM/000000.png… for each film, as `etude capture --masks MASKS` reads
// them. SIZE of the network: lite, full (default) or heavy.
import fs from 'node:fs';
import path from 'node:path';
import {spawn, spawnSync} from 'node:child_process';
import {once} from 'node:events';
import {parseArgs} from 'node:util';

import {PNG} from 'pngjs';

import {Segmenter} from './segmenter.mjs';

/** Yields the pictures of a film, three bytes a pixel, as ffmpeg decodes them: every frame once, rotated upright. */
async function* picturesOf(film) {
  // ffmpeg tells the size after rotation: decode the first frame as a PNG.
  const first = spawnSync('ffmpeg', ['-v', 'error', '-i', film, '-frames:v', '1', '-f', 'image2pipe', '-c:v', 'png', '-'],
                          {maxBuffer: 1 << 28});
  if (first.status !== 0) throw new Error(`${film}: ${first.stderr ?? first.error}`);
  const {width, height} = PNG.sync.read(first.stdout);
  const size = 3 * width * height;
  const ffmpeg = spawn('ffmpeg', ['-v', 'error', '-i', film, '-map', '0:v:0', '-vsync', 'passthrough', '-f', 'rawvideo',
                                  '-pix_fmt', 'rgb24', '-'], {stdio: ['ignore', 'pipe', 'inherit']});
  const ended = once(ffmpeg, 'close');
  let waiting = [], bytes = 0;
  for await (const chunk of ffmpeg.stdout) {
    waiting.push(chunk);
    bytes += chunk.length;
    if (bytes < size) continue;
    let all = Buffer.concat(waiting);
    for (; all.length >= size; all = all.subarray(size)) {
      yield {width, height, channels: 3, data: all.subarray(0, size)};
    }
    waiting = [all];
    bytes = all.length;
  }
  const [status] = await ended;
  if (status !== 0) throw new Error(`${film}: ffmpeg ended with ${status} before the film did`);
}

const {values, positionals: films} = parseArgs({allowPositionals: true, options: {size: {type: 'string'}}});
const masks = films.pop();
if (films.length === 0) {
  console.error('usage: node masks.mjs [--size lite|full|heavy] FILM… MASKS');
  process.exit(2);
}
const segmenter = await Segmenter.load(values.size);
for (const film of films) {
  const folder = path.join(masks, path.parse(film).name);
  fs.mkdirSync(folder, {recursive: true});
  let frame = 0;
  for await (const picture of picturesOf(film)) {
    const {width, height} = picture;
    const png = new PNG({width, height, colorType: 0, inputColorType: 0, bitDepth: 8});
    png.data = Buffer.from(segmenter.mask(picture));
    const file = path.join(folder, `${String(frame++).padStart(6, '0')}.png`);
    fs.writeFileSync(file, PNG.sync.write(png, {colorType: 0, inputColorType: 0}));
  }
  console.log(`${folder}: ${frame} masks`);
}
