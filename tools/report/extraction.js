'use strict';
// Mean pressure with the places of low pressure, and where the dust is.
Dust.sections.extraction = ({extraction, air, dust_map, dust}) => {
  if (!extraction) return null;
  const {places, first, reach_m} = extraction, {el} = Dust;
  const has_shares = places.some((place) => place.dust_share !== null);
  const columns = [{title: 'Ring'}, {title: 'x', number: true}, ...(Dust.is_deep() ? [{title: 'y', number: true}] : []), {title: 'z', number: true}, {title: 'Mean pressure', number: true},
    ...(has_shares ? [{title: `Dust within ${Dust.quantity(reach_m, -1, 'm')}`, number: true}] : []), {title: ''}];
  const rows = places.map((place, k) => [place.name, Dust.place_text(place.x), ...(Dust.is_deep() ? [Dust.place_text(place.y)] : []), Dust.place_text(place.z), Dust.depth(place),
    ...(has_shares ? [place.dust_share === null ? Dust.dash : Dust.percent(place.dust_share)] : []),
    k === first && place.dust_share > 0 ? Dust.strong('extract here first') : '']);
  const map = (id, title, text) => el('figure', {}, el('div', {class: 'picture', id: id + '-picture'}), el('div', {id: id + '-legend', class: 'key'}),
    el('figcaption', {}, el('b', {}, title), text));
  const maps = [];
  if (air) maps.push(map('mean-pressure', 'Mean pressure', ' over the second half of the run, in Pa. Rings: places of low mean pressure, the deepest is 1.'));
  if (dust_map) {
    maps.push(map('dust-map', 'Where the dust is', ', mean over the frames of the second half of the run: share of the dust in the domain per cm² of the side view, logarithmic.'
      + (dust && dust.partings.length ? ' Squares: where it parted from the load, in per cent of the loose dust.' : '')));
  }
  return Dust.section('extraction', 'Where to extract',
    Dust.p({}, 'Suction works with the flow where the pressure is low on its own, and removes most where dust lingers. Ranked by mean pressure; extract first where, among places surely '
      + 'below zero, most dust is near.'),
    Dust.table(columns, rows, {look: 'narrow', label: 'Places of low pressure'}),
    Dust.p({class: 'note'}, "Mean pressure with one standard error, over the sensor's averaging time and depth. Dust riding on a surface near by counts as near."),
    maps.length ? el('div', {class: 'pair'}, ...maps) : null);
};
Dust.draw_extraction = () => {
  const rings = (pen, picture) => {
    for (const place of (Dust.data.extraction || {places: []}).places) Dust.ring(pen, picture.x(place.x), picture.z(place.z), place.name);
  };
  // Where dust parted from the load, with its share.
  const squares = (pen, picture) => {
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.font = '11px ' + Dust.colour('sans');
    for (const {x, z, side, share} of (Dust.data.dust || {partings: []}).partings) {
      if (share < 0.02) continue;  // the squares that matter
      const size = side * picture.place.scale, left = picture.x(x) - size / 2, top = picture.z(z) - size / 2;
      pen.strokeStyle = pen.fillStyle = Dust.colour('ink');
      pen.lineWidth = 1;
      pen.setLineDash([2, 2]);
      pen.strokeRect(left, top, size, size);
      pen.setLineDash([]);
      if (share < 0.05) continue;  // neighbours have no room for all
      const text = Dust.number(100 * share, 2) + ' %';
      pen.strokeStyle = Dust.colour('raised');
      pen.lineWidth = 3;
      pen.strokeText(text, left + size / 2, top + size / 2);
      pen.fillText(text, left + size / 2, top + size / 2);
    }
  };
  const pressure = document.getElementById('mean-pressure-picture');
  if (pressure && Dust.air) {
    const set = Dust.data.air;
    let frame = null;
    const picture = new Dust.Picture(pressure, 'Map of the mean air pressure with ranked places', (pen, self) => {
      pen.fillStyle = Dust.colour('body');
      pen.fillRect(self.place.left, self.place.top, self.place.inner, self.place.height);
      if (frame) Dust.air.paint_pressure(pen, self, frame);
      self.bodies(pen);
      rings(pen, self);
    });
    Dust.legend_strip(document.getElementById('mean-pressure-legend'), Dust.pressure_colour, -1, -set.pressure, set.pressure, 'Pa');
    picture.tell_values('mean pressure', 'Pa', Dust.air.grid, (k) => Dust.air.pressure_of(frame)(k));
    Dust.air.load('mean').then((mean) => {
      frame = mean;
      picture.draw();
    });
  }

  const dust = document.getElementById('dust-map-picture');
  const set = Dust.data.dust_map;
  if (!dust || !set) return;
  const map = {...set, dx: set.cell, dz: set.cell}, most = 100 * set.most;
  const over = (pen, picture) => {
    squares(pen, picture);
    rings(pen, picture);
  };
  const picture = Dust.draw_map(dust, 'Map of the mean amount of dust with ranked places', map, Dust.dust_colour, {over});
  picture.tell_values('share of the dust', '%/cm²', map, (k) => {
    const code = picture.code(k);
    return code ? most * 10 ** (set.decades * ((code - 1) / 253 - 1)) : null;
  });
  Dust.decades_strip(document.getElementById('dust-map-legend'), map, Dust.dust_colour, most, '%/cm²');
};
