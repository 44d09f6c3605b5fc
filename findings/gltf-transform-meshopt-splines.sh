#!/usr/bin/env bash
# glTF Transform 4.5.1's meshopt(), by default, turns the tangents of rotation splines into unit quaternions: the motion changes.
#
# The output of a CUBICSPLINE sampler holds an in-tangent, a value and an out-tangent for each key (glTF 2.0, appendix C). meshopt() of level
# "high", the default, sends the whole output through EXT_meshopt_compression's quaternion filter (its appendix B), which keeps only unit
# quaternions, without their sign. A zero tangent becomes (1, 0, 0, 0), and a turn of 90 degrees that eases in and out is at 24 degrees after
# a quarter of its time instead of 13. There is no warning. Level "medium" and LINEAR samplers keep their motion.
#
# Needs: npm and node (18 or later). Downloads 2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts @gltf-transform/{core,extensions,functions}@4.5.1 meshoptimizer@1.3.0 \
  gltf-validator@2.0.0-dev.3.10 > /dev/null
cat > pack.mjs <<'CODE'
import { Document, NodeIO, VERSION } from '@gltf-transform/core';
import { EXTMeshoptCompression } from '@gltf-transform/extensions';
import { meshopt } from '@gltf-transform/functions';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';
import validator from 'gltf-validator';

await MeshoptEncoder.ready;
await MeshoptDecoder.ready;
const io = new NodeIO().registerExtensions([EXTMeshoptCompression])
  .registerDependencies({ 'meshopt.encoder': MeshoptEncoder, 'meshopt.decoder': MeshoptDecoder });

const half = Math.SQRT1_2, zero = [0, 0, 0, 0];
const outputs = { LINEAR: [[0, 0, 0, 1], [half, 0, 0, half]],
                  CUBICSPLINE: [zero, [0, 0, 0, 1], zero, zero, [half, 0, 0, half], zero] };

function turn(interpolation) {  // a joint that turns by 90 degrees about X within a second
  const document = new Document();
  const buffer = document.createBuffer();
  const accessor = (type, values) => document.createAccessor().setType(type).setArray(new Float32Array(values)).setBuffer(buffer);
  const joint = document.createNode('joint');
  document.createScene().addChild(joint);
  const sampler = document.createAnimationSampler().setInput(accessor('SCALAR', [0, 1]))
    .setOutput(accessor('VEC4', outputs[interpolation].flat())).setInterpolation(interpolation);
  const channel = document.createAnimationChannel().setTargetNode(joint).setTargetPath('rotation').setSampler(sampler);
  document.createAnimation('turn').addSampler(sampler).addChannel(channel);
  return document;
}

function quarter(document) {  // the angle at 0.25 s, from the spline that the document holds
  const sampler = document.getRoot().listAnimations()[0].listSamplers()[0];
  const get = (index) => sampler.getOutput().getElement(index, []);
  if (sampler.getInterpolation() === 'LINEAR') return `last key ${get(1).map((x) => x.toFixed(2))}`;
  const q = get(1).map((a, i) => 0.84375 * a + 0.140625 * get(2)[i] + 0.15625 * get(4)[i] - 0.046875 * get(3)[i]);
  const degrees = 2 * Math.atan2(q[0], q[3]) * 180 / Math.PI;
  return `first key's out-tangent ${get(2).map((x) => x.toFixed(2))}; ${degrees.toFixed(1)} degrees at 0.25 s`;
}

console.log(`glTF Transform ${VERSION}`);
for (const [interpolation, options] of [['LINEAR', {}], ['CUBICSPLINE', { level: 'medium' }], ['CUBICSPLINE', {}]]) {
  const document = turn(interpolation);
  const report = await validator.validateBytes(await io.writeBinary(document));
  const before = quarter(document);
  const quiet = () => {};
  document.setLogger({ debug: quiet, info: quiet, warn: quiet, error: console.error });
  await document.transform(meshopt({ encoder: MeshoptEncoder, ...options }));
  const after = quarter(await io.readBinary(await io.writeBinary(document)));
  console.log(`${interpolation}, ${options.level ?? 'default level'}; errors of the input: ${report.issues.numErrors}`);
  console.log(`  before: ${before}\n  after:  ${after}`);
}
CODE
node pack.mjs | tee said

cat > expected <<'SAID'
glTF Transform v4.5.1
LINEAR, default level; errors of the input: 0
  before: last key 0.71,0.00,0.00,0.71
  after:  last key 0.71,0.00,0.00,0.71
CUBICSPLINE, medium; errors of the input: 0
  before: first key's out-tangent 0.00,0.00,0.00,0.00; 13.2 degrees at 0.25 s
  after:  first key's out-tangent 0.00,0.00,0.00,0.00; 13.2 degrees at 0.25 s
CUBICSPLINE, default level; errors of the input: 0
  before: first key's out-tangent 0.00,0.00,0.00,0.00; 13.2 degrees at 0.25 s
  after:  first key's out-tangent 1.00,0.00,0.00,0.00; 24.2 degrees at 0.25 s
SAID
diff expected said
echo 'As described: the default level changes the splines.'
