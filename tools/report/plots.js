'use strict';
// Plots with uPlot, for any page. `Dust.plot(parent, {title, sensor, x_label, y_label, unit, note, lines})` adds one
// figure; lines: [{name, x, y, low, high, no_error, kind, bars, colour, dash, width}] with x ascending, null for a gap. `low`
// and `high` are a band, or bars with `bars`, where the kind is 'points' or marks have no error; a 'reference' is dashed and stands behind.
// `no_error`: why a mark has no error, '' where it has one; such marks are hollow.
// `band: [n, m]` fills between two of the lines. `path: true` lets x run down and y to the right, both in `unit` and true
// to scale; `caption` and `beside` (nodes) then stand at its side. `Dust.readable_plot` takes numbers in SI units and
// shows them in the unit that reads best.
(() => {
  const ink_of = (k) => Dust.colour('plot' + (k % 6 + 1));
  const flat_height = 246;
  // Labels of an axis of decades: the powers of ten.
  const decades = (u, splits) => splits.map((v) => (v > 0 && Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-6 ? Dust.number(v) : ''));
  // Why marks of a line have no error, by their x.
  const reasons = (line) => new Map((line.no_error || []).map((why, k) => [line.x[k], why]));
  // Between marks without an error a band would have gaps, and leave out a mark between two such.
  const has_bars = (line) => Boolean(line.low) && (line.bars || line.kind === 'points' || (line.no_error || []).some(Boolean));

  const bars_hook = (bars, is_path) => (u) => {
    const pen = u.ctx;
    for (const {at, colour} of bars) {
      pen.strokeStyle = colour;
      pen.lineWidth = (is_path ? 3 : 1.4) * devicePixelRatio;
      pen.beginPath();
      for (let k = 0; k < u.data[0].length; ++k) {
        const low = u.data[at + 1][k], high = u.data[at + 2][k];
        if (low === null || low === undefined || high === null || high === undefined) continue;
        const along = u.valToPos(u.data[0][k], 'x', true), from = u.valToPos(low, 'y', true), to = u.valToPos(high, 'y', true);
        pen.moveTo(...(is_path ? [from, along] : [along, from]));
        pen.lineTo(...(is_path ? [to, along] : [along, to]));
      }
      pen.stroke();
    }
  };

  // Hollow marks over those that uPlot has filled.
  const hollow_hook = (lines, places, series, is_path) => (u) => {
    const pen = u.ctx;
    lines.forEach((line, n) => {
      const {stroke, points} = series[places[n]];
      const why = reasons(line);
      for (let k = 0; k < u.data[0].length; ++k) {
        const value = u.data[places[n]][k];
        if (!why.get(u.data[0][k]) || value === null || value === undefined) continue;
        const along = u.valToPos(u.data[0][k], 'x', true), up = u.valToPos(value, 'y', true);
        pen.beginPath();
        pen.arc(...(is_path ? [up, along] : [along, up]), devicePixelRatio * (points.size / 2 + 0.6), 0, 2 * Math.PI);
        pen.fillStyle = Dust.colour('paper');
        pen.fill();
        pen.strokeStyle = stroke;
        pen.lineWidth = 1.6 * devicePixelRatio;
        pen.stroke();
      }
    });
  };

  // What uPlot needs of the lines: series with their bands and bars, and an entry of the key for each.
  const dressed = (lines, band) => {
    const series = [{}], bands = [], bars = [], keys = [], places = [];
    let inks = 0;
    for (const line of lines) {
      const is_reference = line.kind === 'reference', is_points = line.kind === 'points';
      const colour = line.colour ? Dust.colour(line.colour) : is_reference ? Dust.colour('soft') : ink_of(inks++);
      const few = line.x.length < 40, dash = line.dash || (is_reference ? [6, 4] : undefined);
      const at = series.length;
      places.push(at);
      series.push({label: line.name, stroke: colour, width: is_points ? 0 : line.width || 1.6, spanGaps: false,
        dash, points: {show: is_points || (few && !is_reference), size: is_points ? 7 : 5, fill: colour}});
      if (line.low) {
        series.push({stroke: 'transparent', width: 0, points: {show: false}}, {stroke: 'transparent', width: 0, points: {show: false}});
        if (has_bars(line)) bars.push({at, colour: line.bars ? colour + '99' : colour});
        else bands.push({series: [at + 2, at + 1], fill: colour + '33'});
      }
      const swatch = Dust.el('i', {class: 'line' + (dash ? ' dashed' : '')});
      swatch.style.background = dash ? `repeating-linear-gradient(90deg, ${colour} 0 ${dash[0]}px, transparent ${dash[0]}px ${dash[0] + dash[1]}px)` : colour;
      keys.push(Dust.el('span', {}, swatch, Dust.words(line.name)));
    }
    if (band) bands.push({series: [places[band[1]], places[band[0]]], fill: Dust.colour('tone1') + '47'});
    return {series, bands, bars, keys, places};
  };

  // Size of a path true to scale in the room there is, and its scales.
  const path_layout = (lines, room) => {
    const numbers = (key) => lines.flatMap((line) => line[key]).filter(Number.isFinite);
    const deepest = Math.max(...numbers('x')) * 1.06, left = Math.min(0, ...numbers('y')), right = Math.max(...numbers('y'), 1e-9) * 1.06;
    const sides = 66 + 18, ends = 46 + 10, tallest = 620;
    const inner = Math.min(room - sides, tallest * (right - left) / deepest);
    return {width: inner + sides, height: inner * deepest / (right - left) + ends, x: [0, deepest], y: [left, right]};
  };

  Dust.plot = (parent, {title = '', sensor = '', x_label: named_x = '', y_label = '', unit = '', note = '', lines, band = null, path = false, caption = null, beside = []}) => {
    const x_label = named_x.replace(/^[^,]*/, Dust.words);  // the unit behind the comma stays
    const holder = Dust.el('div', {class: 'plot', role: 'img', 'aria-label': `${Dust.sentence(title)}: ${y_label} against ${x_label}`});
    const words = Dust.el('figcaption', {}, Dust.el('b', {}, Dust.sentence(title) + '.'), ...(caption || [
      ` ${Dust.sentence(y_label)}`, x_label ? ` against ${x_label}.` : '.', sensor ? ` Sensor ${Dust.words(sensor)}.` : '', note ? ' ' + note.trim() : '']));
    const has_errors = (line) => Boolean(line.low) && line.low.some((v, k) => Number.isFinite(v) && v !== line.y[k]);
    if (lines.some((line) => has_errors(line) && !has_bars(line))) words.append(' Band: one standard error to either side.');
    if (lines.some((line) => has_errors(line) && has_bars(line))) words.append(' Bars: one standard error to either side.');
    const doubts = [...new Set(lines.flatMap((line) => line.no_error || []).filter(Boolean).map((why) => why.replace(/^\d+ of \d+ /, '')))];
    if (doubts.length) words.append(` Hollow marks: ${doubts.join('; ')}.`);
    const key = Dust.el('div', {class: 'legend', 'aria-hidden': lines.length > 1 ? 'false' : 'true'});
    const file = Dust.file_name(sensor + ' ' + title);
    const as_csv = Dust.el('button', {type: 'button', 'aria-label': `Numbers of ${Dust.sentence(title)} as CSV`}, 'CSV');
    as_csv.addEventListener('click', () => {
      const heads = lines.flatMap((line) => [`${line.name}: ${x_label}`, `${line.name}: ${y_label}${unit && !y_label.includes(unit) ? ', ' + unit : ''}`,
        ...(line.low ? [`${line.name}: low`, `${line.name}: high`] : []), ...((line.no_error || []).some(Boolean) ? [`${line.name}: no error`] : [])]);
      const columns = lines.flatMap((line) => [line.x, line.y, ...(line.low ? [line.low, line.high] : []), ...((line.no_error || []).some(Boolean) ? [line.no_error] : [])]);
      Dust.save(file + '.csv', new Blob([Dust.csv(heads, columns)], {type: 'text/csv'}));
    });
    const as_png = Dust.el('button', {type: 'button', 'aria-label': `Picture of ${Dust.sentence(title)} as PNG`}, 'PNG');
    as_png.addEventListener('click', () => Dust.save_canvas(file + '.png', holder.querySelector('canvas')));
    const downloads = Dust.el('div', {class: 'downloads screen'}, as_csv, as_png);
    parent.append(path ? Dust.el('figure', {class: 'side'}, Dust.el('div', {}, holder, key, downloads), Dust.el('div', {}, words, ...beside))
      : Dust.el('figure', {}, Dust.el('div', {class: 'axis-unit'}, Dust.el('bdi', {}, unit)), holder, key, words, downloads));

    const data = uPlot.join(lines.map((line) => [line.x, line.y, ...(line.low ? [line.low, line.high] : [])]));
    const is_geometric = !path && lines.every((line) => Dust.is_geometric(line.x));  // classes of equal ratio: an axis of decades
    const size_of = () => (path ? path_layout(lines, Math.max(holder.clientWidth, 200)) : {width: Math.max(holder.clientWidth, 200), height: flat_height});
    // Room for the longest number of the axis: 11 px high, some 6 px a letter.
    const width_of = (u, values) => Math.max(58, 14 + 6.2 * Math.max(0, ...(values || []).map((v) => String(v).length)));
    const make = () => {
      const axis = {stroke: Dust.colour('soft'), grid: {stroke: Dust.colour('faint'), width: 1},
        ticks: {stroke: Dust.colour('line'), width: 1, size: 5}, font: '11px ' + Dust.colour('sans'),
        values: (u, splits) => splits.map((v) => (v === null ? '' : Dust.number(v)))};
      const named = {...axis, labelSize: 18, labelGap: 0, labelFont: axis.font};
      const {series, bands, bars, keys, places} = dressed(lines, band), size = size_of();
      const reading = Dust.el('span', {class: 'reading'});
      key.replaceChildren(...keys, reading);
      holder.replaceChildren();
      const scales = path ? {x: {time: false, ori: 1, dir: -1, range: size.x}, y: {ori: 0, dir: 1, range: size.y}} : {x: is_geometric ? {time: false, distr: 3, log: 10} : {time: false}};
      const axes = path ? [{...named, scale: 'x', side: 3, size: 48, label: x_label}, {...named, scale: 'y', side: 0, size: 28, label: y_label}]
        : [{...named, size: 28, label: x_label, ...(is_geometric ? {values: decades} : {})}, {...axis, size: width_of}];
      return new uPlot({width: size.width, height: size.height, series, bands, padding: path ? [0, 18, 10, 0] : [10, 18, 0, 0],
        legend: {show: false}, cursor: {points: {show: false}, drag: {x: !path, y: false}}, scales, axes,
        hooks: {draw: [bars_hook(bars, path), hollow_hook(lines, places, series, path)], setCursor: [(u) => {
          const k = u.cursor.idx;
          reading.textContent = k === null || k === undefined ? '' : `at ${Dust.number(u.data[0][k])} (${x_label})`;
          if (k === null || k === undefined) return;
          let at = 1;
          lines.forEach((line, n) => {
            const value = u.data[at][k], why = reasons(line).get(u.data[0][k]);
            at += line.low ? 3 : 1;
            keys[n].lastChild.textContent = Dust.words(line.name) + (value === null || value === undefined ? '' : ': ' + Dust.number(value) + (unit ? ' ' + unit : '') + (why ? ` (${why})` : ''));
          });
        }]}}, data, holder);
    };
    let drawn = make();
    Dust.redraw.push(() => {
      drawn.destroy();
      drawn = make();
    });
    const fit = () => {
      if (!holder.clientWidth) return;
      const size = size_of();
      if (Math.abs(size.width - drawn.width) > 1) drawn.setSize(size);
    };
    new ResizeObserver(() => requestAnimationFrame(fit)).observe(holder);
  };

  // Numbers in SI units, in the unit that reads best.
  const readable = (plot) => {
    const sizes = plot.lines.flatMap((line) => line.y).filter(Number.isFinite).map(Math.abs);
    const scale = Dust.scale(plot.unit || '', sizes.reduce((a, b) => Math.max(a, b), 0));
    const shown = (list) => list && list.map((v) => (v === null ? null : v / scale.factor));
    return {...plot, unit: scale.unit, lines: plot.lines.map((line) => ({...line, y: shown(line.y), low: shown(line.low), high: shown(line.high)}))};
  };
  Dust.readable_plot = (parent, plot) => Dust.plot(parent, readable(plot));
})();
