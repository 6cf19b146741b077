'use strict';
// The task graph, drawn by nomnoml from the run's DOT text once somebody opens it.
(() => {
  const text = Dust.data.graph_dot, place = document.getElementById('graph-picture');
  if (!text || !place) return;
  const name = '("(?:[^"\\\\]|\\\\.)*"|[\\w.]+)';
  const bare = (quoted) => quoted.replace(/^"|"$/g, '').replace(/\\(.)/g, '$1');
  const nodes = new Map(), edges = [];
  const node = (id) => {
    if (!nodes.has(id)) nodes.set(id, {id, lines: [id], from: new Set(), to: new Set()});
    return nodes.get(id);
  };
  for (const line of text.split(/[;\n]/)) {
    const edge = new RegExp(`^\\s*${name}\\s*->\\s*${name}`).exec(line);
    const labelled = new RegExp(`^\\s*${name}\\s*\\[.*?label\\s*=\\s*${name}`).exec(line);
    if (edge) {
      const [a, b] = [node(bare(edge[1])), node(bare(edge[2]))];
      edges.push([a, b, /style=dashed/.test(line)]);
      a.to.add(b.id);
      b.from.add(a.id);
    } else if (labelled && !/^\s*(graph|node|edge)\b/.test(line)) {
      node(bare(labelled[1])).lines = labelled[2].replace(/^"|"$/g, '').split(/\\[nlr]/).filter(Boolean);
    }
  }
  if (!edges.length) return;

  // Nodes that wait for the same and that nothing waits for, sensors as a rule, share a box.
  const shared = new Map();
  for (const n of nodes.values()) {
    const key = n.to.size ? n.id : 'after\n' + [...n.from].sort().join('\n');
    if (!shared.has(key)) shared.set(key, []);
    shared.get(key).push(n);
  }
  const heads = new Map();  // of each node, the one whose box it is in
  for (const group of shared.values()) for (const n of group) heads.set(n.id, group[0]);
  const plain = (line) => Dust.words(line).replace(/[[\]|;\\<>#]/g, ' ');
  const box = (n) => `[<task id=${[...nodes.keys()].indexOf(n.id)}>`;
  const full = (group) => {
    if (group.length === 1) return box(group[0]) + group[0].lines.map(plain).join('|') + ']';
    return box(group[0]) + Dust.plural(group.length, 'node') + '|' + group.map((n) => n.lines.map(plain).join(', ')).join('\n') + ']';
  };
  const arrows = new Set(edges.map(([a, b, is_dashed]) => `${box(heads.get(a.id))}] ${is_dashed ? '-->' : '->'} ${box(heads.get(b.id))}]`));
  const source = () => [`#direction: down`, `#font: ${Dust.colour('sans').split(',')[0].replace(/["']/g, '')}`, '#fontSize: 11', '#lineWidth: 1', '#arrowSize: 0.7', '#padding: 6',
    '#spacing: 26', '#gutter: 6', `#stroke: ${Dust.colour('ink')}`, `#.task: fill=${Dust.colour('raised')} stroke=${Dust.colour('soft')} title=bold,center body=center`,
    ...[...shared.values()].map(full), ...arrows].join('\n');

  const library = async () => {
    for (const name of ['graphre', 'nomnoml']) {
      if (!window[name]) document.head.append(Dust.el('script', {}, new TextDecoder().decode(await Dust.unpack(document.getElementById('code-' + name).textContent))));
    }
    return window.nomnoml;
  };
  const canvas = Dust.el('canvas', {role: 'img', 'aria-label': `The task graph: ${Dust.plural(nodes.size, 'node')}; as text below`});
  const as_png = Dust.el('button', {type: 'button', 'aria-label': 'The task graph as PNG'}, 'PNG');
  as_png.addEventListener('click', () => Dust.save_canvas('task_graph.png', canvas));
  const details = place.closest('details');
  const draw = async () => {
    if (!details.open) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 3);
    (await library()).draw(canvas, source(), ratio);
    canvas.style.cssText = `display:block;max-width:none;width:${canvas.width / ratio}px;height:auto`;
    if (!canvas.isConnected) place.append(canvas, Dust.el('div', {class: 'downloads screen'}, as_png));
  };
  details.addEventListener('toggle', draw);
  Dust.redraw.push(draw);
})();
