'use strict';
// The set-up seen along y: bodies, emitters and sensors with numbers. For the page of a run and for that of a set-up
// that has not run (`engine check -o`).
Dust.sections.setting = ({setting, bodies}) => {
  const {el} = Dust;
  const min = (setting.domain || {}).min, max = (setting.domain || {}).max;
  if (!min || !max || !(max[0] > min[0] && max[2] > min[2])) return null;
  const edge = (d) => Dust.place_number(max[d] - min[d], 4);
  const inside = (v, low, high) => Math.min(Math.max(v, low), high);

  // The highest of its edges' ends in the domain, of a body.
  const top_of = (name) => {
    const body = bodies.find((b) => b.name === name);
    const ends = body ? body.segments.flatMap(([xa, za, xb, zb]) => [[xa, za], [xb, zb]]) : [];
    const seen = ends.filter(([x, z]) => x >= min[0] && x <= max[0] && z >= min[2] && z <= max[2]);
    return seen.length ? seen.reduce((a, b) => (b[1] > a[1] + 1e-9 || (b[1] > a[1] - 1e-9 && b[0] < a[0]) ? b : a)) : null;
  };
  const looks = {body: 'body-line', emitter: 'plot2', sensor: 'accent'};
  const words_of = {
    body: (b) => `${Dust.words(b.shape)} of ${Dust.words(b.material)}` + b.motions.map((m) => ', ' + Dust.words(m)).join(''),
    emitter: (e) => Dust.words(e.model || '') + (Number.isFinite(e.stands_for) ? `, each grain for ${Dust.number(e.stands_for, 3)} smaller ones in the air` : ''),
    sensor: (s) => Dust.words(s.model || ''),
  };
  const marks = [], keys = [];
  for (const [list, look] of [['bodies', 'body'], ['emitters', 'emitter'], ['sensors', 'sensor']]) {
    for (const thing of setting[list] || []) {
      const top = look === 'body' ? top_of(thing.name) : null;
      const has_place = (thing.min && thing.max) || thing.at || top;
      const number = has_place ? String(marks.length + 1) : Dust.dash;
      if (has_place) marks.push({thing, look, number, top});
      keys.push(el('li', {}, el('span', {class: 'badge ' + look}, number), el('span', {}, el('b', {}, Dust.words(thing.name)), ` ${look}: ` + words_of[look](thing))));
    }
  }

  const box_of = (picture, thing) => {
    const [x0, x1] = [thing.min[0], thing.max[0]].sort((a, b) => a - b).map((x) => picture.x(x));
    const [z1, z0] = [thing.min[2], thing.max[2]].sort((a, b) => a - b).map((z) => picture.z(z));
    return [x0, z0, x1 - x0, z1 - z0];
  };
  // Draws a thing and says where its number goes.
  const draw_mark = (pen, picture, {thing, look, top}) => {
    if (top) return [picture.x(top[0]), picture.z(top[1])];
    pen.strokeStyle = pen.fillStyle = Dust.colour(looks[look]);
    pen.lineWidth = 1.5;
    if (thing.min && thing.max) {
      const [x, z, width, height] = box_of(picture, thing);
      pen.setLineDash(look === 'sensor' ? [4, 3] : []);
      pen.globalAlpha = 0.12;
      pen.fillRect(x, z, width, height);
      pen.globalAlpha = 1;
      pen.strokeRect(x, z, width, height);
      // A number inside a small one would hide it.
      return Math.max(width, height) < 40 ? [x + width + 11, z - 11] : [x + width / 2, z + height / 2];
    }
    const x = picture.x(thing.at[0]), z = picture.z(thing.at[2]);
    const cross = (a, b) => {
      pen.setLineDash([]);
      pen.beginPath();
      pen.moveTo(a - 7, b);
      pen.lineTo(a + 7, b);
      pen.moveTo(a, b - 7);
      pen.lineTo(a, b + 7);
      pen.stroke();
    };
    cross(x, z);
    if (thing.to) {
      const end = [picture.x(thing.to[0]), picture.z(thing.to[2])];
      cross(...end);
      pen.setLineDash([4, 3]);
      pen.beginPath();
      pen.moveTo(x, z);
      pen.lineTo(...end);
      pen.stroke();
    }
    return [x + 11, z - 11];
  };
  const badge = (pen, x, z, text, colour) => {
    pen.setLineDash([]);
    pen.fillStyle = Dust.colour('paper');
    pen.strokeStyle = colour;
    pen.lineWidth = 1.3;
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
    pen.fillStyle = Dust.colour('accent');
    for (const region of setting.regions || []) {
      pen.globalAlpha = 0.14;
      pen.fillRect(...box_of(picture, region));
      pen.globalAlpha = 1;
    }
    picture.bodies(pen);
    const taken = [];
    for (const [mark, [x, z]] of marks.map((mark) => [mark, draw_mark(pen, picture, mark)])) {
      // Beside the numbers that stand there already.
      const row = inside(z, top + 10, top + height - 10);
      let at = inside(x, left + 10, left + inner - 10);
      const is_free = (p) => taken.every(([a, b]) => Math.hypot(a - p, b - row) >= 19);
      for (const step of [20, -20]) {
        let next = at;
        while (!is_free(next) && next >= left + 10 && next <= left + inner - 10) next += step;
        if (next >= left + 10 && next <= left + inner - 10) {
          at = next;
          break;
        }
      }
      taken.push([at, row]);
      badge(pen, at, row, mark.number, Dust.colour(looks[mark.look]));
    }
  };
  const holder = el('div', {class: 'picture', id: 'setting-picture'});
  Dust.draw_setting = () => new Dust.Picture(holder, `Side view of the set-up: ${marks.map((m) => m.number + ' ' + Dust.words(m.thing.name)).join(', ')}`, paint,
    {view: [min[0], min[2], max[0], max[2]], bodies});
  const grains_at = (side) => Dust.words(side.grains || '') + (side.material ? ' of ' + Dust.words(side.material) : '');
  const sides = Dust.table([{title: 'Side'}, {title: 'Grains'}, {title: 'Air'}], (setting.sides || []).map((side) => [side.name, grains_at(side), side.air ? Dust.words(side.air) : Dust.dash]),
    {look: 'tight', label: 'Sides of the domain'});
  const has_section = bodies.some((body) => (body.section || []).length);
  return Dust.section('setting', 'The set-up', el('figure', {class: 'side'}, holder, el('div', {},
    el('figcaption', {}, el('b', {}, 'Seen along y.'), ` Domain ${edge(0)} × ${edge(1)} × ${edge(2)}\u202f${Dust.places.unit}.`, has_section ? ' Filled: what the middle plane cuts.' : ''),
    keys.length ? el('ul', {class: 'keys'}, ...keys) : '', sides || '')));
};
