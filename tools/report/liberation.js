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
  const colour_of = Dust.release_colour;
  set.kinds.forEach((kind, k) => {
    const buffer = document.createElement('canvas');
    buffer.width = set.nx;
    buffer.height = set.nz;
    let codes = null;
    const picture = new Dust.Picture(document.getElementById(`release-${k}-picture`), `Map of the dust set free ${kind.title}`, (pen, self) => {
      pen.fillStyle = Dust.colour('raised');
      pen.fillRect(self.place.left, self.place.top, self.place.inner, self.place.height);
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
        pen.drawImage(buffer, self.x(set.x0), self.z(set.z0 + set.nz * set.dz), set.nx * set.dx * self.place.scale, set.nz * set.dz * self.place.scale);
      }
      self.bodies(pen);
    });
    Dust.unpack(kind.data).then((bytes) => {
      codes = bytes;
      picture.draw();
    });
  });
  // Decades down from the most of all maps.
  const strip = Dust.el('canvas', {width: 256, height: 1});
  const labels = Array.from({length: set.decades + 1}, (_, k) => Dust.el('span', {style: `left:${100 * k / set.decades}%`},
    Dust.number(1e6 * set.most * 10 ** (k - set.decades), 2)));
  document.getElementById('release-legend').append(Dust.el('div', {class: 'scale'}, strip, Dust.el('div', {class: 'ends'}, ...labels,
    Dust.el('span', {class: 'name'}, 'mg/cm²'))));
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
