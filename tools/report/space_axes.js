'use strict';
// Axes of the space in three dimensions: places along three edges of the domain, in the page's unit; and the files that
// the picture gives: grains, bodies and the plane as CSV.
Dust.space_axes = (T, space) => {
  const group = new T.Group(), size = space.max.map((v, d) => v - space.min[d]);
  const k_height = 64;  // pixels of a label before it is scaled
  let theme = null;
  const label = (text) => {
    const canvas = Dust.el('canvas', {}), pen = canvas.getContext('2d'), font = `500 ${0.62 * k_height}px system-ui, sans-serif`;
    pen.font = font;
    canvas.width = Math.ceil(pen.measureText(text).width) + 12;
    canvas.height = k_height;
    pen.font = font;
    pen.fillStyle = Dust.colour('soft');
    pen.textBaseline = 'middle';
    pen.fillText(text, 6, k_height / 2);
    const sprite = new T.Sprite(new T.SpriteMaterial({map: new T.CanvasTexture(canvas), sizeAttenuation: false, depthTest: false, transparent: true}));
    sprite.userData.shape = canvas.width / canvas.height;
    sprite.renderOrder = 6;
    return sprite;
  };
  const build = () => {
    for (const child of group.children) {
      child.geometry.dispose();
      if (child.material.map) child.material.map.dispose();
    }
    group.clear();
    const reach = 0.018 * Math.max(...size), marks = [];
    // x along the near bottom edge, y along the right one, z up the near left one; labels stand off it.
    const edges = [{d: 0, from: [0, -1, -1], off: [0, -1, -0.6]}, {d: 1, from: [1, 0, -1], off: [1, 0, -0.6]}, {d: 2, from: [-1, -1, 0], off: [-1, -0.6, 0]}];
    for (const {d, from, off} of edges) {
      const ticks = Dust.ticks(space.min[d] / Dust.places.factor, space.max[d] / Dust.places.factor, Math.max(2, Math.round(4 * size[d] / Math.max(...size))));
      ticks.forEach((tick, k) => {
        const p = from.map((side, e) => side * size[e] / 2);
        p[d] = tick * Dust.places.factor - (space.max[d] + space.min[d]) / 2;
        const end = p.map((v, e) => v + off[e] * reach);
        marks.push(...p, ...end);
        const text = label(k === ticks.length - 1 ? `${'xyz'[d]} ${Dust.number(tick)}\u202f${Dust.places.unit}` : Dust.number(tick));
        text.position.set(...p.map((v, e) => v + 2.6 * off[e] * reach));
        group.add(text);
      });
    }
    const lines = new T.LineSegments(new T.BufferGeometry(), new T.LineBasicMaterial({color: new T.Color(Dust.colour('soft'))}));
    lines.geometry.setAttribute('position', new T.Float32BufferAttribute(marks, 3));
    group.add(lines);
  };
  // Labels keep their size on the screen, `height` pixels of the picture; their colour is the theme's.
  const paint = (height) => {
    if (theme !== Dust.theme()) build();
    theme = Dust.theme();
    const share = 19 / height * 0.573;  // of a field of 32 degrees: 2 tan 16
    for (const part of group.children) if (part.isSprite) part.scale.set(share * part.userData.shape, share, 1);
  };
  return {group, paint};
};

// Buttons beside the picture; `shown` gives what it shows now: {t, grains, surfaces, air, dust, plane}.
Dust.space_files = (space, shown) => {
  const set = Dust.data.grains, button = (text, name, file, table) => {
    const node = Dust.el('button', {type: 'button', 'aria-label': name}, text);
    node.addEventListener('click', () => Dust.save(file, new Blob([Dust.csv(...table(shown()))], {type: 'text/csv'})));
    return node;
  };
  const short = (v) => +v.toPrecision(6);
  const files = [];
  if (set) files.push(button('CSV of the grains', 'CSV of the grains in three dimensions', 'grains_in_three_dimensions.csv', ({t, grains}) => Dust.space_tables.grains(set, Dust.data.view, space, t, grains)));
  else if (space.surfaces) files.push(button('CSV of the bodies', 'CSV of the bodies in three dimensions', 'bodies_in_three_dimensions.csv', ({surfaces}) => {
    const columns = [[], [], [], []], middle = space.max.map((v, d) => (v + space.min[d]) / 2);
    for (const [body, first, count] of surfaces.bodies) {
      for (let k = 3 * first; k < 3 * (first + count); ++k) {
        columns[0].push((space.surfaces.names || [])[body] || body + 1);
        for (let d = 0; d < 3; ++d) columns[d + 1].push(short(surfaces.points[3 * surfaces.corners[k] + d] + middle[d]));
      }
    }
    return [['body', 'x [m]', 'y [m]', 'z [m]'], columns];
  }));
  if (space.air) files.push(button('CSV of the plane', 'CSV of the plane in three dimensions: air and dust', 'plane_in_three_dimensions.csv', (now) => Dust.space_tables.plane(space, now)));
  return files;
};

Dust.space_tables = {
  // Places [m], diameter [m] and speed [m/s] of the grains of a frame.
  grains: (set, view, space, t, frame) => {
    const [x0, z0, x1, z1] = view, short = (v) => +v.toPrecision(6), heads = ['time [s]', 'x [m]', 'y [m]', 'z [m]', 'diameter [m]', 'speed [m/s]'], columns = heads.map(() => []);
    for (let k = 0; k < frame.n; ++k) {
      const share = set.depth_bytes === 2 ? (256 * frame.depth[k] + frame.depth_low[k]) / 65535 : (frame.depth[k] + 0.5) / 256;
      [t, x0 + frame.x[k] / 65535 * (x1 - x0), space.min[1] + share * (space.max[1] - space.min[1]), z0 + frame.z[k] / 65535 * (z1 - z0), set.classes[frame.size[k]],
        set.speed * (frame.speed[k] / 255) ** 2].forEach((v, c) => columns[c].push(short(v)));
    }
    return [heads, columns];
  },
  // Velocity of the air [m/s] and dust in it [mg/m3] in the middle of each block that the plane cuts; none in bodies.
  plane: (space, {t, air, dust, plane, velocity_of}) => {
    const {count, origin, step, speed} = space.air, {axis, u, v, at} = plane, short = (x) => +x.toPrecision(4);
    const heads = ['time [s]', 'x [m]', 'y [m]', 'z [m]', 'velocity x [m/s]', 'velocity y [m/s]', 'velocity z [m/s]', ...(dust ? ['dust [mg/m3]'] : [])], columns = heads.map(() => []);
    const velocity = velocity_of(air);
    for (let j = 0; j < count[v]; ++j) {
      for (let i = 0; i < count[u]; ++i) {
        const p = [0, 0, 0];
        p[axis] = Math.min(at, space.max[axis] - 1e-6 * (space.max[axis] - space.min[axis]));
        p[u] = origin[u] + (i + 0.5) * step[u];
        p[v] = origin[v] + (j + 0.5) * step[v];
        const w = velocity(p), row = [t, ...p, ...(w ? w.map((c) => c * speed) : [null, null, null])];
        if (dust) {
          const code = dust[Dust.space_dust.block(p)], value = code === undefined ? null : Dust.space_dust.value(code);
          row.push(value === null ? null : 1e6 * value);
        }
        row.forEach((x, c) => columns[c].push(x === null ? null : short(x)));
      }
    }
    return [heads, columns];
  },
};
