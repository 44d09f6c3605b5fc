// node estimate.mjs PICTURE.png… > keypoints.json
// COCO's 17 keypoints of one person in every picture: {"PICTURE.png": [[u, v, score], …], …}
import fs from 'node:fs';
import path from 'node:path';

import {PNG} from 'pngjs';

import {MoveNet} from './movenet.mjs';

const pictures = process.argv.slice(2);
if (pictures.length === 0) {
  console.error('usage: node estimate.mjs PICTURE.png… > keypoints.json');
  process.exit(2);
}
const movenet = await MoveNet.load();
const found = {};
for (const file of pictures) {
  found[path.basename(file)] = movenet.estimate(PNG.sync.read(fs.readFileSync(file)));
}
console.log(JSON.stringify(found));
