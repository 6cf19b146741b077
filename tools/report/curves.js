'use strict';
// Plots against time and other curves, with uPlot.
(() => {
  const plots = [];
  const hex = (k) => Dust.colour('plot' + (k % 6 + 1));
  const k_error = /[ _/.]*(uncertainty|standard_error|error|sigma)$/i;

  // lines: [{name, x, y, low, high}]; x ascending. Draws one figure into `grid`.
  const plot = (grid, title, sensor, x_label, y_label, lines) => {
    const holder = Dust.el('div', {class: 'plot'});
    const bold = Dust.el('b', {}, Dust.words(title) + '.');
    const caption = Dust.el('figcaption', {}, bold, ` ${y_label}`, x_label ? ` against ${x_label}.` : '.', sensor ? ` Sensor ${Dust.words(sensor)}.` : '');
    const band_of = lines.some((line) => line.low);
    if (band_of) caption.append(' Band: one standard error to either side.');
    const key = Dust.el('div', {class: 'legend'});
    grid.append(Dust.el('figure', {}, holder, lines.length > 1 ? key : '', caption));

    const tables = [];
    for (const line of lines) {
      tables.push([line.x, line.y, ...(line.low ? [line.low, line.high] : [])]);
    }
    const data = uPlot.join(tables);
    const make = () => {
      const axis = {stroke: Dust.colour('soft'), grid: {stroke: Dust.colour('faint'), width: 1},
        ticks: {stroke: Dust.colour('line'), width: 1, size: 5}, font: '11px ' + Dust.colour('sans'),
        values: (u, splits) => splits.map((v) => (v === null ? '' : Dust.number(v)))};
      const series = [{}], bands = [], keys = [];
      lines.forEach((line, k) => {
        const colour = hex(k);
        const few = line.x.length < 40;
        series.push({label: line.name, stroke: colour, width: 1.6, spanGaps: false, points: {show: few, size: 5, fill: colour}});
        if (line.low) {
          const at = series.length;
          series.push({stroke: 'transparent', width: 0, points: {show: false}}, {stroke: 'transparent', width: 0, points: {show: false}});
          bands.push({series: [at + 1, at], fill: colour + '33'});
        }
        const swatch = Dust.el('i', {class: 'line'});
        swatch.style.background = colour;
        keys.push(Dust.el('span', {}, swatch, Dust.words(line.name)));
      });
      key.replaceChildren(...keys);
      holder.replaceChildren();
      return new uPlot({width: Math.max(holder.clientWidth, 200), height: 230, series, bands, padding: [10, 10, 0, 0],
        legend: {show: false}, cursor: {points: {show: false}, drag: {x: true, y: false}}, scales: {x: {time: false}},
        axes: [{...axis, size: 30}, {...axis, size: 58}],
        hooks: {setCursor: [(u) => {
          const k = u.cursor.idx;
          if (k === null || k === undefined) return;
          let at = 1;
          lines.forEach((line, n) => {
            const value = u.data[at][k];
            at += line.low ? 3 : 1;
            keys[n].lastChild.textContent = Dust.words(line.name) + (value === null || value === undefined ? '' : ': ' + Dust.number(value));
          });
        }]}}, data, holder);
    };
    let drawn = make();
    const again = () => {
      drawn.destroy();
      drawn = make();
    };
    plots.push(again);
    Dust.redraw.push(again);
    const fit = () => {
      if (holder.clientWidth && Math.abs(holder.clientWidth - drawn.width) > 1) drawn.setSize({width: holder.clientWidth, height: 230});
    };
    new ResizeObserver(() => requestAnimationFrame(fit)).observe(holder);
  };

  const grid_of = (id) => {
    const section = document.getElementById(id);
    section.hidden = false;
    let grid = section.querySelector('.grid');
    if (!grid) section.append(grid = Dust.el('div', {class: 'grid'}));
    return grid;
  };
  const split_label = (label) => {
    const found = /^(.*?)\s*\[([^\]]*)\]\s*$/.exec(label || '');
    return found ? {name: found[1], unit: found[2]} : {name: label || '', unit: ''};
  };
  const largest = (lists) => {
    let size = 0;
    for (const list of lists) for (const v of list) if (Number.isFinite(v)) size = Math.max(size, Math.abs(v));
    return size;
  };
  const axis_label = (name, unit) => (name ? Dust.words(name) : 'Value') + (unit && unit !== '-' && unit !== '1' ? ', ' + unit : '');
  const by = (list, key_of) => {
    const groups = new Map();
    for (const item of list) {
      const key = key_of(item);
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(item);
    }
    return [...groups.values()];
  };
  // Lower and upper bounds are series of their own; "x error" or "x low"/"x high" become the band of x.
  const with_bands = (lines) => {
    const find = (pattern, name) => lines.find((l) => pattern.test(l.name) && l.name.replace(pattern, '') === name);
    const taken = new Set();
    for (const line of lines) {
      const error = find(k_error, line.name), low = find(/[ _/.]*(low|lower)$/i, line.name), high = find(/[ _/.]*(high|upper)$/i, line.name);
      const usable = (l) => l && l !== line && l.y.length === line.y.length;
      if (usable(error)) {
        line.low = line.y.map((v, k) => (v === null || error.y[k] === null ? null : v - error.y[k]));
        line.high = line.y.map((v, k) => (v === null || error.y[k] === null ? null : v + error.y[k]));
        taken.add(error);
      } else if (usable(low) && usable(high)) {
        line.low = low.y;
        line.high = high.y;
        taken.add(low).add(high);
      }
    }
    return lines.filter((line) => !taken.has(line));
  };
  const in_chunks = (lines, title, draw) => {
    const size = 6;
    for (let k = 0; k < lines.length; k += size) draw(lines.slice(k, k + size), lines.length > size ? `${title} (${k / size + 1})` : title);
  };
  const ascending = (list) => list.every((v, k) => Number.isFinite(v) && (k === 0 || v > list[k - 1]));

  // Curves of the sensors.
  const shown = Dust.data.curves.filter((c) => !Dust.is_stream_curve(c) && Array.isArray(c.x) && Array.isArray(c.y) && c.x.length > 1);
  for (const group of by(shown, (c) => [c.sensor, c.title, c.x_label, c.y_label].join('\n'))) {
    const x_label = split_label(group[0].x_label), y_label = split_label(group[0].y_label);
    const sx = Dust.scale(x_label.unit, largest(group.map((c) => c.x))), sy = Dust.scale(y_label.unit, largest(group.map((c) => c.y)));
    const lines = with_bands(group.map((c) => {
      const n = Math.min(c.x.length, c.y.length);
      const order = Array.from({length: n}, (_, k) => k).filter((k) => Number.isFinite(c.x[k]));
      if (!ascending(c.x)) order.sort((a, b) => c.x[a] - c.x[b]);
      return {name: String(c.series || ''), x: order.map((k) => c.x[k] / sx.factor),
        y: order.map((k) => (Number.isFinite(c.y[k]) ? c.y[k] / sy.factor : null))};
    }));
    in_chunks(lines, group[0].title || 'Curve', (part, title) =>
      plot(grid_of('curves'), title, group[0].sensor, axis_label(x_label.name, sx.unit), axis_label(y_label.name, sy.unit), part));
  }

  // Columns of series.csv: one plot per sensor and unit.
  const columns = Dust.data.series;
  const clock = columns.find((c) => /^(t|time)$/i.test(c.name)) || columns[0];
  if (!clock || clock.values.length < 2 || !ascending(clock.values)) return;
  const sensors = [...Dust.data.sensors].sort((a, b) => b.length - a.length);
  const sensor_of = (name) => sensors.find((s) => name.startsWith(s) && /^[ /._:]/.test(name.slice(s.length))) || '';
  const told = columns.filter((c) => c !== clock).map((c) => {
    const sensor = sensor_of(c.name);
    return {...c, sensor, short: sensor ? c.name.slice(sensor.length + 1) : c.name};
  }).filter((c) => c.values.some((v) => v !== null));
  for (const group of by(told, (c) => c.sensor + '\n' + c.unit)) {
    const {sensor, unit} = group[0];
    const scale = Dust.scale(unit, largest(group.map((c) => c.values)));
    const lines = with_bands(group.map((c) => ({name: c.short, x: clock.values,
      y: c.values.map((v) => (v === null ? null : v / scale.factor))})));
    const title = lines.length === 1 ? (sensor ? sensor + ', ' : '') + lines[0].name : sensor || {kg: 'Mass', J: 'Energy', '-': 'Counts', '1': 'Counts', '': 'Counts'}[unit] || 'Quantities';
    const bare = scale.unit === '-' || scale.unit === '1' || scale.unit === '';
    in_chunks(lines, title.charAt(0).toUpperCase() + title.slice(1), (part, name) => plot(grid_of(sensor ? 'curves' : 'series'), name, '', 'time, s',
      bare ? 'Number' : 'In ' + scale.unit, part));
  }
})();
