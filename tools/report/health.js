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
  'mass_kg', 'timers_s', 'timer_groups', 'state_sha256', 'sensors', 'reason', 'size_classes', 'plugins', 'build', 'warnings', 'references', 'scenario_sha256', 'input_files', 'huge_page_bytes', 'series', 'series_roles']);

Dust.sections.health = ({summary, limits, notes, crushed}) => {
  const {p} = Dust;
  const leaves = (value, path) => {
    if (Array.isArray(value)) return value.flatMap((part) => leaves(part, path));
    if (value && typeof value === 'object') return Object.entries(value).flatMap(([key, part]) => leaves(part, path ? `${path} / ${key}` : key));
    if (value === null || value === undefined) return [];
    return [[Dust.words(path), value === true ? 'yes' : value === false ? 'no' : Number.isInteger(value) ? Dust.count(value) : typeof value === 'number' ? Dust.number(value, 6) : String(value)]];
  };
  const own = new Set(limits.map((l) => l.key));
  const health = Object.entries(summary.health || {}).filter(([key]) => !own.has(key)).flatMap(([key, value]) => leaves(value, key));
  const others = Object.entries(summary).filter(([key]) => key !== 'health' && !Dust.shown_elsewhere.has(key)).flatMap(([key, value]) => leaves(value, key));
  const warnings = (summary.warnings || []).filter((w) => typeof w === 'string');
  if (!health.length && !others.length && !notes.length && !limits.length && !warnings.length) return null;
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
    health.length ? Dust.details('Counters of the run', '', Dust.facts(health, 'Counters')) : null, others.length ? Dust.details('Other entries of the summary', '', Dust.facts(others, 'Other entries')) : null);
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
