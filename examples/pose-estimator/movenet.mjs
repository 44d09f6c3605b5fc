// MoveNet Lightning (Google, Apache-2.0), a neural estimator of one person's 17 COCO keypoints, on the CPU without a
// browser. The weights are in the npm package @vladmandic/human.
import fs from 'node:fs';
import {fileURLToPath} from 'node:url';

import {setWasmPaths} from '@tensorflow/tfjs-backend-wasm';
import {loadGraphModel} from '@tensorflow/tfjs-converter';
import * as tf from '@tensorflow/tfjs-core';

const INPUT_SIZE = 192;
const LEAST_SCORE = 0.2;     // minimum score of a keypoint that helps to locate the person
const TRUNK_MARGIN = 1.9;    // half the crop's side ÷ the trunk's largest distance from the hips
const BODY_MARGIN = 1.2;     // half the crop's side ÷ the largest distance of any seen keypoint from the hips
const SMALLEST_CROP = 32;    // minimum side of the crop, pixels
const SHOULDERS = [5, 6], HIPS = [11, 12];

const folderOf = (name) => fileURLToPath(new URL(`node_modules/${name}`, import.meta.url));

/** A square of a picture: its top left corner and its side, pixels. */
const wholeOf = (picture) => {
  const side = Math.max(picture.width, picture.height);
  return {u: (picture.width - side) / 2, v: (picture.height - side) / 2, side};
};

/** Returns INPUT_SIZE × INPUT_SIZE × 3 numbers: each is the mean of the pixels that it covers, 0 outside the image. */
function resample(picture, square) {
  const values = new Int32Array(INPUT_SIZE * INPUT_SIZE * 3);
  const step = square.side / INPUT_SIZE, samples = Math.max(2, Math.ceil(step));
  for (let y = 0; y < INPUT_SIZE; ++y) {
    for (let x = 0; x < INPUT_SIZE; ++x) {
      const sum = [0, 0, 0];
      for (let j = 0; j < samples; ++j) {
        const v = Math.floor(square.v + (y + (j + 0.5) / samples) * step);
        if (v < 0 || v >= picture.height) continue;
        for (let i = 0; i < samples; ++i) {
          const u = Math.floor(square.u + (x + (i + 0.5) / samples) * step);
          if (u < 0 || u >= picture.width) continue;
          const at = 4 * (v * picture.width + u);
          for (let channel = 0; channel < 3; ++channel) sum[channel] += picture.data[at + channel];
        }
      }
      for (let channel = 0; channel < 3; ++channel) {
        values[3 * (y * INPUT_SIZE + x) + channel] = Math.round(sum[channel] / (samples * samples));
      }
    }
  }
  return values;
}

/**
 * Returns the square around a person whose trunk is seen, with the hips in its middle, as MoveNet's authors crop
 * ("determine_crop_region" of their tutorial); it also holds limbs that were not found. Returns the whole picture if no
 * shoulder or no hip is seen.
 */
function squareAround(keypoints, picture) {
  const isSeen = (i) => keypoints[i][2] >= LEAST_SCORE;
  if (!SHOULDERS.some(isSeen) || !HIPS.some(isSeen)) return wholeOf(picture);
  const middle = [0, 1].map((axis) => (keypoints[HIPS[0]][axis] + keypoints[HIPS[1]][axis]) / 2);
  const reach = (points) => Math.max(
      ...points.map((point) => Math.max(Math.abs(point[0] - middle[0]), Math.abs(point[1] - middle[1]))));
  const trunk = reach([...SHOULDERS, ...HIPS].map((i) => keypoints[i]));
  const body = reach(keypoints.filter((_, i) => isSeen(i)));
  const half = Math.max(SMALLEST_CROP / 2, TRUNK_MARGIN * trunk, BODY_MARGIN * body);
  if (2 * half > Math.max(picture.width, picture.height)) return wholeOf(picture);
  return {u: middle[0] - half, v: middle[1] - half, side: 2 * half};
}

export class MoveNet {
  static async load() {
    setWasmPaths(`${folderOf('@tensorflow/tfjs-backend-wasm')}/dist/`);
    await tf.setBackend('wasm');
    await tf.ready();
    const base = `${folderOf('@vladmandic/human')}/models/movenet-lightning`;
    const {modelTopology, weightsManifest} = JSON.parse(fs.readFileSync(`${base}.json`, 'utf8'));
    const weightData = new Uint8Array(fs.readFileSync(`${base}.bin`)).buffer;
    const weightSpecs = weightsManifest.flatMap((group) => group.weights);
    return new MoveNet(await loadGraphModel({load: async () => ({modelTopology, weightSpecs, weightData})}));
  }

  constructor(model) {
    this.model = model;
  }

  /**
   * Returns the 17 keypoints in COCO's order as [u, v, score]: pixels from the top left corner, and 0…1. They are found
   * in the whole picture, then once more in the square around the person; the result with the higher score is returned.
   * Pictures are independent of each other.
   * @param picture {width, height, data}, data four bytes a pixel (RGBA)
   */
  estimate(picture) {
    const rough = this.estimateWithin(picture, wholeOf(picture));
    const near = this.estimateWithin(picture, squareAround(rough, picture));
    const sureness = (keypoints) => keypoints.reduce((sum, [, , score]) => sum + score, 0);
    return sureness(near) >= sureness(rough) ? near : rough;
  }

  estimateWithin(picture, square) {
    const output = tf.tidy(() => {
      const input = tf.tensor4d(resample(picture, square), [1, INPUT_SIZE, INPUT_SIZE, 3], 'int32');
      return this.model.predict(input).dataSync();
    });
    const keypoints = [];
    for (let i = 0; i < output.length; i += 3) {
      keypoints.push([square.u + square.side * output[i + 1], square.v + square.side * output[i], output[i + 2]]);
    }
    return keypoints;
  }
}
