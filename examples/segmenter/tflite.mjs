// Runs a TensorFlow Lite model with TensorFlow.js: it executes the file's operators one after the other. It knows only
// the operators of BlazePose; it refuses any other by its number (BuiltinOperator in TensorFlow's schema.fbs; the field
// numbers below are from the same file).
import * as tf from '@tensorflow/tfjs-core';

/** Reads a FlatBuffer's tables: `at(table, i)` is the position of the i-th field, 0 if it is absent. */
class Tables {
  constructor(bytes) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }
  u32(at) { return this.view.getUint32(at, true); }
  i32(at) { return this.view.getInt32(at, true); }
  ref(at) { return at + this.u32(at); }
  at(table, i) {
    const fields = table - this.i32(table), slot = 4 + 2 * i;
    const offset = slot < this.view.getUint16(fields, true) ? this.view.getUint16(fields + slot, true) : 0;
    return offset && table + offset;
  }
  byte(table, i) { const at = this.at(table, i); return at ? this.view.getUint8(at) : 0; }
  int(table, i, otherwise = 0) { const at = this.at(table, i); return at ? this.i32(at) : otherwise; }
  places(table, i) {
    const at = this.at(table, i);
    if (!at) return [];
    const list = this.ref(at);
    return Array.from({length: this.u32(list)}, (_, k) => list + 4 + 4 * k);
  }
  ints(table, i) { return this.places(table, i).map((at) => this.i32(at)); }
  tables(table, i) { return this.places(table, i).map((at) => this.ref(at)); }
  bytes(table, i) {
    const at = this.at(table, i);
    if (!at) return new Uint8Array();
    const list = this.ref(at);
    return new Uint8Array(this.view.buffer, this.view.byteOffset + list + 4, this.u32(list));
  }
}

function floatOfHalf(half) {
  const sign = half & 0x8000 ? -1 : 1, exponent = (half >> 10) & 31, fraction = half & 1023;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

const READERS = {
  0: (bytes) => new Float32Array(bytes.slice().buffer),
  1: (bytes) => Float32Array.from(new Uint16Array(bytes.slice().buffer), floatOfHalf),
  2: (bytes) => new Int32Array(bytes.slice().buffer),
};
const PADDINGS = ['same', 'valid'];
const ACTIVATIONS = {0: (x) => x, 1: tf.relu, 3: tf.relu6};

/** For every operator, a function (tables, options, inputs, shape of the output) => output. */
const OPERATORS = {
  0: (t, o, [a, b]) => ACTIVATIONS[t.byte(o, 0)](tf.add(a, b)),
  3: (t, o, [x, weights, bias]) => {
    const filter = tf.transpose(weights, [1, 2, 3, 0]), strides = [t.int(o, 2), t.int(o, 1)];
    return ACTIVATIONS[t.byte(o, 3)](tf.add(tf.conv2d(x, filter, strides, PADDINGS[t.byte(o, 0)]), bias));
  },
  4: (t, o, [x, weights, bias]) => {
    const filter = tf.transpose(weights, [1, 2, 3, 0]), strides = [t.int(o, 2), t.int(o, 1)];
    return ACTIVATIONS[t.byte(o, 4)](tf.add(tf.depthwiseConv2d(x, filter, strides, PADDINGS[t.byte(o, 0)]), bias));
  },
  6: (t, o, [x]) => x,
  14: (t, o, [x]) => tf.sigmoid(x),
  17: (t, o, [x]) => tf.maxPool(x, [t.int(o, 4), t.int(o, 3)], [t.int(o, 2), t.int(o, 1)], PADDINGS[t.byte(o, 0)]),
  22: (t, o, [x], shape) => tf.reshape(x, shape),
  23: (t, o, [x], shape) => tf.image.resizeBilinear(x, [shape[1], shape[2]], !!t.byte(o, 2), !!t.byte(o, 3)),
  34: (t, o, [x, pads]) => { const p = pads.dataSync(); return tf.pad(x, x.shape.map((_, i) => [p[2 * i], p[2 * i + 1]])); },
};

export class TfLite {
  /** @param bytes a .tflite file */
  constructor(bytes) {
    const t = this.t = new Tables(bytes), model = t.ref(0);
    const codes = t.tables(model, 1).map((code) => Math.max(t.byte(code, 0), t.int(code, 3)));
    const buffers = t.tables(model, 4), graph = t.tables(model, 2)[0];
    const tensors = t.tables(graph, 0);
    this.shapes = tensors.map((tensor) => t.ints(tensor, 0));
    this.constants = tensors.map((tensor, i) => {
      const data = t.bytes(buffers[t.int(tensor, 2)], 0), type = t.byte(tensor, 1);
      return data.length === 0 ? undefined : tf.tensor(READERS[type](data), this.shapes[i], type === 2 ? 'int32' : 'float32');
    });
    this.input = t.ints(graph, 1)[0];
    this.outputs = t.ints(graph, 2);
    this.operators = t.tables(graph, 3).map((operator) => ({
      code: codes[t.int(operator, 0)], inputs: t.ints(operator, 1), output: t.ints(operator, 2)[0],
      options: t.at(operator, 4) ? t.ref(t.at(operator, 4)) : undefined,
    }));
    const unknown = this.operators.find(({code}) => !(code in OPERATORS));
    if (unknown) throw new Error(`operator ${unknown.code} of TensorFlow Lite is not known`);
  }

  /** Returns the outputs `wanted` (indices into the model's list) for an input tensor. Call within tf.tidy. */
  run(input, wanted) {
    const values = this.constants.slice();
    values[this.input] = input;
    for (const {code, inputs, output, options} of this.operators) {
      values[output] = OPERATORS[code](this.t, options, inputs.filter((i) => i >= 0).map((i) => values[i]), this.shapes[output]);
    }
    return wanted.map((i) => values[this.outputs[i]]);
  }
}
