'use strict';
// Two runs side by side: grains over the speed of the air, moved by one clock.
(() => {
  const place = document.getElementById('cases');
  if (!place) return;
  const top = (key, of) => Math.max(0, ...Dust.data.runs.map((run) => (run[key] ? of(run[key]) : 0)));
  // One scale for both, so that colours compare.
  const fastest = top('air', (air) => air.speed);
  const nearest = (list, t) => list.reduce((best, frame, k) => (Math.abs(frame.t - t) < Math.abs(list[best].t - t) ? k : best), 0);

  const make = (run) => {
    const {grains, air} = run;
    const [x0, z0, x1, z1] = run.view;
    const figure = Dust.el('figure', {}), box = Dust.el('div', {class: 'picture'});
    const note = Dust.el('figcaption', {});
    figure.append(Dust.el('h3', {}, run.name), box, note);
    place.append(figure);
    const buffer = document.createElement('canvas');
    if (air) [buffer.width, buffer.height] = [air.nx, air.nz];
    const cache = new Map();
    const unpacked = (key, data) => {
      if (!cache.has(key)) cache.set(key, Dust.unpack(data));
      return cache.get(key);
    };
    const speeds = new Map();  // sums of the stored differences, made once per frame
    let shown = null;

    const paint_air = (pen, picture) => {
      const inner = buffer.getContext('2d'), image = inner.createImageData(air.nx, air.nz);
      for (let z = 0; z < air.nz; ++z) {
        for (let x = 0; x < air.nx; ++x) {
          const code = shown.air[(air.nz - 1 - z) * air.nx + x];
          if (code === 255) continue;
          // Codes follow the root of the speed.
          const t = code / 254 * Math.sqrt(air.speed / fastest);
          image.data.set([...picture.table.subarray(4 * Math.round(254 * t), 4 * Math.round(254 * t) + 3), 255], 4 * (z * air.nx + x));
        }
      }
      inner.putImageData(image, 0, 0);
      pen.drawImage(buffer, picture.x(air.x0), picture.z(air.z0 + air.nz * air.dz),
        air.nx * air.dx * picture.place.scale, air.nz * air.dz * picture.place.scale);
    };
    const paint_grains = (pen, picture) => {
      const {n, dust, bytes} = shown.grains, buffer_of = bytes.buffer;
      const xs = new Uint16Array(buffer_of, 4 * dust, n), zs = new Uint16Array(buffer_of, 4 * dust + 2 * n, n);
      const sizes = new Uint8Array(buffer_of, 4 * dust + 4 * n, n);
      for (const [from, to, colour, least] of [[0, n - dust, Dust.css(Dust.sand_colour(0.6)), 0.45], [n - dust, n, Dust.colour('dust'), 1.2]]) {
        pen.fillStyle = colour;
        for (let k = from; k < to; ++k) {
          const r = Math.max(grains.classes[sizes[k]] / 2 * picture.place.scale, least);
          const x = picture.x(x0 + xs[k] / 65535 * (x1 - x0)), z = picture.z(z0 + zs[k] / 65535 * (z1 - z0));
          pen.fillRect(x - r, z - r, 2 * r, 2 * r);
        }
      }
    };
    const picture = new Dust.Picture(box, 'Grains and air of ' + run.name, (pen, self) => {
      self.table = Dust.colour_table(Dust.speed_colour, 0);
      pen.fillStyle = Dust.colour(air ? 'body' : 'raised');
      pen.fillRect(self.place.left, self.place.top, self.place.inner, self.place.height);
      if (shown && shown.air) paint_air(pen, self);
      self.bodies(pen);
      if (shown && shown.grains) paint_grains(pen, self);
    }, run);
    picture.make_zoomable();
    if (air) {
      const grid = {nx: air.nx, nz: air.nz, x0: air.x0, z0: air.z0, dx: air.dx, dz: air.dz};
      picture.tell_values('speed of the air', 'm/s', grid, (k) => (!shown || !shown.air || shown.air[k] === 255 ? null : (shown.air[k] / 254) ** 2 * air.speed));
    }
    return async (t) => {
      const next = {};
      if (grains) {
        const k = nearest(grains.frames, t), frame = grains.frames[k];
        next.grains = {n: frame.n, dust: frame.dust, bytes: await unpacked('g' + k, frame.data)};
        note.textContent = `${Dust.count(frame.all)} ${frame.all === 1 ? 'grain' : 'grains'} at ${Dust.number(frame.t)} s.`;
      }
      if (air) {
        const k = nearest(air.frames, t);
        const bytes = await unpacked('a' + k, air.frames[k].data);
        if (!speeds.has(k)) {
          const codes = bytes.slice(0, air.nx * air.nz);
          for (let i = 1; i < codes.length; ++i) codes[i] += codes[i - 1];
          speeds.set(k, codes);
        }
        next.air = speeds.get(k);
      }
      return () => {
        shown = next;
        picture.draw();
      };
    };
  };
  const shows = Dust.data.runs.map(make);
  if (fastest > 0) {
    const key = Dust.el('div', {class: 'key'});
    place.after(key);
    Dust.legend_strip(key, Dust.speed_colour, 0, 0, fastest, 'm/s', Math.sqrt);
    key.prepend('Speed of the air, the same colours in both pictures. Dust is drawn larger than it is.');
  }

  const times = [...new Set(Dust.data.runs.flatMap((run) => (run.grains || run.air || {frames: []}).frames.map((f) => f.t)))].sort((a, b) => a - b);
  const show = async (index) => {
    for (const draw of await Promise.all(shows.map((of_run) => of_run(times[index])))) draw();
  };
  if (times.length) Dust.clock(times, show);
})();
