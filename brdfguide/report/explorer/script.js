'use strict';
(() => {
const root = document.getElementById('explorer'), $ = name => root.querySelector('[data-is="' + name + '"]');
const S = JSON.parse(document.getElementById('explorer-state').textContent);
const [THETAS, ROLLS, RINGS, SPOKES] = S.table, SIZE = 512;
const state = {a: 0, b: Math.max(S.models.findIndex((m, k) => k > 0 && m.law.includes('he-torrance')), Math.min(1, S.models.length - 1)), wipe: 1, mode: 'wipe', light: 'side', object: 0, lock: false, angle: 75};
const make = (tag, more = {}, ...inside) => { const e = document.createElement(tag);
  for (const [k, v] of Object.entries(more)) k in e && k !== 'list' ? e[k] = v : e.setAttribute(k, v);
  e.append(...inside); return e; };
const short = (x, digits = 4) => String(+(+x).toPrecision(digits));
for (const m of S.models) { m.fitted = m.knobs.map(k => [...k.value]); m.stale = true; }

// ---- numbers of a law: V of one channel, inside units, with what follows from them
const values = (m, c) => { const V = {};
  for (const k of m.knobs) V[k.id] = k.value[Math.min(c, k.value.length - 1)] * k.scale;
  return Object.assign(V, TWINS[S.models.indexOf(m)].numbers(V, c)); };
const evaluator = (m, c) => { const V = values(m, c), f = TWINS[S.models.indexOf(m)].finite;
  return (ci, cr, q, p) => f(V, ci, cr, q, p); };
const plane = (ti, tr) => { const a = ti * Math.PI / 180, b = tr * Math.PI / 180, x = Math.sin(a), y = -Math.sin(b);
  const mid = Math.sin((a - b) / 2) * Math.cos((a + b) / 2) * 2;
  return [Math.max(Math.cos(a), 1e-6), Math.max(Math.cos(b), 1e-6), mid * mid, x * y]; };
const channel = () => S.data && S.data.channels === 3 ? S.data.place : 0;

function error(m) {
  if (!S.data) return null;
  const c = channel(), f = evaluator(m, c), V = values(m, c), d = S.data, twin = TWINS[S.models.indexOf(m)];
  let sum = 0;
  for (let k = 0; k < d.ln.length; k++) {
    let model = 0;
    for (const [ci, cr, q, p, weight] of d.views) if (ci[k] > 0 && cr[k] > 0) model += weight * f(ci[k], cr[k], q[k], p[k]);
    if (d.beam && d.beam[k]) model += twin.mirror(V, d.views[0][0][k]) * d.beam[k];
    const r = Math.log(Math.max(model, 1e-300)) - d.ln[k];
    sum += (d.weights ? d.weights[k] : 1) * r * r;
  }
  return Math.sqrt(sum / d.ln.length);
}

// ---- the picture by WebGL2
const canvas = $('picture');
let gl = null;
function start() {
  gl = canvas.getContext('webgl2', {antialias: false, preserveDrawingBuffer: true});
  if (gl && !gl.getExtension('EXT_color_buffer_float')) gl = null;
  if (!gl) return;
  common = {table: program(S.sources.table), show: program(S.sources.show), grid: target(ROLLS, 2).textures[0]};
  const data = new Float32Array(8 * ROLLS), put = (k, x) => data.set([x, Math.sin(x), Math.cos(x), 0], 4 * k);
  for (let k = 0; k < ROLLS; k++) put(k, Math.sinh((2 * k / (ROLLS - 1) - 1) * 6) / Math.sinh(6) * .5 * Math.PI);
  for (let k = 0; k < THETAS; k++) put(ROLLS + k, k === THETAS - 1 ? 89.6 * Math.PI / 180 : .5 * Math.PI * (1 - (1 - k / (THETAS - 1)) ** 1.5));
  gl.bindTexture(gl.TEXTURE_2D, common.grid); gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ROLLS, 2, gl.RGBA, gl.FLOAT, data);
}
let common;
function program(fragment) {  // HEAD and WORLD are the same of all
  const p = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, S.sources.flat], [gl.FRAGMENT_SHADER, fragment]]) {
    const s = gl.createShader(kind); gl.shaderSource(s, S.sources.head + text.replace('WORLD', S.sources.world)); gl.compileShader(s);
    if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw Error(gl.getShaderInfoLog(s));
    gl.attachShader(p, s);
  }
  gl.linkProgram(p);
  if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw Error(gl.getProgramInfoLog(p));
  return p;
}
function target(width, height, count = 1) {
  const frame = gl.createFramebuffer(), textures = [];
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  for (let k = 0; k < count; k++) {
    const t = gl.createTexture(); textures.push(t);
    gl.bindTexture(gl.TEXTURE_2D, t);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D, t, 0);
  }
  gl.drawBuffers(textures.map((_, k) => gl.COLOR_ATTACHMENT0 + k));
  return {frame, textures, width, height};
}
function uniforms(p, given) {
  let unit = 0;
  for (const [name, value] of Object.entries(given)) {
    const at = gl.getUniformLocation(p, name);
    if (value instanceof WebGLTexture) { gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(gl.TEXTURE_2D, value); gl.uniform1i(at, unit++); }
    else if (Array.isArray(value)) gl.uniform3fv(at, value);
    else if (value && value.whole !== undefined) gl.uniform1i(at, value.whole);
    else gl.uniform1f(at, value);
  }
}
const whole = n => ({whole: n});
function pass(p, into, given, rows) {
  gl.useProgram(p);
  gl.bindFramebuffer(gl.FRAMEBUFFER, into ? into.frame : null);
  gl.viewport(0, 0, into ? into.width : canvas.width, into ? into.height : canvas.height);
  uniforms(p, given);
  if (rows) { gl.enable(gl.SCISSOR_TEST); gl.scissor(0, rows[0], into.width, rows[1]); }
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  gl.disable(gl.SCISSOR_TEST);
}
function law(m) {
  const given = {}, each = [0, 1, 2].map(c => values(m, c));
  for (const id of [...m.knobs.map(k => k.id), ...m.numbers]) given[id] = each.map(V => V[id]);
  return given;
}
function* drawn(m, part) {
  m.gl ??= {lobe: program(S.sources.lobe.replace('LAW', () => m.glsl)), picture: program(S.sources.picture.replace('LAW', () => m.glsl)), lights: target(SPOKES, RINGS * THETAS * (1 + m.back), 2),
    table: target(ROLLS, THETAS), radiance: target(SIZE, SIZE)};
  const rings = whole(RINGS / part), spokes = whole(SPOKES / part), back = whole(m.back), grid = common.grid, given = {...law(m), grid}, g = m.gl;
  pass(g.lobe, g.lights, {...given, rings, spokes, back});
  for (let row = 0; row < THETAS; row += 8) {
    pass(common.table, g.table, {grid, rings, spokes, back, lights: g.lights.textures[0], sides: g.lights.textures[1]}, [row, 8]);
    if (part === 1) yield;
  }
  pass(g.picture, g.radiance, {...given, size: SIZE, object: whole(state.object), sun: S.lights[state.light], around: g.table.textures[0]});
}
let run = 0, part = 4;
function draw(full) {
  if (!gl) return software(full);
  const mine = ++run, models = [S.models[state.a], S.models[state.b]];
  const show = () => pass(common.show, null, {one: models[0].gl.radiance.textures[0], two: models[1].gl.radiance.textures[0],
    wipe: state.wipe, mode: whole(state.mode === 'difference' ? 1 : 0), width: canvas.width});
  const work = (function* () { for (const m of new Set(models)) if (m.stale) { yield* drawn(m, full ? 1 : part); m.stale = !full; } })();
  if (!full) { const began = performance.now(); while (!work.next().done); show(); gl.finish();
    const took = performance.now() - began; part = took > 40 ? Math.min(part * 2, 8) : took < 8 ? Math.max(part / 2, 1) : part; return; }
  const step = () => { if (mine !== run) return;
    if (work.next().done) { show(); root.dataset.done = 'yes'; } else setTimeout(step, 0); };
  step();
}

// ---- the picture without a graphics card: the same sums by the JavaScript twins
function software(full) {
  const size = 160, rings = full ? 14 : 7, spokes = 24, thetas = 28, rolls = 61, c2 = canvas.getContext('2d');
  const image = c2.createImageData(size, size), W = S.world;
  const sky = h => h >= 0 ? W.zenith.map((z, k) => z + (W.horizon[k] - z) * Math.exp(-h / W.scale)) : W.ground;
  const theta = k => k === thetas - 1 ? 89.6 * Math.PI / 180 : 0.5 * Math.PI * (1 - Math.pow(1 - k / (thetas - 1), 1.5));
  const roll = k => Math.sinh((2 * k / (rolls - 1) - 1) * 6) / Math.sinh(6) * 0.5 * Math.PI;
  const models = [S.models[state.a], S.models[state.b]];
  for (const m of new Set(models)) if (m.stale || !m.soft || m.soft.rings !== rings) m.soft = {rings, table: tableOf(m)};
  function tableOf(m) {
    const f = [0, 1, 2].map(c => evaluator(m, c)), one = m.knobs.every(k => k.value.length < 2) && !m.numbers.length, table = [];
    for (let k = 0; k < thetas; k++) {
      const t0 = theta(k), r = [Math.sin(t0), 0, Math.cos(t0)], seen = [], low = Math.log(3e-4), step = (Math.log(40) - low) / rings;
      for (let turned = 0; turned <= m.back; turned++) for (let ring = 0; ring < rings; ring++) for (let s = 0; s < spokes; s++) {
        const t = Math.exp(low + step * (ring + .5)), hz = 1 / Math.sqrt(1 + t * t), phi = 2 * Math.PI / spokes * (s + .5 + .618 * ring);
        const h = [t * hz * Math.cos(phi), t * hz * Math.sin(phi), hz], cd = h[0] * r[0] + hz * r[2];
        const i = h.map((x, n) => 2 * cd * x - r[n]);
        if (cd <= 0 || i[2] <= 1e-6) continue;
        let w = 4 * cd * t * t * hz ** 3 * step * 2 * Math.PI / spokes * i[2], q = 4 * cd * cd * (h[0] ** 2 + h[1] ** 2);
        if (m.back) { const other = (r[0] - i[0]) ** 2 + i[1] ** 2; w *= other * other / Math.max(q * q + other * other, 1e-30);
          if (turned) { i[0] = -i[0]; i[1] = -i[1]; q = other; } }
        const g = one ? Array(3).fill(f[0](i[2], r[2], q, i[0] * r[0])) : f.map(e => e(i[2], r[2], q, i[0] * r[0]));
        seen.push([g.map(x => x * w), r[0] * i[2] - r[2] * i[0], i[1]]);
      }
      table.push(Array.from({length: rolls}, (_, n) => { const s = Math.sin(roll(n)), c = Math.cos(roll(n)), sum = [0, 0, 0];
        for (const [g, a, b] of seen) { const L = sky(s * a + c * b); for (let k = 0; k < 3; k++) sum[k] += g[k] * L[k]; }
        return sum; }));
    }
    return table;
  }
  const find = (of, count, x) => { let k = 0; while (k < count - 2 && of(k + 1) < x) k++;
    return [k, Math.min(Math.max((x - of(k)) / (of(k + 1) - of(k)), 0), 1)]; };
  const sun = S.lights[state.light];
  models.forEach(m => { m.soft.law = [0, 1, 2].map(c => evaluator(m, c)); m.soft.V = [0, 1, 2].map(c => values(m, c)); });
  for (let py = 0; py < size; py++) for (let px = 0; px < size; px++) {
    const x = (px + .5) / size, y = 1 - (py + .5) / size, m = x < state.wipe ? models[0] : models[1];
    let sx = (x - .5) / (state.object ? .46 : .29), sy = (y - (state.object ? .5 : .66)) / (state.object ? .46 : .29), n = null;
    const rim = Math.hypot(sx, sy);
    if (rim < 1) n = [sx, sy, Math.sqrt(Math.max(1 - sx * sx - sy * sy, 0))];
    else if (!state.object && x > .08 && x < .92 && y > .05 && y < .29) {
      const tilt = (-12 + 100 * (y - .05) / .24) * Math.PI / 180, bend = 50 * ((x - .08) / .84 - .5) * Math.PI / 180;
      n = [Math.sin(bend) * Math.cos(tilt), Math.sin(tilt), Math.cos(bend) * Math.cos(tilt)];
    }
    let L = sky(.9 * (y - .66));
    if (n) {
      const T = m.soft.table, [k, a] = find(theta, thetas, Math.acos(n[2])), [j, b] = find(roll, rolls, Math.atan2(n[1], Math.abs(n[0])));
      L = [0, 1, 2].map(c => (1 - a) * ((1 - b) * T[k][j][c] + b * T[k][j + 1][c]) + a * ((1 - b) * T[k + 1][j][c] + b * T[k + 1][j + 1][c]));
      const ci = n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2], cr = Math.max(n[2], 1e-6);
      if (ci > 0) { const v = [sun[0], sun[1], sun[2] + 1].map((e, w) => e - n[w] * (ci + n[2])), q = v[0] ** 2 + v[1] ** 2 + v[2] ** 2;
        for (let c = 0; c < 3; c++) L[c] += W.sun[c] * m.soft.law[c](ci, cr, q, sun[2] - ci * cr) * ci; }
      const to = 2 * n[2] * n[1], glint = sky(to), twin = TWINS[S.models.indexOf(m)];
      for (let c = 0; c < 3; c++) L[c] += twin.mirror(m.soft.V[c], cr) * glint[c];
    }
    for (let c = 0; c < 3; c++) { let e = Math.max(L[c], 0) * W.exposure; e = e < .5 ? e : 1 - .25 / e;
      image.data[4 * (py * size + px) + c] = 255 * (e <= .0031308 ? 12.92 * e : 1.055 * e ** (1 / 2.4) - .055) + .5; }
    image.data[4 * (py * size + px) + 3] = 255;
  }
  canvas.width = canvas.height = size;
  c2.putImageData(image, 0, 0);
  for (const m of models) m.stale = false;
  root.dataset.done = 'yes';
}

// ---- knobs
const toSlider = (k, x) => k.log ? Math.log(Math.max(x - k.origin, k.least)) : x, fromSlider = (k, x) => k.log ? k.origin + Math.exp(x) : x;
function knob(m, k) {
  k.least = Math.max(k.low - k.origin, (k.high - k.origin) * 1e-6, 1e-9);
  const label = k.key + (k.unit ? ' [' + k.unit + ']' : ''), id = 'k' + S.models.indexOf(m) + k.id, low = toSlider(k, k.low), high = toSlider(k, k.high);
  const slide = make('input', {type: 'range', min: low, max: high, step: (high - low) / 1000, id}), field = make('input', {type: 'number', step: 'any', min: k.low, max: k.high});
  field.setAttribute('aria-label', label + ', number'); slide.disabled = field.disabled = k.held;
  const value = () => k.value.length > 1 ? k.value.reduce((a, b) => a + b) / k.value.length : k.value[0];
  const fitted = m.fitted[m.knobs.indexOf(k)], at = fitted.reduce((a, b) => a + b) / fitted.length;
  const share = x => 100 * Math.min(Math.max((toSlider(k, x) - low) / (high - low), 0), 1);
  const band = make('span', {className: 'band'}), from = share(at - 2 * (k.stderr || 0)), to = share(at + 2 * (k.stderr || 0));
  band.style.left = from + '%'; band.style.width = Math.max(to - from, .4) + '%';
  const said = k.stderr ? ', fitted ' + short(at - 2 * k.stderr) + ' to ' + short(at + 2 * k.stderr) : ', given ' + short(at);
  k.show = () => { slide.value = toSlider(k, value()); field.value = short(value(), 6); if (pick) pick.value = hex(k.value);
    slide.setAttribute('aria-valuetext', label + ' ' + short(value()) + said); };
  k.set = (x, follows) => { x = Math.min(Math.max(x, k.low), k.high); const was = value();
    k.value = k.value.length > 1 ? k.value.map(v => was ? Math.min(v * x / was, k.high) : x) : [x];
    k.show(); if (!follows) { follow(m, k); changed(m); } };
  const pick = k.linear && k.high <= 1.5 && make('input', {type: 'color'});
  const hex = v => '#' + [0, 1, 2].map(c => { const x = Math.min(v[Math.min(c, v.length - 1)], 1);
    return Math.round(255 * (x <= .0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - .055)).toString(16).padStart(2, '0'); }).join('');
  if (pick) { pick.setAttribute('aria-label', k.key + ', colour');
    pick.oninput = () => { k.value = [1, 3, 5].map(n => { const x = parseInt(pick.value.slice(n, n + 2), 16) / 255;
      return +(x <= .04045 ? x / 12.92 : ((x + .055) / 1.055) ** 2.4).toPrecision(6); }); k.show(); changed(m); }; }
  slide.oninput = () => k.set(fromSlider(k, +slide.value)); slide.onchange = () => draw(true);
  field.onchange = () => { if (field.value !== '' && isFinite(field.value)) k.set(+field.value); else k.show(); draw(true); };
  k.show();
  const row = make('div', {className: 'knob'}, make('label', {htmlFor: id}, label), make('span', {className: 'track'}, band, slide), field, pick || '');
  if (k.held) row.append(make('small', {}, 'held: what follows from it is a table'));
  return row;
}
function fill() {
  for (const side of ['a', 'b']) {
    const box = $('knobs-' + side), m = S.models[state[side]];
    box.replaceChildren(...m.knobs.filter(k => !k.minor).map(k => knob(m, k)));
    const more = m.knobs.filter(k => k.minor);
    if (more.length) box.append(make('details', {}, make('summary', {}, 'numbers that fits hold'), ...more.map(k => knob(m, k))));
    $('pick-' + side).value = state[side];
  }
  for (const name of ['side-b', 'wiped', 'compared']) $(name).hidden = S.models.length < 2;
}

// ---- the contour of emergence
const wave = m => { const find = name => m.knobs.find(k => k.key.endsWith('he-torrance.' + name) || k.key === name), a = m.knobs.find(k => k.key.endsWith('alpha') && !k.held);
  if (find('sigma') && find('slope')) return {sigma: find('sigma'), slope: find('slope')};
  if (a) return {facets: 1, slope: {low: a.low / 2, high: a.high / 2, get value() { return [a.value[0] / 2]; }, set: (x, f) => a.set(2 * x, f)}, sigma: {get value() { return [crossing(state.angle, a.value[0] / 2, UM)]; }, set() {}}};
};
function crossing(angle, slope, um) {
  const C = S.contours, spot = (grid, x) => { let k = 0; while (k < grid.length - 2 && grid[k + 1] <= x) k++; return [k, (x - grid[k]) / (grid[k + 1] - grid[k])]; };
  const [i, u] = spot(C.ln_cos.map(x => -x), -Math.log(Math.cos(angle * Math.PI / 180))), [j, v] = spot(C.slopes.map(Math.log), Math.log(slope));
  const cubic = (y, t) => y[1] + .5 * t * (y[2] - y[0] + t * (2 * y[0] - 5 * y[1] + 4 * y[2] - y[3] + t * (3 * (y[1] - y[2]) + y[3] - y[0])));
  const at = (row, k) => row[k] ?? (k < 0 ? 2 * row[0] - row[1] : 2 * row.at(-1) - row.at(-2));
  const rows = C.ln_sigma.map(row => cubic([-1, 0, 1, 2].map(d => at(row, j + d)), v));
  return Math.exp(cubic([-1, 0, 1, 2].map(d => at(rows, i + d)), u)) * um / C.wavelength;
}
const waving = () => { const two = [S.models[state.a], S.models[state.b]]; return two.find(m => wave(m) && !wave(m).facets) || two.find(wave); };
const UM = .55, eq3 = tau => { const T = [[15, 1.1], [45, 1.6], [60, 2.4], [75, 5.5], [80, 9], [85, 20]], x = a => -Math.log(Math.cos(a * Math.PI / 180));
  let k = 0; while (k < T.length - 2 && T[k + 1][0] < state.angle) k++;
  const s = (x(state.angle) - x(T[k][0])) / (x(T[k + 1][0]) - x(T[k][0]));
  return state.angle > 85 ? null : T[k][1] * (T[k + 1][1] / T[k][1]) ** s / (tau ** .7 + 6); };
function follow(m, moved) {
  const w = wave(m);
  if (!state.lock || !w || w.facets || (moved !== w.sigma && moved !== w.slope)) return;
  if (moved === w.slope) w.sigma.set(crossing(state.angle, w.slope.value[0], UM), true);
  else { let low = Math.log(Math.max(w.slope.low, .02)), high = Math.log(Math.min(w.slope.high, .5));
    for (let k = 0; k < 60; k++) { const mid = (low + high) / 2; crossing(state.angle, Math.exp(mid), UM) < w.sigma.value[0] ? low = mid : high = mid; }
    w.slope.set(Math.exp(low), true); w.sigma.set(crossing(state.angle, w.slope.value[0], UM), true); }
}

// ---- plots
const power = d => '10' + String(d).replace('-', '\u207b').replace(/\d/g, x => '⁰¹²³⁴⁵⁶⁷⁸⁹'[x]);
// decades of an axis, with 2 and 5 between them where there are few
const marks = (low, high) => { const few = high - low < 2.5, found = [];
  for (let d = Math.floor(low); d <= high; d++) for (const m of few ? [1, 2, 5] : [1]) { const y = d + Math.log10(m); if (y >= low && y <= high) found.push([y, few ? short(m * 10 ** d, 1) : power(d)]); }
  return found; };
const colours = () => { const s = getComputedStyle(root); return ['--a', '--b', '--ink', '--rule'].map(n => s.getPropertyValue(n).trim()); };
function plot() {
  const [A, B, ink, rule] = colours(), box = $('cuts'), scale = devicePixelRatio || 1, w = box.clientWidth || 640, h = 330, c = box.getContext('2d');
  box.width = w * scale; box.height = h * scale; c.scale(scale, scale); c.font = '12px system-ui, sans-serif';
  const cuts = S.data && S.data.panels.length ? S.data.panels : [20, 45, 70].map(theta_i => ({theta_i, theta_r: [], value: []}));
  const count = cuts.length, gap = 46, each = (w - gap - 8) / count, top = 24, strip = S.data ? 70 : 0, height = h - top - 40 - strip;
  const sides = S.models.length > 1 && state.b !== state.a ? [['a', A, []], ['b', B, [6, 4]]] : [['a', A, []]], curves = [];
  let low = Infinity, high = -Infinity;
  cuts.forEach((cut, n) => { for (const [side, colour, dash] of sides) { const f = evaluator(S.models[state[side]], channel()), line = [];
      for (let t = -88; t <= 88; t += .5) { const y = Math.log10(f(...plane(cut.theta_i, t))); line.push([t, y]); if (isFinite(y) && !cut.value.length) { low = Math.min(low, y); high = Math.max(high, y); } }
      curves.push({n, side, colour, dash, line}); }
    for (const y of cut.value) { low = Math.min(low, Math.log10(y)); high = Math.max(high, Math.log10(y)); } });
  high += .3; low = Math.max(low - .3, high - 6);
  const X = (n, t) => gap + n * each + 8 + (t + 90) / 180 * (each - 14), Y = y => top + height * (high - y) / (high - low);
  c.strokeStyle = rule; c.fillStyle = ink; c.lineWidth = 1;
  for (const [y, label] of marks(low, high)) { c.textAlign = 'right'; c.fillText(label, gap, Y(y) + 4);
    for (let n = 0; n < count; n++) { c.beginPath(); c.moveTo(X(n, -90), Y(y)); c.lineTo(X(n, 90), Y(y)); c.stroke(); } }
  cuts.forEach((cut, n) => { c.textAlign = 'left'; c.fillText('\u03b8\u1d62 = ' + short(cut.theta_i, 3) + '°', X(n, -90), 15);
    c.strokeStyle = ink; c.strokeRect(X(n, -90), top, each - 14, height); if (strip) c.strokeRect(X(n, -90), top + height + 8, each - 14, strip - 8);
    c.textAlign = 'center'; for (const t of [-60, 0, 60]) c.fillText(t, X(n, t), h - 24); c.strokeStyle = rule; c.beginPath(); c.moveTo(X(n, cut.theta_i), top); c.lineTo(X(n, cut.theta_i), h - 40); c.stroke();
    c.fillStyle = ink; cut.value.forEach((v, k) => { c.beginPath(); c.arc(X(n, cut.theta_r[k]), Y(Math.log10(v)), 1.7, 0, 7); c.fill(); }); });
  for (const {n, side, colour, dash, line} of curves) { c.save(); c.beginPath(); c.rect(X(n, -90), top, each - 14, height); c.clip(); c.strokeStyle = colour; c.lineWidth = 2; c.setLineDash(dash); c.beginPath();
    line.forEach(([t, y], k) => isFinite(y) && c[k ? 'lineTo' : 'moveTo'](X(n, t), Y(y))); c.stroke(); c.restore();
    if (strip) { const f = evaluator(S.models[state[side]], channel()), mid = top + height + 8 + (strip - 8) / 2; c.fillStyle = colour;
      cuts[n].value.forEach((v, k) => { const r = Math.max(-1, Math.min(1, Math.log(f(...plane(cuts[n].theta_i, cuts[n].theta_r[k])) / v))); c.fillRect(X(n, cuts[n].theta_r[k]) - 1, mid - r * (strip - 12) / 2 - 1, 2, 2); });
      c.strokeStyle = rule; c.beginPath(); c.moveTo(X(n, -90), mid); c.lineTo(X(n, 90), mid); c.stroke(); } }
  c.fillStyle = ink; c.textAlign = 'center'; c.fillText('reflection angle \u03b8\u1d63 [deg]' + (strip ? '; below ln(model/data), \u00b11' : ''), w / 2, h - 6); c.textAlign = 'left'; c.fillText('1/sr', 4, 15);
  polar(cuts, sides, ink, rule); chart(ink, rule, A);
}
function polar(cuts, sides, ink, rule) {
  const box = $('polar'), scale = devicePixelRatio || 1, w = Math.min(box.clientWidth || 320, 420), h = w / 2 + 30, c = box.getContext('2d');
  box.width = w * scale; box.height = h * scale; box.style.height = h + 'px'; c.scale(scale, scale); c.font = '12px system-ui, sans-serif';
  const cut = cuts[Math.floor((cuts.length - 1) / 2)], ti = cut.theta_i, R = w / 2 - 12, at = (t, r) => [w / 2 + r * Math.sin(t * Math.PI / 180), h - 22 - r * Math.cos(t * Math.PI / 180)];
  const lines = sides.map(([side, colour, dash]) => { const f = evaluator(S.models[state[side]], channel()), line = []; for (let t = -89; t <= 89; t += .5) line.push([t, Math.log10(f(...plane(ti, t)))]); return {colour, dash, line}; });
  const all = lines.flatMap(l => l.line.map(p => p[1])).filter(isFinite), high = Math.ceil(Math.max(...all)), low = Math.max(Math.floor(Math.min(...all) - .3), high - 5);
  c.strokeStyle = rule; c.fillStyle = ink; for (let d = low + 1; d <= high; d++) { c.beginPath(); c.arc(w / 2, h - 22, R * (d - low) / (high - low), Math.PI, 0); c.stroke(); }
  c.fillText('outermost ' + power(high) + ' /sr, rings are decades, \u03b8\u1d62 = ' + short(ti, 3) + '°', 8, h - 5);
  c.strokeStyle = ink; c.beginPath(); c.moveTo(...at(-ti, R)); c.lineTo(...at(0, 0)); c.stroke();
  for (const {colour, dash, line} of lines) { c.strokeStyle = colour; c.lineWidth = 2; c.setLineDash(dash); c.beginPath(); line.forEach(([t, y], k) => c[k ? 'lineTo' : 'moveTo'](...at(t, R * Math.max(0, (Math.min(y, high) - low) / (high - low))))); c.stroke(); c.setLineDash([]); }
}
function chart(ink, rule, A) {
  const m = waving(), w = m && wave(m), box = $('chart'); $('contour').hidden = !w || !S.contours;
  if (!w || !S.contours) return;
  const c = box.getContext('2d'), scale = devicePixelRatio || 1, W = box.clientWidth || 320, H = 220; box.width = W * scale; box.height = H * scale; c.scale(scale, scale); c.font = '12px system-ui, sans-serif';
  const X = s => 36 + (Math.log(s) - Math.log(.02)) / Math.log(25) * (W - 46), Y = s => H - 34 - (Math.log(s) - Math.log(.02)) / Math.log(250) * (H - 44);
  c.strokeStyle = rule; c.strokeRect(36, 10, W - 46, H - 44); c.fillStyle = ink;
  for (const s of [.02, .05, .1, .2, .5]) { c.textAlign = s > .02 ? 'center' : 'left'; c.fillText(s, X(s), H - 20); } for (const s of [.02, .1, .5, 2]) { c.textAlign = 'right'; c.fillText(s, 32, Y(s) + 4); }
  c.textAlign = 'left'; c.fillText('sigma [\u00b5m] over slope sigma/tau', 36, H - 5);
  c.strokeStyle = '#c1272d'; c.lineWidth = 2; c.beginPath(); for (let s = .02; s <= .5; s *= 1.05) c[s > .02 ? 'lineTo' : 'moveTo'](X(s), Y(crossing(state.angle, s, UM))); c.stroke();
  c.fillStyle = A; c.beginPath(); c.arc(X(w.slope.value[0]), Y(w.sigma.value[0]), 5, 0, 7); c.fill();
  const tau = w.sigma.value[0] / w.slope.value[0], formula = eq3(tau), there = crossing(state.angle, w.slope.value[0], UM);
  $('reading').textContent = (w.facets ? m.name + ': facets of slope alpha/2 = ' + short(w.slope.value[0]) + '; they show no mirror image, waves would. ' : '') + 'On the ' + short(state.angle) + '° contour at this slope: criterion sigma ' + short(there) + ' \u00b5m, tau ' + short(there / w.slope.value[0]) + ' \u00b5m' + (formula ? '; Eq. 3 at tau ' + short(tau) + ' \u00b5m: sigma ' + short(formula) + ' \u00b5m.' : '.');
  box.onpointermove = box.onpointerdown = e => { if (!e.buttons) return; const r = box.getBoundingClientRect(), slope = Math.exp((e.clientX - r.left - 36) / (W - 46) * Math.log(25) + Math.log(.02)), sigma = Math.exp((H - 34 - e.clientY + r.top) / (H - 44) * Math.log(250) + Math.log(.02));
    w.slope.set(Math.min(Math.max(slope, .02), .5), true); w.sigma.set(state.lock ? crossing(state.angle, w.slope.value[0], UM) : sigma, true); changed(m); }; box.onpointerup = () => draw(true);
  box.onkeydown = e => { const d = {ArrowRight: 1, ArrowLeft: -1, ArrowUp: 1, ArrowDown: -1}[e.key]; if (!d) return; e.preventDefault(); const k = e.shiftKey ? w.sigma : w.slope; state.lock ||= !e.shiftKey; $('lock').checked = state.lock;
    if (e.shiftKey) { state.lock = false; $('lock').checked = false; } k.set(k.value[0] * 1.03 ** d); draw(true); };
}

// ---- words, link, copying
const words = m => m.law + ' ' + m.knobs.map(k => k.key + '=' + k.value.map(v => short(v, 9)).join(',')).join(' ');
const documentOf = m => JSON.stringify({schema: 'brdfguide/fit/1', data: {channels: m.knobs.some(k => k.value.length > 1) ? ['R', 'G', 'B'] : ['550 nm'], wavelength_nm: m.knobs.some(k => k.value.length > 1) ? [650, 550, 450] : [550]},
  ranking: [{model: m.law, candidate: m.law, parameters: Object.fromEntries(m.knobs.map(k => [k.key, {value: k.value.length > 1 ? k.value : k.value[0]}]))}], recommended: m.law}, null, 1);
const yaml = m => { const box = {}, n = {albedo: 'diffuse_reflectance', alpha: 'roughness'};
  const put = (k, v) => { box[k] ??= v.length > 1 ? '[' + v.map(x => short(x, 7)).join(', ') + ']' : short(v[0], 7); };
  for (const k of m.knobs) { const end = k.key.split('.').at(-1); if (n[end]) put(n[end], k.value); }
  const of = end => m.knobs.find(k => k.key.split('.').at(-1) === end), s = of('sigma'), t = of('slope');
  if (box.roughness) box.in = 'alpha';
  if (of('n')) { box.kind = of('k') && of('k').value[0] > 0 ? 'metal' : 'dielectric'; box.index = '{n: ' + short(of('n').value[0], 7) + (of('k') && of('k').value[0] > 0 ? ', k: ' + short(of('k').value[0], 7) : '') + '}'; }
  if (s && t) box.stylus = '{sigma_um: ' + short(s.value[0], 7) + ', tau_um: ' + short(s.value[0] / t.value[0], 7) + '}';
  return '# of ' + m.law + ', as far as a description goes\n' + Object.entries({name: JSON.stringify(m.name), ...box}).map(e => e.join(': ')).join('\n') + '\n'; };
function say() {
  const m = S.models[state.a], e = error(m), other = S.models[state.b], f = evaluator(m, 0), at45 = f(...plane(45, 45));
  let half = 0; while (half < 80 && f(...plane(20, Math.min(20 + half, 89))) > .5 * f(...plane(20, 20))) half += .25;
  const seen = 'A ' + m.name + ': ' + short(at45, 3) + ' /sr in the mirror direction at 45°' + (half < 69 ? ', highlight half width ' + short(half, 3) + '°' : ', no highlight at 20°');
  const off = x => (x < Math.LN2 ? short(100 * Math.expm1(x), 2) + ' % off' : 'a factor ' + short(Math.exp(x), 2) + ' off'), exactly = x => ' (rms ln ' + x.toPrecision(4) + ')';
  const fit = e === null ? '' : '; A is typically ' + off(e) + ' the data' + exactly(e) + (other !== m ? ', B ' + off(error(other)) + exactly(error(other)) : '');
  $('says').textContent = seen + fit + '.'; canvas.setAttribute('aria-label', seen);
  if (e !== null) root.dataset.rms = e;
  $('text').value = state.copy === 'json' ? documentOf(m) : state.copy === 'yaml' ? yaml(m) : state.copy === 'export' ? 'brdfguide export ' + m.knobs.map(k => k.key + '=' + k.value.map(v => short(v, 9)).join(',')).join(' ') + ' --model "' + m.law + '" --to mitsuba -o surface.xml' : words(m);
}
function link() {
  const p = new URLSearchParams({a: state.a, b: state.b, wipe: state.wipe, mode: state.mode, light: state.light, object: state.object, angle: state.angle, lock: +state.lock});
  S.models.forEach((m, n) => m.knobs.forEach((k, j) => { if (String(k.value) !== String(m.fitted[j])) p.set(n + '.' + k.key, k.value.map(v => short(v, 7)).join(',')); }));
  try { history.replaceState(null, '', '#' + p); } catch { /* a page in a frame of its own */ }
}
function follows() {
  const p = new URLSearchParams(location.hash.slice(1)), number = (name, low, high, was) => { const x = parseFloat(p.get(name)); return x >= low && x <= high ? x : was; };
  state.a = Math.floor(number('a', 0, S.models.length - 1, state.a)); state.b = Math.floor(number('b', 0, S.models.length - 1, state.b));
  state.wipe = number('wipe', 0, 1, S.models.length > 1 ? .5 : 1); state.object = number('object', 0, 1, 0); state.angle = number('angle', 55, 88, 75); state.lock = p.get('lock') === '1';
  if (p.get('light') in S.lights) state.light = p.get('light'); if (p.get('mode') === 'difference') state.mode = 'difference';
  S.models.forEach((m, n) => m.knobs.forEach(k => { const text = p.get(n + '.' + k.key); if (!text) return; const given = text.split(',').map(Number);
    if ((given.length === 1 || given.length === 3) && given.every(v => v >= k.low && v <= k.high)) k.value = given; }));
}
let soon = 0;
function changed(m) { m.stale = true; root.dataset.done = 'no'; clearTimeout(soon); draw(false); plot(); soon = setTimeout(() => { say(); link(); }, 150); }
function again() { for (const m of S.models) m.stale = true; draw(true); plot(); say(); link(); }

S.models.forEach((m, n) => { for (const side of ['a', 'b']) $('pick-' + side).append(make('option', {value: n}, m.name)); });
for (const side of ['a', 'b']) $('pick-' + side).onchange = e => { state[side] = +e.target.value; fill(); again(); };
for (const name of ['light', 'mode']) $(name).onchange = e => { state[name] = e.target.value; again(); };
$('object').onchange = e => { state.object = +e.target.value; again(); };
$('wipe').oninput = e => { state.wipe = +e.target.value; draw(false); link(); }; $('wipe').onchange = () => draw(true);
canvas.onpointermove = canvas.onpointerdown = e => { if (!e.buttons || S.models.length < 2) return; const r = canvas.getBoundingClientRect(); state.wipe = Math.min(Math.max((e.clientX - r.left) / r.width, 0), 1); $('wipe').value = state.wipe; draw(false); };
$('lock').onchange = e => { state.lock = e.target.checked; const w = waving() && wave(waving()); if (w && state.lock) w.slope.set(w.slope.value[0]); draw(true); };
$('angle').onchange = e => { const x = +e.target.value; if (x >= 55 && x <= 88) state.angle = x; e.target.value = state.angle; const w = waving() && wave(waving()); if (w && state.lock) w.slope.set(w.slope.value[0]); plot(); draw(true); link(); };
$('reset').onclick = () => { S.models.forEach(m => m.knobs.forEach((k, j) => { k.value = [...m.fitted[j]]; })); fill(); again(); };
root.querySelectorAll('[data-copy]').forEach(b => { b.onclick = async () => { state.copy = b.dataset.copy; say(); $('text').select();
  try { await navigator.clipboard.writeText($('text').value); $('copied').textContent = 'copied'; } catch { $('copied').textContent = 'selected: press Ctrl-C'; } }; });
follows(); start();
$('card').textContent = gl ? '' : 'Drawn without the graphics card.';
$('light').value = state.light; $('mode').value = state.mode; $('object').value = state.object; $('wipe').value = state.wipe; $('angle').value = state.angle; $('lock').checked = state.lock;
fill(); plot(); say(); draw(true);
addEventListener('resize', plot);
for (const [event, on] of [['beforeprint', true], ['afterprint', false]]) addEventListener(event, () => { root.classList.toggle('paper', on); plot(); });
root.explorer = {state: S, choice: state, evaluator, values, crossing, error, words, documentOf, yaml, twins: TWINS,
  paint: m => { for (const _ of drawn(m, 1)); return root.explorer.pixels(m); },
  pixels: m => { const out = new Float32Array(4 * SIZE * SIZE); gl.bindFramebuffer(gl.FRAMEBUFFER, m.gl.radiance.frame); gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.FLOAT, out); return out; }};
})();
