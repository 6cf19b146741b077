'use strict';
// The pieces that pages are made of. What comes from a run enters as text, never as markup.
// `Dust.later` holds what is drawn once the page stands.
Dust.sections = {};  // id: (data) => the section, or null where the run has nothing to say

Dust.section = (id, title, ...children) => Dust.el('section', {id, 'aria-labelledby': id + '-title'},
  Dust.el('h2', {id: id + '-title'}, title), ...children.flat().filter(Boolean));
Dust.p = (attributes, ...children) => Dust.el('p', attributes, ...children.flat());
Dust.strong = (text, look) => Dust.el('strong', look ? {class: look} : {}, text);

// A table: columns [{title, number, hidden}], rows of cells (texts or nodes); the first cell heads its row.
// A row {group: title} spans all columns.
Dust.table = (columns, rows, {look = '', label = ''} = {}) => {
  if (!rows.length) return null;
  const place = (column) => (column.number ? {class: 'n'} : {});
  const head = columns.map((c) => (c.title === '' ? Dust.el('td', {}) : Dust.el('th', {scope: 'col', ...place(c)}, c.title)));
  const body = rows.map((row) => {
    if (row.group !== undefined) {
      return Dust.el('tr', {class: 'group'}, Dust.el('th', {colspan: columns.length, scope: 'rowgroup'}, row.group));
    }
    return Dust.el('tr', {}, ...row.map((cell, k) => {
      if (k === 0) return Dust.el('th', {scope: 'row', ...place(columns[0])}, cell);
      const is_bar = cell instanceof Node && cell.dataset && cell.dataset.bar;
      return Dust.el('td', is_bar ? {class: 'bar'} : place(columns[k]), cell === null || cell === undefined ? '' : cell);
    }));
  });
  return Dust.el('div', {class: 'scroll', tabindex: 0, role: 'group', 'aria-label': label || 'Table'},
    Dust.el('table', look ? {class: look} : {}, Dust.el('thead', {}, Dust.el('tr', {}, ...head)), Dust.el('tbody', {}, ...body)));
};
// Names with values.
Dust.facts = (rows, label = 'Facts') => Dust.el('div', {class: 'scroll', tabindex: 0, role: 'group', 'aria-label': label},
  Dust.el('table', {class: 'facts'}, Dust.el('tbody', {}, ...rows.map(([name, text]) =>
    Dust.el('tr', {}, Dust.el('th', {scope: 'row'}, name), Dust.el('td', {}, text))))));
Dust.details = (title, small, ...children) => Dust.el('details', {}, Dust.el('summary', {}, title,
  small ? Dust.el('small', {}, small) : ''), ...children);
Dust.tiles = (tiles, look = '') => {
  const shown = tiles.filter(Boolean);
  if (!shown.length) return null;
  return Dust.el('dl', {class: 'tiles ' + look}, ...shown.map(([name, value, note]) => Dust.el('div', {class: 'tile'},
    Dust.el('dt', {}, name), Dust.el('dd', {}, Dust.el('b', {}, value), note ? Dust.el('span', {}, note) : ''))));
};
Dust.bar = (share, look) => (share > 0 ? Dust.el('i', {class: 'bar ' + look, style: 'width:' + Dust.width(share), 'data-bar': 1}) : '');
Dust.error_bar = (share, error, look) => {
  const bar = Dust.bar(share, look);
  if (!bar || !(error > 0)) return bar;
  const low = Math.max(share - error, 0), high = Math.min(share + error, 1);
  return Dust.el('span', {class: 'errorbar', 'data-bar': 1}, bar,
    Dust.el('s', {style: `left:${Dust.width(low)};width:${Dust.width(high - low)}`}));
};
// A figure of summary.json or of the document: {value, uncertainty, unit}.
// Why a figure has no error stands in its place.
Dust.lacks_error = (figure) => figure.no_error && figure.value !== 0;
Dust.why_no_error = (figure) => (Dust.lacks_error(figure) ? ` (${figure.no_error})` : '');
Dust.amount = (figure, none = Dust.dash) => (figure ? Dust.quantity(figure.value, figure.uncertainty, figure.unit) + Dust.why_no_error(figure) : none);

// The top of a page: kind, scenario, status, the switch of the theme and the title.
Dust.heading = ({kind, scenario, status, title}) => {
  document.title = `${title} – ${kind.toLowerCase()}`;
  return [Dust.el('p', {class: 'eyebrow'}, Dust.el('img', {class: 'logo', src: document.getElementById('logo').content, alt: ''}),
    Dust.el('span', {}, kind), scenario ? Dust.el('span', {}, scenario) : '',
    status ? Dust.el('span', {class: 'status ' + (status === 'finished' || status === 'running' ? 'good' : 'bad')}, status) : '',
    Dust.el('button', {type: 'button', id: 'theme', hidden: ''}, 'Dark')),
  Dust.el('h1', {}, title)];
};
// A table as a sensor gives it.
Dust.plain_table = (table) => Dust.table(table.columns.map((title) => ({title: String(title), number: true})),
  table.rows.map((cells) => cells.map((cell) => (typeof cell === 'number' ? Dust.number(cell, 5) : cell === null ? Dust.dash : String(cell)))),
  {label: table.title});
