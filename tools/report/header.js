'use strict';
// The first screen: how much dust, from where, how sure, and where to extract.
Dust.sections.header = (data) => {
  const {summary, dust} = data;
  const {el, p} = Dust;
  const text_of = (value) => (typeof value === 'string' ? value : '');

  const title = () => {
    const given = text_of(data.title), scenario = text_of(summary.scenario);
    // The title is the scenario's name unless someone gave a better one.
    return Dust.sentence(given && given !== scenario ? given : scenario) || 'Run';
  };
  const banner = () => {
    const status = text_of(summary.status);
    if (!status || status === 'finished') return '';
    const at = Number.isFinite(summary.simulated_s) ? ` at ${Dust.number(summary.simulated_s)}\u202fs of simulated time` : '';
    if (status === 'running') return p({class: 'banner going', role: 'status'}, Dust.strong(`This run goes on; it stands${at}.`), ' Everything below is what it has reached.');
    const way_on = status === 'failed'
      ? ['The last good state is kept in ', el('code', {}, 'checkpoint.h5'), ', the cause stands at the end of ', el('code', {}, 'run.log'), '.']
      : [el('code', {}, 'engine run scenario.yaml --resume'), ' goes on from its checkpoint.'];
    return p({class: 'banner', role: 'status'}, Dust.strong((status === 'failed' ? 'This run failed' : 'This run was stopped before its end') + at + '.'),
      ' Everything below is what it had reached. ', text_of(summary.reason) ? text_of(summary.reason) + ' ' : '', way_on);
  };
  const place = Dust.place = (figure, words = Dust.words) => el('em', {}, words(figure.sensor)
    + (figure.diameter_m !== null && dust.classes.length > 1 ? ` (grains of ${Dust.quantity(figure.diameter_m, -1, 'm')})` : ''));
  const spoken = dust ? dust[dust.spoken_of] : [];
  const has_counted = spoken.some((f) => f.value !== 0);

  // Each figure that stands beside a published number once, with the first of its numbers.
  const published = [];
  for (const entry of data.references) {
    if (!Number.isFinite(entry.ours) || !Number.isFinite(entry.value)) continue;
    if (published.length === 4 || published.some((known) => known.quantity === entry.quantity)) continue;
    published.push({quantity: entry.quantity, name: Dust.sentence(String(entry.quantity).replace(/^sensors\./, '').replace(/\./g, ' ')),
      ours: Dust.quantity(entry.ours, entry.our_uncertainty, entry.unit), theirs: Dust.quantity(entry.value, entry.uncertainty, entry.unit)});
  }

  const lede = () => {
    if (dust && !has_counted) return [Dust.strong('No dust has been counted' + (dust.spoken_of === 'openings' ? ' at the openings' : '')), '.'];
    if (dust) {
      const {value, uncertainty} = dust.headline, is_small = value < 0.1, factor = is_small ? 1e3 : 1;
      const amount = `${Dust.value(value * factor, uncertainty * factor)}\u202f${is_small ? 'mg' : 'g'} of dust per tonne`;
      const share = dust.fed > 0 ? `, ${Dust.value(100 * value / dust.fed, 100 * uncertainty / dust.fed)}\u202f% of the dust fed` : '';
      const where = dust.spoken_of === 'openings' ? ['get out'] : ['is found at ', place(spoken[0])];
      return [Dust.strong(amount), ' of load ', ...where, share + '.'];
    }
    const stream = Dust.dust_stream(data);
    const is_of_load = stream && Dust.load_dust(data).has_loads, {load, rate} = stream ? (is_of_load ? stream.came_off : stream.free) : {};
    if (stream && !is_of_load) {
      return rate.value > 0 ? [Dust.strong(`${Dust.figure_text(rate, 'kg/h')} of dust`), ' come into the air.'] : [Dust.strong('No dust comes into the air'), '.'];
    }
    if (stream && Number.isFinite(load.value)) {
      return [Dust.strong(`${Dust.figure_text(load, 'g/t')} of dust`), load.is_whole ? ' have come off the load' : ' come off the load',
        ...(stream.causes.length ? [', most by ', el('em', {}, stream.causes[0].name === 'grains' ? 'grains on grains' : Dust.words(stream.causes[0].name))] : []), '.'];
    }
    if (published.length) return [published[0].name + ' ', Dust.strong(published[0].ours), `; published are ${published[0].theirs}.`];
    const emitted = (summary.particles || {}).emitted;
    if (!Number.isFinite(emitted)) return null;
    return [emitted === 1 ? 'One grain was released' : Dust.count(emitted) + ' grains were released',
      Number.isFinite(summary.simulated_s) ? ` in ${Dust.number(summary.simulated_s)}\u202fs of simulated time.` : '.'];
  };

  const answer = (question, value, ...lines) => el('section', {class: 'answer'}, el('h2', {}, question), p({class: 'value'}, value), ...lines.flat().filter(Boolean));
  const how_much = () => {
    const f = dust.fractions;
    return answer('How much dust?', dust.headline.value === 0 ? 'none counted' : Dust.amount(dust.headline),
      dust.fed > 0 && p({}, `of ${Dust.quantity(dust.fed, -1, 'g/t')} in the load`),
      f && p({}, `of that ${Dust.percent(f.inhalable)} inhalable, ${Dust.percent(f.thoracic)} thoracic, ${Dust.percent(f.respirable)} respirable (`,
        el('abbr', {title: 'EN 481:1993, by aerodynamic diameter'}, 'EN\u202f481'), `); PM10 ${Dust.percent(f.pm10)}`));
  };
  const from_where = () => {
    const most = 4, largest = Math.max(...spoken.map((f) => f.value), 0);
    const rows = spoken.slice(0, most).map((f) => el('li', {}, el('span', {}, place(f)),
      el('span', {}, f.value === 0 ? 'none' : Dust.amount(f)), Dust.bar(largest > 0 ? f.value / largest : 0, 'dustbar')));
    if (spoken.length > most) rows.push(el('li', {}, el('span', {}, el('a', {href: '#dust'}, `${spoken.length - most} more`))));
    const top = spoken.reduce((a, b) => (b.value > a.value ? b : a));
    // Where it is on its way: the largest passage that is a part of a total.
    const passing = dust.spoken_of === 'openings' && dust.passages.find((f) => f.towards && f.value !== 0);
    const first = dust.partings[0];
    return answer('From where?', has_counted ? place(top, Dust.sentence) : 'nowhere yet', el('ul', {class: 'ranks'}, ...rows),
      passing && p({}, Dust.amount(passing) + ' pass ', place(passing)),
      first && p({}, el('a', {href: '#dust'}, 'Parted from the load'), ` most near ${Dust.place_xz(first)}: `
        + `${Dust.value(100 * first.share, 100 * first.share_error)}\u202f%`));
  };
  const how_sure = () => {
    const {value, uncertainty} = dust.headline, is_known = uncertainty > 0 && value > 0;
    const counted = dust.observed_s > 0 && dust.counted !== null ? ` and ${Dust.number(dust.counted, 3)} real grains` : '';
    const from = dust.observed_s > 0 ? `, from ${Dust.quantity(dust.observed_s, -1, 's')} after start-up${counted}` : '';
    const steady = 1.5, change = dust.later_over_earlier;  // a factor between both halves that a short count may have
    const touched = data.limits.filter((l) => l.is_touched).length;
    const why = {'few grains': 'fewer than 20 grains were counted at an opening', 'not steady': 'the amount has not settled in the time observed'}[dust.headline.no_error];
    return answer('How sure?', is_known ? `±\u202f${Dust.number(100 * uncertainty / value, 2)}\u202f%` : dust.headline.no_error || 'no estimate',
      p({}, (is_known ? 'one standard error' : why || 'no standard error is known') + from),
      change !== null && (change > steady || change < 1 / steady)
        && p({class: 'caution'}, `Still changing: the second half of that time brought ${Dust.number(change, 2)} times the first.`),
      touched === 0 ? p({}, el('a', {href: '#health'}, 'No limit of validity touched'))
        : p({class: 'caution'}, el('a', {href: '#health'}, Dust.plural(touched, 'limit') + ' of validity touched')));
  };
  const where_to_extract = () => {
    const {places, first, reach_m} = data.extraction, best = places[first];
    const at = Dust.place_xyz;
    const others = places.filter((_, k) => k !== first).slice(0, 2);
    return answer('Where to extract?', at(best),
      p({}, Dust.depth(best) + ' in the mean' + (best.dust_share > 0 ? `; ${Dust.percent(best.dust_share)} of the dust lies within ${Dust.quantity(reach_m, -1, 'm')}` : '')),
      others.length > 0 && p({}, 'Low pressure next:'),
      others.length > 0 && el('ul', {class: 'ranks'}, ...others.map((o) => el('li', {}, el('span', {}, at(o)), el('span', {}, Dust.depth(o))))));
  };

  const tiles = () => {
    const last = data.stream.at(-1), grains = summary.particles || {}, real = (summary.real_particles || {}).emitted;
    const mass = (summary.mass_kg || {}).emitted;
    return Dust.tiles([...published.map((f) => [f.name, f.ours, 'published ' + f.theirs]),
      last && last.median && ['Stream, median', Dust.quantity(last.median.value, last.median.error, 'm'), `forward at ${Dust.quantity(last.drop, -1, 'm')} drop`],
      Number.isFinite(grains.emitted) && ['Grains released', Dust.count(grains.emitted), Number.isFinite(real) && real !== grains.emitted ? `for ${Dust.count(real)} real ones` : ''],
      Number.isFinite(mass) && ['Load released', Dust.quantity(mass, -1, 'kg'), ''],
      Number.isFinite(summary.wall_s) && ['Computing time', Dust.duration(summary.wall_s), Number.isFinite(summary.simulated_s) ? `for ${Dust.number(summary.simulated_s, 3)}\u202fs simulated` : '']]);
  };

  const words = lede();
  const answers = [...(dust ? [how_much(), from_where(), how_sure()] : []), ...Dust.load_dust_answers(data), ...(data.extraction && !Dust.has_hoods_for_load_dust(data) ? [where_to_extract()] : [])].filter(Boolean);
  const plant = Dust.overview_answers(data);
  if (plant.length && !answers.length) plant.unshift(Dust.no_dust_answer(data), Dust.overview_sure_answer(data));
  return el('header', {}, ...Dust.heading({kind: 'Run report', scenario: text_of(summary.scenario), status: text_of(summary.status), title: title()}),
    banner(), words ? p({class: 'lede'}, words) : '', answers.length ? el('div', {class: 'answers' + (answers.length > 4 ? ' many' : '')}, ...answers) : '',
    plant.length ? el('div', {class: 'answers'}, ...plant.filter(Boolean)) : '', tiles() || '');
};

// The mean pressure of a place; three digits where no error tells how many count.
Dust.depth = (place) => (place.depth.uncertainty > 0 ? Dust.quantity(-place.depth.value, place.depth.uncertainty, place.depth.unit)
  : Dust.number(-place.depth.value, 3) + '\u202f' + place.depth.unit);
