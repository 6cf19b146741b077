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
Dust.words = (name) => String(name).replace(/_/g, ' ').replace(/ um(?=$|\W)/g, ' µm').replace(/(\w)\/([a-z]{3,})/g, '$1 / $2');  // m/s stays
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
