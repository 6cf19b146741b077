'use strict';
// Plots with uPlot, for any page. `Dust.plot(parent, {title, sensor, x_label, y_label, unit, note, lines})` adds one
// figure; lines: [{name, x, y, low, high, kind}] with x ascending, null for a gap. `low` and `high` are a band, or
// bars where the kind is 'points'; a 'reference' is dashed and stands behind. `Dust.readable_plot` takes numbers in SI
// units and shows them in the unit that reads best.
(() => {
  const ink_of = (k) => Dust.colour('plot' + (k % 6 + 1));
  const capital = (text) => text.replace(/^./, (c) => c.toUpperCase());
  const height = 246;

  const bars_hook = (bars) => (u) => {
    const pen = u.ctx;
    for (const {at, colour} of bars) {
      pen.strokeStyle = colour;
      pen.lineWidth = 1.4 * devicePixelRatio;
      pen.beginPath();
      for (let k = 0; k < u.data[0].length; ++k) {
        const low = u.data[at + 1][k], high = u.data[at + 2][k];
        if (low === null || low === undefined || high === null || high === undefined) continue;
        const x = u.valToPos(u.data[0][k], 'x', true);
        pen.moveTo(x, u.valToPos(low, 'y', true));
        pen.lineTo(x, u.valToPos(high, 'y', true));
      }
      pen.stroke();
    }
  };

  Dust.plot = (parent, {title = '', sensor = '', x_label = '', y_label = '', unit = '', note = '', lines}) => {
    const holder = Dust.el('div', {class: 'plot', role: 'img', 'aria-label': `${Dust.sentence(title)}: ${y_label} against ${x_label}`});
    const caption = Dust.el('figcaption', {}, Dust.el('b', {}, Dust.sentence(title) + '.'),
      ` ${capital(y_label)}`, x_label ? ` against ${x_label}.` : '.', sensor ? ` Sensor ${Dust.words(sensor)}.` : '', note ? ' ' + note.trim() : '');
    if (lines.some((line) => line.low && line.kind !== 'points')) caption.append(' Band: one standard error to either side.');
    if (lines.some((line) => line.low && line.kind === 'points')) caption.append(' Bars: one standard error to either side.');
    const key = Dust.el('div', {class: 'legend', 'aria-hidden': lines.length > 1 ? 'false' : 'true'});
    const file = Dust.file_name(sensor + ' ' + title);
    const as_csv = Dust.el('button', {type: 'button', 'aria-label': `Numbers of ${Dust.sentence(title)} as CSV`}, 'CSV');
    as_csv.addEventListener('click', () => {
      const heads = lines.flatMap((line) => [`${line.name}: ${x_label}`, `${line.name}: ${y_label}${unit && !y_label.includes(unit) ? ', ' + unit : ''}`,
        ...(line.low ? [`${line.name}: low`, `${line.name}: high`] : [])]);
      const columns = lines.flatMap((line) => [line.x, line.y, ...(line.low ? [line.low, line.high] : [])]);
      Dust.save(file + '.csv', new Blob([Dust.csv(heads, columns)], {type: 'text/csv'}));
    });
    const as_png = Dust.el('button', {type: 'button', 'aria-label': `Picture of ${Dust.sentence(title)} as PNG`}, 'PNG');
    as_png.addEventListener('click', () => Dust.save_canvas(file + '.png', holder.querySelector('canvas')));
    const downloads = Dust.el('div', {class: 'downloads screen'}, as_csv, as_png);
    parent.append(Dust.el('figure', {}, Dust.el('div', {class: 'axis-unit'}, unit), holder, key, caption, downloads));

    const data = uPlot.join(lines.map((line) => [line.x, line.y, ...(line.low ? [line.low, line.high] : [])]));
    const make = () => {
      const axis = {stroke: Dust.colour('soft'), grid: {stroke: Dust.colour('faint'), width: 1},
        ticks: {stroke: Dust.colour('line'), width: 1, size: 5}, font: '11px ' + Dust.colour('sans'),
        values: (u, splits) => splits.map((v) => (v === null ? '' : Dust.number(v)))};
      const series = [{}], bands = [], bars = [], keys = [];
      let inks = 0;
      for (const line of lines) {
        const is_reference = line.kind === 'reference', is_points = line.kind === 'points';
        const colour = is_reference ? Dust.colour('soft') : ink_of(inks++);
        const few = line.x.length < 40;
        const at = series.length;
        series.push({label: line.name, stroke: colour, width: is_points ? 0 : line.width || 1.6, spanGaps: false,
          dash: is_reference ? [6, 4] : undefined, points: {show: is_points || (few && !is_reference), size: is_points ? 7 : 5, fill: colour}});
        if (line.low) {
          series.push({stroke: 'transparent', width: 0, points: {show: false}}, {stroke: 'transparent', width: 0, points: {show: false}});
          if (is_points) bars.push({at, colour});
          else bands.push({series: [at + 2, at + 1], fill: colour + '33'});
        }
        const swatch = Dust.el('i', {class: 'line' + (is_reference ? ' dashed' : '')});
        swatch.style.background = is_reference ? `repeating-linear-gradient(90deg, ${colour} 0 5px, transparent 5px 8px)` : colour;
        keys.push(Dust.el('span', {}, swatch, Dust.words(line.name)));
      }
      const reading = Dust.el('span', {class: 'reading'});
      key.replaceChildren(...keys, reading);
      holder.replaceChildren();
      return new uPlot({width: Math.max(holder.clientWidth, 200), height, series, bands, padding: [10, 18, 0, 0],
        legend: {show: false}, cursor: {points: {show: false}, drag: {x: true, y: false}}, scales: {x: {time: false}},
        axes: [{...axis, size: 28, label: x_label, labelSize: 18, labelGap: 0, labelFont: axis.font}, {...axis, size: 58}],
        hooks: {draw: [bars_hook(bars)], setCursor: [(u) => {
          const k = u.cursor.idx;
          reading.textContent = k === null || k === undefined ? '' : `at ${Dust.number(u.data[0][k])} (${x_label})`;
          if (k === null || k === undefined) return;
          let at = 1;
          lines.forEach((line, n) => {
            const value = u.data[at][k];
            at += line.low ? 3 : 1;
            keys[n].lastChild.textContent = Dust.words(line.name) + (value === null || value === undefined ? '' : ': ' + Dust.number(value) + (unit ? ' ' + unit : ''));
          });
        }]}}, data, holder);
    };
    let drawn = make();
    Dust.redraw.push(() => {
      drawn.destroy();
      drawn = make();
    });
    const fit = () => {
      if (holder.clientWidth && Math.abs(holder.clientWidth - drawn.width) > 1) drawn.setSize({width: holder.clientWidth, height});
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
