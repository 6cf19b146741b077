'use strict';
// The side view of the grains.
Dust.grains = (() => {
  const set = Dust.data.grains;
  if (!set) return null;
  const [x0, z0, x1, z1] = Dust.data.view;
  const is_dust = (d) => set.is_dust[set.classes.indexOf(d)];
  const coarse = set.classes.filter((d) => !is_dust(d));
  const span = coarse.length > 1 ? Math.log(coarse.at(-1) / coarse[0]) : 1;
  const tone = (d) => (coarse.length > 1 ? Math.log(d / coarse[0]) / span : 0.4);
  const cache = new Map();
  const trail = 6;  // frames of a dust grain's path

  const load = (index) => {
    if (!cache.has(index)) {
      const frame = set.frames[index];
      cache.set(index, Dust.unpack(frame.data).then((bytes) => {
        const n = frame.n, dust = frame.dust, buffer = bytes.buffer;
        return {n, dust, t: frame.t, all: frame.all,
          number: new Uint32Array(buffer, 0, dust),
          x: new Uint16Array(buffer, 4 * dust, n),
          z: new Uint16Array(buffer, 4 * dust + 2 * n, n),
          size: new Uint8Array(buffer, 4 * dust + 4 * n, n),
          speed: new Uint8Array(buffer, 4 * dust + 5 * n, n),
          depth: new Uint8Array(buffer, 4 * dust + 6 * n, n),
          depth_low: new Uint8Array(buffer, 4 * dust + 7 * n, set.depth_bytes === 2 ? n : 0)};
      }));
    }
    return cache.get(index);
  };

  let current = null, before = [];
  const x_of = (frame, k) => x0 + frame.x[k] / 65535 * (x1 - x0);
  const z_of = (frame, k) => z0 + frame.z[k] / 65535 * (z1 - z0);

  const paint_dust = (pen, picture, with_trails, radius) => {
    if (!current) return;
    const colour = Dust.colour('dust');
    if (with_trails && before.length) {
      const last = new Map();
      for (let k = current.n - current.dust; k < current.n; ++k) {
        last.set(current.number[k - current.n + current.dust], [x_of(current, k), z_of(current, k)]);
      }
      pen.strokeStyle = colour;
      pen.lineWidth = 0.7;
      before.forEach((frame, age) => {
        pen.globalAlpha = Math.min(0.35, Math.max(0.06, 150 / current.dust)) * (1 - age / trail);
        pen.beginPath();
        for (let k = frame.n - frame.dust; k < frame.n; ++k) {
          const name = frame.number[k - frame.n + frame.dust], to = last.get(name);
          if (!to) continue;
          const from = [x_of(frame, k), z_of(frame, k)];
          pen.moveTo(picture.x(from[0]), picture.z(from[1]));
          pen.lineTo(picture.x(to[0]), picture.z(to[1]));
          last.set(name, from);
        }
        pen.stroke();
      });
      pen.globalAlpha = 1;
    }
    pen.fillStyle = colour;
    pen.globalAlpha = current.dust > 500 ? 0.55 : 0.8;
    pen.beginPath();
    for (let k = current.n - current.dust; k < current.n; ++k) {
      const x = picture.x(x_of(current, k)), z = picture.z(z_of(current, k));
      pen.moveTo(x + radius, z);
      pen.arc(x, z, radius, 0, 6.2832);
    }
    pen.fill();
    pen.globalAlpha = 1;
  };

  const choice = document.getElementById('grains-colour'), air_box = document.getElementById('grains-air');
  const by_speed = () => choice.value === 'speed';
  const outline = (pen, picture, k) => {
    const radius = Math.max(set.classes[current.size[k]] / 2 * picture.place.scale, 0.45);
    const x = picture.x(x_of(current, k)), z = picture.z(z_of(current, k));
    if (radius < 1) {
      pen.rect(x - radius, z - radius, 2 * radius, 2 * radius);
    } else {
      pen.moveTo(x + radius, z);
      pen.arc(x, z, radius, 0, 6.2832);
    }
  };
  // Coarse grains of one colour: `pick(k)` says which.
  const paint_some = (pen, picture, colour, pick) => {
    pen.fillStyle = colour;
    pen.beginPath();
    for (let k = 0; k < current.n - current.dust; ++k) {
      if (pick(k)) outline(pen, picture, k);
    }
    pen.fill();
  };
  // Coarse grains by size, in the order of the data: from the back to the front.
  const paint_by_size = (pen, picture) => {
    const end = current.n - current.dust;
    for (let k = 0; k < end;) {
      const size = current.size[k];
      pen.fillStyle = Dust.css(Dust.sand_colour(tone(set.classes[size])));
      pen.beginPath();
      for (; k < end && current.size[k] === size; ++k) outline(pen, picture, k);
      pen.fill();
    }
  };
  const k_speed_steps = 24;
  const paint = (pen, picture) => {
    const {left, top, inner, height} = picture.place;
    const has_air = air_box && air_box.checked && Dust.air;
    pen.fillStyle = Dust.colour(has_air ? 'body' : 'raised');
    pen.fillRect(left, top, inner, height);
    if (has_air) {
      Dust.air.paint_speed(pen, picture);
      // A veil, so that the grains stand out.
      pen.globalAlpha = 0.4;
      pen.fillStyle = Dust.colour('raised');
      pen.fillRect(left, top, inner, height);
      pen.globalAlpha = 1;
    }
    picture.bodies(pen);
    if (!current) return;
    if (by_speed()) {
      for (let c = 0; c < k_speed_steps; ++c) {
        // Speeds are stored by their root.
        paint_some(pen, picture, Dust.css(Dust.grain_speed_colour((c + 0.5) / k_speed_steps)),
          (k) => Math.min(Math.floor(current.speed[k] / 256 * k_speed_steps), k_speed_steps - 1) === c);
      }
    } else {
      paint_by_size(pen, picture);
    }
    paint_dust(pen, picture, true, 1.3);
  };

  const picture = new Dust.Picture(document.getElementById('grains-picture'),
    'Side view of the grains and the air', paint);
  picture.make_zoomable();
  const speed_of = (k) => (current.speed[k] / 255) ** 2 * set.speed;  // stored by its root
  // The grain under the pointer, the front one of several: the last that is drawn there.
  const read = (x, z) => {
    const least = 2.5 / picture.place.scale;
    for (let k = current ? current.n - 1 : -1; k >= 0; --k) {
      const reach = Math.max(set.classes[current.size[k]] / 2, least);
      if (Math.abs(x_of(current, k) - x) > reach || Math.abs(z_of(current, k) - z) > reach) continue;
      return `${Dust.place_xz({x, z})}: grain of ${Dust.quantity(set.classes[current.size[k]], -1, 'm')}` + (set.speed > 0 ? `, ${Dust.number(speed_of(k), 2)}\u202fm/s` : '');
    }
    return '';
  };
  const table = () => {
    const all = Array.from({length: current ? current.n : 0}, (_, k) => k), {unit, factor} = Dust.places;
    const place = (of) => all.map((k) => +(of(current, k) / factor).toPrecision(6));
    return [[`x, ${unit}`, `z, ${unit}`, 'diameter, µm', 'speed, m/s'], [place(x_of), place(z_of), all.map((k) => +(1e6 * set.classes[current.size[k]]).toPrecision(6)),
      all.map((k) => +speed_of(k).toPrecision(3))]];
  };
  picture.tell(read, table);
  document.getElementById('grains-whole').addEventListener('click', () => picture.whole_view());

  const legend = document.getElementById('grains-legend');
  const scale = document.getElementById('grains-scale');
  // Sizes with their colours; coarse ones have colours of their own only where size is shown.
  const put_legend = (parent, is_by_speed) => {
    const length = (d) => (d < 1e-3 ? Dust.number(d * 1e6, 3) + ' µm' : Dust.number(d * 1e3, 3) + ' mm');
    const classes = is_by_speed ? set.classes.filter(is_dust) : set.classes;
    const few = classes.length <= 10 ? classes
      : classes.filter((d, k) => k % Math.ceil(classes.length / 8) === 0 || k === classes.length - 1);
    parent.replaceChildren(...[...few].reverse().map((d) => {
      const dust = is_dust(d);
      const dot = Dust.el('i', {class: dust ? 'small' : ''});
      dot.style.background = dust ? Dust.colour('dust') : Dust.css(Dust.sand_colour(tone(d)));
      return Dust.el('span', {class: 'entry'}, dot, length(d) + (dust ? ', dust' : ''));
    }));
  };
  const draw_legend = () => {
    scale.replaceChildren();
    if (by_speed()) Dust.legend_strip(scale, Dust.grain_speed_colour, 0, 0, set.speed, 'm/s', Math.sqrt, false);
    put_legend(legend, by_speed());
  };
  Dust.redraw.push(draw_legend);
  draw_legend();
  choice.addEventListener('change', () => {
    draw_legend();
    picture.draw();
  });
  if (air_box && /^#picture/.test(location.hash)) air_box.checked = false;  // the air stands beside them there
  if (air_box) {
    const strip = document.getElementById('grains-air-scale');
    const air_colour = (t) => Dust.speed_colour(t);
    Dust.legend_strip(strip, air_colour, 0, 0, Dust.data.air.speed, 'm/s', Math.sqrt);
    strip.prepend('Speed of the air');
    air_box.addEventListener('change', () => {
      strip.hidden = !air_box.checked;
      picture.draw();
    });
  }

  const count = document.getElementById('grains-count');
  const show = async (index) => {
    const frames = await Promise.all([index, ...Array.from({length: trail}, (_, k) => index - 1 - k)
      .filter((k) => k >= 0)].map(load));
    return {
      take: () => {
        current = frames[0];
        before = frames.slice(1);
        count.textContent = `At ${Dust.number(current.t)} s: ${Dust.count(current.all)} computed ${current.all === 1 ? 'grain' : 'grains'}` +
          (set.is_dust.includes(true) ? `, of them ${Dust.count(current.dust)} dust grains shown.` : '.');
      },
      draw: () => picture.draw(),
    };
  };
  return {times: set.frames.map((frame) => frame.t), show, load, put_legend, paint_dust, has_dust: set.is_dust.includes(true), draw: () => picture.draw()};
})();
