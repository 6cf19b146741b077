'use strict';
// The path of the stream: how far forward against the drop, true to scale: the figures whose role is stream_quantile, of
// one sensor. Its curves are the same again; of those that the scenario names beside them x is forward and y the height
// over the start.
(() => {
  const section = document.getElementById('stream');
  const of_stream = new Set(Dust.data.stream.map((d) => d.sensor));
  Dust.is_stream = (sensor) => of_stream.has(sensor);
  const percent = (probability) => Dust.number(100 * probability, 3) + '\u202f%';
  const looks = (probability) => (probability === 0.5 ? {colour: 'ink', width: 2.2} : {colour: 'tone2', width: 1.4});

  const references = () => Dust.data.curves.filter((c) => c.kind === 'reference' && of_stream.has(c.sensor) && Array.isArray(c.x) && Array.isArray(c.y)).map((curve) => {
    const points = curve.x.map((x, k) => [x, -curve.y[k]]).filter((p) => p.every(Number.isFinite)).sort((a, b) => a[1] - b[1]);
    return {name: String(curve.series), kind: 'reference', forward: points.map(([x]) => x), drop: points.map(([, drop]) => drop)};
  }).filter((line) => line.drop.length);
  const of_figures = () => {
    const lines = [['low', 0.05], ['median', 0.5], ['high', 0.95]].map(([key, probability]) => {
      const at = Dust.data.stream.filter((d) => d[key]), error = at.map((d) => (d[key].error > 0 ? d[key].error : null));
      const side = (sign) => at.map((d, k) => (error[k] === null ? null : d[key].value + sign * error[k]));
      return {name: percent(probability), probability, ...looks(probability), forward: at.map((d) => d[key].value), drop: at.map((d) => d.drop),
        ...(error.some((e) => e !== null) ? {near: side(-1), far: side(1), bars: true} : {})};
    }).filter((line) => line.drop.length);
    return lines;
  };
  // What single grains would do: thrown without air (dashed), and alone in still air (dotted).
  const of_flights = (deepest) => Dust.data.flights.flatMap((flight) => {
    const drops = Array.from({length: 41}, (_, k) => deepest * (k / 40) ** 2);
    const size_of = (one) => (flight.free.length > 1 ? ', ' + Dust.number(one.diameter * 1e3, 3) + ' mm' : '');
    return [...flight.free.map((one) => ({name: 'free flight' + size_of(one), kind: 'reference', drop: drops, forward: drops.map((h) => flight.speed * Math.sqrt(2 * Math.max(0, h + one.start) / flight.gravity))})),
      ...(flight.lone || []).map((one) => ({name: (one.diameter < 1e-3 ? Dust.number(one.diameter * 1e6, 3) + ' µm' : Dust.number(one.diameter * 1e3, 3) + ' mm') + ' alone', kind: 'reference', dash: [2, 3], colour: 'plot1', drop: one.drop, forward: one.x}))];
  });

  const {unit, factor} = Dust.places;
  const scaled = (list) => list && list.map((v) => (v === null ? null : v / factor));
  const outer = of_figures();
  if (!outer.length) return;
  const own = [...outer, ...references()];
  // Free flights beyond what the stream reaches would make it small.
  const reach = 1.1 * Math.max(...own.flatMap((l) => l.forward)), lines = [...own, ...of_flights(Math.max(...own.flatMap((l) => l.drop)))].map((line) => {
    const last = line.kind === 'reference' ? line.forward.filter((x) => x <= reach).length : line.forward.length;
    return {...line, x: scaled(line.drop.slice(0, last)), y: scaled(line.forward.slice(0, last)), low: scaled(line.near), high: scaled(line.far)};
  }).filter((line) => line.x.length);
  const speed = Dust.data.flights.length ? Dust.number(Dust.data.flights[0].speed) : '';
  Dust.plot(document.getElementById('stream-picture'), {title: 'Path of the stream', x_label: 'drop, ' + unit, y_label: 'forward, ' + unit, unit, lines, path: true,
    band: outer.length > 1 ? [0, outer.length - 1] : null,
    caption: [` Distance forward against the drop, both from the start of the stream, in ${unit}, true to scale.`,
      outer.length > 1 ? ` Between the outer lines: the grains between the ${outer[0].name} and ${outer.at(-1).name} quantiles; the heavy line is the median.` : '',
      speed ? ` Dashed: free flight without air of a grain on the belt, at its speed, ${speed}\u202fm/s.` : '',
      Dust.data.flights.some((flight) => (flight.lone || []).length) ? ' Dotted: single grains thrown level into still air at that speed (drag of Schiller and Naumann); a stream takes the air along and outruns them.' : ''],
    beside: [...section.querySelectorAll('.scroll')]});
  section.hidden = false;
})();
