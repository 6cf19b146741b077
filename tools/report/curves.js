'use strict';
// Which plots a run gets: curves of the sensors, then the columns of series.csv.
(() => {
  const grid_of = (id) => {
    const section = document.getElementById(id);
    section.hidden = false;
    let grid = section.querySelector('.grid');
    if (!grid) section.append(grid = Dust.el('div', {class: 'grid'}));
    return grid;
  };
  // A sensor that heads a section of its own has its curves there.
  const place_of = (sensor) => (sensor && document.getElementById('own-' + sensor) ? 'own-' + sensor : 'curves');
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
  const in_chunks = (lines, title, draw) => {
    const size = 6;
    for (let k = 0; k < lines.length; k += size) draw(lines.slice(k, k + size), lines.length > size ? `${title} (${k / size + 1})` : title);
  };
  const ascending = (list) => list.every((v, k) => Number.isFinite(v) && (k === 0 || v > list[k - 1]));

  // Rates sampled at every step are mostly noise of single grains: means of blocks of samples, with the
  // standard error that the scatter inside a block gives.
  const k_points = 60;
  const in_blocks = (line) => {
    const size = Math.ceil(line.x.length / k_points);
    const blocks = {name: line.name, x: [], y: [], low: [], high: []};
    for (let from = 0; from + size <= line.x.length; from += size) {
      const values = line.y.slice(from, from + size);
      if (values.some((v) => v === null)) continue;
      const mean = values.reduce((a, b) => a + b, 0) / size;
      const error = Math.sqrt(values.reduce((a, v) => a + (v - mean) ** 2, 0) / Math.max(size - 1, 1) / size);
      blocks.x.push((line.x[from] + line.x[from + size - 1]) / 2);
      blocks.y.push(mean);
      blocks.low.push(mean - error);
      blocks.high.push(mean + error);
    }
    return blocks;
  };
  const is_zero = (list) => list.every((v) => !v);
  const zeros = new Set(), drawn = new Set();
  // Sensors that speak of dust share a plot: their amounts compare.
  const dust = Dust.data.dust || {openings: [], passages: [], stocks: []};
  const of_dust = new Set([...dust.openings, ...dust.passages, ...dust.stocks].map((f) => f.sensor));
  const is_dust = (sensor) => of_dust.has(sensor);
  const roles = Dust.data.summary.series_roles || {};
  const role_of = (column) => roles[`${column.name} [${column.unit}]`] || {};
  const say_zeros = () => {
    const still = [...zeros].filter((sensor) => !drawn.has(sensor));
    if (!still.length) return;
    const section = document.getElementById('curves');
    section.hidden = false;
    section.append(Dust.el('p', {class: 'note'}, 'Nothing counted in the whole run, not drawn: ' + still.map(Dust.words).join(', ') + '.'));
  };

  // Curves of the sensors.
  const shown = Dust.data.curves.filter((c) => !Dust.is_stream(c.sensor) && Array.isArray(c.x) && Array.isArray(c.y) && c.x.length > 1);
  for (const whole of by(shown, (c) => [is_dust(c.sensor) ? 'dust' : c.sensor, c.title, c.x_label, c.y_label].join('\n'))) {
    const group = whole.filter((c) => !is_zero(c.y));
    for (const c of whole) (is_zero(c.y) ? zeros : drawn).add(c.sensor);
    if (!group.length) continue;
    const x_label = split_label(group[0].x_label), y_label = split_label(group[0].y_label);
    const is_time = x_label.unit === 's', has_many = new Set(group.map((c) => c.sensor)).size > 1;
    // Our own first: of them the mean over blocks is told.
    group.sort((a, b) => (a.kind === 'reference') - (b.kind === 'reference'));
    const sx = is_time ? {factor: 1, unit: x_label.unit} : Dust.scale(x_label.unit, largest(group.map((c) => c.x))), sy = Dust.scale(y_label.unit, largest(group.map((c) => c.y)));
    let lines = group.map((c) => {
      const n = Math.min(c.x.length, c.y.length);
      const order = Array.from({length: n}, (_, k) => k).filter((k) => Number.isFinite(c.x[k]));
      if (!ascending(c.x)) order.sort((a, b) => c.x[a] - c.x[b]);
      const is_reference = c.kind === 'reference';
      return {name: has_many && !is_reference ? c.sensor : String(c.series || ''), kind: is_reference ? 'reference' : undefined, x: order.map((k) => c.x[k] / sx.factor),
        y: order.map((k) => (Number.isFinite(c.y[k]) ? c.y[k] / sy.factor : null))};
    });
    let note = '';
    if (is_time && y_label.unit.endsWith('/s') && lines[0].x.length > 3 * k_points) {
      const before = lines[0].x;
      const width = (before.at(-1) - before[0]) / (before.length - 1) * Math.ceil(before.length / k_points);
      lines = lines.map((line) => (line.kind === 'reference' ? line : in_blocks(line)));
      note = ` Means over ${Dust.number(width * 1e3, 2)} ms.`;
    }
    // What goes to and fro along x: means over neighbours.
    if (group.some((c) => c.kind !== 'reference' && !ascending(c.x)) && lines[0].x.length > 3 * k_points) {
      lines = lines.map((line) => (line.kind === 'reference' ? line : in_blocks(line)));
      note = ` Means over ${k_points} parts of the samples, in the order of x.`;
    }
    in_chunks(lines, group[0].title || 'Curve', (part, title) =>
      Dust.plot(grid_of(has_many ? 'curves' : place_of(group[0].sensor)), {title: has_many ? title + ', dust' : title, sensor: has_many ? '' : group[0].sensor,
        x_label: axis_label(x_label.name, sx.unit), y_label: axis_label(y_label.name, sy.unit), unit: sy.unit, lines: part, note}));
  }

  // Columns of series.csv: one plot per sensor and unit.
  const columns = Dust.data.series;
  const clock = columns[0];  // the time comes first
  if (!clock || clock.values.length < 2 || !ascending(clock.values)) return say_zeros();
  // A sensor's own curve against time already tells what its column of the same unit repeats.
  const told_by_curve = new Set(shown.filter((c) => split_label(c.x_label).unit === 's').map((c) => c.sensor + '\n' + split_label(c.y_label).unit));
  const told = columns.filter((c) => c !== clock).map((c) => {
    const head = c.name.split('/')[0], sensor = head in (Dust.data.summary.sensors || {}) ? head : '';  // SENSOR/figure
    return {...c, sensor, short: sensor ? c.name.slice(sensor.length + 1) : c.name};
  }).filter((c) => {
    // What the path of the stream already shows, as running means.
    if (Dust.is_stream(c.sensor)) return false;
    if (c.sensor && is_zero(c.values)) {
      zeros.add(c.sensor);
      return false;
    }
    if (c.sensor) drawn.add(c.sensor);
    return !(is_dust(c.sensor) && role_of(c).quantity === 'number');  // its mass tells
  }).filter((c) => c.values.some((v) => v !== null) && !told_by_curve.has(c.sensor + '\n' + c.unit));
  for (const group of by(told, (c) => (is_dust(c.sensor) ? 'dust' : c.sensor) + '\n' + c.unit)) {
    const has_many = new Set(group.map((c) => c.sensor)).size > 1;
    const {unit} = group[0], sensor = has_many ? 'dust' : group[0].sensor;
    const scale = Dust.scale(unit, largest(group.map((c) => c.values)));
    const lines = group.map((c) => ({name: has_many ? c.sensor + ', ' + c.short : c.short, x: clock.values,
      y: c.values.map((v) => (v === null ? null : v / scale.factor))}));
    const title = lines.length === 1 ? (sensor ? sensor + ', ' : '') + lines[0].name : sensor || {kg: 'Mass', J: 'Energy', '-': 'Counts', '1': 'Counts', '': 'Counts'}[unit] || 'Quantities';
    const bare = scale.unit === '-' || scale.unit === '1' || scale.unit === '';
    in_chunks(lines, Dust.sentence(title), (part, name) => Dust.plot(grid_of(sensor ? place_of(sensor) : 'series'), {title: name, x_label: 'time, s',
      y_label: bare ? 'Number' : 'In ' + scale.unit, unit: bare ? '' : scale.unit, lines: part}));
  }
  say_zeros();
})();
