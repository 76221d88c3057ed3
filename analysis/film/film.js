/* Draws a body at the instants of a film: its elements, from the far to the near ones, and its interfaces that have cracked. */
"use strict";
(() => {
const bytesOf = id => {
  const text = atob(document.getElementById(id).textContent.trim()), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
};
const film = JSON.parse(document.getElementById("film").textContent);
const {dimension, elements, corners, interfaces, ends} = film, nodes = elements * corners, last = film.instants.length - 1;
const start = new Float32Array(bytesOf("place")), side = new Uint32Array(bytesOf("side")), absent = 0xffffffff;
const around = corners === 6 ? [0, 3, 1, 4, 2, 5] : [...Array(corners).keys()]; /* nodes in the order of an outline */

/* ---- instants ---- */

const known = [];
function instant(i) {
  if (known[i]) return known[i];
  const bytes = bytesOf(`instant${i}`), label = new Uint32Array(bytes, 0, elements);
  const step = new Uint16Array(bytes, 4 * elements, nodes * dimension), moved = new Float32Array(3 * nodes);
  for (let n = 0; n < nodes; n++)
    for (let k = 0; k < dimension; k++) {
      const low = film.moved[2 * k], high = film.moved[2 * k + 1];
      moved[3 * n + k] = low + (high - low) * step[dimension * n + k] / 65535;
    }
  let at = 4 * elements + 2 * dimension * nodes;
  const damage = new Uint8Array(bytes, at, interfaces);
  at += interfaces;
  const value = film.values.map((_, v) => new Uint8Array(bytes, at + v * elements, elements));
  return known[i] = {label, moved, damage, value};
}

/* Whole parts: the fragment that goes through the seam of a periodic bar lies in two. */
function partsOf(label) {
  if (corners !== 2) return label;
  const at = n => [0, 1, 2].map(k => start[3 * n + k]), between = (a, b) => Math.hypot(...at(a).map((x, k) => x - at(b)[k]));
  const part = Uint32Array.from(label);
  for (let e = 1; e < elements; e++) part[e] = label[e] === label[e - 1] ? part[e - 1] : elements + e;
  const ring = label[0] === label[elements - 1] && between(0, 2 * elements - 1) < 1e-3 * between(0, 1), seam = part[elements - 1];
  return ring ? part.map(p => p === seam ? part[0] : p) : part;
}

/* Middle of each part before any motion, and that of the body. */
function middles(label) {
  const of = new Map(), all = [0, 0, 0, 0];
  for (let e = 0; e < elements; e++) {
    if (!of.has(label[e])) of.set(label[e], [0, 0, 0, 0]);
    for (const sum of [of.get(label[e]), all]) {
      for (let c = 0; c < corners; c++)
        for (let k = 0; k < 3; k++) sum[k] += start[3 * (e * corners + c) + k] / corners;
      sum[3]++;
    }
  }
  for (const sum of [...of.values(), all])
    for (let k = 0; k < 3; k++) sum[k] /= sum[3];
  return {of, all};
}

/* ---- what is set ---- */

const look = {at: 0, colour: "fragment", motion: 1, apart: 0, cracks: true, mesh: false, zoom: 1, pan: [0, 0], azimuth: 45, elevation: 35.264};

/* Places of all nodes: moved `motion` times as far, fragments `apart`. */
function places(i) {
  const {label, moved} = instant(i), at = new Float32Array(3 * nodes);
  for (let n = 0; n < 3 * nodes; n++) at[n] = start[n] + look.motion * moved[n];
  if (!look.apart) return at;
  const part = partsOf(label), {of, all} = middles(part);
  for (let e = 0; e < elements; e++) {
    const middle = of.get(part[e]);
    for (let c = 3 * e * corners; c < 3 * (e + 1) * corners; c++) at[c] += look.apart * (middle[c % 3] - all[c % 3]);
  }
  return at;
}

/* ---- projection ---- */

/* Directions to the right, upward and toward the reader. */
function view() {
  if (dimension === 2) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const a = look.azimuth * Math.PI / 180, h = look.elevation * Math.PI / 180;
  return [[-Math.sin(a), Math.cos(a), 0], [-Math.sin(h) * Math.cos(a), -Math.sin(h) * Math.sin(a), Math.cos(h)],
          [Math.cos(h) * Math.cos(a), Math.cos(h) * Math.sin(a), Math.sin(h)]];
}

const dot = (v, at, n) => v[0] * at[n] + v[1] * at[n + 1] + v[2] * at[n + 2];

/* The room that the body takes: that of its start, widened by the ranges of all displacements. */
const still = {low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity], reach: 0};
for (let n = 0; n < 3 * nodes; n++) {
  still.low[n % 3] = Math.min(still.low[n % 3], start[n]);
  still.high[n % 3] = Math.max(still.high[n % 3], start[n]);
}
for (let n = 0; n < 3 * nodes; n += 3)
  still.reach = Math.max(still.reach, Math.hypot(...[0, 1, 2].map(k => start[n + k] - (still.low[k] + still.high[k]) / 2)));
let room;
function measure() {
  const axes = [0, 1, 2], half = axes.map(k => (still.high[k] - still.low[k]) / 2);
  const moved = axes.map(k => k < dimension ? [0, 1].map(end => look.motion * film.moved[2 * k + end]) : [0, 0]);
  const low = axes.map(k => still.low[k] - look.apart * half[k] + Math.min(0, moved[k][0]));
  const high = axes.map(k => still.high[k] + look.apart * half[k] + Math.max(0, moved[k][1]));
  const middle = axes.map(k => (low[k] + high[k]) / 2), extent = axes.map(k => high[k] - low[k]);
  const beyond = axes.map(k => extent[k] / 2 - (1 + look.apart) * half[k]);
  room = {middle, extent, across: 2 * ((1 + look.apart) * still.reach + Math.max(...beyond))};
}

/* ---- colours ---- */

const dark = matchMedia("(prefers-color-scheme: dark)");
const stops = [[68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128], [94, 201, 98], [173, 220, 48], [253, 231, 37]];
const ramp = [...Array(256).keys()].map(v => {
  const at = v / 255 * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(at));
  return stops[k].map((c, i) => c + (stops[k + 1][i] - c) * (at - k));
});
const hues = new Map();
function hueOf(label) {
  const key = label + (dark.matches ? 0.5 : 0);
  if (!hues.has(key)) {
    let bits = label; /* mixed, so that labels of neighbours, as any, have colours apart */
    for (const by of [0x85ebca6b, 0xc2b2ae35]) bits = Math.imul(bits ^ bits >>> 15, by);
    bits = (bits ^ bits >>> 16) >>> 0;
    const h = (205 + bits % 360) % 360, s = 0.35 + 0.25 * (bits >>> 9 & 7) / 7, l = (dark.matches ? 0.36 : 0.62) + 0.16 * (bits >>> 20 & 15) / 15;
    const part = n => 255 * (l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min((n + h / 30) % 12 - 3, 9 - (n + h / 30) % 12, 1)));
    hues.set(key, [part(0), part(8), part(4)]);
  }
  return hues.get(key);
}
const css = (rgb, shade) => `rgb(${rgb.map(c => Math.round(c * shade)).join()})`;

/* ---- drawing ---- */

const part = (name, set = {}, ...inside) => {
  const element = Object.assign(document.createElement(name), set);
  element.append(...inside);
  return element;
};
const valued = () => film.values.findIndex(value => value.key === look.colour), head = () => valued() < 0 ? 8 : 52, foot = 36;
const canvas = part("canvas", {tabIndex: 0}), pen = canvas.getContext("2d"), stage = document.getElementById("stage");
canvas.setAttribute("role", "img");
Object.assign(canvas.style, {touchAction: "none", maxWidth: "100%"}); /* a finger turns the body */

/* Interfaces by the element at either of their sides. */
const sidesOf = Array.from({length: elements}, () => []);
for (let i = 0; i < interfaces; i++)
  for (let s = 0; s < 2; s++) {
    const first = side[(2 * i + s) * ends];
    if (first !== absent) sidesOf[Math.floor(first / corners)].push([i, s]);
  }

function resize() {
  const width = Math.max(280, stage.clientWidth), dots = devicePixelRatio || 1;
  const tall = dimension === 2 ? room.extent[1] / Math.max(room.extent[0], 1e-300) : 0.8;
  const height = Math.round(Math.max(150, Math.min(width * Math.min(tall, 1.2) + 60, innerHeight * 0.66)));
  canvas.style.width = width + "px";
  canvas.style.height = height + "px";
  canvas.width = Math.round(width * dots);
  canvas.height = Math.round(height * dots);
  return {width, height, dots};
}

/* Places in pixels, and how near to the reader. */
function project(at, size) {
  const [right, up, toward] = view(), x = new Float32Array(nodes), y = new Float32Array(nodes), near = new Float32Array(nodes);
  const wide = dimension === 2 ? room.extent[0] : room.across, high = dimension === 2 ? room.extent[1] : room.across;
  const scale = look.zoom * Math.min((size.width - 24) / Math.max(wide, 1e-300), (size.height - head() - foot - 12) / Math.max(high, wide * 1e-6));
  const mx = dot(right, room.middle, 0), my = dot(up, room.middle, 0);
  for (let n = 0; n < nodes; n++) {
    x[n] = size.width / 2 + look.pan[0] + scale * (dot(right, at, 3 * n) - mx);
    y[n] = (size.height + head() - foot) / 2 + look.pan[1] - scale * (dot(up, at, 3 * n) - my);
    near[n] = dot(toward, at, 3 * n);
  }
  return {x, y, near, scale};
}

/* Light of an element: less on its inner side, and where it turns away. */
function shadeOf(on, e) {
  if (dimension === 2 || corners === 2) return 1;
  const [a, b, c] = [0, 1, 2].map(i => e * corners + i), s = on.scale;
  const ux = on.x[b] - on.x[a], uy = on.y[a] - on.y[b], uz = s * (on.near[b] - on.near[a]);
  const vx = on.x[c] - on.x[a], vy = on.y[a] - on.y[c], vz = s * (on.near[c] - on.near[a]);
  const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx, facing = nz / (Math.hypot(nx, ny, nz) || 1);
  return facing < 0 ? 0.42 - 0.25 * facing : 0.5 + 0.5 * facing;
}

function outline(on, e) {
  pen.beginPath();
  if (corners === 2) { /* half a pixel longer, so that neighbours leave no gap */
    const a = 2 * e, dx = on.x[a + 1] - on.x[a], dy = on.y[a + 1] - on.y[a], l = 2 * Math.hypot(dx, dy) || 1;
    pen.moveTo(on.x[a] - dx / l, on.y[a] - dy / l);
    pen.lineTo(on.x[a + 1] + dx / l, on.y[a + 1] + dy / l);
    return;
  }
  around.forEach((c, k) => pen[k ? "lineTo" : "moveTo"](on.x[e * corners + c], on.y[e * corners + c]));
  pen.closePath();
}

/* One side of an interface: a line along it; in a chain across it. */
function drawSide(on, i, s, within) {
  const first = (2 * i + s) * ends, node = [...side.subarray(first, first + ends)];
  pen.beginPath();
  if (ends === 1) {
    const e = Math.floor(node[0] / corners), a = e * corners, dx = on.x[a + 1] - on.x[a], dy = on.y[a + 1] - on.y[a], l = Math.hypot(dx, dy) || 1;
    for (const way of [-1, 1]) { /* what has cracked alone is marked beside the body */
      pen.moveTo(on.x[node[0]] + way * within * dy / l, on.y[node[0]] - way * within * dx / l);
      pen.lineTo(on.x[node[0]] + way * 9 * dy / l, on.y[node[0]] - way * 9 * dx / l);
    }
  } else {
    node.sort((a, b) => (a % corners) - (b % corners)); /* a middle comes after the corners */
    const order = ends === 3 ? [node[0], node[2], node[1]] : node;
    order.forEach((n, k) => pen[k ? "lineTo" : "moveTo"](on.x[n], on.y[n]));
  }
  pen.stroke();
}

function drawSides(on, e, damage) {
  for (const [i, s] of sidesOf[e]) {
    if (!damage[i]) continue;
    pen.strokeStyle = damage[i] === 255 ? (dark.matches ? "#f0f3f6" : "#101418") : (dark.matches ? "#9aa4af" : "#77818c");
    pen.lineWidth = damage[i] === 255 ? 1 : 0.6;
    drawSide(on, i, s, damage[i] === 255 ? 0 : 6);
  }
}

function drawElements(now, on) {
  const order = Uint32Array.from({length: elements}, (_, e) => e), v = valued();
  if (dimension === 3) {
    const near = Float32Array.from({length: elements}, (_, e) => {
      let sum = 0;
      for (let c = 0; c < corners; c++) sum += on.near[e * corners + c];
      return sum;
    });
    order.sort((a, b) => near[a] - near[b]);
  }
  pen.lineJoin = "round";
  for (const e of order) {
    const shade = shadeOf(on, e), colour = v < 0 ? css(hueOf(now.label[e]), shade) : css(ramp[now.value[v][e]], 0.9 + 0.1 * shade);
    outline(on, e);
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = corners === 2 ? 10 : 0.6;
    if (corners > 2) pen.fill();
    if (look.mesh && corners > 2) pen.strokeStyle = dark.matches ? "#14181d" : "#ffffff";
    pen.stroke();
    if (look.cracks && dimension === 3) drawSides(on, e, now.damage);
  }
  if (look.cracks && dimension === 2)
    for (let e = 0; e < elements; e++) drawSides(on, e, now.damage);
}

const length = value => {
  const [unit, factor] = value >= 1 ? ["m", 1] : value >= 1e-3 ? ["mm", 1e-3] : value >= 1e-6 ? ["µm", 1e-6] : ["nm", 1e-9];
  return `${Number((value / factor).toPrecision(3))} ${unit}`;
};

const fragmentsNow = () => {
  const {fragments} = film.instants[look.at];
  return `${fragments} fragment${fragments === 1 ? "" : "s"}`;
};

/* A length, the instant, and the colours of values. */
function drawWords(size, scale) {
  const ink = dark.matches ? "#e6e9ed" : "#1b1f24", bottom = size.height - 10, most = size.width / 5 / scale;
  const power = 10 ** Math.floor(Math.log10(most)), bar = [5, 2, 1].find(n => n * power <= most) * power;
  pen.fillStyle = pen.strokeStyle = ink;
  pen.lineWidth = 1.5;
  pen.font = "13px system-ui, 'DejaVu Sans', sans-serif";
  pen.beginPath();
  pen.moveTo(10, bottom - 4);
  pen.lineTo(10, bottom);
  pen.lineTo(10 + bar * scale, bottom);
  pen.lineTo(10 + bar * scale, bottom - 4);
  pen.stroke();
  pen.textAlign = "left";
  pen.fillText(length(bar), 10, bottom - 8);
  pen.textAlign = "right";
  const said = [film.instants[look.at].text, fragmentsNow()];
  if (look.motion !== 1) said.push(`motion × ${look.motion}`);
  if (look.apart) said.push(`apart ${look.apart}`);
  pen.fillText(said.join(" · "), size.width - 10, bottom);
  const value = film.values[valued()];
  if (!value) return;
  const wide = Math.min(200, size.width / 2), left = size.width - 10 - wide;
  ramp.forEach((rgb, v) => {
    pen.fillStyle = css(rgb, 1);
    pen.fillRect(left + wide * v / 256, 24, wide / 256 + 0.5, 8);
  });
  pen.fillStyle = ink;
  pen.fillText(value.title, size.width - 10, 16);
  pen.fillText(value.high, size.width - 10, 46);
  pen.textAlign = "left";
  pen.fillText(value.low, left, 46);
}

let asked = 0, drawn = () => {};
function draw() {
  asked = 0;
  const size = resize(), now = instant(look.at), on = project(places(look.at), size);
  pen.setTransform(size.dots, 0, 0, size.dots, 0, 0);
  pen.fillStyle = dark.matches ? "#14181d" : "#ffffff";
  pen.fillRect(0, 0, size.width, size.height);
  drawElements(now, on);
  drawWords(size, on.scale);
  canvas.setAttribute("aria-label", `The body at ${film.instants[look.at].text}: ${fragmentsNow()}`);
  canvas.dataset.drawn = look.at;
  drawn();
}
const redraw = () => asked = asked || requestAnimationFrame(draw);

/* ---- controls ---- */

const button = (text, act) => {
  const made = part("button", {type: "button", textContent: text});
  made.addEventListener("click", act);
  return made;
};
function range(name, set, act) {
  const input = part("input", {type: "range", ...set}), said = part("output");
  input.setAttribute("aria-label", name);
  const show = () => said.textContent = act(Number(input.value));
  input.addEventListener("input", () => {
    show();
    redraw();
  });
  show();
  return [part("label", {}, name + " ", input, said), input, show];
}
function check(name, key) {
  const input = part("input", {type: "checkbox", checked: look[key]});
  input.addEventListener("change", () => {
    look[key] = input.checked;
    redraw();
  });
  return part("label", {}, input, " " + name);
}

measure();
const [, time, showTime] = range("Time", {min: 0, max: last, step: 1, value: last}, i => {
  look.at = i;
  return film.instants[i].text;
});
const timeSaid = part("output");
let timer = 0;
const play = button("Play", () => timer ? stop() : begin());
function go(i) {
  time.value = i;
  showTime();
  time.setAttribute("aria-valuetext", timeSaid.textContent = film.instants[i].text);
  redraw();
}
function stop() {
  clearInterval(timer);
  timer = 0;
  play.textContent = "Play";
}
function begin() {
  if (look.at === last) go(0);
  play.textContent = "Pause";
  timer = setInterval(() => look.at < last ? go(look.at + 1) : stop(), 120);
}
time.addEventListener("input", () => {
  stop();
  go(Number(time.value));
});

/* Motion times 1 to 1000: for bodies whose fragments hardly part. At first as far as nodes are moved apart by a tenth of the body. */
function visible() {
  const {moved} = instant(last), low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let n = 0; n < 3 * nodes; n++) {
    low[n % 3] = Math.min(low[n % 3], moved[n]);
    high[n % 3] = Math.max(high[n % 3], moved[n]);
  }
  const apart = Math.max(...high.map((h, k) => h - low[k]));
  return apart > 0 ? Math.round(20 * Math.max(0, Math.min(3, Math.log10(0.2 * still.reach / apart)))) / 20 : 0;
}
const [motion] = range("Motion", {min: 0, max: 3, step: 0.05, value: visible()}, power => {
  look.motion = Number((10 ** power).toPrecision(2));
  measure();
  return `× ${look.motion}`;
});
const [apart] = range("Apart", {min: 0, max: 1, step: 0.01, value: 0}, value => {
  look.apart = value;
  measure();
  return value ? String(value) : "no";
});
const colour = part("select", {}, ...[{key: "fragment", title: "fragment"}, ...film.values].map(of => part("option", {value: of.key, textContent: of.title})));
colour.addEventListener("change", () => {
  look.colour = colour.value;
  redraw();
});

function save(blob, name) {
  const link = part("a", {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
const name = () => `${film.stem}-${String(look.at + 1).padStart(String(last + 1).length, "0")}.png`;
const picture = button("Save picture", () => canvas.toBlob(blob => save(blob, name())));

/* Each instant is a frame, taken once it is drawn, and shown for a tenth of a second. */
async function record() {
  const stream = canvas.captureStream(0), frame = stream.getVideoTracks()[0], recorder = new MediaRecorder(stream), pieces = [];
  const wait = ms => new Promise(done => setTimeout(done, ms)), controls = stage.querySelectorAll("button,input,select");
  recorder.addEventListener("dataavailable", event => pieces.push(event.data));
  recorder.addEventListener("stop", () => save(new Blob(pieces, {type: recorder.mimeType}), film.stem + ".webm"));
  stop();
  controls.forEach(control => control.disabled = true);
  recorder.start();
  for (let i = 0; i <= last; i++) {
    go(i);
    await new Promise(done => drawn = done);
    (frame.requestFrame ? frame : stream).requestFrame();
    timeSaid.textContent = `recording ${i + 1} of ${last + 1}`;
    await wait(100);
  }
  await wait(300);
  recorder.stop();
  controls.forEach(control => control.disabled = false);
  go(last);
}
const video = window.MediaRecorder && canvas.captureStream ? [button("Save video", record)] : [];

/* ---- the pointer and the keys ---- */

const reset = () => {
  Object.assign(look, {zoom: 1, pan: [0, 0], azimuth: 45, elevation: 35.264});
  redraw();
};
const turn = (right, up) => {
  if (dimension === 2) look.pan = [look.pan[0] + right, look.pan[1] + up];
  else {
    look.azimuth -= right / 2;
    look.elevation = Math.max(-90, Math.min(90, look.elevation + up / 2));
  }
  redraw();
};
const zoom = factor => {
  const by = Math.max(0.2, Math.min(200, look.zoom * factor)) / look.zoom;
  look.zoom *= by;
  look.pan = look.pan.map(p => p * by);
  redraw();
};
canvas.addEventListener("pointermove", event => {
  if (!event.buttons) return;
  if (event.shiftKey && dimension === 3) {
    look.pan = [look.pan[0] + event.movementX, look.pan[1] + event.movementY];
    redraw();
  } else turn(event.movementX, event.movementY);
});
canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
canvas.addEventListener("wheel", event => {
  event.preventDefault();
  zoom(Math.exp(-event.deltaY / 500));
}, {passive: false});
canvas.addEventListener("dblclick", reset);
canvas.addEventListener("keydown", event => {
  const act = {ArrowLeft: () => turn(-20, 0), ArrowRight: () => turn(20, 0), ArrowUp: () => turn(0, -20), ArrowDown: () => turn(0, 20),
               "+": () => zoom(1.25), "-": () => zoom(0.8), "0": reset, " ": () => play.click()}[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});

const bar = (...inside) => part("div", {className: "play"}, ...inside);
stage.append(canvas, bar(play, time, timeSaid), bar(part("label", {}, "Colour ", colour), motion, apart, check("cracks", "cracks"),
             ...(corners > 2 ? [check("mesh", "mesh")] : []), button("Zoom in", () => zoom(1.25)), button("Zoom out", () => zoom(0.8)), button("Reset", reset),
             picture, ...video));
dark.addEventListener("change", redraw);
addEventListener("resize", redraw);
go(last);
})();
