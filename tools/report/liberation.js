'use strict';
// Where dust came off the grains, by what, seen from the side.
Dust.sections.liberation = ({release_map}) => {
  if (!release_map) return null;
  const {el} = Dust, all = release_map.kinds.reduce((sum, kind) => sum + kind.kg, 0);
  const maps = release_map.kinds.map((kind, k) => el('figure', {}, el('div', {class: 'picture', id: `release-${k}-picture`}),
    el('figcaption', {}, el('b', {}, `Dust set free ${kind.title}`), `: ${Dust.percent(kind.kg / all)} of it.`)));
  return Dust.section('liberation', 'Where dust comes off',
    Dust.p({}, 'Mass that contacts and wind have set free from the load since the start, per cm² of the side view, logarithmic; all classes of dust.field together, one '
      + 'scale for all maps.'),
    el('div', {class: 'pair'}, ...maps), el('div', {id: 'release-legend', class: 'key'}));
};
Dust.draw_liberation = () => {
  const set = Dust.data.release_map;
  if (!set || !document.getElementById('release-0-picture')) return;
  set.kinds.forEach((kind, k) => {
    Dust.draw_map(document.getElementById(`release-${k}-picture`), `Map of the dust set free ${kind.title}`, {...set, data: kind.data}, Dust.release_colour);
  });
  Dust.decades_strip(document.getElementById('release-legend'), set, Dust.release_colour, 1e6 * set.most, 'mg/cm²');
};
