'use strict';
// The first screen of a plant: dust that the load carries and what sets it free, and the figures that sensors
// give the first screen (`towards` is overview).
Dust.plant_answer = (question, value, ...lines) => Dust.el('section', {class: 'answer'}, Dust.el('h2', {}, question),
  Dust.p({class: 'value'}, value), ...lines.flat().filter(Boolean));

// A figure with its error, unless that is one of rounding; two digits where nobody knows how many are true.
Dust.figure_alone = ({value, uncertainty}, unit) => (!Number.isFinite(value) ? Dust.dash
  : Number.isFinite(uncertainty) ? Dust.quantity(value, uncertainty > 1e-9 * Math.abs(value) ? uncertainty : -1, unit) : Dust.quantity(Number(value.toPrecision(2)), -1, unit));
// Why it has no error stands beside it: '350 mg/t (not steady)', and within brackets '100 g/h; not steady'.
Dust.figure_text = (figure, unit) => Dust.figure_alone(figure, unit) + Dust.why_no_error(figure);
Dust.figure_within = (figure, unit) => Dust.figure_alone(figure, unit) + (Dust.lacks_error(figure) ? `; ${figure.no_error}` : '');

// Less than a nanogram per m3, hour or tonne is none: below what any instrument reads, and what spreads through the cells of a field by rounding.
Dust.nanogram = {'kg/m3': 1e-12, 'g/m3': 1e-9, 'mg/m3': 1e-6, 'kg/s': 1e-12 / 3600, 'kg/h': 1e-12, 'g/h': 1e-9, 'g/t': 1e-9};
Dust.is_none = ({value, uncertainty, unit}) => Math.abs(value) + (uncertainty || 0) < (Dust.nanogram[unit] || 0);
Dust.none_text = (figures) => {
  const [{unit}] = figures.filter(Dust.is_none), per = unit === 'kg/s' ? 'h' : Dust.raise(unit.split('/')[1]);
  return `${per === 'm³' && figures.every(Dust.is_none) ? 'No dust there yet: l' : 'L'}ess than a nanogram per ${per} is none.`;
};

// Sums over the classes of dust: {fed, free, causes, sides, hoods, carriers, airborne, settled, ...} in kg, lists of {name, kg}, or null.
// Without loads `free` is what sources and clouds of the field give; with them that is `given`, and part of it.
Dust.load_dust = ({summary}) => {
  const loads = Object.values((summary.dust_on_grains || {}).classes || {}), field = Object.values((summary.dust_field || {}).classes || {});
  if (!loads.length && !field.length) return null;
  const has_loads = loads.length > 0, total = (list, of) => list.reduce((sum, c) => sum + (of(c) || 0), 0);
  const named = (list, of) => {
    const sums = new Map();
    for (const c of list) for (const [name, value] of Object.entries(of(c) || {})) sums.set(name, (sums.get(name) || 0) + (Number.isFinite(value) ? value : value.kg));
    return [...sums].map(([name, kg]) => ({name, kg})).sort((a, b) => b.kg - a.kg);
  };
  const settled = named(field, (c) => c.deposited_kg), sides = named(field, (c) => c.left_kg), hoods = named(field, (c) => c.hoods_kg),
    carriers = named(field, (c) => c.carried_out_kg);
  const all = (list) => list.reduce((sum, part) => sum + part.kg, 0), came_off = total(loads, (c) => c.set_free_kg), released = total(field, (c) => c.released_kg);
  const given = has_loads && released - came_off > 1e-9 * released ? released - came_off : 0;
  return {has_loads, fed: total(loads, (c) => c.entered_kg), free: has_loads ? came_off + given : released, came_off, given, causes: named(loads, (c) => c.set_free_by),
    airborne: total(field, (c) => c.airborne_kg), settled: all(settled), caught: total(field, (c) => c.caught_by_grains_kg), sides, hoods, carriers, out: all(sides), drawn: all(hoods),
    error: Math.max(...loads.map((c) => Math.abs(c.balance_error || 0)), ...field.map((c) => Math.abs(c.balance_error || 0)))};
};

// Where hoods extract what the load gives off, the answer to where to extract begins with what they catch.
Dust.has_hoods_for_load_dust = (data) => ((Dust.load_dust(data) || {}).hoods || []).length > 0;
// A hood by name with the flow it draws: 'top (4500 m3/h)'.
Dust.hood_text = ({setting}, name) => {
  const things = [...((setting || {}).sides || []), ...((setting || {}).bodies || [])], flow = (things.find((thing) => thing.name === name) || {}).flow_m3_per_s;
  return Dust.words(name) + (flow > 0 ? ` (${Dust.quantity(flow, -1, 'm3/s')})` : '');
};

// The same in the steady stream, as rates: {free, causes, sides, hoods, carriers, out, drawn, settled, caught, airborne, observed}, each part {name, rate, load},
// figures in kg/h and g/t with their errors; what carries dust out lying on it are `carriers`. Where a run tells no rates, or hardly anything comes off while they are
// taken (`quiet`, in s), means over the whole of it, without errors, and `observed` is 0. Amounts per tonne that the rates do not tell are those of the whole run: `is_whole`;
// none where that run was of two plants (`is_mixed`).
Dust.dust_stream = (data) => {
  const dust = Dust.load_dust(data), {summary} = data, figures = summary.dust_rates || {};
  if (!dust) return null;
  const ways_in = dust.has_loads ? ['set_free', 'released'] : ['released'], rate_of = (way) => (figures[`${way}/all/rate`] || {}).value || 0;
  // Shares of next to nothing say nothing.
  const negligible = 1e-3, others = ['left', 'drawn_out', 'deposited', 'carried_out', 'caught'].reduce((sum, way) => sum + Math.abs(rate_of(way)), 0);
  const seconds = (figures.observed || {}).value || 0, is_quiet = !(ways_in.reduce((sum, way) => sum + rate_of(way), 0) > negligible * others), observed = is_quiet ? 0 : seconds;
  const emitted = (summary.mass_kg || {}).emitted, is_mixed = (summary.start_from || {}).rates_since_s > 0;
  const per_tonne = (kg) => ({value: dust.has_loads && emitted > 0 && !is_mixed ? 1e6 * kg / emitted : NaN, uncertainty: null, is_whole: true});
  if (!observed) {
    const hours = summary.simulated_s / 3600, figure = (value) => ({value, uncertainty: null});
    const part = ({name, kg}) => ({name, rate: figure(hours > 0 ? kg / hours : NaN), load: per_tonne(kg)});
    const whole = (kg) => part({name: 'all', kg});
    return {observed, is_mixed, quiet: dust.free > 0 ? seconds : 0, free: whole(dust.free), came_off: whole(dust.came_off), given: whole(dust.given), causes: dust.causes.map(part), sides: dust.sides.map(part), hoods: dust.hoods.map(part), carriers: dust.carriers.map(part), out: whole(dust.out), drawn: whole(dust.drawn),
      settled: whole(dust.settled), caught: whole(dust.caught), airborne: whole(dust.airborne)};
  }
  const zero = {value: 0, uncertainty: null}, unknown = {value: NaN, uncertainty: null};
  const told = (name) => (figures[name] && Number.isFinite(figures[name].value) ? figures[name] : null);
  const part = (way, name, kg) => ({name, rate: figures[`${way}/${name}/rate`] || zero, load: told(`${way}/${name}/per_load`) || (kg === undefined ? unknown : per_tonne(kg))});
  const names = (way) => Object.keys(figures).map((key) => key.split('/')).filter(([w, name, last]) => w === way && name !== 'all' && last === 'rate').map(([, name]) => name);
  const parts = (way) => names(way).map((name) => part(way, name)).sort((a, b) => b.rate.value - a.rate.value);
  const came_off = part('set_free', 'all', dust.came_off), given = part('released', 'all', dust.has_loads ? undefined : dust.free);
  // What sources give is known: the error is that of what comes off.
  const free = !dust.has_loads ? given : {...came_off, rate: {...came_off.rate, value: came_off.rate.value + given.rate.value}}, out = part('left', 'all', dust.out), [drawn, settled, carried, caught] = ['drawn_out', 'deposited', 'carried_out', 'caught'].map((way) => part(way, 'all'));
  const rest = {value: [out, drawn, settled, carried, caught].reduce((left, {rate}) => left - rate.value, free.rate.value), uncertainty: null};
  return {observed, quiet: 0, free, came_off, given, causes: dust.has_loads ? parts('set_free') : [], sides: parts('left'), hoods: parts('drawn_out'), carriers: parts('carried_out'), out, drawn, settled, caught, airborne: {name: 'airborne', rate: rest, load: unknown}};
};
// Whether the cloud still grows or shrinks, in a sentence.
Dust.cloud_text = (free, airborne) => {
  const kept = free > 0 ? airborne / free : 0, share = Dust.percent(Math.abs(kept));
  if (Math.abs(kept) < 1e-4) return 'What comes into the air goes out of it again: where it goes has settled.';
  if (kept < -0.1) return `More dust leaves the air than comes into it, by ${share} of what comes: its cloud shrinks.`;
  return `${share} of what comes ${kept < 0 ? 'is lost from' : 'stays in'} the air: ${kept > 0.5 ? 'the run is too short to tell where it goes' : kept > 0.1 ? 'its cloud still grows' : 'where it goes has settled'}.`;
};
Dust.dust_surety = (data, stream) => {
  const dust = Dust.load_dust(data), {p} = Dust, end = data.summary.simulated_s, {uncertainty, no_error} = stream.free.rate;
  const said = stream.observed === 0 ? 'no error known' : Number.isFinite(uncertainty) ? '± one standard error' : no_error === 'not steady' ? 'not steady yet' : 'too short to tell an error';
  const restless = stream.observed > 0 && [...stream.hoods, ...stream.sides].filter((part) => part.rate.no_error === 'not steady' && part.rate.value > 0.01 * stream.free.rate.value);
  const seconds = (s) => `${Dust.number(s, 2)}\u202fs`, is_whole = stream.observed > 0 && stream.free.load.is_whole && Number.isFinite(stream.free.load.value);
  return Dust.plant_answer('How sure?', said,
    p({}, stream.observed > 0 ? `Means over the last ${seconds(stream.observed)}, without the start-up; the error is the scatter of this run alone.`
      : stream.quiet > 0 ? `Hardly any dust comes in the last ${seconds(stream.quiet)}: means over the whole ${Dust.number(end, 3)}\u202fs.`
        : `Means over the whole ${Dust.number(end, 3)}\u202fs, with its start-up, in which less comes off.`),
    stream.is_mixed && p({class: 'caution'}, 'They begin at 0\u202fs, with the run that this one started from: they are means over two plants.'),
    is_whole && p({class: 'caution'}, 'Nothing, or nothing even, is fed in that time: amounts per tonne are what has come off in the whole run over what has been released.'),
    stream.free.rate.value > 0 && p({}, Dust.cloud_text(stream.free.rate.value, stream.airborne.rate.value)),
    restless && restless.length > 0 && p({class: 'caution'}, `Not steady yet: what goes out at ${restless.map((part) => Dust.words(part.name)).join(', ')}.`),
    p({}, `The dust's mass closes to ${Dust.number(dust.error, 1)} of it${dust.has_loads ? '; what binds it to the load is measured, not known' : ''}.`), Dust.limits_text(data));
};

// What practice expects of one drop, named as what it is; nothing where the load's moisture is not known.
Dust.drop_estimate = ({dust_estimates}) => {
  const [first] = Object.values((dust_estimates || {}).ap42_drop || {}), digits = (value) => Dust.number(Number(value.toPrecision(2)), 2);
  return first && Dust.p({}, `Order of magnitude, AP-42 for one drop in the open: ${digits(first.least_g_per_tonne)} to ${digits(first.most_g_per_tonne)}\u202fg/t finer than 30\u202fµm in winds of 0.6 to 6.7\u202fm/s`);
};

// Rules of practice that need the height of the fall; nothing where the scenario does not say it. Two digits: they are no better.
Dust.fall_estimates = ({dust_estimates}) => {
  const {vdi_3790_3: drop, induced_air: air} = dust_estimates || {}, rough = (value, unit) => Dust.quantity(Number(value.toPrecision(2)), -1, unit);
  return [drop && Dust.p({}, `Order of magnitude, VDI 3790-3: ${rough(drop.over_2_m, '')} times what a drop of 2\u202fm gives off per tonne`),
    air && Dust.p({}, `Order of magnitude, Anderson's rule: ${rough(air.air_m3_per_s, 'm3/s')} of air drawn in (${rough(air.air_m3_per_tonne, 'm3/t')})`)];
};

// The three indices by which practice ranks transfer points: null where there is none of them.
Dust.indices_answer = ({summary}) => {
  const figures = summary.stream_indices || {}, said = (name) => Dust.figure_text(figures[name], figures[name].unit), within = (name) => Dust.figure_within(figures[name], figures[name].unit);
  const impact = ['impact/all/per_load', 'impact/all/power'].find((name) => figures[name] && figures[name].value > 0), air = figures['entrained_air/flow'], loose = figures['looseness/void_fraction'];
  if (!impact && !air && !loose) return null;
  const causes = Object.entries(figures).filter(([name]) => /^impact\/.*\/power$/.test(name) && name !== 'impact/all/power').sort(([, a], [, b]) => b.value - a.value)
    .map(([name]) => `${name.split('/')[1] === 'grains' ? 'grains on grains' : Dust.words(name.split('/')[1])} ${said(name)}`);
  return Dust.plant_answer('By the indices of practice?', impact ? said(impact) : air ? said('entrained_air/flow') : Dust.percent(loose.value),
    impact && Dust.p({}, `Impacts dissipate it: ${causes.slice(0, 3).join(', ')}`),
    air && Dust.p({}, `Entrained air: the stream takes ${said('entrained_air/flow')} down with it${Number.isFinite((figures['entrained_air/per_load'] || {}).value) ? ` (${within('entrained_air/per_load')})` : ''}`),
    loose && Dust.p({}, `Looseness: ${Dust.percent(loose.value)} of the stream is air where it is loosest, ${Dust.percent(figures['looseness/densest_void_fraction'].value)} where it is densest`));
};

Dust.load_dust_answers = (data) => {
  const dust = Dust.load_dust(data), stream = Dust.dust_stream(data), {summary} = data, {el, p} = Dust;
  if (!dust) return [];
  const {free, came_off, given} = stream, fed = (summary.mass_kg || {}).emitted > 0 ? Dust.quantity(1e6 * dust.fed / summary.mass_kg.emitted, -1, 'g/t') : Dust.dash;
  const said = Dust.figure_text, within = Dust.figure_within, is_told = ({value}) => Number.isFinite(value);
  const share = ({rate}) => (free.rate.value > 0 ? rate.value / free.rate.value : 0), percent = (part) => (free.rate.value > 0 ? Dust.percent(share(part)) : Dust.dash);
  const ranks = (list) => el('ul', {class: 'ranks'}, ...list.map((part) => el('li', {}, el('span', {}, part.title || Dust.words(part.name)), el('span', {}, percent(part)),
    Dust.bar(Math.max(share(part), 0), 'dustbar'))));
  const answer = Dust.plant_answer, counts = (part) => part.rate.value > 1e-4 * free.rate.value;
  const causes = stream.causes.filter((c) => c.rate.value > 0).map((c) => ({...c, title: c.name === 'grains' ? 'grains on grains' : Dust.words(c.name)}));
  const over_all = stream.observed > 0 && free.load.is_whole ? 'of all that was released, set free over the whole run' : '';
  const gets_out = counts(stream.out) && p({}, is_told(stream.out.load) ? `${said(stream.out.load, 'g/t')} get out with the air (${within(stream.out.rate, 'kg/h')})` : `${said(stream.out.rate, 'kg/h')} get out with the air`);
  const of_load = () => answer('How much dust?', !(came_off.rate.value > 0) ? 'none' : is_told(came_off.load) ? said(came_off.load, 'g/t') : said(came_off.rate, 'kg/h'), over_all && is_told(came_off.load) && p({}, over_all),
    p({}, `${said(came_off.rate, 'kg/h')} set free from the load, which carries ${fed}`), given.rate.value > 0 && p({}, `${said(given.rate, 'kg/h')} given by sources beside it`), gets_out, Dust.drop_estimate(summary), Dust.fall_estimates(summary));
  const of_field = () => answer(data.dust ? 'How much dust in the air?' : 'How much dust?', free.rate.value > 0 ? said(free.rate, 'kg/h') : 'none',
    p({}, dust.free > 0 ? `given by its sources; ${Dust.quantity(dust.free, -1, 'kg')} in the whole run, with the clouds at its start` : 'Nothing gave any dust in this run.'), gets_out);
  const how_much = dust.has_loads ? of_load() : of_field();
  const from_where = !dust.has_loads ? null : answer('From where?', causes.length ? Dust.sentence(causes[0].title) : 'nowhere yet', causes.length ? ranks(causes.slice(0, 4)) : null,
    data.release_map ? p({}, el('a', {href: '#liberation'}, 'Where it comes off')) : null);
  const fates = [{...stream.airborne, title: 'still in the air'}, {...stream.settled, title: 'settled'}, {...stream.caught, title: 'caught by grains'}, ...stream.hoods.map((h) => ({...h, title: `drawn out at ${Dust.words(h.name)}`})),
    ...stream.sides.map((s) => ({...s, title: `out at ${Dust.words(s.name)}`})), ...stream.carriers.map((c) => ({...c, title: `out lying on ${Dust.words(c.name)}`}))].filter(counts);
  // What has left the air's domain tells of the extraction only once it is steady; the page says both.
  const left = stream.out.rate.value + stream.drawn.rate.value, catches = left > 1e-2 * free.rate.value ? stream.drawn.rate.value / left : null;
  const unsure = [stream.drawn.rate, stream.out.rate].find((rate) => Dust.lacks_error(rate) && rate.value > 0.01 * left);
  const tried = data.extraction ? data.extraction.places.slice(0, 3) : [], hoods = dust.hoods;
  const where = hoods.length > 0 && answer('Where to extract?', catches === null ? 'too early to tell' : `${Dust.percent(catches)} caught${unsure ? Dust.why_no_error(unsure) : ''}`,
    p({}, catches === null ? 'Hardly any dust has left with the air yet.' : `of the dust that left with the air; ${hoods.map((h) => Dust.hood_text(data, h.name)).join(', ')} ${hoods.length > 1 ? 'extract' : 'extracts'}`),
    stream.sides.length > 0 && counts(stream.sides[0]) && p({}, `Most gets out at ${Dust.words(stream.sides[0].name)} (${within(stream.sides[0].rate, 'kg/h')})`),
    tried.length > 0 && [p({}, el('a', {href: '#extraction'}, 'Low pressure'), ', to be tried:'),
      el('ul', {class: 'ranks'}, ...tried.map((o) => el('li', {}, el('span', {}, Dust.place_xyz(o)), el('span', {}, Dust.depth(o)))))]);
  const goes = fates.length ? Dust.sentence(fates.reduce((a, b) => (b.rate.value > a.rate.value ? b : a)).title) : Dust.dash;
  return [how_much, from_where, answer('Where does it go?', goes, ranks(fates)), Dust.indices_answer(data), Dust.dust_surety(data, stream), where].filter((part) => part !== null);
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
    const text = (f) => (Dust.is_none(f) ? 'none' : Dust.amount(f)), [[first_name, first], ...others] = shown;
    const name = (n, f) => Dust.words(n.replace(/\/value$/, '').replace(/_/g, ' ')) + (f.quantity === 'time' && !/time/.test(n) ? ' time' : '');
    const what = (known.find((s) => s.name === sensor) || {}).what;
    answers.push(Dust.plant_answer(what ? Dust.el('span', {title: what}, Dust.sentence(sensor)) : Dust.sentence(sensor), text(first), Dust.p({}, name(first_name, first)),
      others.length ? Dust.el('ul', {class: 'ranks'}, ...others.map(([n, f]) => Dust.el('li', {}, Dust.el('span', {}, name(n, f)), Dust.el('span', {}, text(f))))) : null,
      shown.some(([, f]) => Dust.is_none(f)) ? Dust.p({class: 'note'}, Dust.none_text(shown.map(([, f]) => f))) : null));
  }
  if (silent.length) answers.push(Dust.plant_answer('Nothing counted', Dust.plural(silent.length, 'sensor'), Dust.p({}, silent.join(', ') + ': nothing came by, or their start-up had not passed.')));
  return answers;
};
