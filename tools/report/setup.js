'use strict';
// The page of a set-up that has not run (`engine check SCENARIO -o setup.html`): what is where, and what it will cost.
Dust.sections.header = ({title, check}) => {
  const {thin} = Dust, megabytes = (bytes) => Dust.number(bytes / 1e6, 3) + thin + 'MB';
  const steps = check.smallest_step_s < check.largest_step_s
    ? `${Dust.quantity(check.smallest_step_s, -1, 's')} to ${Dust.quantity(check.largest_step_s, -1, 's')}` : Dust.quantity(check.largest_step_s, -1, 's');
  const tiles = Dust.tiles([['Simulated time', Dust.quantity(check.end_s, -1, 's'), `in steps of ${Dust.quantity(check.fluid_step_s, -1, 's')}`],
    ['Grains at a time', Dust.number(check.grains, 3), check.size_classes.length ? Dust.plural(check.size_classes.length, 'size class', 'size classes') : ''],
    ['Steps of the grains', steps, ''],
    ['Computing time of one core', Dust.duration(check.core_s), check.core_s_basis || ''],
    ['Memory', megabytes(check.memory_bytes), ''], ['Disk', megabytes(check.disk_bytes), '']]);
  return Dust.el('header', {}, ...Dust.heading({kind: 'Set-up', scenario: '', status: '', title: Dust.sentence(title)}), tiles);
};

Dust.sections.space = (data) => {
  const figure = Dust.space_figure(data);
  return figure ? Dust.section('space-section', 'In three dimensions', figure) : null;
};

// Where bodies touch and where they leave narrow gaps.
Dust.sections.bodies = ({check}) => {
  const place = ([x, y, z]) => `${Dust.place_number(x)}, ${Dust.place_number(y)}, ${Dust.place_text(z)}`;
  const pair = (entry) => entry.bodies.map(Dust.words).join(' – ');
  const rows = [...(check.touching || []).map((t) => [pair(t), 'touch', place(t.place_m)]),
    ...(check.gaps || []).map((g) => [pair(g), Dust.quantity(g.width_m, -1, 'm'), place(g.place_m)])];
  if (!rows.length) return null;
  return Dust.section('bodies', 'Gaps between bodies', Dust.table([{title: 'Bodies'}, {title: 'Gap', number: true}, {title: 'At x, y, z', number: true}], rows, {look: 'narrow', label: 'Gaps between bodies'}));
};

// setup.html#setting: the side view and its key and nothing else, for documents.
if (location.hash === '#setting') document.documentElement.dataset.view = 'setting';

Dust.show_setup = async () => {
  Dust.is_drawing = true;
  if (Dust.draw_setting) Dust.draw_setting();
  if (Dust.space) {
    await Dust.space.show(0, 0);
    await Dust.space.choose('space');
  }
  document.documentElement.dataset.drawn = 'yes';
};
