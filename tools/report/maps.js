'use strict';
// Maps that are logarithmic in a byte: 0 is nothing, 1 to 254 span `decades` up to `most`.

// `map`: {nx, nz, x0, z0, dx, dz, data}. `over` draws on top of it and the bodies. Returns the picture.
Dust.draw_map = (parent, label, map, colour_of, {scene = Dust.data, over = () => {}} = {}) => {
  const buffer = document.createElement('canvas');
  buffer.width = map.nx;
  buffer.height = map.nz;
  let codes = null;
  const picture = new Dust.Picture(parent, label, (pen, self) => {
    pen.fillStyle = Dust.colour('raised');
    pen.fillRect(self.place.left, self.place.top, self.place.inner, self.place.height);
    if (codes) {
      const inner = buffer.getContext('2d'), image = inner.createImageData(map.nx, map.nz);
      for (let z = 0; z < map.nz; ++z) {
        for (let x = 0; x < map.nx; ++x) {
          const code = codes[(map.nz - 1 - z) * map.nx + x];
          if (code) image.data.set([...colour_of((code - 1) / 253), 255], 4 * (z * map.nx + x));
        }
      }
      inner.putImageData(image, 0, 0);
      pen.imageSmoothingEnabled = false;
      pen.drawImage(buffer, self.x(map.x0), self.z(map.z0 + map.nz * map.dz), map.nx * map.dx * self.place.scale, map.nz * map.dz * self.place.scale);
    }
    self.bodies(pen);
    over(pen, self);
  }, scene);
  Dust.unpack(map.data).then((bytes) => {
    codes = bytes;
    picture.draw();
  });
  picture.code = (k) => (codes ? codes[k] : 0);
  return picture;
};
// Decades down from `most`, in `unit`.
Dust.decades_strip = (parent, {decades}, colour_of, most, unit) => {
  const strip = Dust.el('canvas', {width: 256, height: 1});
  const labels = Array.from({length: decades + 1}, (_, k) => Dust.el('span', {style: `left:${100 * k / decades}%`},
    Dust.number(most * 10 ** (k - decades), 2)));
  parent.append(Dust.el('div', {class: 'scale'}, strip, Dust.el('div', {class: 'ends'}, ...labels, Dust.el('span', {class: 'name'}, unit))));
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

// What sensors keep by place.
Dust.sections.maps = ({sensor_maps}) => {
  if (!sensor_maps || !sensor_maps.length) return null;
  const {el} = Dust;
  const figures = sensor_maps.map((map, k) => el('figure', {}, el('div', {class: 'picture', id: `map-${k}-picture`}), el('div', {id: `map-${k}-legend`, class: 'key'}),
    el('figcaption', {}, el('b', {}, Dust.sentence(map.name)), `, ${Dust.words(map.sensor)}: seen along ${map.along}, at most ${Dust.quantity(map.most, -1, map.unit)}.`)));
  return Dust.section('maps', 'What sensors see by place',
    Dust.p({}, 'Means on the grid of the sensor, as they are at the end: the largest along each line of sight, logarithmic. The view is the one that shows most of the surface.'),
    el('div', {class: 'pair'}, ...figures));
};
Dust.draw_maps = () => {
  (Dust.data.sensor_maps || []).forEach((map, k) => {
    const parent = document.getElementById(`map-${k}-picture`);
    if (!parent) return;
    const {factor, unit} = Dust.scale(map.unit, map.most);
    const right = map.x0 + map.nx * map.dx, top = map.z0 + map.nz * map.dz, margin = 0.08 * Math.max(right - map.x0, top - map.z0);
    // Outlines are those seen from the side.
    const scene = {view: [map.x0 - margin, map.z0 - margin, right + margin, top + margin], axes: map.axes, bodies: map.along === 'y' ? Dust.data.bodies : []};
    const picture = Dust.draw_map(parent, `${Dust.sentence(map.name)}, ${Dust.words(map.sensor)}`, map, Dust.release_colour, {scene});
    picture.tell_values(Dust.words(map.name), unit, map, (cell) => {
      const code = picture.code(cell);
      return code ? map.most / factor * 10 ** (map.decades * ((code - 1) / 253 - 1)) : null;
    });
    Dust.decades_strip(document.getElementById(`map-${k}-legend`), map, Dust.release_colour, map.most / factor, unit);
  });
};
