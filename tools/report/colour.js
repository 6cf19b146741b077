'use strict';
// Colour maps with even steps of perceived lightness: straight paths in the OKLCH colour space
// (Ottosson 2020), so that equal differences of the field look equally large.
Dust.oklch = (lightness, chroma, hue) => {
  const h = hue * Math.PI / 180;
  const mix = (c) => {
    const a = c * Math.cos(h), b = c * Math.sin(h);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
      -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
      -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  };
  // Colours a screen cannot show lose chroma, never lightness.
  let rgb = mix(chroma);
  for (let k = 0; k < 24 && rgb.some((v) => v < -0.001 || v > 1.001); ++k) rgb = mix(chroma *= 0.92);
  return rgb.map((v) => {
    v = Math.min(Math.max(v, 0), 1);
    return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
  });
};

// 0 at the paper's tone, 1 at the far end.
Dust.speed_colour = (t) => (Dust.theme() === 'dark'
  ? Dust.oklch(0.21 + 0.72 * t, 0.012 + 0.13 * Math.sin(Math.PI * Math.min(1, 0.85 * t)), 285 - 190 * t)
  : Dust.oklch(0.985 - 0.68 * t, 0.004 + 0.13 * Math.sin(Math.PI * Math.min(1, 0.8 * t)), 130 + 150 * t));

// t in [-1, 1]: low pressure blue, zero the paper's tone, high pressure red.
Dust.pressure_colour = (t) => {
  const size = Math.abs(t), hue = t < 0 ? 255 : 40;
  return Dust.theme() === 'dark' ? Dust.oklch(0.22 + 0.58 * size, 0.16 * size ** 0.8, hue)
    : Dust.oklch(0.985 - 0.55 * size, 0.17 * size ** 0.8, hue);
};

// Coarse grains: sand tones, fine ones light.
Dust.sand_colour = (t) => (Dust.theme() === 'dark' ? Dust.oklch(0.9 - 0.36 * t, 0.07 + 0.05 * t, 88 - 38 * t)
  : Dust.oklch(0.84 - 0.44 * t, 0.075 + 0.04 * t, 86 - 42 * t));

// Speed of grains: from violet to yellow, apart from the greens and blues of the air behind them.
Dust.grain_speed_colour = (t) => (Dust.theme() === 'dark' ? Dust.oklch(0.5 + 0.42 * t, 0.17, 300 + 150 * t)
  : Dust.oklch(0.36 + 0.42 * t, 0.17, 300 + 130 * t));

// Amounts of dust, and of dust that comes off the load; both logarithmic.
Dust.dust_colour = (t) => (Dust.theme() === 'dark' ? Dust.oklch(0.24 + 0.6 * t, 0.03 + 0.17 * t, 350 - 20 * t)
  : Dust.oklch(0.97 - 0.55 * t, 0.015 + 0.2 * t, 350 + 10 * t));
Dust.release_colour = (t) => (Dust.theme() === 'dark' ? Dust.oklch(0.24 + 0.6 * t, 0.03 + 0.15 * t, 60 - 20 * t)
  : Dust.oklch(0.97 - 0.5 * t, 0.015 + 0.16 * t, 70 - 30 * t));

Dust.css = (rgb) => `rgb(${rgb[0]},${rgb[1]},${rgb[2]})`;

// The 256 colours of a map as RGBA bytes; 255 is a masked cell and stays clear.
Dust.colour_table = (colour_of, low) => {
  const bytes = new Uint8ClampedArray(1024);
  for (let k = 0; k < 255; ++k) bytes.set([...colour_of(low + (1 - low) * k / 254), 255], 4 * k);
  return bytes;
};

// A legend strip over [from, to] with round numbers below; the colours span [low, 1]. `place_of` maps a
// share of the range to its place on the strip.
Dust.legend_strip = (parent, colour_of, low, from, to, unit, place_of = (share) => share, is_lasting = true) => {
  const canvas = Dust.el('canvas', {width: 256, height: 1});
  if (unit === 'm/s' && to < 0.02) [from, to, unit] = [from * 1e3, to * 1e3, 'mm/s'];
  const ticks = Dust.ticks(from, to, 5).concat(place_of(0.25) > 0.4 ? Dust.ticks(from, to / 20, 1).slice(1, 2) : []).sort((a, b) => a - b);
  // A tick that would run into the one before is left out.
  const width = (parent.clientWidth || 220) - 80;
  let free = -Infinity;
  const labels = ticks.flatMap((value) => {
    const place = place_of((value - from) / (to - from)), text = Dust.number(value), half = (3.4 * text.length + 3) / width;
    if (place - half < free) return [];
    free = place + half;
    return [Dust.el('span', {style: `left:${100 * place}%`}, text)];
  });
  const ends = Dust.el('div', {class: 'ends'}, ...labels, Dust.el('span', {class: 'name'}, unit));
  parent.replaceChildren(Dust.el('div', {class: 'scale'}, canvas, ends));
  const draw = () => {
    const pen = canvas.getContext('2d');
    for (let k = 0; k < 256; ++k) {
      pen.fillStyle = Dust.css(colour_of(low + (1 - low) * k / 255));
      pen.fillRect(k, 0, 1, 1);
    }
  };
  if (is_lasting) Dust.redraw.push(draw);  // others are made anew with each drawing
  draw();
};
