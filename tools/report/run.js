'use strict';
// A line of contents below the first screen, and the pictures of a run under one clock.
(() => {
  Dust.draw_extraction();
  Dust.draw_liberation();
  Dust.draw_maps();
  if (Dust.draw_setting) Dust.draw_setting();
  const header = document.querySelector('main > header');
  const links = [...document.querySelectorAll('main > section[id]:not([hidden])')].flatMap((section) => {
    const title = section.querySelector('h2');
    return title ? [Dust.el('a', {href: '#' + section.id}, title.textContent)] : [];
  });
  if (links.length > 3) header.append(Dust.el('nav', {class: 'contents screen', 'aria-label': 'Contents'}, ...links));
})();
(() => {
  // report.html#picture: grains and air speed side by side and nothing else, for documents.
  if (/^#picture/.test(location.hash)) {
    document.documentElement.dataset.view = 'picture';
    const legend = document.getElementById('grains-legend');
    if (legend) document.getElementById('grains-picture').after(legend);
  }
  if (/^#scene/.test(location.hash)) document.documentElement.dataset.view = 'scene';
  const times = (Dust.grains || Dust.air || {times: []}).times;
  if (!times.length) {
    document.documentElement.dataset.drawn = 'yes';
    return;
  }
  const nearest = (list, t) => list.reduce((best, value, k) => (Math.abs(value - t) < Math.abs(list[best] - t) ? k : best), 0);
  let wanted = 0;
  const show = async (index) => {
    wanted = index;
    const shows = [];
    if (Dust.grains) shows.push(Dust.grains.show(index));
    if (Dust.air) shows.push(Dust.air.show(nearest(Dust.air.times, times[index])));
    if (Dust.space) shows.push(Dust.space.show(index, times[index]));
    const ready = await Promise.all(shows);
    if (wanted !== index) return;
    // Pictures show grains and air together: all take the new frame before any is drawn.
    for (const shown of ready) shown.take();
    for (const shown of ready) shown.draw();
  };
  // report.html#space, #side: opens with that view; #frame=12 and #space,frame=12 at that frame. #scene: nothing
  // but the picture in three dimensions, for documents.
  const asked = /^#(?:(?:picture|scene|space|side),)?frame=(\d+)$/.exec(location.hash);
  const view = /^#(scene|space|side|picture)/.exec(location.hash);
  const first = async (index) => {
    await show(index);
    if (Dust.space) await Dust.space.choose(!view ? Dust.space.first : view[1] === 'scene' ? 'space' : view[1]);
  };
  let is_first = true;
  const shown = (index) => {
    if (!is_first) return show(index);
    is_first = false;
    return first(index);
  };
  Dust.clock(times, shown, asked ? Math.min(+asked[1], times.length - 1) : times.length - 1);
})();
