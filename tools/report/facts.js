'use strict';
// Sections that are tables: the stream's, published numbers, balance, limits, cost, all figures, provenance.
Dust.sections.stream = ({stream}) => {
  const cell = (q) => (q ? Dust.quantity(q.value, q.error, 'm') : Dust.dash);
  const table = Dust.table(['Drop', '5\u202f%', 'Median', '95\u202f%'].map((title) => ({title, number: true})), stream.map((d) => [Dust.quantity(d.drop, -1, 'm'), cell(d.low), cell(d.median), cell(d.high)]),
    {look: 'tight', label: 'Quantiles of the stream'});
  const section = Dust.section('stream', 'The path of the stream', Dust.el('div', {id: 'stream-picture'}), table);
  section.hidden = stream.length === 0;  // curves alone may fill it
  return section;
};

Dust.sections.references = ({references}) => {
  const rows = references.map((r) => [Dust.words(String(r.quantity).replace(/^sensors\./, '').replace('.', ' / ')), Dust.quantity(r.ours, r.our_uncertainty, r.unit), Dust.quantity(r.value, r.uncertainty, r.unit),
    r.difference_share === null ? Dust.dash : Dust.number(100 * r.difference_share, 2) + '\u202f%', r.in_errors === null ? Dust.dash : Dust.number(r.in_errors, 2),
    [r.source, r.problem && 'not compared: ' + r.problem].filter(Boolean).join('; ')]);
  const table = Dust.table([{title: 'Quantity'}, {title: 'This run', number: true}, {title: 'Published', number: true}, {title: 'Difference', number: true}, {title: 'In standard errors', number: true},
    {title: 'Source'}], rows, {label: 'Beside published numbers'});
  return table && Dust.section('references', 'Beside published numbers', table);
};

// Sections that sensors head themselves; curves.js draws their curves into them.
Dust.sections.own = ({sections, tables}) => {
  if (!sections.length) return null;
  const part = document.createDocumentFragment();
  for (const {sensor, heading, text} of sections) {
    const section = Dust.section('own-' + sensor, heading, Dust.p({}, text), Dust.el('div', {class: 'grid'}),
      ...tables.filter((t) => t.sensor === sensor && t.rows.length).flatMap((t) => [Dust.el('h3', {}, t.title), Dust.plain_table(t)]));
    section.classList.add('own');
    part.append(section);
  }
  return part;
};
Dust.sections.curves = () => {
  const section = Dust.section('curves', 'Curves of the sensors');
  section.hidden = true;
  return section;
};
Dust.sections.series = () => {
  const section = Dust.section('series', 'The run over time');
  section.hidden = true;
  return section;
};

Dust.sections.balance = ({balance, summary}) => {
  if (!balance.length) return null;
  const {el, p} = Dust;
  const closes = balance.every((row) => row.is_closed);
  const names = {particles: 'Computed grains', real_particles: 'Real grains', mass_kg: 'Mass'};
  const rows = balance.map((row) => {
    const is_mass = row.of === 'mass_kg';
    // Weights of rare grains leave fractions; nobody counts those.
    const cell = (v) => (is_mass ? Dust.quantity(v, -1, 'kg') : Number.isInteger(v) || Math.abs(v) > 1e3 ? Dust.count(Math.round(v)) : Dust.number(v));
    const difference = is_mass && row.difference !== 0 ? Dust.number(row.difference / row.emitted, 2) + '\u202fof it' : Dust.number(row.difference, 2);
    return [names[row.of] || row.of, cell(row.emitted), cell(row.in_domain), cell(row.left), cell(row.removed), row.is_closed ? difference : el('span', {class: 'wrong'}, difference)];
  });
  const mass = balance.find((row) => row.of === 'mass_kg');
  const shares = mass && mass.emitted > 0 ? [['in_domain', 'still in the domain'], ['left', 'left through a boundary'], ['removed', 'removed']]
    .map(([key, name], k) => ({name, look: 'tone' + (k + 1), share: mass[key] / mass.emitted})).filter((s) => s.share > 0) : [];
  const stack = shares.length ? [el('div', {class: 'stack', role: 'img', 'aria-label': 'Shares of the mass released: ' + shares.map((s) => `${s.name} ${Dust.width(s.share)}`).join(', ')},
    ...shares.map((s) => el('i', {class: s.look, style: 'width:' + Dust.width(s.share)}))),
  p({class: 'legend'}, ...shares.map((s) => el('span', {}, el('i', {class: s.look}), `${s.name} ${Dust.width(s.share).replace('%', '')}\u202f%`)))] : [];
  const parts = ['emitted', 'in_domain', 'left', 'removed'];
  const classes = (summary.size_classes || []).filter((c) => c.mass_kg && Number.isFinite(c.mass_kg.emitted))
    .map((c) => [Dust.quantity(c.diameter_m, -1, 'm'), ...parts.map((key) => Dust.quantity(c.mass_kg[key] || 0, -1, 'kg'))]);
  const heads = ['Released', 'In domain', 'Left', 'Removed'].map((title) => ({title, number: true}));
  const most = (summary.particles || {}).max;
  return Dust.section('balance', 'Mass balance',
    closes ? p({}, Dust.strong('The balance closes.', 'good'), ' Every grain released is still in the domain, has left through a boundary or was removed, in numbers exactly and in mass to round-off.')
      : p({}, Dust.strong('The balance does not close.', 'wrong'), ' What was released differs from what is in the domain, left and was removed: trust no figure of this run before the cause is known.'),
    stack, Dust.table([{title: ''}, ...heads, {title: 'Difference', number: true}], rows, {label: 'Balance'}),
    Dust.table([{title: 'Mass by diameter'}, ...heads], classes, {label: 'Mass by diameter'}),
    Number.isFinite(most) && p({class: 'note'}, `At most ${Dust.count(most)} computed ${most === 1 ? 'grain was' : 'grains were'} in the domain at one time. A real grain counts with the statistical weight of the `
      + 'computed grains that stand for it.'));
};

Dust.sections.cost = ({cost, summary, graph_dot}) => {
  if (!cost) return null;
  const {thin} = Dust;
  const some = (value) => value !== null && value !== undefined;
  const tiles = Dust.tiles([
    some(cost.wall_per_simulated) && ['Computing time per simulated second', Dust.duration(cost.wall_per_simulated)],
    some(cost.grain_steps_per_dem_second) ? ['Grain-steps per second of DEM time', Dust.number(cost.grain_steps_per_dem_second / 1e6, 3) + thin + 'million']
      : some(cost.grain_steps_per_second) && ['Grain-steps per second', Dust.number(cost.grain_steps_per_second, 3)],
    some(cost.air_step_s) && ['Air, time per step', Dust.quantity(cost.air_step_s, -1, 's')],
    some(cost.processors_busy) && ['Processors busy, on average', Dust.number(cost.processors_busy, 3) + (Number.isFinite(summary.threads) ? ` of ${Dust.count(summary.threads)}` : '')],
    Number.isFinite(summary.peak_rss_bytes) && ['Memory at most', Dust.number(summary.peak_rss_bytes / 1e6, 4) + thin + 'MB']], 'small');
  // Nodes below half a per cent of the time are one line.
  const nodes = cost.nodes.filter((n) => n.share >= 0.005), small = cost.nodes.filter((n) => n.share < 0.005);
  if (small.length > 1) nodes.push(small.reduce((a, n) => ({...a, seconds: a.seconds + n.seconds, share: a.share + n.share}), {name: `${small.length} other nodes`, seconds: 0, share: 0}));
  else nodes.push(...small);
  const longest = Math.max(...nodes.map((n) => n.seconds), 1e-300);
  const table = Dust.table([{title: 'Node'}, {title: 'Time', number: true}, {title: 'Share of the wall time', number: true}, {title: ''}],
    nodes.map((n) => [Dust.words(n.name), Dust.number(n.seconds, 3) + thin + 's', Dust.width(n.share).replace('%', thin + '%'), Dust.bar(n.seconds / longest, '')]), {look: 'bars', label: 'Time by node'});
  const graph = graph_dot ? Dust.details('The task graph with its times', '', Dust.el('div', {id: 'graph-picture', tabindex: 0, role: 'group', 'aria-label': 'The task graph'}), Dust.el('pre', {tabindex: 0}, graph_dot)) : null;
  if (graph) graph.id = 'graph';
  return Dust.section('cost', 'What it cost', tiles, table,
    table && Dust.p({class: 'note'}, 'Wall-clock time of each kind of node; nodes that run side by side may add up to more than the whole. DEM time is that of the nodes of the particles alone; a '
      + 'grain-step is one grain moved on by one step.'), graph);
};

Dust.sections.figures = ({summary, sections, tables}) => {
  const leaves = (value, path) => {
    if (typeof value === 'number') return [{name: path, value, unit: ''}];
    if (value && typeof value === 'object' && 'value' in value) return [{...value, name: path}];
    if (value && typeof value === 'object') return Object.entries(value).flatMap(([key, part]) => leaves(part, path ? path + '/' + key : key));
    return [];
  };
  const parts = Object.entries(summary.sensors || {}).map(([sensor, values]) => {
    const figures = leaves(values, '');
    if (!figures.length) return null;
    return Dust.details(Dust.words(sensor), Dust.plural(figures.length, 'figure'), Dust.table([{title: 'Quantity'}, {title: 'Value ± standard error', number: true}, {title: 'SI value', number: true}],
      figures.map((f) => [Dust.words(f.name).replace(/\//g, ' / ').replace(/ {2,}/g, ' '), Dust.quantity(f.value, f.uncertainty, f.unit || '') + Dust.why_no_error(f),
        Dust.el('span', {class: 'raw'}, Number.isFinite(f.value) ? String(+f.value.toPrecision(9)) + (Dust.is_bare(f.unit) ? '' : ' ' + f.unit) : '')]), {label: 'Figures of ' + Dust.words(sensor)}));
  }).filter(Boolean);
  const has_own = new Set(sections.map((s) => s.sensor));
  for (const table of tables) {
    if (!table.rows.length || has_own.has(table.sensor)) continue;
    parts.push(Dust.details(table.title, 'table of ' + Dust.words(table.sensor || ''), Dust.plain_table(table)));
  }
  if (!parts.length) return null;
  return Dust.section('figures', 'All figures', Dust.p({}, "Every sensor's figures of this run. The error is one standard error; where none stands, the sensor makes no estimate: '(few grains)' rests on fewer than 20, '(not steady)' has not settled in the time observed, '(feed not even)': the feed begins, ends or changes in it."), parts);
};

Dust.sections.provenance = ({summary, scenario}) => {
  const {el} = Dust, rows = [];
  const text = (name, key, is_code) => { if (summary[key]) rows.push([name, is_code ? el('code', {}, String(summary[key])) : String(summary[key])]); };
  const count = (name, key) => { if (Number.isFinite(summary[key])) rows.push([name, Dust.count(summary[key])]); };
  text('Scenario', 'scenario');
  text('Scenario as run, SHA-256', 'scenario_sha256', true);
  text('Engine version', 'version');
  const build = summary.build || {};
  if (build.compiler) rows.push(['Built by', build.compiler + (build.processor ? ` for ${build.processor}` : '') + (Number.isFinite(build.plugin_interface) ? `, plugin interface ${build.plugin_interface}` : '')]);
  text('Status', 'status');
  if (Number.isFinite(summary.simulated_s)) rows.push(['Simulated time', Dust.number(summary.simulated_s, 6) + '\u202fs']);
  count('Threads', 'threads');
  for (const [name, key] of [['Wall time', 'wall_s'], ['Processor time', 'cpu_s']]) {
    if (Number.isFinite(summary[key])) rows.push([name, Dust.duration(summary[key]) + (summary[key] >= 100 ? ` (${Dust.number(summary[key], 6)}\u202fs)` : '')]);
  }
  count('DEM steps', 'dem_steps');
  count('Fluid steps', 'fluid_steps');
  count('Grain-steps', 'particle_steps');
  text('State, SHA-256', 'state_sha256', true);
  const kinds = new Map();
  for (const {kind, name, version} of summary.plugins || []) kinds.set(kind, [...(kinds.get(kind) || []), `${name}\u00a0${version}`]);
  return Dust.section('provenance', 'Provenance', Dust.p({}, 'The same scenario, build and machine give the same state on any number of threads and after any interruption.'), rows.length ? Dust.facts(rows, 'Provenance') : null,
    Dust.table([{title: 'Kind'}, {title: 'Models and their versions'}], [...kinds].map(([kind, names]) => [Dust.words(kind), names.join(', ')]), {look: 'facts', label: 'Models'}),
    scenario ? Dust.details('The scenario as run', '', el('pre', {tabindex: 0}, scenario)) : null);
};
