// node estimate.mjs [--coco] PICTURE.png… > keypoints.json
// COCO's 17 keypoints of one person in every picture: {"PICTURE.png": [[u, v, score], …], …}; with --coco as a COCO
// keypoint file of these pictures in their order, which `etude capture --keypoints` reads.
import fs from 'node:fs';
import path from 'node:path';

import {PNG} from 'pngjs';

import {MoveNet} from './movenet.mjs';

const CENTRE = 0.5;  // MoveNet counts pixels from the first pixel's corner, COCO from its centre

const isCoco = process.argv[2] === '--coco';
const pictures = process.argv.slice(isCoco ? 3 : 2);
if (pictures.length === 0) {
  console.error('usage: node estimate.mjs [--coco] PICTURE.png… > keypoints.json');
  process.exit(2);
}
const movenet = await MoveNet.load();
const found = {}, images = [], annotations = [];
for (const [id, file] of pictures.entries()) {
  const picture = PNG.sync.read(fs.readFileSync(file));
  const keypoints = movenet.estimate(picture);
  found[path.basename(file)] = keypoints;
  images.push({id, file_name: path.basename(file), width: picture.width, height: picture.height});
  const triples = keypoints.flatMap(([u, v, score]) => [u - CENTRE, v - CENTRE, score]);
  annotations.push({id, image_id: id, category_id: 1, keypoints: triples});
}
console.log(JSON.stringify(isCoco ? {images, annotations} : found));
