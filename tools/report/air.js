'use strict';
// Maps of air speed and pressure.
Dust.air = (() => {
  const set = Dust.data.air;
  if (!set) return null;
  const cells = set.nx * set.nz, arrows = set.ax * set.az;
  const cache = new Map();

  const load = (index) => {
    if (!cache.has(index)) {
      cache.set(index, Dust.unpack((index === 'mean' ? set.mean : set.frames[index]).data).then((bytes) => {
        const part = (from, length) => {
          const codes = bytes.subarray(from, from + length);
          for (let k = 1; k < length; ++k) codes[k] += codes[k - 1];  // stored as differences
          return codes;
        };
        return {speed: part(0, cells), pressure: part(cells, cells), u: part(2 * cells, arrows),
          w: part(2 * cells + arrows, arrows)};
      }));
    }
    return cache.get(index);
  };

  let current = null;
  const buffer = document.createElement('canvas');
  buffer.width = set.nx;
  buffer.height = set.nz;

  const paint_map = (pen, picture, codes, table) => {
    const inner = buffer.getContext('2d');
    const image = inner.createImageData(set.nx, set.nz);
    for (let z = 0; z < set.nz; ++z) {
      for (let x = 0; x < set.nx; ++x) {
        const from = 4 * codes[(set.nz - 1 - z) * set.nx + x], to = 4 * (z * set.nx + x);
        image.data[to] = table[from];
        image.data[to + 1] = table[from + 1];
        image.data[to + 2] = table[from + 2];
        image.data[to + 3] = table[from + 3];
      }
    }
    inner.putImageData(image, 0, 0);
    pen.imageSmoothingEnabled = true;
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(buffer, picture.x(set.x0), picture.z(set.z0 + set.nz * set.dz),
      set.nx * set.dx * picture.place.scale, set.nz * set.dz * picture.place.scale);
  };

  const square = (t) => t * Math.abs(t);
  // Velocity at a point, as a share of the scale's end; null inside a body or outside the grid.
  const velocity = (x, z) => {
    const i = (x - set.x0) / set.adx - 0.5, j = (z - set.z0) / set.adz - 0.5;
    const i0 = Math.min(Math.max(Math.floor(i), 0), set.ax - 2), j0 = Math.min(Math.max(Math.floor(j), 0), set.az - 2);
    if (set.ax < 2 || set.az < 2 || i < -0.5 || j < -0.5 || i > set.ax - 0.5 || j > set.az - 0.5) return null;
    const fi = Math.min(Math.max(i - i0, 0), 1), fj = Math.min(Math.max(j - j0, 0), 1);
    let u = 0, w = 0;
    for (const [k, weight] of [[j0 * set.ax + i0, (1 - fi) * (1 - fj)], [j0 * set.ax + i0 + 1, fi * (1 - fj)],
      [(j0 + 1) * set.ax + i0, (1 - fi) * fj], [(j0 + 1) * set.ax + i0 + 1, fi * fj]]) {
      if (current.u[k] === 255) {
        if (weight > 0.5) return null;
        continue;
      }
      u += weight * square(current.u[k] / 127 - 1);  // stored by the root
      w += weight * square(current.w[k] / 127 - 1);
    }
    return [u, w];
  };

  // Short threads that follow the air. Their seeds stay in place from frame to frame.
  const paint_threads = (pen, picture) => {
    const spacing = 15 / picture.place.scale, longest = 2.4 * spacing, steps = 9;
    const [x0, z0, x1, z1] = picture.view;
    let seed = 1;
    const random = () => ((seed = (seed * 16807) % 2147483647) / 2147483647);
    const inks = [Dust.colour('ink'), Dust.colour('paper')];
    pen.lineCap = 'round';
    for (let z = z0 + spacing / 2; z < z1; z += spacing) {
      for (let x = x0 + spacing / 2; x < x1; x += spacing) {
        let px = x + (random() - 0.5) * spacing * 0.8, pz = z + (random() - 0.5) * spacing * 0.8;
        for (let k = 0; k < steps; ++k) {
          const v = velocity(px, pz);
          const size = v ? Math.hypot(v[0], v[1]) : 0;
          if (size < 0.0015) break;  // below the resolution of the stored directions
          if (k === 0) pen.strokeStyle = inks[+(size > 0.25)];  // stands out from slow and fast air
          // Length grows with the root of the speed: slow eddies stay visible.
          const step = longest / steps * Math.sqrt(Math.min(size, 1)) / size;
          const qx = px + v[0] * step, qz = pz + v[1] * step;
          pen.globalAlpha = 0.12 + 0.5 * k / steps;
          pen.lineWidth = 0.5 + 1.1 * k / steps;
          pen.beginPath();
          pen.moveTo(picture.x(px), picture.z(pz));
          pen.lineTo(picture.x(qx), picture.z(qz));
          pen.stroke();
          px = qx;
          pz = qz;
        }
      }
    }
    pen.globalAlpha = 1;
  };

  // The places a sensor found, or else the lowest cell of the frame.
  const paint_lowest = (pen, picture) => {
    const places = (Dust.data.extraction || {places: []}).places;
    for (const place of places) Dust.ring(pen, picture.x(place.x), picture.z(place.z), place.name);
    if (places.length) return;
    let place = -1, lowest = 127;
    for (let k = 0; k < cells; ++k) {
      if (current.pressure[k] < lowest) {
        lowest = current.pressure[k];
        place = k;
      }
    }
    if (place < 0) return;
    const x = picture.x(set.x0 + (place % set.nx + 0.5) * set.dx);
    const z = picture.z(set.z0 + (Math.floor(place / set.nx) + 0.5) * set.dz);
    Dust.ring(pen, x, z, '');
  };

  const checkbox = document.getElementById('air-dust');
  let tables = {};
  const make_tables = () => {
    tables = {speed: Dust.colour_table(Dust.speed_colour, 0), pressure: Dust.colour_table(Dust.pressure_colour, -1)};
  };
  make_tables();
  Dust.redraw.push(make_tables);
  const background = (pen, picture) => {
    pen.fillStyle = Dust.colour('body');
    pen.fillRect(picture.place.left, picture.place.top, picture.place.inner, picture.place.height);
  };
  const speed = new Dust.Picture(document.getElementById('speed-picture'), 'Map of the air speed', (pen, picture) => {
    background(pen, picture);
    if (!current) return;
    paint_map(pen, picture, current.speed, tables.speed);
    paint_threads(pen, picture);
    picture.bodies(pen);
    if (checkbox.checked && Dust.grains) Dust.grains.paint_dust(pen, picture, false, 1.3);
  });
  const pressure = new Dust.Picture(document.getElementById('pressure-picture'), 'Map of the air pressure', (pen, picture) => {
    background(pen, picture);
    if (!current) return;
    paint_map(pen, picture, current.pressure, tables.pressure);
    picture.bodies(pen);
    paint_lowest(pen, picture);
  });
  const grid = {nx: set.nx, nz: set.nz, x0: set.x0, z0: set.z0, dx: set.dx, dz: set.dz};
  const pressure_of = (frame) => (k) => (!frame || frame.pressure[k] === 255 ? null : (frame.pressure[k] / 127 - 1) * set.pressure);
  // The speed is stored by its root.
  speed.tell_values('speed of the air', 'm/s', grid, (k) => (!current || current.speed[k] === 255 ? null : (current.speed[k] / 254) ** 2 * set.speed));
  pressure.tell_values('pressure', 'Pa', grid, (k) => pressure_of(current)(k));
  checkbox.addEventListener('change', () => speed.draw());
  const mean_box = document.getElementById('air-mean');
  let last = 0;
  mean_box.addEventListener('change', async () => {
    const shown = await show(last);
    shown.take();
    shown.draw();
    if (Dust.grains) Dust.grains.draw();
  });
  if (!Dust.grains || !Dust.grains.has_dust) checkbox.parentElement.hidden = true;

  Dust.legend_strip(document.getElementById('speed-legend'), Dust.speed_colour, 0, 0, set.speed, 'm/s', Math.sqrt);
  Dust.legend_strip(document.getElementById('pressure-legend'), Dust.pressure_colour, -1,
    -set.pressure, set.pressure, 'Pa');

  const show = async (index) => {
    last = index;
    const frame = await load(mean_box.checked ? 'mean' : index);
    return {
      take: () => { current = frame; },
      draw: () => {
        speed.draw();
        pressure.draw();
      },
    };
  };
  // For other pictures: the speed of the frame shown, the pressure of any frame.
  const paint_speed = (pen, picture) => {
    if (current) paint_map(pen, picture, current.speed, tables.speed);
  };
  const paint_pressure = (pen, picture, frame) => paint_map(pen, picture, frame.pressure, tables.pressure);
  // For the scene in three dimensions: the speed of the frame shown as a picture of the x-z plane.
  const pixels = () => {
    if (!current) return null;
    const rgba = new Uint8Array(4 * cells);
    for (let k = 0; k < cells; ++k) {
      if (current.speed[k] === 255) continue;
      rgba.set(tables.speed.subarray(4 * current.speed[k], 4 * current.speed[k] + 3), 4 * k);
      rgba[4 * k + 3] = 215;
    }
    const velocity_at = ([x, , z]) => {
      const v = velocity(x, z);
      return v ? [v[0], 0, v[1]] : null;
    };
    return {pixels: rgba, width: set.nx, height: set.nz, step: [set.dx, set.dz], velocity: velocity_at};
  };
  return {times: set.frames.map((frame) => frame.t), show, load, paint_speed, paint_pressure, pressure_of, grid, pixels};
})();
