'use strict';
// A canvas true to scale over a part of the x-z plane, or of the one of `scene.axes`, with axes in the unit of places. `paint(pen)` draws inside.
Dust.Picture = class {
  constructor(parent, label, paint, scene = Dust.data) {
    this.paint = paint;
    this.scene = scene;
    this.axis_names = scene.axes || ['x', 'z'];
    this.whole = scene.view;
    this.view = [...this.whole];
    this.canvas = Dust.el('canvas', {role: 'img', 'aria-label': label});
    const as_png = Dust.el('button', {type: 'button', 'aria-label': `${label} as PNG`}, 'PNG');
    as_png.addEventListener('click', () => Dust.save_canvas(Dust.file_name(label).slice(0, 60) + '.png', this.canvas));
    this.label = label;
    this.downloads = Dust.el('div', {class: 'downloads screen'}, as_png);
    parent.append(this.canvas, this.downloads);
    this.parent = parent;
    // Drawn in the next frame: a canvas that changes its own box must not do so inside the observer.
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(parent);
    Dust.redraw.push(() => this.draw());
  }
  draw() {
    const left = 44, bottom = 34, right = 6, top = 6;
    const [x0, z0, x1, z1] = this.view;
    const whole = this.whole;
    const width = this.parent.clientWidth;
    if (width < 80) return;
    let inner = width - left - right;
    let height = inner * (whole[3] - whole[1]) / (whole[2] - whole[0]);
    const tallest = Dust.on_paper ? 820 : Math.max(300, Math.min(window.innerHeight * 0.95, 820));
    const shrink = Math.min(1, tallest / height);
    inner *= shrink;
    height *= shrink;
    const ratio = Math.min(window.devicePixelRatio || 1, 3);
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round((height + top + bottom) * ratio);
    this.canvas.style.aspectRatio = `${width} / ${height + top + bottom}`;  // keeps its shape on paper
    const pen = this.canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height + top + bottom);
    const scale = inner / (x1 - x0);
    this.place = {left, top, inner, height, scale};
    this.x = (x) => left + (x - x0) * scale;
    this.z = (z) => top + (z1 - z) * scale;
    pen.save();
    pen.beginPath();
    pen.rect(left, top, inner, height);
    pen.clip();
    this.paint(pen, this);
    pen.restore();
    this.axes(pen);
  }
  axes(pen) {
    const {left, top, inner, height} = this.place;
    const [x0, z0, x1, z1] = this.view;
    pen.strokeStyle = Dust.colour('line');
    pen.lineWidth = 1;
    pen.strokeRect(left - 0.5, top - 0.5, inner + 1, height + 1);
    pen.fillStyle = Dust.colour('soft');
    pen.font = '11px ' + Dust.colour('sans');
    pen.textAlign = 'center';
    pen.textBaseline = 'top';
    const {unit, factor} = Dust.places;
    for (const x of Dust.ticks(x0 / factor, x1 / factor, inner / 70)) {
      const at = this.x(x * factor);
      pen.fillRect(at - 0.5, top + height, 1, 4);
      if (at < left + inner - 48) pen.fillText(Dust.number(x), at, top + height + 7);
    }
    pen.textAlign = 'right';
    const [right, up] = this.axis_names;
    pen.fillText(`${right}, ${unit}`, left + inner, top + height + 7);
    pen.textBaseline = 'middle';
    for (const z of Dust.ticks(z0 / factor, z1 / factor, height / 60)) {
      const at = this.z(z * factor);
      pen.fillRect(left - 5, at - 0.5, 4, 1);
      if (at > top + 24) pen.fillText(Dust.number(z), left - 8, Math.min(at, top + height - 5));
    }
    pen.textBaseline = 'top';
    pen.fillText(`${up}, ${unit}`, left - 8, top);
  }
  bodies(pen) {
    pen.fillStyle = Dust.colour('body');
    pen.strokeStyle = Dust.colour('body-line');
    pen.lineWidth = 1.2;
    pen.lineJoin = 'round';
    for (const body of this.scene.bodies) {
      // One path: no seams between the rows.
      pen.beginPath();
      for (const [x0, z0, x1, z1] of body.section || []) pen.rect(this.x(x0), this.z(z1), this.x(x1) - this.x(x0), this.z(z0) - this.z(z1));
      pen.fill();
      for (const ring of body.polygons) {
        pen.beginPath();
        ring.forEach(([x, z], k) => (k ? pen.lineTo(this.x(x), this.z(z)) : pen.moveTo(this.x(x), this.z(z))));
        pen.closePath();
        pen.fill();
        pen.stroke();
      }
      pen.beginPath();
      for (const [xa, za, xb, zb] of body.segments) {
        pen.moveTo(this.x(xa), this.z(za));
        pen.lineTo(this.x(xb), this.z(zb));
      }
      pen.stroke();
      const flat = body.triangles;
      pen.beginPath();
      for (let k = 0; k + 5 < flat.length; k += 6) {
        pen.moveTo(this.x(flat[k]), this.z(flat[k + 1]));
        pen.lineTo(this.x(flat[k + 2]), this.z(flat[k + 3]));
        pen.lineTo(this.x(flat[k + 4]), this.z(flat[k + 5]));
        pen.closePath();
      }
      if (flat.length) pen.fill();
    }
  }
  // What lies under the pointer, `read(x, z)` as a text, and the numbers of the picture as a file, `table()` as [heads, columns].
  tell(read, table) {
    const reading = Dust.el('span', {class: 'reading'});
    const as_csv = Dust.el('button', {type: 'button', 'aria-label': `${this.label} as CSV`}, 'CSV');
    as_csv.addEventListener('click', () => Dust.save(Dust.file_name(this.label).slice(0, 60) + '.csv', new Blob([Dust.csv(...table())], {type: 'text/csv'})));
    this.downloads.prepend(as_csv);
    this.downloads.append(reading);
    this.canvas.addEventListener('pointermove', (event) => {
      const box = this.canvas.getBoundingClientRect(), {left, top, inner, height, scale} = this.place;
      const across = event.clientX - box.left - left, down = event.clientY - box.top - top;
      const is_inside = across >= 0 && down >= 0 && across <= inner && down <= height;
      reading.textContent = is_inside ? read(this.view[0] + across / scale, this.view[3] - down / scale) : '';
    });
    this.canvas.addEventListener('pointerleave', () => { reading.textContent = ''; });
  }
  // The same of a map. `grid`: {nx, nz, x0, z0, dx, dz}; `value(k)` of its cell k, rows of x from below, or null where
  // there is none.
  tell_values(name, unit, grid, value) {
    const read = (x, z) => {
      const i = Math.floor((x - grid.x0) / grid.dx), j = Math.floor((z - grid.z0) / grid.dz);
      const here = i >= 0 && j >= 0 && i < grid.nx && j < grid.nz ? value(j * grid.nx + i) : null;
      return here === null ? '' : `${this.axis_names[0]}\u202f${Dust.place_number(x)}, ${this.axis_names[1]}\u202f${Dust.place_text(z)}: ${Dust.number(here, 2)}\u202f${unit}`;
    };
    const places = Dust.places, place = (first, step) => (n) => +((first + (n + 0.5) * step) / places.factor).toPrecision(6);
    const x = place(grid.x0, grid.dx), z = place(grid.z0, grid.dz);
    this.tell(read, () => {
      const cells = Array.from({length: grid.nx * grid.nz}, (_, k) => k).filter((k) => value(k) !== null);
      return [[...this.axis_names.map((axis) => `${axis}, ${places.unit}`), `${name}, ${unit}`],
        [cells.map((k) => x(k % grid.nx)), cells.map((k) => z(Math.floor(k / grid.nx))), cells.map((k) => +value(k).toPrecision(3))]];
    });
  }
  // Double-click or + looks closer, dragging or the arrow keys move; `whole_view` undoes both.
  make_zoomable() {
    const canvas = this.canvas;
    const point = (event) => {
      const box = canvas.getBoundingClientRect();
      const {left, top, scale} = this.place;
      return [this.view[0] + (event.clientX - box.left - left) / scale,
        this.view[3] - (event.clientY - box.top - top) / scale];
    };
    const show = (x0, z0, factor) => {
      const [w0, w1, w2, w3] = this.whole;
      const width = (w2 - w0) * factor, height = (w3 - w1) * factor;
      x0 = Math.min(Math.max(x0, w0), w2 - width);
      z0 = Math.min(Math.max(z0, w1), w3 - height);
      this.view = [x0, z0, x0 + width, z0 + height];
      this.draw();
    };
    const factor = () => (this.view[2] - this.view[0]) / (this.whole[2] - this.whole[0]);
    canvas.addEventListener('dblclick', (event) => {
      const [x, z] = point(event);
      closer(x, z, 2.2);
    });
    let start = null;
    canvas.addEventListener('pointerdown', (event) => {
      if (factor() < 0.999) {
        start = {x: event.clientX, y: event.clientY, view: [...this.view]};
        canvas.setPointerCapture(event.pointerId);
      }
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!start) return;
      const {scale} = this.place;
      show(start.view[0] - (event.clientX - start.x) / scale, start.view[1] + (event.clientY - start.y) / scale, factor());
    });
    canvas.addEventListener('pointerup', () => { start = null; });
    const closer = (x, z, times) => {
      const f = Math.min(Math.max(factor() / times, 1 / 60), 1);
      const [a, b, c, d] = this.whole;
      show(x - (c - a) * f / 2, z - (d - b) * f / 2, f);
    };
    canvas.tabIndex = 0;
    canvas.addEventListener('keydown', (event) => {
      const [x0, z0, x1, z1] = this.view;
      const step = 0.15 * (x1 - x0);
      const moves = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
      const middle = [(x0 + x1) / 2, (z0 + z1) / 2];
      if (event.key === '+' || event.key === '=') closer(...middle, 1.5);
      else if (event.key === '-') closer(...middle, 1 / 1.5);
      else if (event.key === '0' || event.key === 'Escape') this.whole_view();
      else if (moves[event.key] && factor() < 0.999) show(x0 + moves[event.key][0], z0 + moves[event.key][1], factor());
      else return;
      event.preventDefault();
    });
    this.whole_view = () => {
      this.view = [...this.whole];
      this.draw();
    };
  }
};

// A numbered place on a picture.
Dust.ring = (pen, x, z, text) => {
  pen.strokeStyle = pen.fillStyle = Dust.colour('ink');
  pen.lineWidth = 1.4;
  pen.beginPath();
  pen.arc(x, z, 7, 0, 6.2832);
  pen.stroke();
  pen.font = '11px ' + Dust.colour('sans');
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  pen.fillText(text, x + 10, z);
};
