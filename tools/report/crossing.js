'use strict';
// Two parameters of a calibration: where each target is met, the confidence region, the runs and the likeliest values.
// Contours by d3-contour.
Dust.crossing = ({axes, per_direction: n, fields, region, points}, confidence) => {
  const {el} = Dust, [x, y] = axes;
  const holder = el('div', {class: 'picture'}), canvas = el('canvas', {role: 'img',
    'aria-label': `Contours over ${x.name} and ${y.name}; likeliest ${Dust.number(x.best)} and ${Dust.number(y.best)}`});
  holder.append(canvas);
  const key = el('div', {class: 'legend'});
  const label = (axis) => (Dust.is_bare(axis.unit) ? Dust.words(axis.name) : `${Dust.words(axis.name)}, ${axis.unit}`);
  const lines = (values, level) => d3.contours().size([n, n]).thresholds([level])(values)[0].coordinates.flat();
  const colours = ['plot2', 'plot3', 'plot5', 'plot4', 'plot6'];
  const with_unit = (value, unit) => Dust.number(value) + (Dust.is_bare(unit) ? '' : '\u202f' + unit);
  const reading = el('span', {class: 'reading'});
  let place_of = () => null;
  const draw = () => {
    const width = holder.clientWidth, ratio = Math.min(devicePixelRatio || 1, 3);
    if (width < 80) return;
    const left = 58, bottom = 44, right = 10, top = 10, inner = width - left - right, height = inner * 0.75;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round((height + top + bottom) * ratio);
    canvas.style.aspectRatio = `${width} / ${height + top + bottom}`;
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = Dust.colour('raised');
    pen.fillRect(left, top, inner, height);
    const px = (v) => left + inner * (v - x.low) / (x.high - x.low), py = (v) => top + height * (1 - (v - y.low) / (y.high - y.low));
    // d3 puts value k at k + 1/2; the first and the last stand on the ends of the interval.
    const place = ([i, j]) => [left + inner * (i - 0.5) / (n - 1), top + height * (1 - (j - 0.5) / (n - 1))];
    const path = (rings) => {
      pen.beginPath();
      for (const ring of rings) ring.forEach((c, k) => (k ? pen.lineTo(...place(c)) : pen.moveTo(...place(c))));
    };
    pen.save();
    pen.beginPath();
    pen.rect(left, top, inner, height);
    pen.clip();
    // Contours enclose what is above a level: the region is where the negative is.
    path(lines(region.values.map((v) => -v), -region.level));
    pen.fillStyle = Dust.colour('accent');
    pen.globalAlpha = 0.18;
    pen.fill('evenodd');
    pen.globalAlpha = 1;
    fields.forEach((field, k) => {
      pen.strokeStyle = Dust.colour(colours[k % colours.length]);
      for (const [level, thick] of [[field.level, 2.2], [field.level - field.error, 0.9], [field.level + field.error, 0.9]]) {
        pen.lineWidth = thick;
        path(lines(field.values, level));
        pen.stroke();
      }
    });
    pen.fillStyle = Dust.colour('soft');
    for (const [a, b] of points) {
      pen.beginPath();
      pen.arc(px(a), py(b), 2.4, 0, 6.2832);
      pen.fill();
    }
    pen.strokeStyle = Dust.colour('ink');
    pen.lineWidth = 2;
    pen.beginPath();
    pen.moveTo(px(x.best) - 7, py(y.best));
    pen.lineTo(px(x.best) + 7, py(y.best));
    pen.moveTo(px(x.best), py(y.best) - 7);
    pen.lineTo(px(x.best), py(y.best) + 7);
    pen.stroke();
    pen.restore();
    // The contours close along the frame: the frame covers that.
    pen.lineWidth = 2;
    pen.strokeStyle = Dust.colour('line');
    pen.strokeRect(left, top, inner, height);
    pen.fillStyle = Dust.colour('soft');
    pen.font = '11px ' + Dust.colour('sans');
    pen.textAlign = 'center';
    pen.textBaseline = 'top';
    for (const v of Dust.ticks(x.low, x.high, inner / 80)) pen.fillText(Dust.number(v), px(v), top + height + 6);
    pen.fillText(label(x), left + inner / 2, top + height + 24);
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    for (const v of Dust.ticks(y.low, y.high, height / 60)) pen.fillText(Dust.number(v), left - 6, py(v));
    pen.save();
    pen.translate(12, top + height / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = 'center';
    pen.fillText(label(y), 0, 0);
    pen.restore();
    place_of = (event) => {
      const box = canvas.getBoundingClientRect();
      const a = (event.clientX - box.left - left) / inner, b = 1 - (event.clientY - box.top - top) / height;
      return a >= 0 && a <= 1 && b >= 0 && b <= 1 ? [a, b] : null;
    };
    key.replaceChildren(...fields.map((field, k) => {
      const mark = el('i', {class: 'line'});
      mark.style.background = Dust.colour(colours[k % colours.length]);
      return el('span', {}, mark, `${Dust.words(field.name)} = ${with_unit(field.level, field.unit)}`);
    }), reading);
  };
  // The values of the surrogate under the pointer.
  canvas.addEventListener('pointermove', (event) => {
    const at = place_of(event);
    if (!at) return void (reading.textContent = '');
    const [i, j] = at.map((share) => Math.round(share * (n - 1)));
    const here = [x, y].map((axis, d) => `${Dust.words(axis.name)} ${with_unit(axis.low + at[d] * (axis.high - axis.low), axis.unit)}`);
    reading.textContent = [...here, ...fields.map((field) => `${Dust.words(field.name)} ${with_unit(field.values[j * n + i], field.unit)}`)].join(', ');
  });
  canvas.addEventListener('pointerleave', () => { reading.textContent = ''; });
  new ResizeObserver(() => requestAnimationFrame(draw)).observe(holder);
  Dust.redraw.push(draw);
  const as_png = el('button', {type: 'button', 'aria-label': 'Crossing of the contours as PNG'}, 'PNG');
  as_png.addEventListener('click', () => Dust.save_canvas('crossing.png', canvas));
  // The lattice of the surrogate, row by row.
  const as_csv = el('button', {type: 'button', 'aria-label': 'Numbers of the crossing of the contours as CSV'}, 'CSV');
  as_csv.addEventListener('click', () => {
    const at = (axis, k) => axis.low + k / (n - 1) * (axis.high - axis.low), cells = Array.from({length: n * n}, (_, k) => k);
    Dust.save('crossing.csv', new Blob([Dust.csv([label(x), label(y), ...fields.map((f) => label(f))],
      [cells.map((k) => at(x, k % n)), cells.map((k) => at(y, Math.floor(k / n))), ...fields.map((f) => f.values)])], {type: 'text/csv'}));
  });
  return el('figure', {style: 'max-width:640px;margin-top:28px'}, holder, key, el('figcaption', {}, el('b', {}, 'Where the contours cross.'),
    ` Thick: where the surrogate meets a target; thin: one standard error to either side. Shaded: the confidence region of ${Dust.number(100 * confidence)}\u202f%. Dots: runs; cross: the likeliest values.`),
  el('div', {class: 'downloads screen'}, as_csv, as_png));
};
