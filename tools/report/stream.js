'use strict';
// The path of the stream: position against drop, true to scale, drawn as SVG.
(() => {
  const section = document.getElementById('stream');
  const svg_el = (tag, attributes, text) => {
    const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (text !== undefined) node.textContent = text;
    return node;
  };
  // A length, that is: a drop of pressure is none.
  const is_drop = (label) => /(drop|below).*\[m{1,2}\]/i.test(label || '');
  // Heights that are negative throughout are drops as well.
  const drop_axis = (curve) => {
    if (is_drop(curve.y_label)) return 'y';
    if (is_drop(curve.x_label)) return 'x';
    const sinks = /height/i.test(curve.y_label || '') && curve.y.length > 0 && curve.y.every((v) => v <= 0);
    return sinks ? 'y' : null;
  };
  const quantile = (name) => {
    if (/median|(^|\D)50(\D|$)/i.test(name)) return 'median';
    if (/(^|\D)95(\D|$)/.test(name)) return 'high';
    if (/(^|\D)0?5(\D|$)/.test(name)) return 'low';
    return null;
  };

  // Curves of a sensor with a drop on one axis: {title, sensor, lines: [{name, kind, points: [[x, drop]]}]}.
  const of_curves = () => {
    const groups = new Map();
    for (const curve of Dust.data.curves) {
      if (!Array.isArray(curve.x) || !Array.isArray(curve.y)) continue;
      const down = drop_axis(curve);
      if (!down) continue;
      const key = curve.sensor + '\n' + curve.title;
      if (!groups.has(key)) groups.set(key, {title: curve.title, sensor: curve.sensor, lines: []});
      const drops = down === 'y' ? curve.y : curve.x, across = down === 'y' ? curve.x : curve.y;
      const unit = (label) => (/\[?\bmm\b/.test(label) ? 1e-3 : 1);
      const drop_unit = unit(down === 'y' ? curve.y_label : curve.x_label);
      const across_unit = unit(down === 'y' ? curve.x_label : curve.y_label);
      const points = drops.map((d, k) => [across[k] * across_unit, Math.abs(d) * drop_unit])
        .filter((p) => Number.isFinite(p[0]) && Number.isFinite(p[1])).sort((a, b) => a[1] - b[1]);
      if (points.length) groups.get(key).lines.push({name: String(curve.series), kind: curve.kind === 'reference' ? 'reference' : quantile(String(curve.series)), points});
    }
    // Zeros throughout: nothing had crossed when the run ended.
    return [...groups.values()].filter((group) => group.lines.some((line) => line.points.some((p) => p[0] !== 0)));
  };
  const of_figures = () => {
    const lines = [['low', '5 %'], ['median', '50 %'], ['high', '95 %']].map(([kind, name]) => ({name, kind,
      points: Dust.data.stream.filter((d) => d[kind]).map((d) => [d[kind].value, d.drop, d[kind].error])}));
    const given = lines.filter((line) => line.points.length);
    return given.length ? [{title: '', sensor: '', lines: given}] : [];
  };

  const draw = (group) => {
    const lone = Dust.data.flights.flatMap((flight) => (flight.lone || []).map((one) => [one.x.at(-1), one.drop.at(-1)]));
    const all = group.lines.flatMap((line) => line.points).concat(lone);
    const drops = all.map((p) => p[1]), places = all.map((p) => p[0]);
    const deepest = Math.max(...drops) * 1.1, left = Math.min(0, ...places), right = Math.max(...places, 1e-6) * 1.08;
    const pad = {left: 70, right: 80, top: 34, bottom: 16};
    const inner = document.documentElement.clientWidth < 600 ? 250 : 420, scale = inner / (right - left);
    const height = Math.min(deepest * scale, 620);
    const down = height / deepest;
    const {unit, factor} = Dust.places;
    const x = (v) => pad.left + (v - left) * scale, y = (v) => pad.top + v * down;
    const total = [inner + pad.left + pad.right, height + pad.top + pad.bottom];
    const svg = svg_el('svg', {viewBox: `0 0 ${total[0]} ${total[1]}`, role: 'img', 'aria-label': 'Path of the stream',
      style: `width:100%;max-width:${total[0]}px;height:auto;display:block`});
    const line = (a, b, c, d, style) => svg.append(svg_el('line', {x1: a, y1: b, x2: c, y2: d, style}));
    for (const v of Dust.ticks(left / factor, right / factor, 8)) {
      line(x(v * factor), pad.top, x(v * factor), pad.top + height, 'stroke:var(--line)');
      if (v !== 0) svg.append(svg_el('text', {x: x(v * factor), y: pad.top - 8, 'text-anchor': 'middle'}, Dust.number(v)));
    }
    svg.append(svg_el('text', {x: total[0], y: pad.top - 8, 'text-anchor': 'end'}, 'forward, ' + unit));
    for (const v of Dust.ticks(0, deepest / factor, 6)) {
      line(pad.left, y(v * factor), pad.left + inner, y(v * factor), 'stroke:var(--line)');
      svg.append(svg_el('text', {x: pad.left - 8, y: y(v * factor) + 4, 'text-anchor': 'end'}, Dust.number(v)));
    }
    svg.append(svg_el('text', {x: pad.left - 8, y: pad.top - 8, 'text-anchor': 'end'}, 'drop, ' + unit));
    const low = group.lines.find((l) => l.kind === 'low'), high = group.lines.find((l) => l.kind === 'high');
    if (low && high) {
      const ring = [...low.points, ...[...high.points].reverse()].map((p) => `${x(p[0])},${y(p[1])}`).join(' ');
      svg.append(svg_el('polygon', {points: ring, style: 'fill:var(--tone1);fill-opacity:.28'}));
    }
    // Free flight without air from the belt's speed, dashed.
    for (const flight of Dust.data.flights) {
      const points = Array.from({length: 41}, (_, k) => deepest * (k / 40) ** 2).map((h) => [flight.speed * Math.sqrt(2 * h / flight.gravity), h])
        .filter((p) => p[0] <= right);
      svg.append(svg_el('polyline', {points: points.map((p) => `${x(p[0])},${y(p[1])}`).join(' '), style: 'fill:none;stroke:var(--soft);stroke-width:1.4;stroke-dasharray:6 4'}));
      const at = points[Math.floor(points.length * 0.62)];
      svg.append(svg_el('text', {x: x(at[0]) + 10, y: y(at[1]) - 4, 'text-anchor': 'start'}, 'free flight'));
      for (const [n, lone] of (flight.lone || []).entries()) {
        const path = lone.x.map((v, k) => `${x(v)},${y(lone.drop[k])}`).join(' ');
        svg.append(svg_el('polyline', {points: path, style: 'fill:none;stroke:var(--plot1);stroke-width:1.4;stroke-dasharray:2 3'}));
        const k = Math.floor(lone.x.length * (n === 0 ? 0.85 : 0.55));  // names apart from each other
        svg.append(svg_el('text', {x: x(lone.x[k]) - 8, y: y(lone.drop[k]) + 4, 'text-anchor': 'end', style: 'fill:var(--plot1)'},
          Dust.number(lone.diameter * 1e6, 3) + ' µm alone'));
      }
    }
    group.lines.forEach((entry, k) => {
      const is_reference = entry.kind === 'reference';
      const colour = is_reference ? 'var(--soft)' : entry.kind === 'median' ? 'var(--ink)' : entry.kind ? 'var(--tone2)' : `var(--plot${k % 6 + 1})`;
      const path = entry.points.map((p) => `${x(p[0])},${y(p[1])}`).join(' ');
      svg.append(svg_el('polyline', {points: path, style: `fill:none;stroke:${colour};stroke-width:${entry.kind === 'median' ? 2.2 : 1.4}${is_reference ? ';stroke-dasharray:6 4' : ''}`}));
      for (const p of entry.points) {
        if (p[2] > 0) line(x(p[0] - p[2]), y(p[1]), x(p[0] + p[2]), y(p[1]), `stroke:${colour};stroke-width:3;opacity:.6`);
        if (entry.points.length <= 12) svg.append(svg_el('circle', {cx: x(p[0]), cy: y(p[1]), r: 3.2, style: `fill:${colour}`}));
      }
      const last = entry.points.at(-1);
      const [dx, dy, anchor] = {low: [-7, 4, 'end'], high: [7, 4, 'start']}[entry.kind] || [0, 17, 'middle'];
      svg.append(svg_el('text', {x: x(last[0]) + dx, y: y(last[1]) + dy, 'text-anchor': anchor, style: `fill:${colour}`}, ({low: '5 %', median: '50 %', high: '95 %'})[entry.kind] || Dust.words(entry.name)));
    });
    return svg;
  };

  // The figures carry errors; curves of the same quantiles would only repeat them.
  const figures = of_figures();
  const drawn = of_curves();
  // What is known from elsewhere of the path stands beside the figures.
  if (figures.length) figures[0].lines.push(...drawn.flatMap((group) => group.lines.filter((l) => l.kind === 'reference')));
  const groups = [...figures, ...drawn.filter((group) => !figures.length || !group.lines.every((l) => l.kind))];
  for (const group of groups) {
    // The table stands beside the first picture.
    const tables = group === groups[0] ? [...section.querySelectorAll('.scroll')] : [];
    const caption = Dust.el('figcaption', {}, Dust.el('b', {}, group.title ? Dust.sentence(group.title) + '.' : 'Path of the stream.'),
      ' Distance forward against the drop, both from the start of the stream, in ' + Dust.places.unit,
      group.lines.some((l) => l.kind) ? '; the band holds the grains between the 5 and 95 % quantiles, the heavy line is the median; bars are standard errors.' : '.',
      Dust.data.flights.length ? ` Dashed: free flight without air at the speed of the belt, ${Dust.number(Dust.data.flights[0].speed)} m/s.` : '',
      Dust.data.flights.some((flight) => (flight.lone || []).length) ? ' Dotted: single grains thrown level into still air at that speed (drag of Schiller and Naumann); a stream takes the air along and outruns them.' : '');
    document.getElementById('stream-picture').append(Dust.el('figure', {class: 'side'}, Dust.el('div', {}, draw(group)), Dust.el('div', {}, caption, ...tables)));
    section.hidden = false;
  }
  Dust.is_stream_curve = (curve) => Array.isArray(curve.y) && drop_axis(curve) !== null;
})();
