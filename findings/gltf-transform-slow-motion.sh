#!/usr/bin/env bash
# glTF Transform 4.5.1's resample(), which removes keys "losslessly", removes a slow motion whole: the sway of a person
# who stands is gone.
#
# Its documentation says that it deduplicates keyframes without loss; the command line's optimize runs it by default.
# Its method, that of keyframe-resample 0.1.0, drops a key that is within 0.0001 of the line from the last kept key to
# the next key, and never looks at the dropped keys again. The next key is near, so this line passes near the key even
# if the motion curves. A coordinate that moves by less than 0.0001 from key to key keeps its first and its last key
# only: 12 mm/s in a file of 120 keys a second in metres, or 1.4 degrees/s. More keys a second make it worse. A
# tolerance of 0 keeps the motion.
#
# Needs: npm and node (18 or later). Downloads 2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @gltf-transform/{core,functions}@4.5.1 keyframe-resample@0.1.0 > /dev/null
cat > sway.mjs <<'CODE'
import { Document, VERSION } from '@gltf-transform/core';
import { resample } from '@gltf-transform/functions';
import { ready, resample as compiled } from 'keyframe-resample';

const seconds = 60, frequency = 0.1;  // a body sways once in 10 s, by 10 mm and 1 degree to each side

async function sway(path, rate, options) {
  const times = Array.from({ length: seconds * rate + 1 }, (_, i) => i / rate);
  const value = (time) => {
    const phase = Math.sin(2 * Math.PI * frequency * time);
    if (path === 'translation') return [0.01 * phase, 1, 0];
    const half = phase * Math.PI / 360;
    return [Math.sin(half), 0, 0, Math.cos(half)];
  };
  const document = new Document();
  const buffer = document.createBuffer();
  const accessor = (type, values) => document.createAccessor().setType(type).setArray(new Float32Array(values)).setBuffer(buffer);
  const body = document.createNode('body');
  document.createScene().addChild(body);
  const sampler = document.createAnimationSampler().setInterpolation('LINEAR').setInput(accessor('SCALAR', times))
    .setOutput(accessor(path === 'rotation' ? 'VEC4' : 'VEC3', times.flatMap(value)));
  document.createAnimation('stand').addSampler(sampler)
    .addChannel(document.createAnimationChannel().setTargetNode(body).setTargetPath(path).setSampler(sampler));

  await document.transform(resample(options));

  const kept = sampler.getInput().getArray(), get = (key) => sampler.getOutput().getElement(key, [])[0];
  let worst = 0, key = 0;
  for (const time of times) {  // between two keys, x of a quaternion of a small turn is linear, too
    while (key < kept.length - 2 && kept[key + 1] < time) ++key;
    const part = (time - kept[key]) / (kept[key + 1] - kept[key]);
    worst = Math.max(worst, Math.abs((1 - part) * get(key) + part * get(key + 1) - value(time)[0]));
  }
  const error = path === 'translation' ? `${(1000 * worst).toFixed(1)} mm` : `${(2 * Math.asin(worst) * 180 / Math.PI).toFixed(2)} degrees`;
  const count = kept.length === times.length ? 'all' : kept.length === 2 ? 'the first and the last' : 'some';
  console.log(`${path}, ${rate} keys a second: ${count} kept, wrong by up to ${error}`);
}

console.log(`glTF Transform ${VERSION}`);
for (const path of ['translation', 'rotation']) {
  for (const rate of [30, 120]) await sway(path, rate, {});
}
console.log('with the compiled resample of keyframe-resample:');
await sway('translation', 120, { ready, resample: compiled });
console.log('with tolerance 0:');
await sway('translation', 120, { tolerance: 0 });
CODE
node sway.mjs | tee said

cat > expected <<'SAID'
glTF Transform v4.5.1
translation, 30 keys a second: some kept, wrong by up to 1.5 mm
translation, 120 keys a second: the first and the last kept, wrong by up to 10.0 mm
rotation, 30 keys a second: some kept, wrong by up to 0.30 degrees
rotation, 120 keys a second: the first and the last kept, wrong by up to 1.00 degrees
with the compiled resample of keyframe-resample:
translation, 120 keys a second: the first and the last kept, wrong by up to 10.0 mm
with tolerance 0:
translation, 120 keys a second: all kept, wrong by up to 0.0 mm
SAID
diff expected said
echo 'As described: the sway is gone.'
