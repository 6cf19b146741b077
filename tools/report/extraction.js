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
  const below = (pen, picture, colour) => {
    pen.fillStyle = Dust.colour(colour);
    pen.fillRect(picture.place.left, picture.place.top, picture.place.inner, picture.place.height);
  };

  const pressure = document.getElementById('mean-pressure-picture');
  if (pressure && Dust.air) {
    const set = Dust.data.air;
    let frame = null;
    const picture = new Dust.Picture(pressure, 'Map of the mean air pressure with ranked places', (pen, self) => {
      below(pen, self, 'body');
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
  const colour_of = Dust.dust_colour;
  const buffer = document.createElement('canvas');
  buffer.width = set.nx;
  buffer.height = set.nz;
  let codes = null;
  const picture = new Dust.Picture(dust, 'Map of the mean amount of dust with ranked places', (pen, self) => {
    below(pen, self, 'raised');
    if (codes) {
      const inner = buffer.getContext('2d'), image = inner.createImageData(set.nx, set.nz);
      for (let z = 0; z < set.nz; ++z) {
        for (let x = 0; x < set.nx; ++x) {
          const code = codes[(set.nz - 1 - z) * set.nx + x];
          if (code) image.data.set([...colour_of((code - 1) / 253), 255], 4 * (z * set.nx + x));
        }
      }
      inner.putImageData(image, 0, 0);
      pen.imageSmoothingEnabled = false;
      pen.drawImage(buffer, self.x(set.x0), self.z(set.z0 + set.nz * set.cell),
        set.nx * set.cell * self.place.scale, set.nz * set.cell * self.place.scale);
    }
    self.bodies(pen);
    squares(pen, self);
    rings(pen, self);
  });
  picture.tell_values('share of the dust', '%/cm²', {nx: set.nx, nz: set.nz, x0: set.x0, z0: set.z0, dx: set.cell, dz: set.cell},
    (k) => (codes && codes[k] ? 100 * set.most * 10 ** (set.decades * ((codes[k] - 1) / 253 - 1)) : null));
  Dust.unpack(set.data).then((bytes) => {
    codes = bytes;
    picture.draw();
  });
  // A logarithmic strip: decades down from the largest share.
  const strip = Dust.el('canvas', {width: 256, height: 1});
  const labels = Array.from({length: set.decades + 1}, (_, k) => Dust.el('span', {style: `left:${100 * k / set.decades}%`},
    Dust.number(100 * set.most * 10 ** (k - set.decades), 2)));
  document.getElementById('dust-map-legend').append(Dust.el('div', {class: 'scale'}, strip,
    Dust.el('div', {class: 'ends'}, ...labels, Dust.el('span', {class: 'name'}, '%/cm²'))));
  const draw = () => {
    const pen = strip.getContext('2d');
    for (let k = 0; k < 256; ++k) {
      pen.fillStyle = Dust.css(colour_of(k / 255));
      pen.fillRect(k, 0, 1, 1);
    }
  };
  Dust.redraw.push(draw);
  draw();
};
