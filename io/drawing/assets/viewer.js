// Shows recorded motions: bodies, errors by colour, marks on a time bar (reports/viewer). A button whose data-cell is a
// recorded cell opens this cell. The card that report.js opens for a clicked dot or table row also gets a button (event
// etude:cells).
const JOINTS = ['hip centre', 'spine', 'shoulder centre', 'head', ...['shoulder elbow wrist hand', 'hip knee ankle foot'].flatMap((limb) =>
  ['left', 'right'].flatMap((side) => limb.split(' ').map((joint) => `${side} ${joint}`)))];
const PARENT = [-1, 0, 1, 2, 2, 4, 5, 6, 2, 8, 9, 10, 0, 12, 13, 14, 0, 16, 17, 18];
const ARM = [.052, .042, .034, .026], LEG = [.075, .054, .04, .03], RADIUS = [.085, .085, .055, .05, ...ARM, ...ARM, ...LEG, ...LEG];
const HEAD = 3, HEAD_RADIUS = .1, THIN = .022;
// The skeleton of a body: the twenty joints, or the body's own joints, which are drawn as thin lines.
const BODY = {joints: JOINTS, parents: PARENT};
const treeOf = (body) => body.joints ? {joints: body.joints.map((name) => name.replaceAll('_', ' ')), parents: body.parents} : BODY;
// The colour scale runs from blue over pale yellow to red: readers who confuse green and red can also read this scale.
const SCALE = [[45, 100, 180], [125, 180, 220], [248, 232, 175], [236, 140, 72], [178, 28, 40]];

const island = document.getElementById('motions');
let files = null;  // cell → file; read at the first use
const fileOf = (cell) => {
  if (!files) {
    files = new Map();
    for (const [file, cells] of Object.entries(JSON.parse(island.textContent))) {
      for (const id of cells) files.set(id, file);
    }
  }
  return files.get(cell);
};

// ---- Prepare the data of the script beside the page.
const worlds = {};
const prepare = (world) => {
  const scale = world.unit === 'mm' ? 1000 : 100;
  const everyError = [];
  world.frames = 1;
  for (const body of world.bodies) {
    const bytes = Uint8Array.from(atob(body.data), (c) => c.charCodeAt(0)), view = new DataView(bytes.buffer);
    body.tree = treeOf(body);
    body.count = body.tree.joints.length;
    body.stored = bytes.length / 6 / body.count;
    body.places = new Float32Array(body.stored * 3 * body.count);
    for (let i = 0; i < body.places.length; ++i) {
      const steps = view.getUint16(2 * i, true);
      body.places[i] = steps === 65535 ? NaN : body.low_m[i % 3] + body.step_m * steps;  // NaN: the point was not seen
    }
    world.frames = Math.max(world.frames, body.begin + body.frames);
  }
  for (const body of world.bodies) {
    if (!body.against.length) continue;
    // Errors are NaN, never 0, where there is no reference to compare with.
    body.errors = new Float32Array(body.frames * body.count).fill(NaN);
    for (let f = 0; f < body.frames; ++f) {
      const t = f + body.begin;
      const other = body.against.map((i) => world.bodies[i]).filter((b) => isThere(b, t)).pop();
      if (!other) continue;
      const a = place(body, t), b = place(other, t);
      for (let j = 0; j < body.count; ++j) {
        const e = scale * Math.hypot(a[3 * j] - b[3 * j], a[3 * j + 1] - b[3 * j + 1], a[3 * j + 2] - b[3 * j + 2]);
        body.errors[f * body.count + j] = e;
        if (e >= 0) everyError.push(e);
      }
    }
  }
  // The colour scale ends at the 90th percentile of errors that exceed 1/50 of the largest error, rounded up to 1, 2, 3, 5 or 10
  // times a power of ten.
  const greatest = everyError.reduce((a, b) => Math.max(a, b), 0), seen = everyError.filter((e) => e > greatest / 50).sort((a, b) => a - b);
  const high = seen[Math.floor(.9 * (seen.length - 1))] || 1, power = 10 ** Math.floor(Math.log10(high));
  world.most = [1, 2, 3, 5, 10].find((n) => n * power >= high * .999) * power;
  return world;
};
const isThere = (body, t) => t > body.begin - 1e-6 && t < body.begin + body.frames - 1 + 1e-6;
// Returns the joints at frame t, interpolated linearly.
const place = (body, t, steps = false, out = new Float32Array(3 * body.count)) => {
  const at = Math.min(Math.max(t - body.begin, 0), body.stored - 1), f = Math.floor(at + 1e-6);
  const part = steps ? 0 : at - f, p = body.places, from = f * out.length, to = Math.min(f + 1, body.stored - 1) * out.length;
  for (let i = 0; i < out.length; ++i) out[i] = part ? p[from + i] + part * (p[to + i] - p[from + i]) : p[from + i];
  return out;
};
const errorsAt = (body, t) => {
  if (!body.errors || !isThere(body, t)) return null;
  const f = Math.min(Math.max(Math.round(t - body.begin), 0), body.frames - 1);
  return body.errors.subarray(f * body.count, (f + 1) * body.count);
};
const load = (file) => new Promise((resolve, reject) => {
  if (worlds[file]) return resolve(worlds[file]);
  window.etudeMotion = (world) => { worlds[world.file] = prepare(world); };
  const script = document.createElement('script');
  script.src = file;
  script.onload = () => { worlds[file] ? resolve(worlds[file]) : reject(file); };
  script.onerror = () => reject(file);
  document.head.append(script);
});

// ---- Vectors.
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const l = Math.hypot(...a) || 1; return a.map((x) => x / l); };
const jointOf = (places, j) => [places[3 * j], places[3 * j + 1], places[3 * j + 2]];

// ---- Draw. A scene is {items: [{places, colours, ghost, tree}], spots: [{at, radius, colour, squash}], floor, page,
// line}.
const cameraOf = (view, width, height) => {
  const {yaw, pitch, distance, target} = view, c = Math.cos(pitch);
  const eye = [target[0] + distance * c * Math.sin(yaw), target[1] + distance * Math.sin(pitch), target[2] + distance * c * Math.cos(yaw)];
  const z = unit(sub(eye, target)), x = unit(cross([0, 1, 0], z)), y = cross(z, x), focus = 2.2, aspect = width / height;
  const near = .05, far = 200, k = aspect < 1 ? aspect : 1, fx = focus * k / aspect, fy = focus * k;
  const a = (far + near) / (near - far), b = 2 * far * near / (near - far);
  const matrix = new Float32Array([
    fx * x[0], fy * y[0], a * z[0], -z[0], fx * x[1], fy * y[1], a * z[1], -z[1], fx * x[2], fy * y[2], a * z[2], -z[2],
    -fx * dot(x, eye), -fy * dot(y, eye), -a * dot(z, eye) + b, dot(z, eye)]);
  const project = (p) => {
    const m = matrix, w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
    return [(.5 + .5 * (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12]) / w) * width,
      (.5 - .5 * (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13]) / w) * height, w];
  };
  return {eye, matrix, project, focus: fy * height / 2};
};
// Returns sixteen numbers per limb: start, radius, end, radius, start's colour, opacity, end's colour,
// flatness.
const limbsOf = (scene, ghosts) => [...scene.items.filter((item) => item.ghost === ghosts).flatMap(({places: p, colours: c, tree}) => tree !== BODY ?
  tree.parents.map((parent, j) => {
    const from = parent < 0 ? j : parent;
    return [...jointOf(p, from), THIN, ...jointOf(p, j), THIN, ...jointOf(c, from), ghosts ? .3 : 1, ...jointOf(c, j), 1];
  }).filter((limb) => limb.every((x) => x === x)) : PARENT.map((parent, j) => {
  const from = j ? parent : HEAD, to = j || HEAD, wide = ghosts ? 1.14 : 1, ends = j === HEAD ? [RADIUS[HEAD], RADIUS[HEAD]] : j ? [RADIUS[from], RADIUS[to]] : [HEAD_RADIUS, HEAD_RADIUS];
  return [...jointOf(p, from), wide * ends[0], ...jointOf(p, to), wide * ends[1], ...jointOf(c, from), ghosts ? .1 : 1, ...jointOf(c, to), 1];
})), ...ghosts ? [] : scene.spots.map(({at, radius, colour, squash}) => [...at, radius, ...at, radius, ...colour, 1, ...colour, squash])];
const glRenderer = (canvas, onLost) => {
  // Ask for antialiasing only if the browser draws with a graphics card.
  const options = {stencil: true, alpha: false};
  const gl = canvas.getContext('webgl2', {...options, antialias: true, failIfMajorPerformanceCaveat: true}) ??
      canvas.getContext('webgl2', {...options, antialias: false});
  if (!gl) return null;
  canvas.addEventListener('webglcontextlost', (event) => { event.preventDefault(); onLost(); });
  const build = (vertex, fragment) => {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, '#version 300 es\nprecision highp float;\n' + text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
    const at = {};
    for (let i = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) - 1; i >= 0; --i) {
      const {name} = gl.getActiveUniform(program, i);
      at[name] = gl.getUniformLocation(program, name);
    }
    return {program, at};
  };
  // Draws a capsule from a to b with radii a.w and b.w; the capsule's shadow is projected on the floor along the light.
  const limbs = build(`layout(location=0) in vec4 v; layout(location=1) in vec4 a; layout(location=2) in vec4 b;
    layout(location=3) in vec4 ca; layout(location=4) in vec4 cb;
    uniform mat4 m; uniform float ground; uniform bool isShadow; out vec3 n; out vec3 w; out vec4 c;
    void main() {
      vec3 d = b.xyz - a.xyz; float l = length(d); vec3 y = l > 1e-5 ? d / l : vec3(0, 1, 0);
      vec3 x = normalize(cross(y, abs(y.y) < .9 ? vec3(0, 1, 0) : vec3(1, 0, 0))), z = cross(x, y);
      n = v.x * x + v.y * y + v.z * z;
      w = mix(a.xyz, b.xyz, v.w) + n * mix(a.w, b.w, v.w) * vec3(1, cb.w, 1);
      c = vec4(mix(ca.rgb, cb.rgb, v.w), ca.a);
      if (isShadow) { w -= vec3(.25, 1, .15) * (w.y - ground); }
      gl_Position = m * vec4(w, 1);
    }`, `in vec3 n; in vec3 w; in vec4 c; uniform vec3 eye; uniform bool isShadow; out vec4 o;
    void main() {
      vec3 N = normalize(n);
      float rim = pow(1. - max(0., dot(N, normalize(eye - w))), 4.), light = .58 + .42 * dot(N, normalize(vec3(.5, .8, .35)));
      o = isShadow ? vec4(0, 0, 0, .22) : vec4(c.rgb * light + .12 * rim, c.a < 1. ? mix(c.a, .7, rim) : 1.);
    }`);
  const ground = build(`uniform mat4 m; uniform vec3 at; out vec3 w;
    void main() { w = at + 40. * vec3(gl_VertexID & 1, 0, gl_VertexID >> 1) - vec3(20, 0, 20); gl_Position = m * vec4(w, 1); }`,
  `in vec3 w; uniform vec3 at; uniform vec3 line; out vec4 o;
    void main() {
      vec2 g = abs(fract(w.xz * 2. + .5) - .5) / max(fwidth(w.xz * 2.), 1e-4);
      o = vec4(line, (1. - min(min(g.x, g.y), 1.)) * exp(-dot(w.xz - at.xz, w.xz - at.xz) / 40.));
    }`);
  if (!limbs || !ground) return null;
  const ring = 10, rise = 3, mesh = [], ids = [];
  for (let i = 0; i < 2 * rise + 2; ++i) {
    const end = i > rise ? 1 : 0, angle = ((i - end) / (2 * rise) - .5) * Math.PI;
    for (let k = 0; k < ring; ++k) {
      const turn = 2 * Math.PI * k / ring;
      mesh.push(Math.cos(angle) * Math.cos(turn), Math.sin(angle), Math.cos(angle) * Math.sin(turn), end);
      if (i) {
        const a = (i - 1) * ring + k, b = (i - 1) * ring + (k + 1) % ring;
        ids.push(a, a + ring, b, b, a + ring, b + ring);
      }
    }
  }
  const array = gl.createVertexArray(), many = gl.createBuffer();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(mesh), gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(ids), gl.STATIC_DRAW);
  gl.bindBuffer(gl.ARRAY_BUFFER, many);
  for (let i = 1; i <= 4; ++i) {
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, 4, gl.FLOAT, false, 64, 16 * (i - 1));
    gl.vertexAttribDivisor(i, 1);
  }
  return {kind: 'WebGL2', draw(scene, view) {
    const {width, height} = canvas, {eye, matrix} = cameraOf(view, width, height);
    gl.viewport(0, 0, width, height);
    gl.clearColor(...scene.page, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(ground.program);
    gl.bindVertexArray(null);
    gl.uniformMatrix4fv(ground.at.m, false, matrix);
    gl.uniform3f(ground.at.at, view.target[0], scene.floor, view.target[2]);
    gl.uniform3fv(ground.at.line, scene.line);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.useProgram(limbs.program);
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, many);
    gl.uniformMatrix4fv(limbs.at.m, false, matrix);
    gl.uniform3fv(limbs.at.eye, eye);
    gl.uniform1f(limbs.at.ground, scene.floor);
    const draw = (capsules, isShadow) => {
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(capsules.flat()), gl.DYNAMIC_DRAW);
      gl.uniform1i(limbs.at.isShadow, isShadow);
      gl.drawElementsInstanced(gl.TRIANGLES, ids.length, gl.UNSIGNED_SHORT, 0, capsules.length);
    };
    const solid = limbsOf(scene, false), ghosts = limbsOf(scene, true);
    // The stencil lets each pixel of the floor be shaded once.
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.EQUAL, 0, 255);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    draw(solid.length ? solid : ghosts, true);
    gl.disable(gl.STENCIL_TEST);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.CULL_FACE);
    draw(solid, false);
    draw(ghosts, false);
  }};
};
const flatRenderer = (canvas) => {
  const context = canvas.getContext('2d', {willReadFrequently: true});
  const css = (c) => `rgb(${c.map((x) => Math.round(255 * x)).join()})`;
  return {kind: '2D canvas', draw(scene, view) {
    const {width, height} = canvas, {project, focus} = cameraOf(view, width, height);
    context.fillStyle = css(scene.page);
    context.fillRect(0, 0, width, height);
    context.lineCap = 'round';
    const [x, , z] = view.target.map(Math.round);
    context.beginPath();
    for (let i = -4; i <= 4; ++i) {
      for (const ends of [[[x + i, z - 4], [x + i, z + 4]], [[x - 4, z + i], [x + 4, z + i]]]) {
        const [p, q] = ends.map(([u, v]) => project([u, scene.floor, v]));
        if (p[2] < .05 || q[2] < .05) continue;
        context.moveTo(p[0], p[1]);
        context.lineTo(q[0], q[1]);
      }
    }
    context.globalAlpha = .5;
    context.lineWidth = 1;
    context.strokeStyle = css(scene.line);
    context.stroke();
    const strokes = [...limbsOf(scene, false), ...limbsOf(scene, true)].map((limb) => {
      const p = project(limb.slice(0, 3)), q = project(limb.slice(4, 7)), depth = (p[2] + q[2]) / 2;
      return {p, q, depth, wide: (limb[3] + limb[7]) * focus / depth * limb[15] ** .3, colour: [0, 1, 2].map((i) => (limb[8 + i] + limb[12 + i]) / 2), alpha: limb[11]};
    });
    for (const {p, q, wide, colour, alpha} of strokes.sort((a, b) => b.depth - a.depth)) {
      if (p[2] < .05 || q[2] < .05) continue;
      context.globalAlpha = alpha < 1 ? .25 : 1;
      context.strokeStyle = css(colour);
      context.lineWidth = Math.max(1, wide);
      context.beginPath();
      context.moveTo(p[0], p[1]);
      context.lineTo(q[0] + .01, q[1]);
      context.stroke();
    }
    context.globalAlpha = 1;
  }};
};

const KEYS = 'k plays and stops; ← → a frame, with Shift a second; on the picture arrows turn it; + − zoom; 0 the first view; ' +
    '[ ] previous, next moment; Home End first, last frame; s side by side; e colour by error; Escape closes.';
const make = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (typeof value === 'boolean') element.toggleAttribute(key, value);
    else element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
};
const tell = (element, text) => { if (element.textContent !== text) element.textContent = text; };
const button = (label, onclick, attributes = {}) => make('button', {type: 'button', onclick, ...attributes}, label);
const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const rgb = (name) => {
  const context = make('canvas').getContext('2d');
  context.fillStyle = style(name) || '#888';
  context.fillRect(0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3).map((x) => x / 255);
};
const scaled = (share) => {
  const at = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1), i = Math.min(Math.floor(at), SCALE.length - 2);
  return SCALE[i].map((x, k) => (x + (at - i) * (SCALE[i + 1][k] - x)) / 255);
};
const short = (x) => Number.isFinite(x) ? x < 9.995 ? x.toFixed(2) : x < 99.95 ? x.toFixed(1) : x.toFixed(0) : '—';

let drawn = 0;  // frames drawn so far, of all worlds
let opened = null;
const show = (world, cells) => {
  const reduced = matchMedia('(prefers-reduced-motion: reduce)').matches, chosen = new Set(), rate = world.rate_hz, last = world.frames - 1;
  const state = {t: 0, playing: !reduced, speed: 1, apart: cells.length > 1, byError: world.bodies.some((b) => b.errors)};
  const wanted = (body) => body.cell < 0 || cells.includes(world.cells[body.cell].id);
  const comparedWith = new Set(world.bodies.flatMap((b) => b.against));
  world.bodies.forEach((body, i) => { if (wanted(body) && (body.kind !== 'ghost' || comparedWith.has(i))) chosen.add(i); });
  const labelOf = (body) => world.cells.length > 1 && body.cell >= 0 && body.label !== world.cells[body.cell].method ?
      `${body.label} (${world.cells[body.cell].method})` : body.label;

  // If methods are shown apart, they stand side by side; a partner (the coach) always stands beside the dancer.
  const box = () => {
    const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
    for (const i of chosen) {
      const {places} = world.bodies[i];
      for (let k = 0; k < places.length; ++k) {
        if (places[k] < low[k % 3]) low[k % 3] = places[k];
        if (places[k] > high[k % 3]) high[k % 3] = places[k];
      }
    }
    return low[0] > high[0] ? {low: [-1, 0, -1], high: [1, 1.8, 1]} : {low, high};
  };
  let spacing = 1.5, slots = [-1], partners = 0;
  const layOut = () => {
    const {low, high} = box(), bodies = [...chosen].map((i) => world.bodies[i]);
    spacing = Math.min(high[0] - low[0], 2.6) + .3;
    slots = state.apart ? [...new Set(bodies.filter((b) => b.cell >= 0 && b.kind !== 'partner').map((b) => b.cell))].sort((a, b) => a - b) : [-1];
    if (!slots.length) slots = [-1];
    partners = bodies.some((b) => b.kind === 'partner') ? 1 : 0;
  };
  const offsetsOf = (body) => slots.flatMap((cell, k) => {
    if (cell >= 0 && body.cell >= 0 && body.cell !== cell) return [];
    const step = 1 + partners, middle = (slots.length * step - 1) / 2;
    return [(k * step + (body.kind === 'partner' ? 0 : partners) - middle) * spacing];
  });
  const view = {};
  const home = () => {
    const {low, high} = box(), wide = (high[0] - low[0]) + spacing * (slots.length * (1 + partners) - 1);
    view.target = [(low[0] + high[0]) / 2, (Math.max(low[1], world.floor_m) + high[1]) / 2, (low[2] + high[2]) / 2];
    const aspect = stage.clientWidth / Math.max(1, stage.clientHeight) || 1.6;
    view.distance = 1.05 * Math.max(high[1] - low[1] + .25, wide / Math.max(aspect, .4) + .2) + (high[2] - low[2]) / 2;
    view.yaw = .45;
    view.pitch = .2;
  };

  const title = make('h2', {id: 'viewer-title'}, world.title), caption = make('p', {class: 'says'}), time = make('output');
  const stage = make('div', {class: 'stage'}), names = [];
  const play = button('', () => toggle());
  const nearer = button('+', () => zoom(.87), {'aria-label': 'Nearer'}), farther = button('−', () => zoom(1.15), {'aria-label': 'Farther'});
  const slider = make('input', {type: 'range', min: 0, max: last, value: 0, 'aria-label': 'Time', oninput: () => { stop(); seek(Number(slider.value)); }});
  const speed = make('select', {'aria-label': 'Speed', onchange: () => { state.speed = Number(speed.value); }},
      ...[.1, .25, .5, 1, 2].map((s) => make('option', {value: s, selected: s === 1}, `speed × ${s}`)));
  const apart = button('Side by side', () => { state.apart = !state.apart; layOut(); home(); refresh(); });
  const byError = button('Colour by error', () => { state.byError = !state.byError; refresh(); });
  byError.hidden = !state.byError;  // without errors, colouring by error has no meaning
  const scale = make('div', {class: 'scale'}, `${world.error}, ${world.unit}`, make('i'),
      make('span', {}, make('span', {}, '0'), make('span', {}, short(world.most / 2)), make('span', {}, '≥ ' + short(world.most))));
  const seek = (t) => { state.t = Math.min(Math.max(t, 0), last); refresh(); };
  const stop = () => { state.playing = false; refresh(); };
  const toggle = () => {
    state.playing = !state.playing;
    if (state.playing && state.t >= last) state.t = 0;
    refresh();
  };

  const percent = (t) => `${100 * t / Math.max(1, last)}%`;
  const lanes = make('div', {class: 'lanes'}, make('span', {}, 'time'), slider), cursors = [];
  const laneOf = (name, marks) => {
    const lane = make('div', {class: 'lane', onclick: (event) => {
      const {left, width} = lane.getBoundingClientRect();
      seek(Math.round((event.clientX - left) / width * last));
    }});
    for (const {frame, end, kind, text} of marks) {
      const bar = make('i', {class: kind, title: text});
      bar.style.left = percent(frame);
      bar.style.width = percent(Math.min(end, last) - frame);
      lane.append(bar);
    }
    cursors.push(lane.appendChild(make('i', {class: 'now'})));
    lanes.append(make('span', {title: name}, name), lane);
  };
  for (const name of new Set(world.marks.map((m) => m.lane))) laneOf(name, world.marks.filter((m) => m.lane === name));
  const stepping = [...chosen].map((i) => world.bodies[i]).find((b) => b.contacts.length);
  for (const [side, name] of [[0, 'left foot'], [1, 'right foot']]) {
    if (!stepping) break;
    laneOf(name, stepping.contacts.filter((c) => c[0] === side).map(([, begin, end]) =>
      ({frame: begin + stepping.begin, end: end + stepping.begin, kind: 'contact', text: labelOf(stepping) + ' stands'})));
  }
  const marks = [...world.marks].sort((a, b) => a.frame - b.frame);
  const moments = make('details', {}, make('summary', {}, `Moments (${marks.length})`), make('ol', {}, ...marks.map((mark) =>
    make('li', {}, button(`${(mark.frame / rate).toFixed(2)} s, ${mark.lane}: ${mark.text}`, () => { stop(); seek(mark.frame); })))));
  const jump = (way) => {
    const ahead = way > 0 ? marks.find((m) => m.frame > state.t + .5) : marks.findLast((m) => m.frame < state.t - .5);
    stop();
    seek(ahead ? ahead.frame : way > 0 ? last : 0);
  };

  // Show the errors as a table, too, for readers who do not see colours.
  const table = make('div', {class: 'table', tabindex: 0, role: 'region', 'aria-label': 'Error by joint'});
  let cellsNow = [];
  const tabulate = () => {
    const bodies = [...chosen].map((i) => world.bodies[i]).filter((b) => b.errors);
    cellsNow = [];
    table.replaceChildren();
    if (!bodies.length) { table.append('The errors of the shown bodies are not known.'); return; }
    const rows = [...new Set(bodies.flatMap((body) => body.tree.joints)), 'all joints'].map((name) =>
      make('tr', {}, make('th', {scope: 'row'}, name), ...bodies.flatMap((body) => {
        const joints = body.tree.joints.flatMap((joint, j) => joint === name || name === 'all joints' ? [j] : []);
        let sum = 0, count = 0, worst = NaN;
        for (let f = 0; f < body.frames; ++f) {
          for (const j of joints) {
            const e = body.errors[f * body.count + j];
            if (e >= 0) { sum += e; ++count; worst = e > worst || count === 1 ? e : worst; }
          }
        }
        const now = make('td', {class: 'n'});
        cellsNow.push({now, body, joints});
        return [now, make('td', {class: 'n'}, short(sum / count)), make('td', {class: 'n'}, short(worst))];
      })));
    table.append(make('table', {}, make('caption', {}, `${world.error[0].toUpperCase()}${world.error.slice(1)}, ${world.unit}`),
        make('thead', {}, make('tr', {}, make('td'), ...bodies.map((b) => make('th', {colspan: 3, scope: 'colgroup'}, labelOf(b)))),
            make('tr', {}, make('th', {scope: 'col'}, 'joint'), ...bodies.flatMap(() => ['now', 'mean', 'most'].map((h) => make('th', {scope: 'col', class: 'n'}, h))))),
        make('tbody', {}, ...rows)));
  };
  const tellNow = () => {
    for (const {now, body, joints} of cellsNow) {
      const errors = errorsAt(body, state.t);
      const seen = errors ? joints.map((j) => errors[j]).filter((e) => e >= 0) : [];
      now.textContent = short(seen.reduce((sum, e) => sum + e, 0) / seen.length);
    }
  };

  const {id, method} = world.cells.find((cell) => cell.id === cells[0]);
  // The motion's name, as `etude clip` expects it. WORLD@truth is the true motion, also if a method is called "truth".
  const motion = method === 'truth' ? `${id}@` : `${id.slice(0, -method.length - 1)}@${method}`;
  const boxes = make('fieldset', {}, make('legend', {}, 'Shown'), ...world.bodies.map((body, i) => make('label', {},
      make('input', {type: 'checkbox', checked: chosen.has(i), onchange: (event) => {
        event.target.checked ? chosen.add(i) : chosen.delete(i);
        layOut();
        tabulate();
        refresh();
      }}), ` ${labelOf(body)}${body.kind === 'ghost' ? ' (glass)' : ''}`)));
  const failed = world.cells.filter((cell) => cells.includes(cell.id) && cell.reason).map((cell) => make('p', {}, `${cell.method}: ${cell.status}, ${cell.reason}`));
  const dialog = make('dialog', {class: 'viewer', 'aria-labelledby': 'viewer-title', onclose: () => {
    opened = null;
    cancelAnimationFrame(ticking);
    resized.disconnect();
    dialog.remove();
  }},
  make('header', {}, title, button('✕', () => dialog.close(), {'aria-label': 'Close'})),
  make('div', {class: 'halves'},
      make('div', {}, stage, make('div', {class: 'controls'}, play, time, speed, apart, byError, nearer, farther), lanes, caption),
      make('div', {}, boxes, ...failed, ...world.notes.map((note) => make('p', {}, note)), table, moments,
          make('details', {}, make('summary', {}, 'As a file'), make('code', {class: 'file'}, `etude clip convert 'RUN#${motion}' motion.bvh`)),
          make('details', {}, make('summary', {}, 'Keys'), make('p', {}, KEYS)))));

  const colours = {page: rgb('--page'), ghost: rgb('--quiet'), accent: rgb('--accent'), methods: world.cells.map((c) => rgb(`--m${c.colour % 8}`))};
  let renderer, canvas, dirty = true, ticking, before = 0, toldAt = 0, sharpest = 2, slow = 0;
  const turn = (dx, dy) => {
    view.yaw -= dx;
    view.pitch = Math.min(Math.max(view.pitch + dy, .02), 1.5);
    dirty = true;
  };
  const zoom = (by) => { view.distance = Math.min(Math.max(view.distance * by, .6), 60); dirty = true; };
  const setUp = (flat) => {
    canvas?.remove();
    canvas = make('canvas', {tabindex: 0, role: 'img', 'aria-label': 'The motion; arrow keys turn it',
      onpointerdown: (event) => canvas.setPointerCapture(event.pointerId),
      onpointermove: (event) => { if (event.buttons) turn(event.movementX * .008, event.movementY * .006); },
      onwheel: (event) => { event.preventDefault(); zoom(Math.exp(event.deltaY * .001)); }});
    stage.prepend(canvas);
    renderer = (!flat && glRenderer(canvas, () => setUp(true))) || null;
    if (!renderer) {
      if (!flat) return setUp(true);  // a canvas that has had a WebGL context gives no other context
      renderer = flatRenderer(canvas);
    }
    stage.dataset.renderer = renderer.kind;
    fit();
  };
  const fit = () => {
    const sharp = Math.min(devicePixelRatio, sharpest);
    canvas.width = Math.max(1, Math.round(stage.clientWidth * sharp));
    canvas.height = Math.max(1, Math.round(stage.clientHeight * sharp));
    dirty = true;
  };
  const paint = () => {
    const items = [], shown = [], spots = offsetsOf({cell: -1}).flatMap((dx) => world.targets_m.map(([x, y, z]) => ({at: [x + dx, y, z], radius: .045, colour: [.95, .6, .1], squash: 1})));
    for (const i of chosen) {
      const body = world.bodies[i], there = isThere(body, state.t);
      if (!there && body.kind === 'ghost' && body.stored > 1) continue;
      const errors = state.byError && there ? errorsAt(body, state.t) : null, tints = new Float32Array(3 * body.count);
      const plain = body.kind === 'ghost' || !there ? colours.ghost : body.cell >= 0 ? colours.methods[body.cell] : colours.accent;
      for (let j = 0; j < body.count; ++j) tints.set(errors && errors[j] >= 0 ? scaled(errors[j] / world.most) : errors ? colours.ghost : plain, 3 * j);
      const standing = body.contacts.filter(([, begin, end]) => state.t >= begin + body.begin && state.t < end + body.begin);
      for (const dx of offsetsOf(body)) {
        const places = place(body, state.t, world.steps.length > 0);
        for (let j = 0; j < body.count; ++j) places[3 * j] += dx;
        items.push({places, colours: tints, ghost: body.kind === 'ghost', tree: body.tree});
        if (body.kind !== 'ghost') shown.push({body, places});
        for (const [side] of standing) {
          const foot = side ? 18 : 14, at = [0, 1, 2].map((k) => (places[3 * foot + k] + places[3 * foot + 3 + k]) / 2);
          at[1] = Math.min(world.floor_m + .008, at[1]);
          spots.push({at, radius: .13, colour: colours.accent, squash: .06});
        }
      }
    }
    const scene = {items, spots, floor: world.floor_m, page: colours.page, line: colours.ghost};
    renderer.draw(scene, view);
    const {project} = cameraOf(view, stage.clientWidth, stage.clientHeight);
    shown.forEach(({body, places}, k) => {
      const name = names[k] ??= stage.appendChild(make('span', {class: 'name'}));
      let head = HEAD;  // for bodies of other joints: the highest joint
      if (body.tree !== BODY) body.tree.joints.forEach((_, j) => { if (!j || !(places[3 * head + 1] >= places[3 * j + 1])) head = j; });
      const [x, y] = project([places[3 * head], places[3 * head + 1] + .17, places[3 * head + 2]]);
      name.hidden = false;
      tell(name, labelOf(body));
      name.style.transform = `translate(${Math.max(0, x).toFixed(1)}px, ${Math.max(0, state.apart ? y : y - 18 * k).toFixed(1)}px) translate(-50%, -100%)`;
    });
    names.slice(shown.length).forEach((name) => { name.hidden = true; });
    ++drawn;
  };
  const report = () => {
    const frame = Math.round(state.t), word = state.playing ? 'Stop' : 'Play';
    tell(play, word);
    apart.setAttribute('aria-pressed', state.apart);
    byError.setAttribute('aria-pressed', state.byError);
    scale.hidden = !state.byError;
    slider.value = String(frame);
    time.textContent = `${(state.t / rate).toFixed(2)} of ${(last / rate).toFixed(2)} s`;
    slider.setAttribute('aria-valuetext', time.textContent);
    for (const cursor of cursors) cursor.style.left = percent(state.t);
    const steps = world.steps.filter((s) => cells.includes(world.cells[s.cell].id)).map((s) => {
      const i = Math.min(frame, s.iterations.length - 1);
      return `${world.cells[s.cell].method}: iteration ${s.iterations[i]}, worst end ${short(s.off_cm[i])} cm and ${short(s.off_deg[i])}° off.`;
    });
    const said = world.marks.filter((m) => m.frame <= state.t + .5 && state.t <= Math.max(m.end, m.frame + rate)).map((m) => `${m.lane}: ${m.text}.`);
    const text = [...steps, ...said.slice(-3)].join(' ');
    tell(caption, text);
    tellNow();
  };
  const refresh = () => { dirty = true; toldAt = 0; };
  const tick = (now) => {
    if (state.playing) {
      state.t += Math.min(now - before, 200) / 1000 * rate * state.speed;
      if (state.t > last) state.t = last > 0 ? state.t % (last + 1) : 0;
      if (state.t > last) state.t = last;
      dirty = true;
    }
    // If drawing is slow, use half the resolution; if it is still slow, draw in 2D.
    slow = state.playing && now - before > 36 ? slow + 1 : 0;
    if (slow > 5) {
      slow = 0;
      if (sharpest > .5) { sharpest = .5; fit(); } else if (renderer.kind === 'WebGL2') setUp(true);
    }
    before = now;
    if (dirty) {
      dirty = false;
      paint();
      if (now - toldAt > 120 || !state.playing) { toldAt = now; report(); }  // text changes eight times a second
    }
    ticking = requestAnimationFrame(tick);
  };
  dialog.addEventListener('keydown', (event) => {
    const {key, target} = event;
    if (event.ctrlKey || event.metaKey || event.altKey || target.tagName === 'SELECT') return;
    const step = event.shiftKey ? rate : 1, arrows = {ArrowLeft: -1, ArrowRight: 1};
    const keys = {k: toggle, s: () => apart.click(), e: () => byError.click(), '+': () => zoom(.87), '=': () => zoom(.87), '-': () => zoom(1.15), '0': () => { home(); refresh(); },
      '[': () => jump(-1), ']': () => jump(1), Home: () => seek(0), End: () => seek(last)};
    if (target === canvas && key.startsWith('Arrow')) turn((arrows[key] ?? 0) * -.12, {ArrowUp: .1, ArrowDown: -.1}[key] ?? 0);
    else if (key in arrows) { stop(); seek(Math.round(state.t) + step * arrows[key]); }
    else if (key in keys) keys[key]();
    else return;
    event.preventDefault();
  });
  const resized = new ResizeObserver(() => fit());
  stage.append(scale);
  document.body.append(dialog);
  dialog.showModal();
  layOut();
  setUp(window.etudeViewer.flat);
  home();
  tabulate();
  resized.observe(stage);
  play.focus();
  before = performance.now();
  ticking = requestAnimationFrame(tick);
  opened = {world, state, view, dialog, seek: (t) => { stop(); seek(t); }};
};

window.etudeViewer = {
  has: (cell) => fileOf(cell) !== undefined,
  // Opens the world of `cells`; the dialog also offers the world's other cells.
  open: (...cells) => {
    const known = cells.filter((cell) => fileOf(cell) !== undefined);
    if (opened || !known.length) return Promise.resolve(false);
    return load(fileOf(known[0])).then((world) => { show(world, known); return true; },
        (file) => { alert(`The motions are not beside this page: report/${file}`); return false; });
  },
  get drawn() { return drawn; },
  get opened() { return opened; },
  flat: false,
};
document.addEventListener('click', (event) => {
  const {cell, frame} = event.target.closest?.('button[data-cell]')?.dataset ?? {};
  if (cell === undefined || opened || !window.etudeViewer.has(cell)) return;
  event.preventDefault();
  window.etudeViewer.open(cell).then((isOpen) => { if (isOpen && frame !== undefined) opened.seek(Number(frame)); });
});
// Adds a button to the card of a dot or a row with a recorded motion.
document.addEventListener('etude:cells', ({detail: {cells, card}}) => {
  const known = cells.filter(window.etudeViewer.has);
  if (!known.length) return;
  const watch = Object.assign(document.createElement('button'), {type: 'button', textContent: 'Watch the motion', className: 'watched',
                                                                 onclick: () => window.etudeViewer.open(...known)});
  card.querySelector('code').before(watch);
});
document.querySelectorAll('.watch').forEach((line) => { line.hidden = false; });
