// Where three.js's loader puts every node of an FBX file, in its unit and axes: JSON {name: [[x, y, z], …]}.
//   node three_fbx.mjs FOLDER_OF_THREE FILE RATE FRAMES
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, file, rate, frames] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(path.join(folder, name)).href);
// Textures and cameras want a page; nothing here looks at them.
globalThis.window = globalThis;
globalThis.document = { createElementNS: () => ({ addEventListener() {}, removeEventListener() {} }) };
console.warn = () => {};
const THREE = await load('build/three.module.js');
const { FBXLoader } = await load('examples/jsm/loaders/FBXLoader.js');
const bytes = fs.readFileSync(file);
const scene = new FBXLoader().parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
const mixer = new THREE.AnimationMixer(scene);
mixer.clipAction(scene.animations[0]).play();
const places = {};
for (let frame = 0; frame < Number(frames); ++frame) {
  mixer.setTime(Math.min(frame / Number(rate), scene.animations[0].duration * (1 - 1e-9)));  // its end is its beginning again
  scene.updateMatrixWorld(true);
  scene.traverse((node) => (places[node.name] ??= []).push(new THREE.Vector3().setFromMatrixPosition(node.matrixWorld).toArray()));
}
console.log(JSON.stringify(places));
