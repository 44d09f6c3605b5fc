// Finds one person's mask with BlazePose (Google, Apache-2.0), on the CPU without a browser. The weights are in the npm
// package @mediapipe/pose.
import fs from 'node:fs';
import {fileURLToPath} from 'node:url';

import {setWasmPaths} from '@tensorflow/tfjs-backend-wasm';
import * as tf from '@tensorflow/tfjs-core';

import {TfLite} from './tflite.mjs';

const SIDE = 256;                           // side of the network's input and of its mask, pixels
const LANDMARKS = 0, PRESENCE = 1, MASK = 2;  // indices of the network's outputs
const NUMBERS = 5;                          // numbers per landmark: u, v, depth, visibility, presence
// Landmarks: the middle of the hips, and a point on the circle around the body.
const MIDDLE = 33, RIM = 34;
const MARGIN = 1.25;                        // side of the crop ÷ diameter of that circle, as BlazePose's authors crop
const LEAST_PRESENCE = 0.5;

const folderOf = (name) => fileURLToPath(new URL(`node_modules/${name}`, import.meta.url));

/** A square of a picture: its middle and side in pixels, and the clockwise rotation of its "up", in radians. */
const wholeOf = ({width, height}) => ({u: width / 2, v: height / 2, side: Math.max(width, height), angle: 0});

/** Returns the steps in the picture, pixels, for one pixel to the right and one pixel down in the network's input. */
function stepsOf({side, angle}) {
  const step = side / SIDE, cos = step * Math.cos(angle), sin = step * Math.sin(angle);
  return {right: [cos, sin], down: [-sin, cos]};
}

/** Returns SIDE × SIDE × 3 numbers 0…1: each is the mean of the pixels that it covers, 0 outside the picture. */
function resample({width, height, data, channels}, square) {
  const {right, down} = stepsOf(square), samples = Math.max(1, Math.round(square.side / SIDE));
  const values = new Float32Array(SIDE * SIDE * 3), share = 1 / (255 * samples * samples);
  for (let y = 0; y < SIDE; ++y) {
    for (let x = 0; x < SIDE; ++x) {
      const at = 3 * (y * SIDE + x);
      for (let j = 0; j < samples * samples; ++j) {
        const dx = x + ((j % samples) + 0.5) / samples - SIDE / 2;
        const dy = y + (Math.floor(j / samples) + 0.5) / samples - SIDE / 2;
        const u = Math.floor(square.u + dx * right[0] + dy * down[0]);
        const v = Math.floor(square.v + dx * right[1] + dy * down[1]);
        if (u < 0 || u >= width || v < 0 || v >= height) continue;
        for (let c = 0; c < 3; ++c) values[at + c] += share * data[channels * (v * width + u) + c];
      }
    }
  }
  return values;
}

/** Returns the probability of the person at each pixel of the picture, 0…255, from the network's logits in a square. */
function spread(logits, square, {width, height}) {
  const {right, down} = stepsOf(square), scale = (SIDE / square.side) ** 2;
  const mask = new Uint8Array(width * height), last = SIDE - 1;
  for (let v = 0; v < height; ++v) {
    for (let u = 0; u < width; ++u) {
      const du = scale * (u + 0.5 - square.u), dv = scale * (v + 0.5 - square.v);
      const x = du * right[0] + dv * right[1] + SIDE / 2 - 0.5, y = du * down[0] + dv * down[1] + SIDE / 2 - 0.5;
      if (x < 0 || y < 0 || x > last || y > last) continue;
      const left = Math.min(Math.floor(x), last - 1), top = Math.min(Math.floor(y), last - 1);
      const at = top * SIDE + left, fx = x - left, fy = y - top;
      const above = logits[at] * (1 - fx) + logits[at + 1] * fx;
      const below = logits[at + SIDE] * (1 - fx) + logits[at + SIDE + 1] * fx;
      mask[v * width + u] = Math.round(255 / (1 + Math.exp(-(above * (1 - fy) + below * fy))));
    }
  }
  return mask;
}

export class Segmenter {
  /** @param size lite, full or heavy */
  static async load(size = 'full') {
    setWasmPaths(`${folderOf('@tensorflow/tfjs-backend-wasm')}/dist/`);
    await tf.setBackend('wasm');
    await tf.ready();
    return new Segmenter(new TfLite(fs.readFileSync(`${folderOf('@mediapipe/pose')}/pose_landmark_${size}.tflite`)));
  }

  constructor(network) {
    this.network = network;
  }

  /**
   * Returns the mask of the person in one picture: found first in the whole picture, then twice more in the square
   * around the body. The mask has one byte a pixel, 0…255; all are 0 if there is no person. Pictures are independent.
   * @param picture {width, height, data, channels}
   */
  mask(picture) {
    let square = wholeOf(picture), found;
    for (let round = 0; round < 3; ++round) {
      if (round > 0) square = found.around;
      found = this.look(picture, square);
      if (!(found.presence >= LEAST_PRESENCE)) return new Uint8Array(picture.width * picture.height);
    }
    return spread(found.logits, square, picture);
  }

  look(picture, square) {
    const [landmarks, presence, logits] = tf.tidy(() => {
      const input = tf.tensor4d(resample(picture, square), [1, SIDE, SIDE, 3]);
      return this.network.run(input, [LANDMARKS, PRESENCE, MASK]).map((output) => output.dataSync().slice());
    });
    const {right, down} = stepsOf(square);
    const [middle, rim] = [MIDDLE, RIM].map((i) => {
      const x = landmarks[NUMBERS * i] - SIDE / 2, y = landmarks[NUMBERS * i + 1] - SIDE / 2;
      return [square.u + x * right[0] + y * down[0], square.v + x * right[1] + y * down[1]];
    });
    const du = rim[0] - middle[0], dv = rim[1] - middle[1];
    const around = {u: middle[0], v: middle[1], side: 2 * MARGIN * Math.hypot(du, dv), angle: Math.atan2(du, -dv)};
    return {presence: presence[0], logits, around};
  }
}
