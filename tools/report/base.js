'use strict';
// What all parts of the page share. Text from the run only ever enters through textContent.
const Dust = {data: JSON.parse(document.getElementById('run-data').textContent), redraw: []};

Dust.fail = (error) => {
  const root = document.documentElement;
  root.dataset.errors = (root.dataset.errors ? root.dataset.errors + ' | ' : '') + error;
};
window.addEventListener('error', (event) => Dust.fail(event.message));
window.addEventListener('unhandledrejection', (event) => Dust.fail(event.reason));

Dust.el = (tag, attributes = {}, ...children) => {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === 'style') node.style.cssText = value;
    else if (key === 'class') node.className = value;
    else node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
};

// Bytes of a blob: base64 of a zlib stream.
Dust.unpack = async (text) => {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

// Theme: the reader's system decides until the button does; paper is always light.
Dust.theme = () => document.documentElement.dataset.theme;
Dust.colour = (name) => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
Dust.set_theme = (theme) => {
  document.documentElement.dataset.theme = theme;
  const button = document.getElementById('theme');
  button.hidden = false;
  button.textContent = theme === 'dark' ? 'Light' : 'Dark';
  for (const draw of Dust.redraw) draw();
};

// Numbers as on paper: a true minus, four digits, powers of ten raised by Unicode.
Dust.number = (value, digits = 4) => {
  if (value === null || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    const raised = String(+exponent).replace('-', '⁻').replace(/\d/g, (d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]);
    return String(+mantissa).replace('-', '−') + ' × 10' + raised;
  }
  return String(+value.toPrecision(digits)).replace('-', '−');
};
Dust.count = (value) => String(value).replace(/\B(?=(\d{3})+$)/g, '\u202f');
Dust.words = (name) => String(name).replace(/_/g, ' ').replace(/ um(?=$|\W)/g, ' µm').replace(/(\w)\/(\w)/g, '$1 / $2');
Dust.sentence = (name) => Dust.words(name).replace(/^./, (c) => c.toUpperCase());

// The unit that reads best for numbers up to `largest`: {factor, unit}.
Dust.scale = (unit, largest) => {
  const ladder = {
    'm': [['m', 1], ['mm', 1e-3], ['µm', 1e-6]],
    's': [['s', 1], ['ms', 1e-3]],
    'kg': [['kg', 1], ['g', 1e-3], ['mg', 1e-6], ['µg', 1e-9], ['ng', 1e-12]],
    'kg/s': [['kg/s', 1], ['g/s', 1e-3], ['mg/s', 1e-6], ['µg/s', 1e-9], ['ng/s', 1e-12]],
    'kg/m3': [['kg/m³', 1], ['g/m³', 1e-3], ['mg/m³', 1e-6], ['µg/m³', 1e-9], ['ng/m³', 1e-12]],
    'J': [['J', 1], ['mJ', 1e-3], ['µJ', 1e-6], ['nJ', 1e-9]],
  }[unit];
  if (!ladder) return {factor: 1, unit: unit.replace(/m3/g, 'm³').replace(/m2/g, 'm²').replace(/s2/g, 's²')};
  for (const [name, factor] of ladder) {
    // Lengths of the picture's size read better in mm.
    if (largest >= factor || name === ladder.at(-1)[0]) return {factor, unit: name};
  }
  return {factor: 1, unit};
};

// Round steps for about `wanted` ticks in [low, high].
Dust.ticks = (low, high, wanted) => {
  const rough = (high - low) / Math.max(wanted, 1);
  if (!(rough > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= rough * 0.999);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) list.push(+(k * step).toPrecision(12));
  return list;
};

// A canvas true to scale over a part of the x-z plane, with axes in mm. `paint(pen)` draws inside.
Dust.Picture = class {
  constructor(parent, label, paint) {
    this.paint = paint;
    this.whole = Dust.data.view;
    this.view = [...this.whole];
    this.canvas = Dust.el('canvas', {role: 'img', 'aria-label': label});
    parent.append(this.canvas);
    this.parent = parent;
    // Drawn in the next frame: a canvas that changes its own box must not do so inside the observer.
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(parent);
    Dust.redraw.push(() => this.draw());
  }
  draw() {
    const left = 44, bottom = 34, right = 6, top = 6;
    const [x0, z0, x1, z1] = this.view;
    const whole = this.whole;
    const width = this.parent.clientWidth;
    if (width < 80) return;
    let inner = width - left - right;
    let height = inner * (whole[3] - whole[1]) / (whole[2] - whole[0]);
    const tallest = Math.max(300, Math.min(window.innerHeight * 0.95, 820));
    const shrink = Math.min(1, tallest / height);
    inner *= shrink;
    height *= shrink;
    const ratio = Math.min(window.devicePixelRatio || 1, 3);
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round((height + top + bottom) * ratio);
    this.canvas.style.aspectRatio = `${width} / ${height + top + bottom}`;  // keeps its shape on paper
    const pen = this.canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height + top + bottom);
    const scale = inner / (x1 - x0);
    this.place = {left, top, inner, height, scale};
    this.x = (x) => left + (x - x0) * scale;
    this.z = (z) => top + (z1 - z) * scale;
    pen.save();
    pen.beginPath();
    pen.rect(left, top, inner, height);
    pen.clip();
    this.paint(pen, this);
    pen.restore();
    this.axes(pen);
  }
  axes(pen) {
    const {left, top, inner, height} = this.place;
    const [x0, z0, x1, z1] = this.view;
    pen.strokeStyle = Dust.colour('line');
    pen.lineWidth = 1;
    pen.strokeRect(left - 0.5, top - 0.5, inner + 1, height + 1);
    pen.fillStyle = Dust.colour('soft');
    pen.font = '11px ' + Dust.colour('sans');
    pen.textAlign = 'center';
    pen.textBaseline = 'top';
    for (const x of Dust.ticks(x0 * 1e3, x1 * 1e3, inner / 70)) {
      const at = this.x(x / 1e3);
      pen.fillRect(at - 0.5, top + height, 1, 4);
      if (at < left + inner - 48) pen.fillText(Dust.number(x), at, top + height + 7);
    }
    pen.textAlign = 'right';
    pen.fillText('x, mm', left + inner, top + height + 7);
    pen.textBaseline = 'middle';
    for (const z of Dust.ticks(z0 * 1e3, z1 * 1e3, height / 60)) {
      const at = this.z(z / 1e3);
      pen.fillRect(left - 5, at - 0.5, 4, 1);
      if (at > top + 24) pen.fillText(Dust.number(z), left - 8, Math.min(at, top + height - 5));
    }
    pen.textBaseline = 'top';
    pen.fillText('z, mm', left - 8, top);
  }
  bodies(pen) {
    pen.fillStyle = Dust.colour('body');
    pen.strokeStyle = Dust.colour('body-line');
    pen.lineWidth = 1.2;
    pen.lineJoin = 'round';
    for (const body of Dust.data.bodies) {
      for (const ring of body.polygons) {
        pen.beginPath();
        ring.forEach(([x, z], k) => (k ? pen.lineTo(this.x(x), this.z(z)) : pen.moveTo(this.x(x), this.z(z))));
        pen.closePath();
        pen.fill();
        pen.stroke();
      }
      pen.beginPath();
      for (const [xa, za, xb, zb] of body.segments) {
        pen.moveTo(this.x(xa), this.z(za));
        pen.lineTo(this.x(xb), this.z(zb));
      }
      pen.stroke();
      const flat = body.triangles;
      pen.beginPath();
      for (let k = 0; k + 5 < flat.length; k += 6) {
        pen.moveTo(this.x(flat[k]), this.z(flat[k + 1]));
        pen.lineTo(this.x(flat[k + 2]), this.z(flat[k + 3]));
        pen.lineTo(this.x(flat[k + 4]), this.z(flat[k + 5]));
        pen.closePath();
      }
      if (flat.length) pen.fill();
    }
  }
  // Double-click looks closer, dragging moves; `whole_view` undoes both.
  make_zoomable() {
    const canvas = this.canvas;
    const point = (event) => {
      const box = canvas.getBoundingClientRect();
      const {left, top, scale} = this.place;
      return [this.view[0] + (event.clientX - box.left - left) / scale,
        this.view[3] - (event.clientY - box.top - top) / scale];
    };
    const show = (x0, z0, factor) => {
      const [w0, w1, w2, w3] = this.whole;
      const width = (w2 - w0) * factor, height = (w3 - w1) * factor;
      x0 = Math.min(Math.max(x0, w0), w2 - width);
      z0 = Math.min(Math.max(z0, w1), w3 - height);
      this.view = [x0, z0, x0 + width, z0 + height];
      this.draw();
    };
    const factor = () => (this.view[2] - this.view[0]) / (this.whole[2] - this.whole[0]);
    canvas.addEventListener('dblclick', (event) => {
      const [x, z] = point(event);
      const f = Math.max(factor() / 2.2, 1 / 60);
      const [a, b, c, d] = this.whole;
      show(x - (c - a) * f / 2, z - (d - b) * f / 2, f);
    });
    let start = null;
    canvas.addEventListener('pointerdown', (event) => {
      if (factor() < 0.999) {
        start = {x: event.clientX, y: event.clientY, view: [...this.view]};
        canvas.setPointerCapture(event.pointerId);
      }
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!start) return;
      const {scale} = this.place;
      show(start.view[0] - (event.clientX - start.x) / scale, start.view[1] + (event.clientY - start.y) / scale, factor());
    });
    canvas.addEventListener('pointerup', () => { start = null; });
    this.whole_view = () => {
      this.view = [...this.whole];
      this.draw();
    };
  }
};
