'use strict';
// The task graph as a picture: nodes in the layer of their longest way from a start, edges downward.
(() => {
  const text = Dust.data.graph_dot, place = document.getElementById('graph-picture');
  if (!text || !place) return;
  const name = '("(?:[^"\\\\]|\\\\.)*"|[\\w.]+)';
  const bare = (quoted) => quoted.replace(/^"|"$/g, '').replace(/\\(.)/g, '$1');
  const nodes = new Map(), edges = [];
  const node = (id) => {
    if (!nodes.has(id)) nodes.set(id, {id, label: id, layer: 0});
    return nodes.get(id);
  };
  for (const line of text.split(/[;\n]/)) {
    const edge = new RegExp(`^\\s*${name}\\s*->\\s*${name}`).exec(line);
    const labelled = new RegExp(`^\\s*${name}\\s*\\[.*?label\\s*=\\s*${name}`).exec(line);
    if (edge) edges.push([node(bare(edge[1])), node(bare(edge[2]))]);
    else if (labelled && !/^\s*(graph|node|edge)\b/.test(line)) node(bare(labelled[1])).label = labelled[2].replace(/^"|"$/g, '');
  }
  if (!edges.length || nodes.size > 80) return;
  // Repeated as often as there are nodes; a cycle, which a task graph has not, would only stop it.
  for (let k = 0; k < nodes.size; ++k) for (const [from, to] of edges) to.layer = Math.min(Math.max(to.layer, from.layer + 1), nodes.size);
  const layers = [];
  for (const n of nodes.values()) (layers[n.layer] ||= []).push(n);
  const rows = layers.filter(Boolean);
  const lines_of = (n) => n.label.split(/\\[nlr]|\n/).filter(Boolean);
  const width = (n) => Math.max(...lines_of(n).map((l) => l.length), 4) * 7 + 22;
  const step = 74, gap = 22;
  const total = Math.max(...rows.map((row) => row.reduce((sum, n) => sum + width(n) + gap, -gap)));
  const svg = (tag, attributes, content) => {
    const item = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) item.setAttribute(key, value);
    if (content !== undefined) item.textContent = content;
    return item;
  };
  const root = svg('svg', {viewBox: `-4 -4 ${total + 8} ${rows.length * step - 20}`, role: 'img', 'aria-label': 'The task graph',
    style: `display:block;width:${total + 8}px;max-width:none;margin:14px 0`});
  rows.forEach((row, r) => {
    let x = (total - row.reduce((sum, n) => sum + width(n) + gap, -gap)) / 2;
    for (const n of row) {
      n.x = x;
      n.y = r * step;
      x += width(n) + gap;
    }
  });
  for (const [from, to] of edges) {
    const a = from.x + width(from) / 2, b = to.x + width(to) / 2, y0 = from.y + 42, y1 = to.y, mid = (y0 + y1) / 2;
    root.append(svg('path', {d: `M${a},${y0}C${a},${mid} ${b},${mid} ${b},${y1}`, style: 'fill:none;stroke:var(--body-line);stroke-width:1'}));
    root.append(svg('path', {d: `M${b - 3.5},${y1 - 6}L${b},${y1}L${b + 3.5},${y1 - 6}`, style: 'fill:none;stroke:var(--body-line);stroke-width:1'}));
  }
  for (const n of nodes.values()) {
    root.append(svg('rect', {x: n.x, y: n.y, width: width(n), height: 42, rx: 6, style: 'fill:var(--raised);stroke:var(--line)'}));
    const lines = lines_of(n).slice(0, 2);
    lines.forEach((line, k) => root.append(svg('text', {x: n.x + width(n) / 2, y: n.y + (lines.length === 1 ? 26 : 18 + 16 * k), 'text-anchor': 'middle',
      style: k ? '' : 'fill:var(--ink)'}, line)));
  }
  place.append(root);
})();
