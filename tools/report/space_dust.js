'use strict';
// Dust in three dimensions: the dust in the air as a cloud, its concentration in the plane, and where it came off the
// load. space_scene.js draws them.
Dust.space_dust = (() => {
  const {space} = Dust.data, data = space && space.dust, air = space && space.air;
  if (!data || !air) return null;
  const size = space.max.map((v, d) => v - space.min[d]), middle = space.max.map((v, d) => (v + space.min[d]) / 2);
  const cache = new Map();
  const codes_of = (key, packed) => {
    if (!cache.has(key)) {
      cache.set(key, Dust.unpack(packed).then((codes) => {
        for (let k = 1; k < codes.length; ++k) codes[k] += codes[k - 1];
        return codes;
      }));
    }
    return cache.get(key);
  };
  const at = (t) => {
    const index = data.frames.reduce((best, f, k) => (Math.abs(f.t - t) < Math.abs(data.frames[best].t - t) ? k : best), 0);
    return codes_of(index, data.frames[index].data);
  };
  const set_free = () => (data.set_free ? codes_of('set_free', data.set_free.data) : null);

  // The share of the logarithmic scale, and the value [kg/m3]; null in bodies.
  const share_of = (code) => (code === 255 ? null : code === 0 ? 0 : (code - 1) / 253);
  const value_of = (code, most) => (code === 255 ? null : code === 0 ? 0 : most * 10 ** (data.decades * ((code - 1) / 253 - 1)));
  const block = (p) => {
    const i = p.map((v, d) => Math.floor((v - air.origin[d]) / air.step[d]));
    return i.some((v, d) => v < 0 || v >= air.count[d]) ? -1 : (i[2] * air.count[1] + i[1]) * air.count[0] + i[0];
  };

  // A soft ball per block, fainter where there is less: three of the four decades are drawn.
  const k_least = 0.25;
  const k_vertex = `
    attribute float radius; attribute vec4 tint; varying vec4 colour; varying vec3 place; uniform float height;
    void main() {
      colour = tint;
      place = position;
      vec4 eye = modelViewMatrix * vec4(position, 1.0);
      gl_Position = projectionMatrix * eye;
      gl_PointSize = max(2.0 * radius * projectionMatrix[1][1] * height * 0.5 / -eye.z, 1.0);
    }`;
  const k_fragment = `
    varying vec4 colour; varying vec3 place; uniform vec4 plane;
    void main() {
      if (dot(plane.xyz, place) > plane.w) discard;
      vec2 p = 2.0 * gl_PointCoord - 1.0;
      float inside = 1.0 - dot(p, p);
      if (inside < 0.0) discard;
      gl_FragColor = vec4(colour.rgb, colour.a * inside);
    }`;
  const cloud = (T) => {
    const points = new T.Points(new T.BufferGeometry(), new T.ShaderMaterial({vertexShader: k_vertex, fragmentShader: k_fragment, transparent: true, depthWrite: false,
      uniforms: {height: {value: 1}, plane: {value: new T.Vector4(0, 0, 0, 1)}}}));
    points.frustumCulled = false;
    points.renderOrder = 4;
    return points;
  };
  const fill = (T, points, codes, colour_of, most_alpha) => {
    const place = [], radius = [], tint = [], [nx, ny] = air.count, reach = 0.75 * Math.max(...air.step);
    // A fixed shift within the block, so that the blocks' order does not show.
    const shift = (k, d) => ((Math.imul(k * 3 + d + 1, 2654435761) >>> 8) / 16777216 - 0.5) * 0.7;
    codes.forEach((code, k) => {
      const share = share_of(code);
      if (share === null || share < k_least) return;
      const i = [k % nx, Math.floor(k / nx) % ny, Math.floor(k / nx / ny)], t = (share - k_least) / (1 - k_least);
      i.forEach((n, d) => place.push(air.origin[d] + (n + 0.5 + shift(k, d)) * air.step[d] - middle[d]));
      radius.push(reach);
      tint.push(...colour_of(share), Math.round(255 * most_alpha * (0.06 + 0.94 * t * t)));
    });
    const shape = points.geometry;
    shape.dispose();
    shape.setAttribute('position', new T.Float32BufferAttribute(place, 3));
    shape.setAttribute('radius', new T.Float32BufferAttribute(radius, 1));
    shape.setAttribute('tint', new T.BufferAttribute(new Uint8Array(tint), 4, true));
  };
  // Concentration in the plane, as pixels of blocks.
  const slice = (codes, u, v, axis, place) => {
    const {count, origin, step} = air, width = count[u], height = count[v], pixels = new Uint8Array(4 * width * height);
    for (let j = 0; j < height; ++j) {
      for (let i = 0; i < width; ++i) {
        const p = [0, 0, 0];
        p[axis] = Math.min(place, space.max[axis] - 1e-6 * size[axis]);
        p[u] = origin[u] + (i + 0.5) * step[u];
        p[v] = origin[v] + (j + 0.5) * step[v];
        const k = block(p), share = k < 0 ? null : share_of(codes[k]);
        if (share === null) continue;
        pixels.set([...Dust.dust_colour(share), 215], 4 * (j * width + i));
      }
    }
    return {pixels, width, height, step: [step[u], step[v]]};
  };
  // A strip with a label per decade [mg/m3].
  const legend = (parent, title, colour_of, most) => {
    const strip = Dust.el('canvas', {width: 256, height: 1}), pen = strip.getContext('2d');
    for (let k = 0; k < 256; ++k) {
      pen.fillStyle = Dust.css(colour_of(k / 255));
      pen.fillRect(k, 0, 1, 1);
    }
    const labels = Array.from({length: data.decades + 1}, (_, k) => Dust.el('span', {style: `left:${100 * k / data.decades}%`}, Dust.number(+(1e6 * most * 10 ** (k - data.decades)).toPrecision(2), 2)));
    parent.append(title, Dust.el('div', {class: 'scale'}, strip, Dust.el('div', {class: 'ends'}, ...labels, Dust.el('span', {class: 'name'}, 'mg/m³'))));
  };
  return {at, set_free, cloud, fill, slice, legend, block, value: (code) => value_of(code, data.most), most: data.most, set_free_most: data.set_free ? data.set_free.most : 0};
})();
