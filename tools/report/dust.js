'use strict';
// Where the dust goes: by place, by where it came from, by size.
Dust.sections.dust = ({dust}) => {
  if (!dust) return null;
  const amount = (f) => (f.value === 0 ? 'none counted' : Dust.amount(f));
  const of_fed = (value) => (dust.fed > 0 ? Dust.percent(value / dust.fed) : Dust.dash);
  const reach = (f) => Math.abs(f.value) + (f.uncertainty > 0 ? f.uncertainty : 0);
  const limit = Dust.quantity(dust.limit_m, -1, 'm');

  const by_place = () => {
    const all = [...dust.openings, ...dust.passages, ...dust.stocks];
    const largest = Math.max(dust.fed || 0, ...all.map(reach));
    const share = (value) => (largest > 0 ? Math.max(value, 0) / largest : 0);
    const rows = [];
    if (dust.fed > 0) rows.push(['In the load', Dust.quantity(dust.fed, -1, 'g/t'), Dust.percent(1), Dust.bar(share(dust.fed), 'fed')]);
    for (const [title, list] of [['Gets out', dust.openings], ['Passes', dust.passages], ['Is there at the end', dust.stocks]]) {
      if (!list.length) continue;
      rows.push({group: title}, ...list.map((f) => [Dust.place(f), amount(f), of_fed(f.value), Dust.error_bar(share(f.value), share(f.uncertainty), 'dustbar')]));
    }
    return [Dust.table([{title: 'By place'}, {title: 'Per tonne of load ± standard error', number: true}, {title: 'Share of the dust fed', number: true}, {title: ''}], rows,
      {look: 'bars', label: 'Dust by place'}),
    Dust.p({class: 'note'}, `Grains finer than ${limit}. What passes is counted per tonne released in the same time, after the sensor's start-up; what is there at the end, per `
      + 'tonne released until then. The same dust may pass several sensors: shares need not add up to the whole.')];
  };
  const by_origin = () => {
    const most = 8, shown = dust.partings.slice(0, most), rest = dust.partings.slice(most);
    const range = (middle, side) => `${Dust.place_number(middle - side / 2, 4)} to ${Dust.place_number(middle + side / 2, 4)}`;
    const rows = shown.map((p) => [`x\u202f${range(p.x, p.side)}, z\u202f${range(p.z, p.side)}\u202f${Dust.places.unit}`, Dust.amount(p.amount),
      `${Dust.value(100 * p.share, 100 * p.share_error)}\u202f%`, Dust.error_bar(p.share, p.share_error, 'dustbar')]);
    const sum = rest.reduce((a, p) => a + p.share, 0);
    if (sum > 0) rows.push([`${rest.length} other places`, Dust.dash, Dust.percent(sum), Dust.bar(sum, 'dustbar')]);
    if (!rows.length) return [];
    return [Dust.table([{title: 'By where it came from'}, {title: 'Per tonne of load ± standard error', number: true}, {title: 'Share of the loose dust', number: true}, {title: ''}], rows,
      {look: 'bars', label: 'Dust by where it came from'}),
    Dust.p({class: 'note'}, 'Where dust that is away from the coarse grains when last seen was last within two diameters of one, in squares of the side view; all of it, whether it '
      + 'got out, rides on a surface or hangs in the air. As fine as the frames of the run. Errors are those of counting.')];
  };
  const by_class = () => {
    if (!dust.classes.length) return [];
    const largest = Math.max(...dust.classes.map((c) => Math.max(c.fed || 0, c.out ? reach(c.out) : 0)));
    const rows = dust.classes.map((c) => [Dust.quantity(c.diameter_m, -1, 'm'), c.fed === null ? Dust.dash : Dust.quantity(c.fed, -1, 'g/t'), c.out ? amount(c.out) : Dust.dash,
      ...(c.fractions ? [`${Dust.number(c.aerodynamic_diameter_m * 1e6, 3)}\u202fµm`, ...['inhalable', 'thoracic', 'respirable', 'pm10'].map((key) => Dust.percent(c.fractions[key]))]
        : Array(5).fill(Dust.dash)),
      c.out && largest > 0 ? Dust.error_bar(c.out.value / largest, c.out.uncertainty / largest, 'dustbar') : '']);
    return [Dust.table([...['By size', 'In the load', 'Gets out ± standard error', 'Aerodynamic diameter', 'Inhalable', 'Thoracic', 'Respirable', 'PM10'].map((title) => ({title, number: true})), {title: ''}],
      rows, {look: 'bars', label: 'Dust by size'}),
    Dust.p({class: 'note'}, 'Inhalable, thoracic and respirable: the share of the mass a sampler takes in after EN\u202f481:1993, by aerodynamic diameter (that of a sphere of '
      + '1000\u202fkg/m³ settling as fast, here d\u202f(ρ/1000)^½); PM10: all grains up to 10\u202fµm aerodynamic diameter. The shares belong to the size classes of the run: a '
      + 'class stands for one size, so a class astride a limit falls on one side of it. The whole width of the bar is the largest amount in the load.')];
  };
  return Dust.section('dust', 'Where the dust goes', by_place(), by_origin(), by_class());
};
