'use strict';
// Limits of validity and health: what each limit means, and what going beyond it does.
Dust.limit_texts = {
  largest_diameter_over_spacing: ['Largest diameter over cell spacing, D/dx',
    'Volumes spread over cells need cells of two diameters; above, the void fraction of a cell is noise. Use larger cells or a voidage rule for large grains.'],
  smallest_void_fraction: ['Smallest void fraction of a cell', 'Drag laws are fitted down to a random packing (about 0.36); below, they extrapolate.'],
  largest_overlap_over_radius: ['Largest overlap over the smaller radius',
    "Contact laws hold for small overlaps: grains are softer here than real ones, and a small grain pressed by a large one sinks in. Raise the Young's modulus, or check what the smallest class does in contact."],
  largest_overlap_over_radius_coarse: ['Largest overlap over the smaller radius, coarse grains',
    "Contact laws hold for small overlaps, and grains are softer here than real ones: raise the Young's modulus, or see that the speeds met are those expected. A small grain caught between a lump and a wall or another grain is pressed in by the lump's energy; its overlap falls by the 0.4 power of the Young's modulus only."],
  largest_overlap_over_radius_fine: ['Largest overlap over the smaller radius, fine grains', 'Fine grains are crushed between coarse ones: see below what that does.'],
  contacts_seen_late: ['Contacts between grains that began unseen',
    'A grain was thrown farther off its course than the lists foresee, and its first overlap counted from the step it was seen at. Shorten the DEM step.'],
  entries_waiting: ['Grains that never found room to enter', 'The feed is denser than its opening allows: less came than asked.'],
  largest_momentum_imbalance: ['Largest momentum imbalance, grains and air', 'What grains lose, the air must gain, to rounding.'],
  last_courant_number: ['Courant number at the end', 'The flow crosses more than a cell in a sub-step.'],
  width_over_diameter: ['Width between walls over largest diameter, W/D', 'Closer walls carry part of the load and shape the packing.'],
};
// Parts of the summary that have their own place on the page.
Dust.shown_elsewhere = new Set(['scenario', 'version', 'status', 'threads', 'wall_s', 'cpu_s', 'simulated_s', 'dem_steps', 'fluid_steps', 'particle_steps', 'peak_rss_bytes', 'particles', 'real_particles',
  'mass_kg', 'timers_s', 'timer_groups', 'state_sha256', 'sensors', 'reason', 'size_classes', 'plugins', 'build', 'warnings', 'references', 'scenario_sha256', 'input_files', 'huge_page_bytes', 'series', 'series_roles',
  'dust_rates', 'stream_indices']);

// A number with what it is: 'diameter 30 mm' of `diameter_m`.
Dust.named_text = ([key, value]) => {
  const [, stem, unit] = /^(.+)_(m|s|kg)$/.exec(key) || [null, key, ''];
  return `${Dust.words(stem)} ${typeof value === 'number' && unit ? Dust.quantity(value, -1, unit) : Dust.leaf_text(value) + (unit ? `\u202f${unit}` : '')}`;
};
Dust.leaf_text = (value) => (Array.isArray(value) ? value.map(Dust.leaf_text).join(value.some((part) => typeof part === 'string') ? '; ' : ', ') : value === true ? 'yes' : value === false ? 'no'
  : Number.isInteger(value) ? Dust.count(value) : typeof value === 'number' ? Dust.number(value, 6) : String(value));
// An entry of the summary as rows [name, text]: a figure with its error, a vector and a thing of a list are one row each; things of a list are numbered.
Dust.summary_rows = (value, path) => {
  if (value === null || value === undefined || (Array.isArray(value) && !value.length)) return [];
  const is_thing = (part) => part !== null && typeof part === 'object' && !Array.isArray(part);
  const row = (name, text) => [Dust.words(name), text];
  if (Array.isArray(value)) {
    if (!value.some(is_thing)) return [row(path, Dust.leaf_text(value))];
    const is_flat = (part) => is_thing(part) && !Object.values(part).some(is_thing);
    return value.flatMap((part, k) => (is_flat(part) ? [row(`${path} / ${k + 1}`, Object.entries(part).filter(([, v]) => v !== null).map(Dust.named_text).join(', '))]
      : Dust.summary_rows(part, `${path} / ${k + 1}`)));
  }
  if (!is_thing(value)) return [row(path, Dust.leaf_text(value))];
  if ('value' in value && 'unit' in value) return [row(path, Dust.amount(value))];
  return Object.entries(value).flatMap(([key, part]) => Dust.summary_rows(part, path ? `${path} / ${key}` : key));
};

// Figures of `dust_rates` by way, place and class; the time that they are means over is said on the first screen.
Dust.dust_rates_table = (rates) => {
  const lines = new Map();
  for (const [name, figure] of Object.entries(rates || {})) {
    const [, what, of] = /^(.+)\/(rate|per_load)$/.exec(name) || [];
    if (what) lines.set(what, {...lines.get(what), [of]: figure});
  }
  const said = (figure) => (figure && Dust.is_none(figure) ? 'none' : Dust.amount(figure, ''));
  const rows = [...lines].map(([what, {rate, per_load}]) => [Dust.words(what.replace(/\//g, ' / ')), said(rate), said(per_load)]);
  return Dust.table([{title: ''}, {title: 'Rate', number: true}, {title: 'Per tonne of load', number: true}], rows, {label: 'Rates of dust'});
};

Dust.sections.health = ({summary, limits, notes, crushed}) => {
  const {p} = Dust;
  const own = new Set(limits.map((l) => l.key)), leaves = ([key, value]) => Dust.summary_rows(value, key);
  const health = Object.entries(summary.health || {}).filter(([key]) => !own.has(key)).flatMap(leaves);
  const others = Object.entries(summary).filter(([key]) => key !== 'health' && !Dust.shown_elsewhere.has(key)).flatMap(leaves);
  const indices = Object.entries(summary.stream_indices || {}).filter(([name]) => name !== 'observed').flatMap(([name, figure]) => leaves([name.replace(/\//g, ' / '), figure]));
  const rates = Dust.dust_rates_table(summary.dust_rates), fold = (title, rows) => rows.length > 0 && Dust.details(title, '', Dust.facts(rows, title));
  const warnings = (summary.warnings || []).filter((w) => typeof w === 'string');
  if (!health.length && !others.length && !indices.length && !rates && !notes.length && !limits.length && !warnings.length) return null;
  const touched = limits.filter((l) => l.is_touched).length;
  const valid = (l) => (l.value === 0 ? 'none' : `${l.bound === 'at_most' ? 'at most' : 'at least'} ${Dust.number(l.value, 3)}`);
  const rows = limits.map((l) => {
    const [name, consequence] = Dust.limit_texts[l.key] || [Dust.words(l.key), ''];
    return [name, Dust.number(l.reached, 3), valid(l), l.is_touched ? Dust.el('span', {}, Dust.strong('beyond.', 'wrong'), ' ' + consequence) : Dust.el('span', {class: 'good'}, 'kept')];
  });
  return Dust.section('health', 'Limits and health',
    (health.length || limits.length) && (touched > 0 ? p({}, Dust.strong(Dust.plural(touched, 'limit') + ' of validity touched.', 'wrong'), ' Nothing is clamped silently.')
      : p({}, Dust.strong('No limit was touched.', 'good'), ' Nothing is clamped silently.')),
    Dust.table([{title: 'Limit'}, {title: 'Reached', number: true}, {title: 'Valid', number: true}, {title: ''}], rows, {look: 'limits', label: 'Limits of validity'}),
    crushed ? Dust.crushed_text(crushed) : null,
    ...warnings.map((text) => p({class: 'caution'}, text)), ...notes.map((text) => p({class: 'note'}, text)),
    fold('Counters of the run', health), rates && Dust.details('Rates of dust', '', rates), fold('Indices of the stream', indices), fold('Other entries of the summary', others));
};

// Why fine grains overlap beyond their radius, and what that does to the dust figures.
Dust.crushed_text = (c) => Dust.p({class: 'caution'}, Dust.strong(`What an overlap of ${Dust.number(c.overlap, 2)} radii means.`),
  ' Coarse grains are softer here than real ones and sink into each other by microns when they collide. A fine grain that is caught between them finds no room: it is pressed in by more than contact laws hold for, '
  + `and comes off with the elastic energy stored in it, at up to some ${Dust.number(c.thrown_speed, 2)}\u202fm/s.`
  + (c.stopping_distance_m ? ` Air stops grains of ${Dust.quantity(c.finest_m, -1, 'm')} within ${Dust.quantity(c.stopping_distance_m, -1, 'm')}.` : '') + ' ',
  Dust.strong('What it does to the dust figures:'), ' dust is loosened from between colliding grains more readily than from stiff ones, so amounts read high rather than low, and the place where it parts from the load is '
  + 'blurred by that distance. Dust that rides on a surface or hangs in the air is not touched.'
  + (c.all > 0 ? ` In the frames of this run ${Dust.count(c.fast)} of ${Dust.count(c.all)} dust grains are faster than anything that carries them (${Dust.number(c.limit_speed, 2)}\u202fm/s).` : '')
  + ' How far a figure depends on it is seen from a second run with ten times the ', Dust.el('code', {}, 'young_modulus'), ' (its steps are a third as long) beside this one: ', Dust.el('code', {}, 'engine compare'), '.');
