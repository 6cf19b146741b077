'use strict';
// The tables of a comparison of two runs.
(() => {
  const {el, p, dash} = Dust;
  const [first, second] = Dust.data.names;
  const columns = [{title: 'Quantity'}, {title: first, number: true}, {title: second, number: true}, {title: 'Difference', number: true}, {title: 'In standard errors', number: true}];
  const value = (v, error, unit, reason) => (v === null ? dash : Dust.quantity(v, error, unit)) + (reason ? ` (${reason})` : '');
  const row = (pair) => {
    const scale = pair.first !== null && pair.second !== null && pair.first !== 0 ? 100 * pair.difference / Math.abs(pair.first) : null;
    const difference = pair.difference === null ? dash : pair.difference === 0 ? 'none'
      : Dust.quantity(pair.difference, -1, pair.unit) + (scale !== null ? ` (${Dust.number(scale, 2)}\u202f%)` : '');
    const sigmas = pair.in_errors === null ? dash : Math.abs(pair.in_errors) > 3 ? Dust.strong(Dust.number(pair.in_errors, 2)) : Dust.number(pair.in_errors, 2);
    return [Dust.words(pair.name), value(pair.first, pair.first_error, pair.unit, pair.first_reason), value(pair.second, pair.second_error, pair.unit, pair.second_reason), difference, sigmas];
  };
  const groups_of = (pairs) => {
    const groups = new Map();
    for (const pair of pairs) groups.set(pair.group, [...(groups.get(pair.group) || []), pair]);
    return [...groups];
  };

  Dust.sections.header = (data) => {
    const rows = groups_of(data.headline).flatMap(([group, pairs]) => [{group: Dust.sentence(group)}, ...pairs.map(row)]);
    return el('header', {}, ...Dust.heading({kind: 'Comparison', title: `${first} beside ${second}`}),
      data.is_same_state ? p({class: 'lede'}, Dust.strong('The end states are the same'), ', bit for bit.') : '',
      ...data.names.filter((_, k) => data.status[k] && data.status[k] !== 'finished').map((name, k) => p({class: 'banner'}, `${name} was not finished: ${data.status[data.names.indexOf(name)]}.`)),
      Dust.table(columns, rows, {label: 'The runs beside each other'}) || '',
      p({class: 'note'}, 'Differences are those of the second run from the first. In standard errors: the difference over the root of the sum of both errors squared, for independent runs; beyond three in bold. ', data.errors_of_one_run));
  };
  Dust.sections.scenarios = ({scenario}) => {
    if (!scenario.length) return Dust.section('scenarios', 'Scenarios', p({}, 'Both runs have the same scenario.'));
    return Dust.section('scenarios', 'Where the scenarios differ', Dust.table([{title: 'Key'}, {title: first}, {title: second}],
      scenario.map((d) => [el('code', {}, d.path), d.first || dash, d.second || dash]), {label: 'Keys of the scenarios that differ'}));
  };
  Dust.sections.pictures = ({runs}) => (runs.some((run) => run.grains || run.air)
    ? Dust.section('pictures', 'Grains and air', el('div', {id: 'clock', class: 'clock screen'}), el('div', {class: 'cases', id: 'cases'})) : null);
  const plots = (id, title) => ({plots: all}) => {
    if (!all[id].length) return null;
    const grid = el('div', {class: 'grid'});
    Dust.later.push(() => all[id].forEach((plot) => Dust.readable_plot(grid, plot)));
    return Dust.section(id, title, grid);
  };
  Dust.sections.curves = plots('curves', 'Curves of the sensors');
  Dust.sections.series = plots('series', 'The runs over time');
  Dust.sections.figures = ({quantities}) => {
    const parts = groups_of(quantities).map(([sensor, pairs]) => Dust.details(Dust.words(sensor), Dust.plural(pairs.length, 'figure'), Dust.table(columns, pairs.map(row), {label: 'Figures of ' + Dust.words(sensor)})));
    return parts.length ? Dust.section('figures', 'All figures', parts) : null;
  };
})();
