'use strict';
// The set-up seen along y: bodies, emitters and sensors with numbers.
Dust.sections.setting = ({setting, bodies}) => {
  const {el} = Dust;
  const min = (setting.domain || {}).min, max = (setting.domain || {}).max;
  if (!min || !max || !(max[0] > min[0] && max[2] > min[2])) return null;
  const edge = (d) => Dust.place_number(max[d] - min[d], 4);
  const marks = [], keys = [];
  for (const [list, look] of [['emitters', 'emitter'], ['sensors', 'sensor']]) {
    for (const thing of setting[list] || []) {
      const has_place = (thing.min && thing.max) || thing.at;
      const number = has_place ? String(marks.length + 1) : Dust.dash;
      if (has_place) marks.push({thing, look, number});
      keys.push(el('li', {}, el('span', {class: 'badge ' + look}, number), el('span', {}, el('b', {}, Dust.words(thing.name)), ' ' + Dust.words(thing.model || '')
        + (Number.isFinite(thing.stands_for) ? `, each grain for ${Dust.number(thing.stands_for, 3)} smaller ones in the air` : ''))));
    }
  }
  const holder = el('div', {class: 'picture', id: 'setting-picture'});
  const badge = (pen, x, z, text, colour) => {
    pen.setLineDash([]);
    pen.fillStyle = Dust.colour('paper');
    pen.strokeStyle = colour;
    pen.beginPath();
    pen.arc(x, z, 9, 0, 6.2832);
    pen.fill();
    pen.stroke();
    pen.fillStyle = Dust.colour('ink');
    pen.font = '11px ' + Dust.colour('sans');
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.fillText(text, x, z);
  };
  const paint = (pen, picture) => {
    const {left, top, inner, height} = picture.place;
    pen.fillStyle = Dust.colour('raised');
    pen.fillRect(left, top, inner, height);
    picture.bodies(pen);
    const badges = [];
    for (const {thing, look, number} of marks) {
      const colour = Dust.colour(look === 'emitter' ? 'plot2' : 'accent');
      pen.strokeStyle = colour;
      pen.lineWidth = 1.5;
      if (thing.min && thing.max) {
        const [x0, x1] = [thing.min[0], thing.max[0]].sort((a, b) => a - b).map((x) => picture.x(x));
        const [z1, z0] = [thing.min[2], thing.max[2]].sort((a, b) => a - b).map((z) => picture.z(z));
        pen.setLineDash(look === 'sensor' ? [4, 3] : []);
        pen.globalAlpha = 0.12;
        pen.fillStyle = colour;
        pen.fillRect(x0, z0, x1 - x0, z1 - z0);
        pen.globalAlpha = 1;
        pen.strokeRect(x0, z0, x1 - x0, z1 - z0);
        badges.push([(x0 + x1) / 2, (z0 + z1) / 2, number, colour]);
      } else {
        const x = picture.x(thing.at[0]), z = picture.z(thing.at[2]);
        pen.setLineDash([]);
        pen.beginPath();
        pen.moveTo(x - 7, z);
        pen.lineTo(x + 7, z);
        pen.moveTo(x, z - 7);
        pen.lineTo(x, z + 7);
        pen.stroke();
        badges.push([x + 11, z - 11, number, colour]);
      }
    }
    const inside = (v, low, high) => Math.min(Math.max(v, low), high);
    for (const [x, z, text, colour] of badges) badge(pen, inside(x, left + 10, left + inner - 10), inside(z, top + 10, top + height - 10), text, colour);
    pen.setLineDash([]);
  };
  Dust.draw_setting = () => new Dust.Picture(holder, `Side view of the set-up: ${marks.map((m) => m.number + ' ' + Dust.words(m.thing.name)).join(', ')}`, paint,
    {view: [min[0], min[2], max[0], max[2]], bodies});
  const sides = Dust.table([{title: 'Side'}, {title: 'Grains'}, {title: 'Air'}], (setting.sides || []).map((side) => [side.name, Dust.words(side.grains || ''), side.air ? Dust.words(side.air) : Dust.dash]),
    {look: 'tight', label: 'Sides of the domain'});
  return Dust.section('setting', 'The set-up', el('figure', {class: 'side'}, holder, el('div', {},
    el('figcaption', {}, el('b', {}, 'Seen along y.'), ` Domain ${edge(0)} × ${edge(1)} × ${edge(2)}\u202f${Dust.places.unit}.`), keys.length ? el('ul', {class: 'keys'}, ...keys) : '', sides || '')));
};
