'use strict';
// What all parts of the page share. Text from the run only ever enters through textContent.
const Dust = {data: JSON.parse(document.getElementById('run-data').textContent), redraw: [], later: []};

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

Object.assign(Dust, Numbers);

// The unit of all places of the page: one that suits the largest domain shown.
Dust.places = (() => {
  const domain = (Dust.data.setting || {}).domain || {};
  const edges = domain.min && domain.max ? domain.max.map((v, d) => v - domain.min[d]) : [];
  for (const {view} of [Dust.data, ...(Dust.data.runs || [])]) if (view) edges.push(view[2] - view[0], view[3] - view[1]);
  const extent = Math.max(0, ...edges.filter(Number.isFinite));
  Dust.set_extent(extent);
  return Dust.place_unit(extent);
})();
// A place [m] in that unit, without and with its name.
Dust.place_number = (metres, digits = 3) => Dust.number(metres / Dust.places.factor, digits);
Dust.place_text = (metres, digits = 3) => Dust.place_number(metres, digits) + '\u202f' + Dust.places.unit;
// With its depth where the domain is deep.
Dust.is_deep = () => Boolean(Dust.data.space && !Dust.data.space.is_thin);
Dust.place_xyz = ({x, y, z}) => (Dust.is_deep() && Number.isFinite(y) ? `x\u202f${Dust.place_number(x)}, y\u202f${Dust.place_number(y)}, z\u202f${Dust.place_text(z)}` : Dust.place_xz({x, z}));
Dust.place_xz = ({x, z}) => `x\u202f${Dust.place_number(x)}, z\u202f${Dust.place_text(z)}`;

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

// Saves text or a canvas as a file of the reader's.
Dust.save = (name, blob) => {
  const link = Dust.el('a', {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
};
Dust.save_canvas = (name, canvas) => {
  // On the paper of the theme: a picture without ground is of no use elsewhere.
  const copy = Dust.el('canvas', {width: canvas.width, height: canvas.height}), pen = copy.getContext('2d');
  pen.fillStyle = Dust.colour('paper');
  pen.fillRect(0, 0, copy.width, copy.height);
  pen.drawImage(canvas, 0, 0);
  copy.toBlob((blob) => Dust.save(name, blob));
};
Dust.file_name = (text) => text.toLowerCase().replace(/[^a-z0-9]+/g, '_').replace(/^_|_$/g, '') || 'figure';
// Columns of different length, RFC 4180.
Dust.csv = (heads, columns) => {
  const field = (v) => (v === null || v === undefined ? '' : /[",\n]/.test(String(v)) ? `"${String(v).replace(/"/g, '""')}"` : String(v));
  const rows = Math.max(...columns.map((c) => c.length), 0);
  const lines = [heads.map(field).join(',')];
  for (let k = 0; k < rows; ++k) lines.push(columns.map((c) => field(c[k])).join(','));
  return lines.join('\r\n') + '\r\n';
};
