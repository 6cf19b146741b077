'use strict';
// The first screen of a plant: dust that the load carries and what sets it free, and the figures that sensors
// give the first screen (`towards` is overview).
Dust.plant_answer = (question, value, ...lines) => Dust.el('section', {class: 'answer'}, Dust.el('h2', {}, question),
  Dust.p({class: 'value'}, value), ...lines.flat().filter(Boolean));

// Sums over the classes of dust: {fed, free, causes: [{name, kg}], fates: [{name, kg}], hoods: Set} in kg, or null.
Dust.load_dust = ({summary}) => {
  const loads = Object.values((summary.dust_on_grains || {}).classes || {}), field = Object.values((summary.dust_field || {}).classes || {});
  if (!loads.length) return null;
  const total = (list, of) => list.reduce((sum, c) => sum + (of(c) || 0), 0);
  const named = (list, of) => {
    const sums = new Map();
    for (const c of list) for (const [name, value] of Object.entries(of(c) || {})) sums.set(name, (sums.get(name) || 0) + (Number.isFinite(value) ? value : value.kg));
    return [...sums].map(([name, kg]) => ({name, kg})).sort((a, b) => b.kg - a.kg);
  };
  const settled = named(field, (c) => c.deposited_kg), sides = named(field, (c) => c.left_kg), hoods = named(field, (c) => c.hoods_kg);
  const all = (list) => list.reduce((sum, part) => sum + part.kg, 0);
  return {fed: total(loads, (c) => c.entered_kg), free: total(loads, (c) => c.set_free_kg), causes: named(loads, (c) => c.set_free_by),
    airborne: total(field, (c) => c.airborne_kg), settled: all(settled), caught: total(field, (c) => c.caught_by_grains_kg), sides, hoods, out: all(sides), drawn: all(hoods),
    error: Math.max(...loads.map((c) => Math.abs(c.balance_error || 0)), ...field.map((c) => Math.abs(c.balance_error || 0)))};
};

// Where hoods extract what the load gives off, the answer to where to extract begins with what they catch.
Dust.has_hoods_for_load_dust = (data) => ((Dust.load_dust(data) || {}).hoods || []).length > 0;
// A hood by name with the flow it draws: 'top (4500 m3/h)'.
Dust.hood_text = ({setting}, name) => {
  const things = [...((setting || {}).sides || []), ...((setting || {}).bodies || [])], flow = (things.find((thing) => thing.name === name) || {}).flow_m3_per_s;
  return Dust.words(name) + (flow > 0 ? ` (${Dust.quantity(flow, -1, 'm3/s')})` : '');
};

Dust.load_dust_answers = (data) => {
  const dust = Dust.load_dust(data), {summary} = data, {el, p} = Dust;
  if (!dust) return [];
  const load = (summary.mass_kg || {}).emitted, hours = summary.simulated_s / 3600;
  const per_load = (kg) => (load > 0 ? Dust.quantity(1e6 * kg / load, -1, 'g/t') : Dust.dash);
  const rate = (kg) => (hours > 0 ? Dust.quantity(kg / hours, -1, 'kg/h') : Dust.dash);
  const share = (kg) => (dust.free > 0 ? Dust.percent(kg / dust.free) : Dust.dash);
  const ranks = (list, text) => el('ul', {class: 'ranks'}, ...list.map((part) => el('li', {}, el('span', {}, part.title || Dust.words(part.name)), el('span', {}, text(part.kg)),
    Dust.bar(dust.free > 0 ? part.kg / dust.free : 0, 'dustbar'))));
  const answer = Dust.plant_answer;
  const causes = dust.causes.filter((c) => c.kg > 0).map((c) => ({...c, title: c.name === 'grains' ? 'grains on grains' : Dust.words(c.name)}));
  const negligible = 1e-4 * dust.free;
  const how_much = answer('How much dust?', dust.free > 0 ? per_load(dust.free) : 'none', p({}, `${rate(dust.free)} set free from the load, which carries ${per_load(dust.fed)}`),
    dust.out > negligible && p({}, `${per_load(dust.out)} get out with the air (${rate(dust.out)})`));
  const from_where = answer('From where?', causes.length ? Dust.sentence(causes[0].title) : 'nowhere yet', causes.length ? ranks(causes.slice(0, 4), share) : null,
    data.release_map ? p({}, el('a', {href: '#liberation'}, 'Where it comes off')) : null);
  const fates = [{title: 'still in the air', kg: dust.airborne}, {title: 'settled', kg: dust.settled}, {title: 'caught by grains', kg: dust.caught}, ...dust.hoods.map((h) => ({...h, title: `drawn out at ${Dust.words(h.name)}`})),
    ...dust.sides.map((s) => ({...s, title: `out at ${Dust.words(s.name)}`}))].filter((f) => f.kg > negligible);
  // What has left the air's domain tells of the extraction only once it is steady; the page says both.
  const left = dust.out + dust.drawn, catches = left > 1e-2 * dust.free ? dust.drawn / left : null;
  const tried = data.extraction ? data.extraction.places.slice(0, 3) : [];
  const where = dust.hoods.length > 0 && answer('Where to extract?', catches === null ? 'too early to tell' : `${Dust.percent(catches)} caught`,
    p({}, catches === null ? 'Hardly any dust has left with the air yet.' : `of the dust that left with the air; ${dust.hoods.map((h) => Dust.hood_text(data, h.name)).join(', ')} ${dust.hoods.length > 1 ? 'extract' : 'extracts'}`),
    dust.sides.length > 0 && dust.sides[0].kg > negligible && p({}, `Most gets out at ${Dust.words(dust.sides[0].name)} (${rate(dust.sides[0].kg)})`),
    tried.length > 0 && [p({}, el('a', {href: '#extraction'}, 'Low pressure'), ', to be tried:'),
      el('ul', {class: 'ranks'}, ...tried.map((o) => el('li', {}, el('span', {}, Dust.place_xyz(o)), el('span', {}, Dust.depth(o)))))]);
  const sure = answer('How sure?', 'one run, no error known', p({}, `Means over the whole ${Dust.number(summary.simulated_s, 3)}\u202fs, with its start-up, in which less comes off.`),
    p({}, `${share(dust.airborne)} of the dust is still in the air: ${dust.airborne > 0.5 * dust.free ? 'the run is too short to tell where it goes' : 'where it goes has settled'}.`),
    p({}, `The dust's mass closes to ${Dust.number(dust.error, 1)} of it; what binds it to the load is measured, not known.`), Dust.limits_text(data));
  return [how_much, from_where, answer('Where does it go?', fates.length ? Dust.sentence(fates.reduce((a, b) => (b.kg > a.kg ? b : a)).title) : Dust.dash, ranks(fates, share)), sure, where];
};

// Whether a limit of validity was touched.
Dust.limits_text = ({limits}) => {
  const touched = (limits || []).filter((l) => l.is_touched), link = (text) => Dust.el('a', {href: '#health'}, text);
  if (!touched.length) return Dust.p({}, link('No limit of validity touched'));
  const names = touched.map((l) => ((Dust.limit_texts || {})[l.key] || [Dust.words(l.key)])[0].replace(/^./, (c) => c.toLowerCase()));
  return Dust.p({class: 'caution'}, link(Dust.plural(touched.length, 'limit') + ' of validity touched'), `: ${names.join('; ')}`);
};
Dust.overview_sure_answer = (data) => Dust.plant_answer('How sure?', '± one standard error', Dust.p({}, 'where one is given: the scatter of this run alone, after its start-up.'), Dust.limits_text(data));

// Of a run that computes no dust at all, so that nobody takes silence for none.
Dust.no_dust_answer = ({grains, summary, dust}) => {
  if (dust || Dust.load_dust({summary}) || !grains || !grains.classes.length || grains.is_dust.includes(true)) return null;
  const finest = Math.min(...grains.classes);
  return Dust.plant_answer('How much dust?', 'not computed', Dust.p({}, `The finest grains here are ${Dust.quantity(finest, -1, 'm')}, and the load carries no dust.`));
};

// One answer per sensor that has figures for the first screen; its first figure is the large one.
Dust.overview_answers = ({summary, setting}) => {
  const answers = [], silent = [], known = (setting || {}).sensors || [], place = (sensor) => known.findIndex((s) => s.name === sensor);
  // In the order of the scenario; those that it does not name come first.
  const sensors = Object.entries(summary.sensors || {}).sort(([a], [b]) => place(a) - place(b));
  for (const [sensor, figures] of sensors) {
    const shown = Object.entries(figures).filter(([, f]) => f && f.towards === 'overview' && Number.isFinite(f.value)).sort(([, a], [, b]) => (a.index || 0) - (b.index || 0));
    if (!shown.length) continue;
    if (shown.every(([, f]) => f.value === 0)) {
      silent.push(Dust.words(sensor));
      continue;
    }
    const text = (f) => Dust.quantity(f.value, f.uncertainty, f.unit), [[first_name, first], ...others] = shown;
    const name = (n, f) => Dust.words(n.replace(/\/value$/, '').replace(/_/g, ' ')) + (f.quantity === 'time' && !/time/.test(n) ? ' time' : '');
    const what = (known.find((s) => s.name === sensor) || {}).what;
    answers.push(Dust.plant_answer(what ? Dust.el('span', {title: what}, Dust.sentence(sensor)) : Dust.sentence(sensor), text(first), Dust.p({}, name(first_name, first)),
      others.length ? Dust.el('ul', {class: 'ranks'}, ...others.map(([n, f]) => Dust.el('li', {}, Dust.el('span', {}, name(n, f)), Dust.el('span', {}, text(f))))) : null));
  }
  if (silent.length) answers.push(Dust.plant_answer('Nothing counted', Dust.plural(silent.length, 'sensor'), Dust.p({}, silent.join(', ') + ': nothing came by, or their start-up had not passed.')));
  return answers;
};
