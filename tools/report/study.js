'use strict';
// The page of a study: the answer of a calibration, expected signs, main effects, all points.
(() => {
  const {el, p, dash} = Dust;
  const with_unit = (name, unit) => (Dust.is_bare(unit) ? Dust.words(name) : `${Dust.words(name)}, ${unit}`);
  const plain = (text) => String(text).replace(/_/g, ' ');  // names of cases; units stay
  const amount = (value, error, unit) => Dust.value(value, error === null ? -1 : error) + (Dust.is_bare(unit) ? '' : '\u202f' + unit);

  Dust.sections.header = ({facts, calibration}) => el('header', {}, ...Dust.heading({kind: 'Study', scenario: facts.name, status: facts.finished === facts.runs ? 'finished' : 'not finished', title: Dust.sentence(facts.name)}),
    p({class: 'lede'}, facts.sentence || (calibration ? `Calibration of ${facts.base}.` : `Variations of ${facts.base}.`)),
    Dust.tiles([['Runs', Dust.count(facts.runs), `${Dust.plural(facts.inputs, 'input')}, ${Dust.plural(facts.outputs, 'output')}`],
      ['Finished', `${Dust.count(facts.finished)} of ${Dust.count(facts.runs)}`, facts.failed === 0 ? 'none failed' : `${facts.failed} failed`],
      ['Time of all runs', Dust.duration(facts.wall_s), 'one after the other'], ['Base', facts.base, facts.base_file]]));

  // Places of hoods against their flows: what is drawn out, what still escapes, the capture.
  Dust.sections.hoods = ({hoods}) => {
    if (!hoods) return null;
    // One unit for all flows: they compare.
    const most = Math.max(...hoods.places.flatMap((place) => place.trials.map((t) => t.flow_m3_per_s)), 0);
    const [per_s, flow_unit] = most > 1 / 60 ? [3600, 'm³/h'] : [6e4, 'l/min'];
    const flow = (f) => Dust.number(per_s * f, 3) + '\u202f' + flow_unit;
    const percent = (share) => Dust.number(100 * share, 2) + '\u202f%';
    const at = (place) => (place.opening ? place.opening.map((v) => Dust.number(1e3 * v, 3)).join(', ') + '\u202fmm' : dash);
    const best_of = (place) => Math.max(...place.trials.map((t) => (t.capture ? t.capture.value : 0)), 0);
    const needed = (place) => (place.needed ? flow(place.needed.flow_m3_per_s) + (place.needed.is_bound ? ' or less' : '') : `not reached, at most ${percent(best_of(place))} captured`);
    const reaching = hoods.places.filter((place) => place.needed).sort((a, b) => a.needed.flow_m3_per_s - b.needed.flow_m3_per_s)[0];
    const answer = reaching ? [`${percent(hoods.wanted)} of the dust `, 'is captured by ', Dust.strong(needed(reaching)), ' at ', Dust.strong(Dust.words(reaching.name)), reaching.opening ? `, opening at ${at(reaching)}.` : '.']
      : [`No hood that was tried captures ${percent(hoods.wanted)} of the dust.`];
    const n = (title) => ({title, number: true});
    const places = Dust.table([{title: 'Place'}, {title: 'Middle of the opening, x, y, z'}, n(`Smallest flow for ${percent(hoods.wanted)}`)], hoods.places.map((place) => [Dust.words(place.name), at(place), needed(place)]), {look: 'narrow', label: 'Places'});

    const cell = (v, factor = 1) => (v === null ? dash : Dust.value(factor * v.value, v.error === null ? -1 : factor * v.error));
    const capture = (t) => (t.capture === null ? dash : t.is_few ? Dust.number(100 * t.capture.value, 2) + ' (few grains)' : cell(t.capture, 100));
    // Hoods that stand there anyway have a column where there are any.
    const row = (place, at_flow, t) => [place, at_flow ? flow(t.flow_m3_per_s) : dash, at_flow ? cell(t.drawn) : dash, ...(hoods.has_others ? [cell(t.drawn_by_others)] : []),
      cell(t.escapes), at_flow || hoods.has_others ? capture(t) : dash];
    const rows = [...(hoods.plain ? [row(hoods.has_others ? 'no hood more' : 'no hood', false, hoods.plain)] : []),
      ...hoods.places.flatMap((place) => place.trials.map((t) => row(Dust.words(place.name), true, t)))];
    const grid = el('div', {class: 'grid'});
    Dust.later.push(() => Dust.plot(grid, {title: 'Capture', x_label: 'flow, ' + flow_unit, y_label: 'of the dust, %', unit: '%', lines: hoods.places.map((place) => {
      const seen = place.trials.filter((t) => t.capture), error = (t) => (t.capture.error || 0);
      return {name: place.name, x: seen.map((t) => per_s * t.flow_m3_per_s), y: seen.map((t) => 100 * t.capture.value),
        low: seen.map((t) => 100 * (t.capture.value - error(t))), high: seen.map((t) => 100 * (t.capture.value + error(t)))};
    })}));
    return Dust.section('hoods', 'What the hoods capture', p({class: 'lede'}, ...answer), places,
      Dust.table([{title: 'Place'}, n('Flow'), n(`Drawn out, ${hoods.unit}`), ...(hoods.has_others ? [n(`By other hoods, ${hoods.unit}`)] : []), n(`Escapes, ${hoods.unit}`), n('Capture, %')], rows, {label: 'Hoods'}), grid,
      p({class: 'note'}, 'Capture: what all hoods draw out over that and what still escapes through the openings that are watched, after the flow of the hood has come about; with one standard error. '
        + 'The smallest flow lies on a straight line between two that were tried; for another fraction: engine suggest-hoods DIR --capture.'));
  };

  Dust.sections.calibration = ({calibration: c}) => {
    if (!c) return null;
    if (!c.has_answer) return Dust.section('calibration', 'The answer', p({class: 'banner'}, 'Not enough runs finished for an answer.'));
    const n = (title) => ({title, number: true});
    const parts = [el('div', c.is_good ? {} : {class: 'banner'}, ...c.statements.map((text) => p({}, text))),
      Dust.table([{title: 'Parameter'}, n('Likeliest'), n('Mean ± deviation'), n('Region from'), n('To'), {title: 'Pinned down'}],
        c.estimates.map((e) => [with_unit(e.name, e.unit), Dust.number(e.best), Dust.value(e.mean, e.deviation), Dust.number(e.low), Dust.number(e.high), e.is_pinned ? 'yes' : Dust.strong('no')]), {look: 'narrow', label: 'Parameters'}),
      Dust.table([{title: 'Target'}, n('Measured'), n('Expected at the likeliest values'), n('Off by [errors]'), n('Scatter of single runs'), n('Their own errors'), n('Not steady')],
        c.targets.map((t) => [with_unit(t.name, t.unit), Dust.value(t.measured, t.measured_error), Dust.value(t.expected, t.expected_error), Dust.number(t.chi, 2), Dust.number(t.scatter, 2), Dust.number(t.run_error, 2), t.points_not_steady > 0 ? Dust.strong(String(t.points_not_steady)) : Dust.number(0)]), {look: 'narrow', label: 'Targets'})];
    if (c.curves) {
      const grid = el('div', {class: 'grid'});
      Dust.later.push(() => c.curves.forEach((q) => Dust.plot(grid, {title: q.goal, x_label: with_unit(q.parameter, q.parameter_unit), y_label: with_unit(q.goal, q.unit), unit: Dust.raise(q.unit),
        note: 'Runs, the surrogate through them, and the target (dashed).', lines: [{name: 'surrogate', ...q.surrogate, width: 2}, {name: 'runs', kind: 'points', ...q.runs},
          {name: 'target', kind: 'reference', x: [q.low, q.high], y: [q.value, q.value]}]})));
      parts.push(grid);
    }
    if (c.crossing) parts.push(Dust.crossing(c.crossing, c.confidence));
    parts.push(p({class: 'note'}, `${c.places} places were run, at most ${c.runs}; surrogate: ${Dust.words(c.surrogate)}. Region: the smallest that holds the parameters with the stated probability, if the targets' errors are normal and `
      + 'independent and every value in the ranges is equally likely beforehand. It holds errors of targets and surrogate, not those of the model.'));
    return Dust.section('calibration', 'The answer', parts);
  };

  const told_from_noise = 'A change is told from noise when it exceeds twice its standard error, or where few seeds tell that, Student\u2019s t of so few: 12.7 errors of two, 4.3 of three. '
    + 'It is open where points are not steady.';

  Dust.sections.expectations = ({expectations}) => {
    if (!expectations.length) return null;
    const count = (kind) => expectations.filter((e) => e.verdict === kind).length;
    const look = {as_expected: 'good', against: 'wrong'};
    const rows = expectations.map((e) => [`${Dust.words(e.output)} ${e.then}`, (e.from ? `from ${e.from} to ${e.to}` : `with ${e.input}`) + (e.at ? ` ${e.at}` : ''), look[e.verdict] ? Dust.strong(e.text, look[e.verdict]) : e.text, e.why]);
    return Dust.section('expectations', 'Expected signs', p({}, `${count('as_expected')} of ${expectations.length} are as expected, ${count('against')} against, ${count('open')} undecided. `, told_from_noise),
      Dust.table([{title: 'Expected'}, {title: 'When'}, {title: 'Found'}, {title: 'Why'}], rows, {label: 'Expected signs'}));
  };

  Dust.sections.effects = ({effects}) => {
    if (!effects) return null;
    const {columns, rows} = effects.table;
    const size = (cell, unit) => amount(cell.change, cell.error, unit) + (cell.coverage ? '\u202f*' : '') + (cell.unsteady ? '\u202f†' : '');
    const any = (what) => rows.some((r) => r.cells.some((cell) => cell && cell[what]));
    const table = columns.length ? [Dust.table([{title: 'Change of'}, ...columns.map((c) => ({number: true,
      title: `over ${Dust.words(c.name)} ${Dust.number(c.from)} to ${Dust.number(c.to)}${Dust.is_bare(c.unit) ? '' : ' ' + c.unit}`}))],
    rows.map((r) => [Dust.words(r.output), ...r.cells.map((cell) => (!cell ? dash : cell.is_clear ? Dust.strong(size(cell, r.unit)) : size(cell, r.unit)))]), {label: 'Main effects'}),
    p({class: 'note'}, 'From the smallest value to the largest, with one standard error where one is known; bold: told from noise.' + (any('coverage') ? ' *: points are missing; the change is over what finished at both values.' : '')
      + (any('unsteady') ? ' †: of points that are not steady.' : ''))] : [];
    const parts = effects.outputs.flatMap((output) => {
      const grid = el('div', {class: 'grid'});
      for (const r of output.rows) grid.append(row_figure(r));
      Dust.later.push(() => output.plots.forEach((plot) => {
        const over = plot.is_scattered ? 'the range (fitted line): ' : 'the levels: ';
        Dust.readable_plot(grid, {...plot, note: (plot.change === null ? 'No change is known' : `Change over ${over}${amount(plot.change, plot.change_error, plot.unit)}`) + covered(plot) + '.'});
      }));
      return [el('h3', {}, Dust.words(output.name), el('small', {}, output.quantity + (output.minus ? ' − ' + output.minus : ''))), grid];
    });
    return Dust.section('effects', 'Main effects', p({}, 'Each mark is the mean over the runs with that level, of the combinations of the other inputs that finished at every level. Errors: from replicates where there are any, otherwise from what the sensors tell of themselves. A hollow mark has no error: none is known, or its points are not steady.'),
      table, parts);
  };
  const covered = ({coverage, unsteady}) => [coverage, unsteady].filter(Boolean).map((text) => ` (${text})`).join('');
  // Names beside means with their errors, as bars on one scale.
  const row_figure = ({title, unit, input, rows, coverage, unsteady}) => {
    const largest = Math.max(...rows.map((r) => Math.abs(r.value) + (r.error || 0)), 1e-300);
    return el('figure', {}, Dust.table([{title: Dust.words(input)}, {title: with_unit(title, unit), number: true}, {title: ''}],
      rows.map((r) => [plain(r.name), Dust.value(r.value, r.error === null ? -1 : r.error) + (r.no_error ? ` (${r.no_error})` : ''), Dust.error_bar(Math.abs(r.value) / largest, (r.error || 0) / largest, r.no_error ? 'hollow' : '')]), {look: 'bars', label: `${title} by ${input}`}),
    el('figcaption', {}, el('b', {}, Dust.sentence(title) + '.'), ` Mean against ${Dust.words(input)}${covered({coverage, unsteady})}.`));
  };

  Dust.sections.points = ({points}) => {
    const n = (c) => ({title: with_unit(c.name, c.unit), number: true});
    const is_text = (k) => points.rows.some((r) => /[a-z]/i.test(String(r.inputs[k]).replace(/e[+-]?\d/i, '')));
    const input = (c, k) => ({...n(c), number: !is_text(k)});
    const rows = points.rows.map((r, k) => [r.status === 'finished' ? el('a', {href: `points/${r.hash}/report.html`}, String(k + 1)) : String(k + 1), ...r.inputs.map(plain), String(r.seed),
      ...r.outputs.map((o) => (o.value === null ? dash : o.error === null ? Dust.number(o.value, 5) + Dust.why_no_error(o) : Dust.value(o.value, o.error))), r.status + (r.reason ? ': ' + r.reason : ''), r.wall_s === null ? '' : Dust.duration(r.wall_s)]);
    return Dust.section('points', 'All points', Dust.table([{title: 'Point'}, ...points.inputs.map(input), {title: 'Seed', number: true}, ...points.outputs.map(n), {title: 'Status'}, {title: 'Time', number: true}], rows, {label: 'All points'}),
      p({class: 'note'}, "The numbers lead to the runs' own reports. The same table stands in study.csv, and as columns in study.h5."));
  };
  Dust.sections.provenance = ({study_file}) => Dust.section('provenance', 'Provenance', p({}, 'Every run keeps its full scenario beside its results: points/HASH.yaml.'),
    Dust.details('The study file', '', el('pre', {tabindex: 0}, study_file)));
})();
