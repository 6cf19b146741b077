'use strict';
// The scene in three dimensions, drawn with three.js, which is unpacked when it is first wanted.
Dust.space = (() => {
  const figure = document.getElementById('space'), {space: data, grains: set} = Dust.data;
  if (!figure) return null;
  const by_id = (id) => document.getElementById('space-' + id);
  const size = data.max.map((v, d) => v - data.min[d]);
  const middle = data.max.map((v, d) => (v + data.min[d]) / 2);
  const whole = Math.hypot(...size);

  // three.js is a script of a text element: it runs once somebody looks.
  const library = async () => {
    if (window.THREE) return window.THREE;
    const code = new TextDecoder().decode(await Dust.unpack(document.getElementById('three').textContent));
    document.head.append(Dust.el('script', {}, code));
    return window.THREE;
  };

  // ---- what the data hold -------------------------------------------------
  const cache = new Map();
  const once = (key, make) => {
    if (!cache.has(key)) cache.set(key, make());
    return cache.get(key);
  };
  const nearest = (times, t) => times.reduce((best, value, k) => (Math.abs(value - t) < Math.abs(times[best] - t) ? k : best), 0);
  const surfaces_at = (t) => {
    if (!data.surfaces) return null;
    const index = data.surfaces.shown[nearest(data.surfaces.times, t)], entry = data.surfaces.sets[index];
    return once('surfaces' + index, async () => {
      const {buffer} = await Dust.unpack(entry.data);
      const corners = new Uint32Array(buffer, 0, 3 * entry.triangles), points = new Float32Array(3 * entry.points);
      for (let d = 0; d < 3; ++d) {
        const codes = new Uint16Array(buffer, 12 * entry.triangles + 2 * d * entry.points, entry.points);
        for (let k = 0; k < entry.points; ++k) points[3 * k + d] = codes[k] / 65535 * size[d] - size[d] / 2;
      }
      return {index, points, corners, bodies: entry.bodies};
    });
  };
  const square = (code) => { const t = code / 127 - 1; return t * Math.abs(t); };
  const air_at = (t) => {
    if (!data.air) return null;
    const index = nearest(data.air.frames.map((frame) => frame.t), t);
    return once('air' + index, async () => {
      const codes = await Dust.unpack(data.air.frames[index].data), cells = codes.length / 3;
      for (let d = 0; d < 3; ++d) for (let k = d * cells + 1; k < (d + 1) * cells; ++k) codes[k] += codes[k - 1];
      return {codes, cells};
    });
  };
  // Velocity of the air at a place [share of the scale], null in bodies and outside; nearest block of three.
  const velocity_of = (field) => {
    const {count, origin, step} = data.air, {codes, cells} = field;
    return (p) => {
      const i = p.map((v, d) => Math.floor((v - origin[d]) / step[d]));
      if (i.some((v, d) => v < 0 || v >= count[d])) return null;
      const k = (i[2] * count[1] + i[1]) * count[0] + i[0];
      return codes[k] === 255 ? null : [square(codes[k]), square(codes[cells + k]), square(codes[2 * cells + k])];
    };
  };

  // ---- the scene ----------------------------------------------------------
  const k_vertex = `
    attribute float radius; attribute vec3 tint; varying vec3 colour; varying float reach; varying float away; varying vec3 place;
    uniform float height; uniform float smallest;
    void main() {
      colour = tint;
      place = position;
      vec4 eye = modelViewMatrix * vec4(position, 1.0);
      gl_Position = projectionMatrix * eye;
      float pixels = radius * projectionMatrix[1][1] * height / -eye.z;
      gl_PointSize = max(pixels, smallest);
      reach = radius * max(1.0, smallest / max(pixels, 1e-6));
      away = -eye.z;
    }`;
  // A disc with the depth and the shading of a sphere. Grains in front of the plane are left out whole.
  const k_fragment = `
    varying vec3 colour; varying float reach; varying float away; varying vec3 place;
    uniform vec4 plane; uniform float flat_light; uniform vec2 range;
    void main() {
      if (dot(plane.xyz, place) > plane.w) discard;
      vec2 p = 2.0 * gl_PointCoord - 1.0;
      float inside = 1.0 - dot(p, p);
      if (inside < 0.0) discard;
      float up = sqrt(inside);
      float light = mix(0.42 + 0.58 * max(0.0, dot(vec3(p.x, -p.y, up), normalize(vec3(-0.4, 0.6, 0.7)))), 1.0, flat_light);
      float z = away - reach * up;
      gl_FragDepth = ((range.y + range.x) - 2.0 * range.x * range.y / z) / (range.y - range.x) * 0.5 + 0.5;
      gl_FragColor = vec4(colour * light, 1.0);
    }`;

  let stage = null, current = null, wanted = null;
  const rgb = (text) => new stage.T.Color(text);

  const build = (T) => {
    const canvas = Dust.el('canvas', {tabindex: 0, role: 'img'});
    const renderer = new T.WebGLRenderer({canvas, antialias: true, alpha: true, preserveDrawingBuffer: true});
    renderer.localClippingEnabled = true;
    const scene = new T.Scene(), camera = new T.PerspectiveCamera(32, 1, 0.02 * whole, 12 * whole);
    camera.up.set(0, 0, 1);
    const sun = new T.DirectionalLight(0xffffff, 0.75), sky = new T.HemisphereLight(0xffffff, 0x8a8070, 0.6);
    camera.add(sun);
    sun.position.set(-0.6, 0.8, 1);
    scene.add(camera, sky);
    const bodies = new T.Group(), grains = new T.Points(new T.BufferGeometry(), new T.ShaderMaterial({vertexShader: k_vertex, fragmentShader: k_fragment,
      uniforms: {height: {value: 1}, smallest: {value: 1.6}, plane: {value: new T.Vector4(0, 0, 0, 1)}, flat_light: {value: 0}, range: {value: new T.Vector2(camera.near, camera.far)}}}));
    const dust = new T.Points(new T.BufferGeometry(), grains.material.clone());
    dust.material.uniforms.smallest.value = 3;
    dust.material.uniforms.flat_light.value = 1;
    grains.frustumCulled = dust.frustumCulled = false;
    const cut = new T.Plane(new T.Vector3(0, -1, 0), 0);
    const slice = new T.Mesh(new T.PlaneGeometry(1, 1), new T.MeshBasicMaterial({side: T.DoubleSide, transparent: true, alphaTest: 0.02, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
    const threads = new T.LineSegments(new T.BufferGeometry(), new T.LineBasicMaterial({vertexColors: true, transparent: true}));
    threads.frustumCulled = false;
    const frame = new T.LineSegments(new T.EdgesGeometry(new T.BoxGeometry(...size)), new T.LineBasicMaterial({}));
    const rim = new T.LineSegments(new T.EdgesGeometry(new T.PlaneGeometry(1, 1)), new T.LineBasicMaterial({}));
    // Bodies shimmer through the plane: it is painted after them.
    const load_dust = Dust.space_dust, cloud = load_dust ? load_dust.cloud(T) : null, origin = load_dust ? load_dust.cloud(T) : null;
    slice.renderOrder = 2;
    threads.renderOrder = 3;
    const axes = Dust.space_axes(T, data);
    scene.add(bodies, grains, dust, slice, threads, frame, rim, axes.group, ...(cloud ? [cloud, origin] : []));
    by_id('picture').append(canvas);
    const as_png = Dust.el('button', {type: 'button', 'aria-label': 'The picture in three dimensions as PNG'}, 'PNG');
    as_png.addEventListener('click', () => { draw(); Dust.save_canvas('three_dimensions.png', canvas); });
    by_id('picture').append(Dust.el('div', {class: 'downloads screen'}, ...Dust.space_files(data, () => ({...current, plane: plane_of()})), as_png));
    return {T, canvas, renderer, scene, camera, bodies, grains, dust, cut, slice, threads, frame, rim, axes, cloud, origin,
      eye: {around: 0, up: 0, far: 0, at: new T.Vector3()}};
  };

  // ---- camera -------------------------------------------------------------
  const views = {slant: [-58, 24], side: [-90, 0], front: [0, 0], top: [-90, 89.5]};
  const look_from = (name) => {
    const {eye} = stage;
    [eye.around, eye.up] = views[name].map((v) => v * Math.PI / 180);
    eye.at.set(0, 0, 0);
    eye.far = 0;  // as far as the whole needs
    draw();
  };
  // The distance from which the box fills the picture.
  const fitting = () => {
    const {camera, T, eye} = stage, tangent = Math.tan(camera.fov * Math.PI / 360);
    let far = 0;
    const ahead = direction().negate(), right = new T.Vector3().crossVectors(ahead, camera.up).normalize(), above = new T.Vector3().crossVectors(right, ahead);
    for (let k = 0; k < 8; ++k) {
      const corner = new T.Vector3(...size.map((s, d) => (k >> d & 1 ? s : -s) / 2)).sub(eye.at);
      far = Math.max(far, Math.abs(corner.dot(right)) / tangent / camera.aspect - corner.dot(ahead), Math.abs(corner.dot(above)) / tangent - corner.dot(ahead));
    }
    return 1.06 * far;
  };
  const direction = () => {
    const {eye, T} = stage;
    return new T.Vector3(Math.cos(eye.up) * Math.cos(eye.around), Math.cos(eye.up) * Math.sin(eye.around), Math.sin(eye.up));
  };
  const turn = (dx, dy) => {
    const {eye} = stage;
    eye.around -= dx;
    eye.up = Math.min(Math.max(eye.up + dy, -1.56), 1.56);
    draw();
  };
  const move = (dx, dy) => {
    const {eye, camera, T} = stage, far = eye.far || fitting();
    eye.far = far;
    const right = new T.Vector3().setFromMatrixColumn(camera.matrix, 0), above = new T.Vector3().setFromMatrixColumn(camera.matrix, 1);
    eye.at.addScaledVector(right, -dx * far).addScaledVector(above, dy * far);
    draw();
  };
  const nearer = (factor) => {
    const {eye} = stage;
    eye.far = Math.min(Math.max((eye.far || fitting()) / factor, 0.03 * whole), 4 * whole);
    draw();
  };
  const listen = () => {
    const {canvas} = stage;
    for (const name of Object.keys(views)) by_id(name).addEventListener('click', () => look_from(name));
    by_id('nearer').addEventListener('click', () => nearer(1.25));
    by_id('farther').addEventListener('click', () => nearer(0.8));
    const step = 0.09;
    const keys = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
    canvas.addEventListener('keydown', (event) => {
      const go = keys[event.key];
      if (go) event.shiftKey ? move(0.5 * go[0], 0.5 * -go[1]) : turn(go[0], go[1]);
      else if (event.key === '+' || event.key === '=') nearer(1.2);
      else if (event.key === '-') nearer(1 / 1.2);
      else if (event.key === 'Home') look_from('slant');
      else return;
      event.preventDefault();
    });
    let held = null;
    canvas.addEventListener('pointerdown', (event) => {
      held = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!held) return;
      const dx = (event.clientX - held[0]) / canvas.clientHeight, dy = (event.clientY - held[1]) / canvas.clientHeight;
      held = [event.clientX, event.clientY];
      event.shiftKey || event.buttons === 4 || event.buttons === 2 ? move(0.6 * dx, 0.6 * dy) : turn(3 * dx, 3 * dy);
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { held = null; });
    // The page scrolls under a wheel until the picture has been chosen.
    canvas.addEventListener('wheel', (event) => {
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      nearer(1.1 ** (-event.deltaY / 100));
    }, {passive: false});
    for (const id of ['axis', 'place', 'cut', 'air', 'colour', 'bodies', 'cloud', 'origin']) {
      const part = by_id(id);
      if (part) part.addEventListener('input', () => { fill(); draw(); });
    }
  };

  // ---- filling ------------------------------------------------------------
  const free = (thing) => { thing.geometry.dispose(); };
  const fill_bodies = () => {
    const {T, bodies, cut} = stage, found = current.surfaces;
    if (!found) return;
    if (bodies.userData.index !== found.index) {
      bodies.children.forEach(free);
      bodies.clear();
      bodies.userData.index = found.index;
      const points = new T.BufferAttribute(found.points, 3);
      for (const [body, first, count] of found.bodies) {
        const shape = new T.BufferGeometry();
        shape.setAttribute('position', points);
        shape.setIndex(new T.BufferAttribute(found.corners.subarray(3 * first, 3 * (first + count)), 1));
        const mesh = new T.Mesh(shape, new T.MeshLambertMaterial({side: T.DoubleSide, flatShading: true, transparent: true}));
        mesh.name = (data.surfaces.names || [])[body] || `body ${body + 1}`;
        // Edges of a copy of its own corners: those of other bodies do not count.
        const edges = new T.LineSegments(new T.EdgesGeometry(shape, 32), new T.LineBasicMaterial({transparent: true}));
        mesh.renderOrder = edges.renderOrder = 1;
        bodies.add(mesh, edges);
      }
    }
    const solid = +by_id('bodies').value, cuts = by_id('cut').value === 'none' ? [] : [cut];
    for (const part of bodies.children) {
      part.visible = solid > 0;
      part.material.clippingPlanes = cuts;
      part.material.color = rgb(Dust.colour(part.isMesh ? 'body' : 'body-line'));
      part.material.opacity = part.isMesh ? solid : Math.min(1, 0.25 + solid);
      part.material.depthWrite = solid > 0.95;
    }
  };
  const tone_of = () => {
    const coarse = set.classes.filter((d, k) => !set.is_dust[k]), span = coarse.length > 1 ? Math.log(coarse.at(-1) / coarse[0]) : 1;
    return (d) => (coarse.length > 1 ? Math.log(d / coarse[0]) / span : 0.4);
  };
  const fill_grains = () => {
    const {T, grains, dust} = stage, frame = current.grains;
    if (!frame) return;
    const by_speed = by_id('colour').value === 'speed', tone = tone_of();
    const of_class = set.classes.map((d) => Dust.sand_colour(tone(d))), of_speed = Array.from({length: 256}, (_, k) => Dust.grain_speed_colour(k / 255));
    const pink = rgb(Dust.colour('dust')).toArray().map((v) => Math.round(255 * v));
    const [x0, z0, x1, z1] = Dust.data.view;
    const put = (points, first, last, is_dust) => {
      const n = last - first, place = new Float32Array(3 * n), radius = new Float32Array(n), tint = new Uint8Array(3 * n);
      for (let k = 0; k < n; ++k) {
        const g = first + k, y = set.depth_bytes === 2 ? (256 * frame.depth[g] + frame.depth_low[g]) / 65535 : (frame.depth[g] + 0.5) / 256;
        place[3 * k] = x0 + frame.x[g] / 65535 * (x1 - x0) - middle[0];
        place[3 * k + 1] = (y - 0.5) * size[1];
        place[3 * k + 2] = z0 + frame.z[g] / 65535 * (z1 - z0) - middle[2];
        radius[k] = set.classes[frame.size[g]] / 2;
        tint.set(is_dust ? pink : by_speed ? of_speed[frame.speed[g]] : of_class[frame.size[g]], 3 * k);
      }
      const shape = points.geometry;
      shape.dispose();
      shape.setAttribute('position', new T.BufferAttribute(place, 3));
      shape.setAttribute('radius', new T.BufferAttribute(radius, 1));
      shape.setAttribute('tint', new T.BufferAttribute(tint, 3, true));
    };
    put(grains, 0, frame.n - frame.dust, false);
    put(dust, frame.n - frame.dust, frame.n, true);
  };
  // The plane stands in the middle of the load, or of the space where there is none.
  const middle_of_load = () => {
    const frame = current.grains, coarse = frame ? frame.n - frame.dust : 0;
    if (coarse === 0) return 0.5;
    return (Array.from(frame.depth.subarray(0, coarse)).sort((a, b) => a - b)[coarse >> 1] + 0.5) / 256;
  };
  // The plane: axis and place, and the two axes within it.
  const plane_of = () => {
    const axis = +by_id('axis').value, share = +by_id('place').value, [u, v] = [[1, 2], [0, 2], [0, 1]][axis];
    return {axis, u, v, at: data.min[axis] + share * size[axis]};
  };
  const fill_slice = () => {
    const {T, slice, threads, rim} = stage, {axis, u, v, at} = plane_of(), shown = by_id('air') ? by_id('air').value : 'none', has_air = shown === 'air';
    by_id('at').textContent = `${'xyz'[axis]} = ${Dust.place_text(at)}`;
    by_id('place').setAttribute('aria-valuetext', by_id('at').textContent);
    const corners = [];
    for (const [a, b] of [[0, 0], [1, 0], [1, 1], [0, 1]]) {
      const p = [0, 0, 0];
      p[axis] = at - middle[axis];
      p[u] = (a - 0.5) * size[u];
      p[v] = (b - 0.5) * size[v];
      corners.push(p);
    }
    const [a, b, c, d] = corners;
    slice.geometry.setAttribute('position', new T.Float32BufferAttribute([...d, ...c, ...a, ...b], 3));
    rim.geometry.setAttribute('position', new T.Float32BufferAttribute([a, b, b, c, c, d, d, a].flat(), 3));
    slice.geometry.computeBoundingSphere();
    rim.geometry.computeBoundingSphere();
    const look = has_air ? (data.air ? slice_of_field(u, v, axis, at) : axis === 1 ? Dust.air && Dust.air.pixels() : null)
      : shown === 'dust' && current.dust ? Dust.space_dust.slice(current.dust, u, v, axis, at) : null;
    slice.visible = threads.visible = Boolean(look);
    if (!look) return;
    if (slice.material.map) slice.material.map.dispose();
    const texture = new T.DataTexture(look.pixels, look.width, look.height);
    texture.magFilter = texture.minFilter = T.LinearFilter;
    // The last blocks of a row reach beyond the plane where blocks do not divide the cells.
    texture.repeat.set(size[u] / (look.width * look.step[0]), size[v] / (look.height * look.step[1]));
    texture.needsUpdate = true;
    slice.material.map = texture;
    // What lies behind the plane shines through where nothing is cut away.
    slice.material.opacity = by_id('cut').value === 'none' && !data.is_thin ? 0.62 : 1;
    slice.material.needsUpdate = true;
    fill_threads(look.velocity, {axis, u, v, at});
  };
  const slice_of_field = (u, v, axis, at) => {
    const field = current.air, {count, origin, step} = data.air, table = Dust.colour_table(Dust.speed_colour, 0);
    const velocity = velocity_of(field), width = count[u], height = count[v], pixels = new Uint8Array(4 * width * height);
    for (let j = 0; j < height; ++j) {
      for (let i = 0; i < width; ++i) {
        const p = [0, 0, 0];
        p[axis] = Math.min(at, data.max[axis] - 1e-6 * size[axis]);
        p[u] = origin[u] + (i + 0.5) * step[u];
        p[v] = origin[v] + (j + 0.5) * step[v];
        const w = velocity(p), to = 4 * (j * width + i);
        if (!w) continue;
        const code = 4 * Math.min(254, Math.round(254 * Math.sqrt(Math.hypot(...w))));
        pixels.set(table.subarray(code, code + 3), to);
        pixels[to + 3] = 215;
      }
    }
    return {pixels, width, height, step: [step[u], step[v]], velocity};
  };
  // Short threads along the air within the plane, as in the maps.
  const fill_threads = (velocity, {axis, u, v, at}) => {
    const {T, threads} = stage, points = [], colours = [], ink = rgb(Dust.colour('ink'));
    const spacing = Math.max(size[u], size[v]) / 42, longest = 2.2 * spacing, steps = 6, lift = 0.002 * whole;
    let seed = 1;
    const random = () => ((seed = (seed * 16807) % 2147483647) / 2147483647);
    for (let a = spacing / 2; velocity && a < size[u]; a += spacing) {
      for (let b = spacing / 2; b < size[v]; b += spacing) {
        const p = [0, 0, 0];
        p[axis] = Math.min(at, data.max[axis] - 1e-6 * size[axis]);
        p[u] = data.min[u] + a + (random() - 0.5) * spacing * 0.8;
        p[v] = data.min[v] + b + (random() - 0.5) * spacing * 0.8;
        for (let k = 0; k < steps; ++k) {
          const w = velocity(p), speed = w ? Math.hypot(w[u], w[v]) : 0;
          if (speed < 0.0015) break;
          const way = longest / steps * Math.sqrt(Math.min(speed, 1)) / speed, next = [...p];
          next[u] += w[u] * way;
          next[v] += w[v] * way;
          for (const q of [p, next]) points.push(...q.map((s, d) => s - middle[d] + (d === axis ? lift * stage_side(axis) : 0)));
          for (const share of [k, k + 1]) colours.push(ink.r, ink.g, ink.b, 0.1 + 0.6 * share / steps);
          p[u] = next[u];
          p[v] = next[v];
        }
      }
    }
    threads.geometry.dispose();
    threads.geometry.setAttribute('position', new T.Float32BufferAttribute(points, 3));
    threads.geometry.setAttribute('color', new T.Float32BufferAttribute(colours, 4));
  };
  const stage_side = (axis) => Math.sign(direction().getComponent(axis)) || 1;
  const fill = () => {
    if (!stage || !current) return;
    fill_bodies();
    fill_grains();
    fill_slice();
    fill_dust();
  };
  const fill_dust = () => {
    const {T, cloud, origin} = stage;
    if (!cloud) return;
    cloud.visible = by_id('cloud').checked && Boolean(current.dust);
    if (cloud.visible) Dust.space_dust.fill(T, cloud, current.dust, Dust.dust_colour, 0.5);
    origin.visible = Boolean(by_id('origin') && by_id('origin').checked && current.set_free);
    if (origin.visible) Dust.space_dust.fill(T, origin, current.set_free, Dust.release_colour, 0.75);
  };

  // ---- drawing ------------------------------------------------------------
  const draw = () => {
    if (!stage || !current || figure.hidden) return;
    const {T, canvas, renderer, camera, eye, cut, grains, dust, frame, rim, cloud, origin} = stage;
    const width = by_id('picture').clientWidth;
    if (width < 80) return;
    const height = Math.round(Math.min(Math.max(width * 0.62, 280), 0.85 * window.innerHeight, 760));
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
      canvas.style.aspectRatio = `${width} / ${height}`;
    }
    camera.aspect = width / height;
    camera.position.copy(direction().multiplyScalar(eye.far || fitting()).add(eye.at));
    camera.lookAt(eye.at);
    camera.updateProjectionMatrix();
    // What lies between the eye and the plane goes.
    const {axis, at} = plane_of(), side = stage_side(axis), local = at - middle[axis];
    cut.normal.set(0, 0, 0).setComponent(axis, -side);
    cut.constant = side * local + 1e-5 * whole;
    for (const points of [grains, dust, cloud, origin].filter(Boolean)) {
      const plane = points.material.uniforms.plane.value;
      if (by_id('cut').value === 'all') plane.set(0, 0, 0, side * local).setComponent(axis, side);
      else plane.set(0, 0, 0, 1);
      points.material.uniforms.height.value = height * ratio;
    }
    frame.material.color = rgb(Dust.colour('line'));
    rim.material.color = rgb(Dust.colour('accent'));
    stage.axes.paint(height);
    renderer.render(stage.scene, camera);
    tell();
  };
  // What a reader who does not see the picture is told.
  const tell = () => {
    const {canvas, eye} = stage, degrees = (v) => Math.round(v * 180 / Math.PI);
    const names = data.surfaces ? [...new Set(current.surfaces.bodies.map(([body]) => Dust.words((data.surfaces.names || [])[body] || '')))].filter(Boolean) : [];
    const g = current.grains;
    const what = Dust.data.kind === 'setup' ? 'The set-up in three dimensions: ' : `The run in three dimensions at ${Dust.number(current.t)} s: `;
    canvas.setAttribute('aria-label', what + [
      names.length ? `bodies ${names.join(', ')}` : '', g ? `${Dust.count(g.n - g.dust)} coarse grains` + (g.dust ? ` and ${Dust.count(g.dust)} of dust` : '') : '',
      `plane ${by_id('at').textContent}`, `seen from ${degrees(eye.up)}° above, ${((degrees(eye.around) % 360) + 360) % 360}° around z from x`].filter(Boolean).join('; '));
  };
  const draw_legends = () => {
    if (set) {
      const by_speed = by_id('colour').value === 'speed', tone = tone_of();
      by_id('scale').replaceChildren();
      if (by_speed) Dust.legend_strip(by_id('scale'), Dust.grain_speed_colour, 0, 0, set.speed, 'm/s', Math.sqrt, false);
      Dust.grains.put_legend(by_id('legend'), by_speed);
    }
    const end = data.air ? data.air.speed : Dust.data.air ? Dust.data.air.speed : 0;
    const strip = by_id('air-scale'), in_plane = by_id('air') ? by_id('air').value : 'none', is_on = in_plane === 'air';
    strip.replaceChildren();
    if (is_on && end > 0) {
      Dust.legend_strip(strip, Dust.speed_colour, 0, 0, end, 'm/s', Math.sqrt, false);
      strip.prepend('Speed of the air');
    }
    const amounts = by_id('dust-scale'), dust = Dust.space_dust;
    amounts.replaceChildren();
    if (dust && (in_plane === 'dust' || by_id('cloud').checked)) dust.legend(amounts, 'Dust in the air', Dust.dust_colour, dust.most);
    if (dust && by_id('origin') && by_id('origin').checked) dust.legend(amounts, 'Dust that came off the load since the start, per volume of space', Dust.release_colour, dust.set_free_most);
  };

  // ---- the switch ---------------------------------------------------------
  // A page of one view has none.
  const switches = document.getElementById('view-side') ? {side: document.getElementById('view-side'), space: document.getElementById('view-space')} : null;
  const take = async (t, index) => ({t, index, surfaces: await surfaces_at(t), air: await air_at(t),
    dust: Dust.space_dust ? await Dust.space_dust.at(t) : null, set_free: Dust.space_dust ? await Dust.space_dust.set_free() : null, velocity_of,
    grains: set && Dust.grains ? await Dust.grains.load(index) : null});
  const start = async () => {
    if (stage) return true;
    try {
      const T = await library();
      stage = build(T);
    } catch (error) {
      // Without WebGL the side view is what there is.
      const text = 'This browser draws nothing in three dimensions (no WebGL).';
      if (switches) Object.assign(switches.space, {disabled: true, title: text});
      else figure.before(Dust.p({class: 'note'}, text));
      return false;
    }
    const {eye} = stage;
    [eye.around, eye.up] = views.slant.map((v) => v * Math.PI / 180);
    listen();
    new ResizeObserver(() => requestAnimationFrame(draw)).observe(by_id('picture'));
    Dust.redraw.push(() => { fill(); draw(); draw_legends(); });
    for (const id of ['colour', 'air', 'cloud', 'origin']) if (by_id(id)) by_id(id).addEventListener('input', draw_legends);
    return true;
  };
  const choose = async (view) => {
    const side = document.getElementById('grains'), is_space = view === 'space' && await start();
    figure.hidden = !is_space;
    if (side) side.hidden = is_space;
    if (switches) for (const name of ['side', 'space']) switches[name].setAttribute('aria-pressed', String(is_space === (name === 'space')));
    if (!is_space || !wanted) return;
    const is_first = !current;
    current = await take(...wanted);
    if (is_first) by_id('place').value = middle_of_load();
    fill();
    draw();
    draw_legends();
    figure.dataset.drawn = 'yes';
  };
  const show = async (index, t) => {
    wanted = [t, index];
    if (figure.hidden) return {take: () => {}, draw: () => {}};
    const next = await take(t, index);
    return {take: () => { current = next; }, draw: () => { fill(); draw(); }};
  };
  if (switches) for (const view of ['side', 'space']) switches[view].addEventListener('click', () => choose(view));
  return {show, choose, first: switches ? document.querySelector('.views').dataset.first : 'space'};
})();
